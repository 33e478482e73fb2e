"""Opens every page of the site in chromium, at the width of a phone and of a tablet: nothing may be wider than the screen, every
formula must be set, every picture loaded, and no script may fail. Usage: check_browser.py CHROMIUM FOLDER; exit code 1 where a page fails."""

import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests" / "pages"))
from browser import Browser  # noqa: E402

WIDTHS = (400, 800)
LOOK = """(() => {
  const root = document.documentElement, faults = [];
  const count = selector => root.querySelectorAll(selector).length;
  if (root.scrollWidth > innerWidth) faults.push(`${root.scrollWidth} pixels wide on a screen of ${innerWidth}`);
  if (count(".katex-error")) faults.push(`${count(".katex-error")} formulas that KaTeX refuses`);
  if (count(".highlight") != count(".highlight > .copy")) faults.push("listings without a button that copies them");
  for (const copy of root.querySelectorAll(".highlight > .copy"))
    if (copy.getBoundingClientRect().left < copy.parentElement.querySelector("pre").getBoundingClientRect().right)
      faults.push("the button that copies lies over its listing");
  if (count(".formula") != count(".formula .katex")) faults.push("formulas that are not set");
  for (const image of document.images)
    if (image.complete && !image.naturalWidth) faults.push(`${image.getAttribute("src")} does not load`);
  return faults;
})()"""


def faults_of(browser, page):
    """Faults of a page. It is loaded once: its styles differ only among widths below 1000 pixels, where site.js folds
    the contents."""
    browser.open(page, WIDTHS[0])
    found = browser.value(LOOK)
    browser.resize(WIDTHS[1])
    return found + browser.value(LOOK) + browser.errors


def dark_faults(browser, page):
    """Whether the page stays bright where the screen is dark, or its text cannot be distinguished from it."""
    browser.open(page, WIDTHS[1], dark=True)
    ground, text = browser.value("""["backgroundColor", "color"].map((one) => getComputedStyle(document.body)[one].match(/\\d+/g)
      .slice(0, 3).reduce((sum, part) => sum + Number(part) / 3, 0))""")
    return [] if ground < 60 and text > 180 else [f"in the dark the ground is {ground:.0f} and the text {text:.0f} of 255"]


def look_at(chromium, folder):
    """The number of pages, and what is wrong with them."""
    pages = sorted(folder.rglob("*.html"))
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        browser = Browser(chromium, profile)
        found = [f"{page.relative_to(folder)}: {fault}" for page in pages for fault in faults_of(browser, page)]
        found += [f"{pages[0].relative_to(folder)}: {fault}" for fault in dark_faults(browser, pages[0])]
        browser.close()
    return len(pages), found


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("usage: check_browser.py CHROMIUM FOLDER")
    number, faults = look_at(sys.argv[1], Path(sys.argv[2]).resolve())
    print("\n".join(faults) if faults else f"{number} pages at {len(WIDTHS)} widths: all fit")
    sys.exit(1 if faults else 0)
