"""Directives that run the examples of a page while the site is made, and show what they write.

Each page has a separate folder. `run` runs its commands there in the order of the page, `file` writes files, and
`picture`, `result-table` and the role `value` read results. A command with an unexpected exit code stops the build.
"""

import csv
import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from docutils import nodes
from docutils.parsers.rst import Directive, directives
from sphinx.errors import ExtensionError

MAX_SECONDS = 120
PROGRESS = re.compile(r"^[a-z ]+: step \d+(, .*)?\n", re.MULTILINE)  # of a run that took seconds, on a busy machine


def work_folder(env, create=True):
    """The folder in which the examples of the page that is being read run."""
    folder = Path(env.app.config.wavebalance_work) / env.docname.replace("/", "_")
    if create:
        folder.mkdir(parents=True, exist_ok=True)
    return folder


def empty_work_folder(app, docname, source):
    folder = Path(app.config.wavebalance_work) / docname.replace("/", "_")
    shutil.rmtree(folder, ignore_errors=True)


def make_programs(app):
    """A folder for PATH with the command, the programs of the examples and the Python that runs Sphinx."""
    folder = Path(app.config.wavebalance_work) / "programs"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    (folder / "python3").symlink_to(sys.executable)
    for program in app.config.wavebalance_programs:
        if not Path(program).is_file():
            raise ExtensionError(f"{program}: no such program; `make docs` builds it")
        (folder / Path(program).name).symlink_to(program)


def environment(app):
    values = dict(os.environ)
    values["PATH"] = f"{app.config.wavebalance_work}/programs{os.pathsep}{values.get('PATH', '')}"
    values["COLUMNS"] = "100"
    values["OPENBLAS_NUM_THREADS"] = "1"
    if app.config.wavebalance_python:
        values["PYTHONPATH"] = app.config.wavebalance_python
    return values


def answer(env, command):
    """Exit code and output, including errors, of a shell command in the folder of the page."""
    try:
        done = subprocess.run(["sh", "-e", "-c", command], cwd=work_folder(env), env=environment(env.app), text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=MAX_SECONDS)
    except subprocess.TimeoutExpired as error:
        raise ExtensionError(f"{env.docname}: `{command}` took more than {MAX_SECONDS} s") from error
    return done.returncode, done.stdout


def run_command(env, command, expected):
    """The output of a command that has to end with the expected exit code."""
    code, output = answer(env, command)
    if code != expected:
        raise ExtensionError(f"{env.docname}: `{command}` ended with {code} in place of {expected}:\n{output}")
    return output


def shortened(text, limit):
    lines = text.rstrip("\n").split("\n")
    if limit and len(lines) > limit:
        lines = lines[:limit] + ["..."]
    return "\n".join(lines)


class Run(Directive):
    """`.. run::` with one shell command per line; shows commands and output. `:silent:` shows only the commands and
    `:hidden:` nothing, `:lines:` limits the lines shown per command, `:exit:` is the expected exit code."""

    has_content = True
    option_spec = {"exit": directives.nonnegative_int, "lines": directives.positive_int, "silent": directives.flag,
                   "hidden": directives.flag}

    def run(self):
        env = self.state.document.settings.env
        text = re.sub(r"\\\n\s*", "", "\n".join(self.content))
        shown = []
        for command in filter(str.strip, text.split("\n")):
            output = PROGRESS.sub("", run_command(env, command, self.options.get("exit", 0)))
            shown.append(f"$ {command}")
            if "silent" not in self.options and output.strip():
                shown.append(shortened(output, self.options.get("lines")))
        if "hidden" in self.options:
            return []
        block = nodes.literal_block("\n".join(shown), "\n".join(shown), language="console", classes=["console"])
        return [block]


