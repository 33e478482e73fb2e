"""Common parts of the tests of pages: one browser, and the reports of the command, each made once."""

import os
import re
import shutil
import subprocess
import time
from pathlib import Path

import pytest
from browser import Browser

HERE = Path(__file__).resolve().parent
SCENES = HERE.parents[1] / "reproduce" / "scenes"


@pytest.fixture(scope="session")
def browser(tmp_path_factory):
    """A chromium with one page; tests are skipped without it."""
    chromium = shutil.which("chromium")
    if chromium is None:
        pytest.skip("chromium is not installed (setup installs it)")
    one = Browser(chromium, tmp_path_factory.mktemp("profile"))
    yield one
    one.close()


@pytest.fixture(scope="session")
def scenes():
    """The folder of the scenes of this project."""
    return SCENES


@pytest.fixture(scope="session")
def report(tmp_path_factory):
    """Runs the command with arguments and --output, once for each of them; returns the folder of its results."""
    made = {}

    def run(*arguments):
        words = tuple(map(str, arguments))
        if words not in made:
            made[words] = tmp_path_factory.mktemp("report") / "out"
            ended = subprocess.run([os.environ["WAVEBALANCE_COMMAND"], *words, "--quiet", "--output", made[words]], capture_output=True,
                                   text=True, check=False, timeout=100)
            assert ended.returncode in (0, 3), ended.stderr
        return made[words]

    return run


def broken_links(page):
    """The targets of links and sources of a page that lead nowhere: files that are missing, anchors without an element."""
    text = page.read_text()
    ids = set(re.findall(r' id="([^"]*)"', text))
    targets = re.findall(r' (?:href|src|data-curves|data-motion|data-readings|data-library)="([^"]+)"', text)
    targets += [one for many in re.findall(r' data-bodies="([^"]*)"', text) for one in many.split()]
    return {one for one in targets if not one.startswith(("https:", "http:", "data:", "mailto:")) and
            not (one[1:] in ids if one.startswith("#") else (page.parent / one.split("#")[0]).exists())}


class Look:
    """Checks of every page of this project."""

    def __init__(self, browser):
        self.browser = browser

    def open(self, page, width=1400, dark=False):
        """Opens a page with the functions of look.js."""
        self.browser.open(page, width, dark=dark)
        self.browser.value((HERE / "look.js").read_text() + ";0")

    def sound(self, page):
        """At three widths nothing is cut or unnamed, no script complains, what moves moves, and each name of a legend hides something."""
        assert broken_links(page) == set()
        self.open(page)
        for box in range(self.browser.value("document.querySelectorAll('.motion, .body-motion').length")):
            self.plays(f"document.querySelectorAll('.motion, .body-motion')[{box}]")
        self.outline()
        self.fits(page, 1400)
        assert self.browser.value("look.idle()") == []
        self.browser.resize(800)
        self.fits(page, 800)
        self.open(page, 400, dark=True)
        self.fits(page, 400)
        assert self.browser.errors == []

    def outline(self):
        """Headings in order, words and room for each picture, formulas set, and no figure that scrolls inside itself."""
        found = self.browser.value("look.outline()")
        assert found["language"] == "en"
        assert found["levels"][0] == 1
        assert all(b <= a + 1 for a, b in zip(found["levels"], found["levels"][1:])), found["levels"]
        assert (found["withoutWords"], found["withoutRoom"], found["formulasLeft"], found["scrollInside"]) == ([], [], 0, 0)

    def fits(self, page, width):
        """Nothing is wider than the window, folded or not, as pictures or as curves; titles of axes are whole, legends seen."""
        place = f"{page} at {width} px"
        assert self.browser.value("look.overflow()") <= 0, place
        for curves in ("false", "true"):
            self.browser.value(f"look.draw({curves})")
            assert self.browser.value("look.tooWide()") == [], place
            assert self.browser.value("look.overflow()") <= 0, place
        assert self.browser.value("look.unreadable()") == [], place

    def legible(self, picture, least=2):
        """In an SVG picture no two texts overlap, none is cut by its edge, no curve passes through a name of the
        legend, every axis has its `least` numbers, and axes take half of their column and of their row at least."""
        self.browser.open(picture, 2200, 6000)
        found = self.browser.value((HERE / "pictures.js").read_text() + f";measured(document.documentElement, {least})")
        assert found["texts"] > 0, picture
        assert (found["overlapping"], found["cut"], found["covered"], found["unlabelled"]) == ([], [], [], 0), picture
        for size, low, high in (("width", "left", "right"), ("height", "top", "bottom")):
            # Places within 40 px of each other are one column or row.
            places = sorted(area[low if size == "width" else high] for area in found["areas"])
            count = sum(i == 0 or place > places[i - 1] + 40 for i, place in enumerate(places))
            for area in found["areas"]:
                assert area[high] - area[low] >= 0.5 * found[size] / count, picture

    def near(self, box):
        """Scrolls to a box whose content is made when it comes near, and waits for it."""
        self.browser.place(box)
        self.browser.value("window.dispatchEvent(new Event('scroll'))")
        self.browser.until(f"{box}.querySelector('input')")

    def plays(self, box):
        """Play moves it through the period, also where the first frame's time lies before the click; a body is drawn and moves."""
        self.near(box)
        if self.browser.value(f"{box}.matches('.body-motion')"):
            rest, moved = (self.browser.value(f"look.body({box}, {place})") for place in (0, 0.25))
            assert 0.002 * rest["all"] < rest["ink"] < 0.8 * rest["all"], rest
            assert rest["sum"] != moved["sum"]
            assert moved["time"].startswith("t = 0.25"), moved
        self.browser.value("""window.frames_of_the_browser ??= window.requestAnimationFrame;
          window.requestAnimationFrame = (step) => frames_of_the_browser.call(window, (now) => step(now - 60))""")
        play, shown = f"{box}.querySelector('button')", f"{box}.querySelector('output').textContent"
        before = self.browser.value(shown)
        self.browser.click(play)
        assert self.browser.value(f"{play}.textContent") == "Pause"
        self.browser.until(f"{shown} !== {before!r}")
        self.browser.click(play)
        still = self.browser.value(shown)
        time.sleep(0.1)
        assert self.browser.value(shown) == still
        assert self.browser.value(f"{play}.textContent") == "Play"
        assert self.browser.errors == []


@pytest.fixture
def look(browser):
    """Opens pages and checks them."""
    return Look(browser)
