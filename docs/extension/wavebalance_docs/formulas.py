"""Formulas as TeX in elements of class `formula`, which static/site.js sets by KaTeX. Its files are copied into the
site, so that pages need no network; without scripts the TeX is there to read."""

import shutil
from html import escape
from pathlib import Path


def visit_inline(self, node):
    self.body.append(f'<span class="formula">{escape(node.astext())}</span>')
    raise_skip()


def visit_display(self, node):
    anchors = "".join(f'<span id="{escape(name)}"></span>' for name in node.get("ids", []))
    text = node.astext().strip()
    if "\\\\" in text or "&" in text:
        text = f"\\begin{{aligned}}{text}\\end{{aligned}}"
    self.body.append(f'{anchors}<div class="formula display">{escape(text)}</div>')
    raise_skip()


def raise_skip():
    from docutils.nodes import SkipNode
    raise SkipNode


def copy_katex(app, error):
    if error or app.builder.format != "html":
        return
    source = Path(app.config.wavebalance_katex)
    target = Path(app.outdir) / "_static" / "katex"
    shutil.rmtree(target, ignore_errors=True)
    target.mkdir(parents=True)
    for name in ("katex.min.js", "katex.min.css"):
        shutil.copy(source / name, target / name)
    shutil.copytree(source / "fonts", target / "fonts")


def setup(app):
    app.add_config_value("wavebalance_katex", "", "html")
    app.add_html_math_renderer("katex", (visit_inline, None), (visit_display, None))
    app.connect("build-finished", copy_katex)