class File(Directive):
    """`.. file:: name` writes its content into the folder of the page and shows it; `:from:` copies a file of the
    sources, relative to their top, instead of the content. `:hidden:` shows nothing."""

    required_arguments = 1
    has_content = True
    option_spec = {"from": directives.unchanged, "hidden": directives.flag, "language": directives.unchanged}

    def run(self):
        env = self.state.document.settings.env
        name = self.arguments[0]
        if "from" in self.options:
            source = Path(env.app.config.wavebalance_source) / self.options["from"]
            if not source.is_file():
                raise ExtensionError(f"{env.docname}: no file {source}")
            env.note_dependency(str(source))
            shutil.copy(source, work_folder(env) / name)
            text = source.read_text(errors="replace")
        else:
            text = "\n".join(self.content) + "\n"
            (work_folder(env) / name).write_text(text)
        if "hidden" in self.options:
            return []
        languages = {".toml": "toml", ".py": "python", ".cpp": "cpp"}
        language = self.options.get("language", languages.get(Path(name).suffix, "text"))
        title = nodes.paragraph("", "", nodes.literal(name, name), classes=["file-name"])
        return [title, nodes.literal_block(text, text, language=language)]


class Picture(Directive):
    """`.. picture:: file` shows a picture from the folder of the page; `:alt:` describes it, the content is its
    caption. `:page:` shows the picture of that name of another page, and leads there."""

    required_arguments = 1
    has_content = True
    option_spec = {"alt": directives.unchanged_required, "page": directives.unchanged_required}

    def run(self):
        env = self.state.document.settings.env
        if "alt" not in self.options:
            raise ExtensionError(f"{env.docname}: the picture {self.arguments[0]} has no :alt:")
        if "page" in self.options:  # check_links.py finds those that the page does not show
            page = self.options["page"]
            address = address_of(env, page, Path(self.arguments[0]))
            return [figure(address, self.options["alt"], self.caption(), env.app.builder.get_relative_uri(env.docname, page))]
        source = work_folder(env) / self.arguments[0]
        if not source.is_file():
            raise ExtensionError(f"{env.docname}: no picture {source}")
        return [picture(env, source, self.options["alt"], self.caption())]

    def caption(self):
        node = nodes.Element()
        self.state.nested_parse(self.content, self.content_offset, node)
        return node.children


def picture(env, source, alt, caption):
    """A figure node around a copy of the picture `source` in the site."""
    address = address_of(env, env.docname, source)
    folder = Path(env.app.outdir) / "pictures"
    folder.mkdir(exist_ok=True)
    shutil.copy(source, folder / Path(address).name)
    return figure(address, alt, caption, address)


def address_of(env, page, source):
    """Where the copy of a picture of a page is, seen from the page that is being read."""
    name = f"{page.replace('/', '_')}_{re.sub('[^A-Za-z0-9.]', '_', source.parent.name + '_' + source.name)}"
    return f"{'../' * env.docname.count('/')}pictures/{name}"


def figure(address, alt, caption, leads_to):
    escaped = alt.replace("&", "&amp;").replace('"', "&quot;")
    node = nodes.container(classes=["picture"])
    node += nodes.raw("", f'<a href="{leads_to}"><img src="{address}" alt="{escaped}" loading="lazy"></a>', format="html")
    node.extend(caption)
    return node


class ResultTable(Directive):
    """`.. result-table:: file.csv` shows rows of a table of results: `:columns:` names them, separated by commas, each
    with a factor after `*`, a title after `=` and a format after `|`; `:every:` shows each n-th row."""

    required_arguments = 1
    option_spec = {"columns": directives.unchanged_required, "every": directives.positive_int}

    def run(self):
        env = self.state.document.settings.env
        file = work_folder(env) / self.arguments[0]
        columns = [read_column(text) for text in self.options["columns"].split(",")]
        with open(file, newline="") as stream:
            rows = list(csv.DictReader(stream))[::self.options.get("every", 1)]
        missing = [name for name, _, _ in columns if rows and name not in rows[0]]
        if missing or not rows:
            raise ExtensionError(f"{env.docname}: {file} has no rows or no columns {missing}")
        return [table([title for _, title, _ in columns],
                      [[formatted(row[name]) for name, _, formatted in columns] for row in rows])]


