"""`.. python-package::` documents the Python package from its docstrings by autodoc, if it was built."""

import importlib
import pkgutil
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
            text = ("The Python package was not built when this site was made. Until then, Python starts the command and "
                    "reads its files: summary.json by json, and CSV files by csv, numpy or pandas.")
            return [nodes.admonition("", nodes.title("", "Not built"), nodes.paragraph("", text))]
        try:
            package = importlib.import_module("wavebalance")
        except ImportError as error:
            raise ExtensionError(f"the Python package is there but cannot be imported: {error}") from error
        lines = [".. automodule:: wavebalance", "   :members:", "   :imported-members:", ""]
        for module in pkgutil.iter_modules(package.__path__, "wavebalance."):
            if not module.name.rsplit(".", 1)[1].startswith("_"):
                lines += [f".. automodule:: {module.name}", "   :members:", "   :no-index:", ""]
        content = StringList(lines, source="python-package")
        holder = nodes.section()
        holder.document = self.state.document
        self.state.nested_parse(content, 0, holder)
        return holder.children


def setup(app):
    app.add_directive("python-package", PythonPackage)
    app.connect("config-inited", add_to_path)
