"""`.. headers:: folder` documents the public names of all headers below a folder from the XML that Doxygen wrote: classes,
structs, concepts, enums, functions and types, each with its comment in the header."""

import re
import xml.etree.ElementTree as ElementTree
from collections import defaultdict
from pathlib import Path

from docutils import nodes
from docutils.parsers.rst import Directive, directives
from sphinx import addnodes
from sphinx.errors import ExtensionError

KINDS = {"class", "struct", "concept"}


class Index:
    """The compounds and free members of Doxygen's XML by the header that declares them."""

    def __init__(self, folder):
        self.compounds = defaultdict(list)
        self.members = defaultdict(list)
        for file in sorted(Path(folder).glob("*.xml")):
            if file.name.startswith(("class", "struct", "concept", "namespace")):
                self.read(ElementTree.parse(file).getroot().find("compounddef"))

    def read(self, compound):
        if compound.get("kind") == "namespace":
            for member in compound.iter("memberdef"):
                self.members[member.find("location").get("file")].append(member)
        elif compound.get("kind") in KINDS and compound.get("prot", "public") == "public":
            self.compounds[compound.find("location").get("file")].append(compound)

    def of_header(self, header):
        """Compounds and members of a header in the order of their lines."""
        found = self.compounds[header] + [m for m in self.members[header] if "detail" not in name_of(m)]
        return sorted(found, key=lambda one: int(one.find("location").get("line")))


def name_of(element):
    for tag in ("compoundname", "qualifiedname", "name"):
        if element.find(tag) is not None:
            return "".join(element.find(tag).itertext())
    return ""


def plain(element):
    return re.sub(r"\s+", " ", "".join(element.itertext())).strip() if element is not None else ""


def tidy(code):
    code = re.sub(r"wavebalance::(wavelets|spectral|fem|contact|solvers|app)::", r"\1::", code)
    return re.sub(r"\s*([&*])\s*(?=\w)", r"\1 ", code).replace("& &", "&&").replace("< ", "<").replace(" >", ">")


def signature(member):
    """The declaration of a member as one line of C++."""
    kind, name = member.get("kind"), plain(member.find("name"))
    template = ", ".join(plain(p) for p in member.findall("templateparamlist/param"))
    head = f"template <{template}> " if template else ""
    kept = plain(member.find("type"))
    if kind == "enum":
        return f"enum {'class ' if member.get('strong') == 'yes' else ''}{name}"
    if kind == "typedef":
        return f"using {name} = {kept}"
    words = ("static " if member.get("static") == "yes" and kind == "function" else "") + (f"{kept} " if kept else "")
    initial = plain(member.find("initializer"))
    initial = f" {initial}" if initial and len(initial) < 60 else ""
    return head + words + name + plain(member.find("argsstring")) + (initial if kind == "variable" else "")


def is_shown(member):
    name = plain(member.find("name"))
    arguments = plain(member.find("argsstring"))
    moves = "&&)" in arguments and not plain(member.find("type")) or name == "operator="
    return not (moves or name.startswith(("~", "@")) or arguments.endswith(("=delete", "=default", "= default", "= delete")))


def blocks(description):
    """Docutils blocks of a brief or detailed description."""
    result = []
    for para in description if description is not None else []:
        node = nodes.paragraph()
        node += nodes.Text(para.text or "")
        for child in para:
            if child.tag in ("itemizedlist", "orderedlist"):
                items = [nodes.list_item("", *blocks(item)) for item in child.findall("listitem")]
                result += [node, nodes.bullet_list("", *items)]
                node = nodes.paragraph()
            elif child.tag in ("verbatim", "programlisting", "preformatted"):
                text = "".join(child.itertext()).strip("\n")
                result += [node, nodes.literal_block(text, text, language="text")]
                node = nodes.paragraph()
            elif child.tag == "computeroutput":
                node += nodes.literal("", "".join(child.itertext()))
            else:
                node += nodes.Text("".join(child.itertext()))
            node += nodes.Text(child.tail or "")
        result.append(node)
    return [one for one in result if one.astext().strip()]