def read_column(text):
    """`name * factor = title | format` as name, title and a function that formats a value."""
    text, _, style = text.partition("|")
    name, _, title = text.partition("=")
    name, _, factor = name.partition("*")

    def formatted(value):
        if not style.strip():
            return str(value)
        return format(float(value) * float(factor or 1.0), style.strip()) if value is not None else ""

    return name.strip(), (title or name).strip(), formatted


def with_formulas(text):
    """A paragraph of a text with formulas between dollar signs."""
    paragraph = nodes.paragraph()
    for number, part in enumerate(re.split(r"\$([^$]+)\$", str(text))):
        paragraph += nodes.math(part, part) if number % 2 else nodes.Text(part)
    return paragraph


def table(titles, rows):
    """A docutils table of texts, with formulas between dollar signs, or of lists of nodes."""
    group = nodes.tgroup(cols=len(titles))
    group.extend(nodes.colspec(colwidth=1) for _ in titles)
    for tag, lines in ((nodes.thead, [titles]), (nodes.tbody, rows)):
        part = tag()
        for line in lines:
            row = nodes.row()
            for cell in line:
                content = cell if isinstance(cell, list) else [with_formulas(cell)]
                row += nodes.entry("", *content)
            part += row
        group += part
    return nodes.container("", nodes.table("", group), classes=["wide"])


class JsonTable(Directive):
    """`.. json-table:: summary.json key` shows a list of records of a summary; `:columns:` as in `result-table`."""

    required_arguments = 2
    option_spec = {"columns": directives.unchanged_required}

    def run(self):
        env = self.state.document.settings.env
        records = look_up(work_folder(env) / self.arguments[0], self.arguments[1], env)
        columns = [read_column(text) for text in self.options["columns"].split(",")]
        rows = []
        for record in records:
            for name, _, _ in columns:
                if name not in record:
                    raise ExtensionError(f"{env.docname}: {self.arguments[1]} has no {name}, but {sorted(record)}")
            rows.append([formatted(record[name]) for name, _, formatted in columns])
        if not rows:
            raise ExtensionError(f"{env.docname}: {self.arguments[1]} of {self.arguments[0]} is empty")
        return [table([title for _, title, _ in columns], rows)]


def look_up(file, path, env):
    """The value of a dotted key in a JSON file."""
    try:
        value = json.loads(file.read_text())
        for part in path.split("."):
            value = value[int(part)] if isinstance(value, list) else value[part]
    except (OSError, KeyError, IndexError, ValueError) as error:
        raise ExtensionError(f"{env.docname}: no {path} in {file}: {error!r}") from error
    return value


def value_role(name, rawtext, text, lineno, inliner, options=None, content=None):
    """:value:`file.json key * factor | format` is a computed number."""
    env = inliner.document.settings.env
    expression, _, style = text.partition("|")
    words = expression.split()
    value = look_up(work_folder(env) / words[0], words[1], env)
    if len(words) == 4 and words[2] == "*":
        value = float(value) * float(words[3])
    shown = format(value, style.strip()) if style else str(value)
    return [nodes.inline(rawtext, shown, classes=["computed"])], []


def setup(app):
    app.add_config_value("wavebalance_work", "", "env")
    app.add_config_value("wavebalance_source", "", "env")
    app.add_config_value("wavebalance_programs", [], "env")
    app.add_config_value("wavebalance_python", "", "env")
    app.add_directive("run", Run)
    app.add_directive("file", File)
    app.add_directive("picture", Picture)
    app.add_directive("result-table", ResultTable)
    app.add_directive("json-table", JsonTable)
    app.add_role("value", value_role)
    app.connect("builder-inited", make_programs)
    app.connect("source-read", empty_work_folder)
