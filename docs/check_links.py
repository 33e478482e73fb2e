"""Checks a folder of HTML pages: every internal link, anchor, image, script and style exists, every image has a text, and
nothing is loaded from the network. Usage: check_links.py FOLDER; prints each fault, exit code 1 where there is one."""

import re
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit


class Page(HTMLParser):
    """The anchors of one page and what it links to and loads."""

    def __init__(self, text):
        super().__init__()
        self.anchors, self.links, self.loaded, self.faults = set(), [], [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        for name in ("id", "name"):
            if values.get(name) and tag not in ("input", "meta"):
                if name == "id" and values[name] in self.anchors:
                    self.faults.append(f"the anchor #{values[name]} stands twice")
                self.anchors.add(values[name])
        if tag == "a" and "href" in values:
            self.links.append(values["href"])
        if tag in ("script", "img", "iframe") and "src" in values:
            self.loaded.append(values["src"])
        if tag == "link" and "href" in values:
            self.loaded.append(values["href"])
        if tag == "img" and not values.get("alt"):
            self.faults.append(f"the image {values.get('src')} has no text")


def check_address(address, file, pages, folder, loaded):
    """The fault of one address in the page `file`, or nothing."""
    parts = urlsplit(address)
    if parts.scheme or parts.netloc:
        return f"loads {address} from elsewhere" if loaded and parts.scheme != "data" else None
    target = (file.parent / unquote(parts.path)).resolve() if parts.path else file
    if not target.is_file():
        return f"{address}: no such file"
    if not target.is_relative_to(folder):
        return f"{address}: outside of the site"
    if target.stat().st_size == 0:
        return f"{address}: an empty file"
    anchor = unquote(parts.fragment)
    if anchor and target in pages and anchor not in pages[target].anchors:
        return f"{address}: no such anchor"
    return None


def check_styles(folder):
    for file in sorted(folder.rglob("*.css")):
        for address in re.findall(r"url\(['\"]?([^'\")]+)['\"]?\)", file.read_text(errors="replace")):
            if not address.startswith("data:") and not (file.parent / urlsplit(address).path).is_file():
                yield f"{file.relative_to(folder)}: {address}: no such file"


def check(folder):
    folder = Path(folder).resolve()
    pages = {file: Page(file.read_text()) for file in sorted(folder.rglob("*.html"))}
    faults = list(check_styles(folder))
    for file, page in pages.items():
        name = file.relative_to(folder)
        faults += [f"{name}: {fault}" for fault in page.faults]
        for loaded, addresses in ((False, page.links), (True, page.loaded)):
            for address in dict.fromkeys(addresses):
                fault = check_address(address, file, pages, folder, loaded)
                if fault:
                    faults.append(f"{name}: {fault}")
    return len(pages), sum(len(p.links) + len(p.loaded) for p in pages.values()), faults


if __name__ == "__main__":
    if len(sys.argv) != 2 or not Path(sys.argv[1]).is_dir():
        sys.exit("usage: check_links.py FOLDER")
    number, links, found = check(sys.argv[1])
    print("\n".join(found) if found else f"{number} pages, {links} links: all hold")
    sys.exit(1 if found or number == 0 else 0)
