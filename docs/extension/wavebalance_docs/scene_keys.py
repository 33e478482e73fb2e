"""`.. scene-keys::` lists all keys of a scene from `wavebalance keys`, so that this reference agrees with the
program."""

import re

from docutils import nodes
from docutils.parsers.rst import Directive
from sphinx import addnodes
from sphinx.errors import ExtensionError

from wavebalance_docs.commands import run_command


def read_keys(text):
    """Sections in order, each a list of (key, paragraphs) as `wavebalance keys` prints them."""
    sections = []
    for line in text.split("\n"):
        if re.match(r"^\[.*\]", line):
            sections.append((line.strip(), []))
        elif re.match(r"^  [a-z]", line) and sections:
            sections[-1][1].append((line.strip(), []))
        elif line.startswith("      ") and sections and sections[-1][1]:
            sections[-1][1][-1][1].append(line.strip())
        elif line.strip() and sections and not sections[-1][1]:
            sections[-1][1].append(("", [line.strip()]))
        elif line.strip():
            sections.append(("", [("", [line.strip()])]))
    return sections


def split_description(lines):
    """Description and the sentence on type, range and default, which begins behind the last full stop."""
    for i in range(len(lines) - 1, 0, -1):
        if lines[i - 1].endswith("."):
            return " ".join(lines[:i]), " ".join(lines[i:])
    return " ".join(lines), ""


class SceneKeys(Directive):
    def run(self):
        env = self.state.document.settings.env
        sections = read_keys(run_command(env, "wavebalance keys", 0))
        if len(sections) < 5 or sum(len(keys) for _, keys in sections) < 40:
            raise ExtensionError("`wavebalance keys` prints no list of keys that this extension can read")
        result = []
        for name, keys in sections:
            result += self.section(name, keys) if name else self.text(keys)
        return result

    def text(self, keys):
        return [nodes.paragraph("", " ".join(lines)) for _, lines in keys]

    def section(self, name, keys):
        plain = re.match(r"\[+([a-z_.]*)", name).group(1)
        section = nodes.section(ids=[f"keys-{plain.replace('.', '-').replace('_', '-')}"], names=[name])
        section += nodes.title("", "", nodes.literal(name, name))
        entries = nodes.definition_list(classes=["keys"])
        for key, lines in keys:
            if not key:
                section += nodes.paragraph("", " ".join(lines))
                continue
            anchor = f"key-{plain}-{key}".replace("_", "-").replace(".", "-")
            description, kind = split_description(lines)
            index = addnodes.index(entries=[("single", f"{plain}.{key} (key)", anchor, "", None)])
            term = nodes.term("", "", nodes.literal(key, key), ids=[anchor])
            body = nodes.definition("", nodes.paragraph("", description))
            if kind:
                body += nodes.paragraph("", kind, classes=["quiet"])
            entries += nodes.definition_list_item("", term, body)
            section += index
        section += entries
        return [section]


def setup(app):
    app.add_directive("scene-keys", SceneKeys)