def documentation(element):
    """Brief and detailed description, whose first paragraphs are one in the header."""
    brief, detail = blocks(element.find("briefdescription")), blocks(element.find("detaileddescription"))
    if brief and detail and isinstance(brief[-1], nodes.paragraph) and isinstance(detail[0], nodes.paragraph):
        brief[-1] += nodes.Text(" ")
        brief[-1].extend(detail.pop(0).children)
    return brief + detail


class Headers(Directive):
    """`.. headers:: solvers/include/wavebalance/solvers/response`, relative to the top of the sources."""

    required_arguments = 1
    option_spec = {"only": directives.unchanged}

    def run(self):
        env = self.state.document.settings.env
        index = getattr(env.app, "wavebalance_index", None)
        if index is None:
            index = env.app.wavebalance_index = Index(env.app.config.wavebalance_doxygen)
        top = Path(env.app.config.wavebalance_source)
        folder = top / self.arguments[0]
        headers = sorted(folder.rglob("*.hpp"))
        if not headers:
            raise ExtensionError(f"{env.docname}: no header below {folder}")
        result = []
        for header in headers:
            path = str(header.relative_to(top))
            found = index.of_header(path)
            if found:
                result.append(self.header(path, found))
        if not result:
            raise ExtensionError(f"{env.docname}: Doxygen wrote nothing for {folder}")
        return result

    def header(self, path, found):
        include = path.split("/include/", 1)[1]
        section = nodes.section(ids=["header-" + re.sub("[^a-z0-9]", "-", include.lower())])
        title = include.rsplit("/", 1)[1]
        section += nodes.title("", "", nodes.literal(title, title))
        line = f"#include <{include}>"
        section += nodes.literal_block(line, line, language="cpp")
        for one in found:
            section.extend(self.compound(one) if one.tag == "compounddef" else self.entries([one]))
        return section

    def compound(self, compound):
        kind, name = compound.get("kind"), plain(compound.find("compoundname"))
        members = [m for part in compound.findall("sectiondef") if part.get("kind", "").startswith("public")
                   for m in part.findall("memberdef") if is_shown(m)]
        text = f"{kind} {name.removeprefix('wavebalance::')}"
        if kind == "concept":
            text = re.sub(r"\n\s*\n+", "\n", "".join(compound.find("initializer").itertext()).strip())
        item = self.item(text, compound, name)
        if members:
            item.children[-1].extend(self.entries(members))
        return [nodes.definition_list("", item, classes=["cpp"])]

    def entries(self, members):
        items = [self.item(tidy(signature(m)), m, name_of(m)) for m in members if is_shown(m)]
        return [nodes.definition_list("", *items, classes=["cpp"])] if items else []

    def item(self, text, element, name):
        anchor = element.get("id").lower().replace("_", "-")
        short = name.removeprefix("wavebalance::")
        body = nodes.definition("", *documentation(element))
        if element.get("kind") == "enum":
            body += self.enumerators(element)
        code = nodes.literal_block(text, text, language="cpp") if "\n" in text else nodes.literal("", text, classes=["code"])
        term = nodes.term("", "", ids=[anchor])
        if element.get("kind") in KINDS | {"function", "enum", "typedef"}:
            term += addnodes.index(entries=[("single", f"{short} (C++)", anchor, "", None)])
        if "\n" in text:
            term += nodes.literal("", short, classes=["code"])
            body.insert(0, code)
        else:
            term += code
        return nodes.definition_list_item("", term, body)

    def enumerators(self, element):
        items = []
        for value in element.findall("enumvalue"):
            name = plain(value.find("name"))
            text = nodes.paragraph("", "", nodes.literal(name, name))
            for block in documentation(value):
                text += nodes.Text(" " + block.astext())
            items.append(nodes.list_item("", text))
        return nodes.bullet_list("", *items)


def setup(app):
    app.add_config_value("wavebalance_doxygen", "", "env")
    app.add_directive("headers", Headers)
