"""`.. readme:: app/LAWS.md` shows a file in Markdown of the sources as part of a page, or with `:section:` the part below one
of its headings, so that a reference stands in one place only. It reads what these files use: headings, paragraphs,
lists, tables, blocks of code, pictures, and in a line code, links, bold and slanted text."""

import re
from pathlib import Path

from docutils import nodes
from docutils.parsers.rst import Directive, directives
from sphinx.errors import ExtensionError

from wavebalance_docs.commands import picture, table

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


class Markdown:
    """Docutils nodes of Markdown; `address` gives the address of a link, or nothing for plain text."""

    def __init__(self, address, image):
        self.address, self.image = address, image

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
                result += [nodes.reference("", "", *inner, refuri=target)] if target else inner
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
                result.append(nodes.rubric("", "", *self.inline(line.lstrip("# "))))
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
        return Markdown(self.address, lambda link, alt: picture(env, file.parent / link, alt, [])).blocks(lines)

    @staticmethod
    def address(link):
        return link if link.startswith(("https://", "http://")) else None


def setup(app):
    app.add_directive("readme", Readme)
