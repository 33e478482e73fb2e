"""Runs the cells of a notebook in their order, without Jupyter, and prints what each leaves as JSON.

    run_notebook.py FILE

Each entry of the list has `kind` ("markdown" or "code") and `source`; of code also `text`, what it printed or its last
expression as text, and `html`, that expression's picture where it has one. A cell that raises ends the program.
"""

from __future__ import annotations

import ast
import contextlib
import io
import json
import pathlib
import sys
from typing import Any


def run_cell(source: str, names: dict[str, Any]) -> dict[str, str]:
    tree = ast.parse(source)
    last = ast.Expression(tree.body.pop().value) if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    printed = io.StringIO()
    value = None
    with contextlib.redirect_stdout(printed):
        exec(compile(tree, "<cell>", "exec"), names)
        if last is not None:
            value = eval(compile(last, "<cell>", "eval"), names)
    html = value._repr_html_() if hasattr(value, "_repr_html_") else ""
    text = printed.getvalue()
    if value is not None and not html:
        text += repr(value) + "\n"
    return {"text": text, "html": html or ""}


def run_notebook(file: pathlib.Path) -> list[dict[str, str]]:
    names: dict[str, Any] = {"__name__": "__main__"}
    done = []
    for cell in json.loads(file.read_text())["cells"]:
        source = "".join(cell["source"])
        entry = {"kind": cell["cell_type"], "source": source}
        if cell["cell_type"] == "code":
            entry.update(run_cell(source, names))
        done.append(entry)
    return done


if __name__ == "__main__":
    if len(sys.argv) != 2:
        raise SystemExit(__doc__)
    del sys.path[0]  # this folder, where the package has no compiled module
    print(json.dumps(run_notebook(pathlib.Path(sys.argv[1]))))
