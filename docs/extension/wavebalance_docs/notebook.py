"""`.. notebook:: python/examples/first_curve.ipynb` runs the cells of a notebook of the sources and shows them with what they leave."""

import json
import subprocess
from pathlib import Path

from docutils import nodes
from docutils.parsers.rst import Directive
from sphinx.errors import ExtensionError

from wavebalance_docs.commands import MAX_SECONDS, environment, work_folder
from wavebalance_docs.readme import Markdown


class Notebook(Directive):
    required_arguments = 1

    def run(self):
        env = self.state.document.settings.env
        source = Path(env.app.config.wavebalance_source)
        file = source / self.arguments[0]
        env.note_dependency(str(file))
        result = []
        for cell in cells_of(env, source / "python" / "run_notebook.py", file):
            if cell["kind"] == "markdown":
                result += Markdown(lambda link: link, lambda link, alt: nodes.Text(alt)).blocks(cell["source"].split("\n"))
                continue
            result.append(nodes.literal_block(cell["source"], cell["source"], language="python"))
            if cell["text"]:
                text = cell["text"].rstrip("\n")
                result.append(nodes.literal_block(text, text, language="text", classes=["console"]))
            if cell["html"]:
                result.append(nodes.container("", nodes.raw("", cell["html"], format="html"), classes=["picture"]))
        return result


def cells_of(env, program, file):
    done = subprocess.run(["python3", str(program), str(file)], cwd=work_folder(env), env=environment(env.app), text=True,
                          capture_output=True, timeout=MAX_SECONDS)
    if done.returncode != 0:
        raise ExtensionError(f"{env.docname}: {file} ended with {done.returncode}:\n{done.stderr}")
    return json.loads(done.stdout)


def setup(app):
    app.add_directive("notebook", Notebook)
