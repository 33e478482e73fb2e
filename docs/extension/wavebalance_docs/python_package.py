"""`.. python-package::` documents the Python package from its docstrings by autodoc, if it was built."""

import importlib
import re
import sys

from docutils import nodes
from docutils.parsers.rst import Directive
from docutils.statemachine import StringList
from sphinx.errors import ExtensionError


def add_to_path(app, config):
    if config.wavebalance_python:
        sys.path.insert(0, config.wavebalance_python)


class PythonPackage(Directive):
    def run(self):
        env = self.state.document.settings.env
        if not env.app.config.wavebalance_python:
            return [not_built()]
        try:
            importlib.import_module("wavebalance")
        except ImportError as error:
            raise ExtensionError(f"the Python package is there but cannot be imported: {error}") from error
        lines = []
        for module in ("wavebalance", "wavebalance.wavelets"):
            lines += [f".. automodule:: {module}", "   :members:", "   :imported-members:", "   :show-inheritance:", ""]
        content = StringList(lines, source="python-package")
        holder = nodes.section()
        holder.document = self.state.document
        self.state.nested_parse(content, 0, holder)
        return holder.children


class IfPython(Directive):
    """`.. if-python::` shows its content, and runs the examples in it, if the package was built."""

    has_content = True

    def run(self):
        env = self.state.document.settings.env
        if not env.app.config.wavebalance_python:
            return [not_built()]
        holder = nodes.section()
        holder.document = self.state.document
        self.state.nested_parse(self.content, self.content_offset, holder, match_titles=True)
        return holder.children


def not_built():
    text = ("The Python package was not built when this site was made. Until then, Python starts the command and reads its "
            "files: summary.json by json, and CSV files by csv, numpy or pandas.")
    return nodes.admonition("", nodes.title("", "Not built"), nodes.paragraph("", text))


def keep_names_together(app, what, name, obj, options, lines):
    """Several names of one attribute entry, which would otherwise be read as a type and a name."""
    for number, line in enumerate(lines):
        found = re.match(r"^:(ivar|vartype) (\w+(?:, \w+)+):(.*)$", line)
        if found:
            lines[number] = f":{found.group(1)} {found.group(2).replace(', ', ',' + chr(0x200b))}:{found.group(3)}"


def setup(app):
    app.connect("autodoc-process-docstring", keep_names_together, priority=600)
    app.add_directive("python-package", PythonPackage)
    app.add_directive("if-python", IfPython)
    app.connect("config-inited", add_to_path)
