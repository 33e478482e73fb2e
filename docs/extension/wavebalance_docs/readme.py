"""`.. readme:: app/LAWS.md` shows a file in Markdown of the sources as part of a page, or with `:section:` the part below one
of its headings, so that a reference is in one place only. It reads what these files use: headings, paragraphs, lists,
tables, blocks of code, pictures, and in a line code, links, bold and slanted text. A link to a file that a page of the
site shows leads to that page."""

import re
from pathlib import Path

from docutils import nodes
from docutils.parsers.rst import Directive, directives
from sphinx.errors import ExtensionError

from wavebalance_docs.commands import picture, table

WHOLE = re.compile(r"^\.\. readme:: (\S+)\n(?! +:section:)", re.M)
INLINE = re.compile(r"`([^`]+)`|!\[([^\]]*)\]\(([^)]+)\)|\[([^\]]+)\]\(([^)]+)\)|\*\*([^*]+)\*\*|(?<![\w*])\*([^*\s][^*]*)\*")


def part_below(text, heading):
    """The lines below a heading up to the next one of its level or above."""
    lines = text.split("\n")
    for number, line in enumerate(lines):
        found = re.match(r"^(#+) (.*)$", line)
        if found and found.group(2).strip() == heading:
            level = len(found.group(1))
            rest = lines[number + 1:]
            code = False
            for end, other in enumerate(rest):
                code ^= other.startswith("```")
                if not code and re.match(rf"^#{{1,{level}}} ", other):
                    return rest[:end]
            return rest
    return None


def slug(heading):
    """The anchor of a heading, as GitHub makes it."""
    return re.sub(r"[^\w\- ]", "", heading.strip("# ").lower()).replace(" ", "-")


def pages_of_files(env):
    """The page that shows each whole file, and each page itself: docnames by path."""
    if not hasattr(env.app, "wavebalance_pages"):
        pages = {}
        for page in sorted(env.found_docs):
            source = Path(env.doc2path(page))
            pages[source.resolve()] = page
            for name in WHOLE.findall(source.read_text()):
                pages[(Path(env.app.config.wavebalance_source) / name).resolve()] = page
        env.app.wavebalance_pages = pages
    return env.app.wavebalance_pages


class Markdown:
    """Docutils nodes of Markdown; `address` gives the address of a link, or nothing for plain text, and `anchor` the
    anchor of a heading, if it has one."""

    def __init__(self, address, image, anchor=None):
        self.address, self.image, self.anchor = address, image, anchor

    def inline(self, text):
        result, place = [], 0
        for found in INLINE.finditer(text):
            result.append(nodes.Text(text[place:found.start()]))
            place = found.end()
            code, _, _, label, link, bold, slanted = found.groups()
            if code:
                result.append(nodes.literal(code, code))
            elif link:
                target = self.address(link)
                inner = self.inline(label)
                inside = not (target or "").startswith(("https://", "http://"))
                result += inner if target is None else [nodes.reference("", "", *inner, refuri=target, internal=inside)]
            elif bold:
                result.append(nodes.strong("", "", *self.inline(bold)))
            elif slanted:
                result.append(nodes.emphasis("", "", *self.inline(slanted)))
        return result + [nodes.Text(text[place:])]

    def paragraph(self, lines):
        text = " ".join(line.strip() for line in lines)
        found = re.fullmatch(r"!\[([^\]]*)\]\(([^)]+)\)", text)
        return self.image(found.group(2), found.group(1)) if found else nodes.paragraph("", "", *self.inline(text))

    def cells(self, line):
        parts = re.split(r"(?<!\\)\|", line.strip().strip("|"))
        return [[nodes.paragraph("", "", *self.inline(part.strip().replace("\\|", "|")))] for part in parts]

    def blocks(self, lines):
        """Blocks up to the end; headings become rubrics, since the page has the sections."""
        result, i = [], 0
        while i < len(lines):
            line = lines[i]
            if not line.strip():
                i += 1
            elif line.startswith("```"):
                end = next(n for n in range(i + 1, len(lines) + 1) if lines[n].startswith("```"))
                text = "\n".join(lines[i + 1:end])
                result.append(nodes.literal_block(text, text, language=line[3:].strip() or "text"))
                i = end + 1
            elif line.startswith("    "):
                end = self.end(lines, i, lambda one: one.startswith("    ") or not one.strip())
                text = "\n".join(one[4:] for one in lines[i:end]).strip("\n")
                result.append(nodes.literal_block(text, text, language="text"))
                i = end
            elif line.startswith("#"):
                ids = {"ids": [self.anchor(line)]} if self.anchor else {}
                result.append(nodes.rubric("", "", *self.inline(line.lstrip("# ")), **ids))
                i += 1
            elif line.startswith("|"):
                end = self.end(lines, i, lambda one: one.startswith("|"))
                rows = [self.cells(one) for one in lines[i:end]]
                result.append(table(rows[0], rows[2:]))
                i = end
            elif re.match(r"^(-|\d+\.) ", line):
                end = self.end(lines, i, lambda one: re.match(r"^(-|\d+\.) |^ ", one) or not one.strip())
                result.append(self.list_of(lines[i:end]))
                i = end
            else:
                end = self.end(lines, i, lambda one: one.strip() and not re.match(r"^(```|\||#|- )", one))
                result.append(self.paragraph(lines[i:end]))
                i = end
        return result

    @staticmethod
    def end(lines, i, belongs):
        while i < len(lines) and belongs(lines[i]):
            i += 1
        return i

    def list_of(self, lines):
        items, numbered = [], bool(re.match(r"^\d", lines[0]))
        for line in lines:
            found = re.match(r"^(?:-|\d+\.) (.*)$", line)
            if found:
                items.append([found.group(1)])
            elif line.strip():
                items[-1].append(line)
        entries = [nodes.list_item("", self.paragraph(item)) for item in items]
        return nodes.enumerated_list("", *entries) if numbered else nodes.bullet_list("", *entries)


class Readme(Directive):
    required_arguments = 1
    option_spec = {"section": directives.unchanged, "from": directives.nonnegative_int}

    def run(self):
        env = self.state.document.settings.env
        file = Path(env.app.config.wavebalance_source) / self.arguments[0]
        if not file.is_file():
            raise ExtensionError(f"{env.docname}: no file {file}")
        text = file.read_text()
        lines = text.split("\n")[1:] if text.startswith("# ") else text.split("\n")
        if "section" in self.options:
            lines = part_below(text, self.options["section"])
        if not lines:
            raise ExtensionError(f"{env.docname}: {file} has no section '{self.options.get('section')}'")
        page = Markdown(lambda link: self.address(env, file, link), lambda link, alt: picture(env, file.parent / link, alt, []),
                        lambda heading: self.anchor(file, heading))
        return page.blocks(lines)

    @staticmethod
    def anchor(file, heading):
        """Unique among the files of a page."""
        return f"{file.parent.name}-{file.stem}-{slug(heading)}".lower()

    @classmethod
    def address(cls, env, file, link):
        if link.startswith(("https://", "http://")):
            return link
        name, _, heading = link.partition("#")
        target = (file.parent / name).resolve() if name else file.resolve()
        page = pages_of_files(env).get(target)
        if page is None:
            return None
        uri = env.app.builder.get_relative_uri(env.docname, page)
        return f"{uri}#{cls.anchor(target, heading)}" if heading and target.suffix == ".md" else uri


def setup(app):
    app.add_directive("readme", Readme)
