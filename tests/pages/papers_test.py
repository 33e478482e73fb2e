"""The page of the papers: one made from small results with all features of the page, and the ones of `make
reproduce`."""

import json
import math
import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest

STEM = "fig06_tip_displacement_case1"
SINE = [math.sin(2 * math.pi * i / 40) for i in range(41)]
TIMES = [i / 40 for i in range(41)]


def moving_bar():
    """A bar of three nodes and 16 instants: two pairs of bases and the reference."""

    def motion(label, size):
        tips = [size * math.cos(2 * math.pi * i / 16) - 1e-4 * math.sin(2 * math.pi * i / 16) for i in range(16)]
        return {"label": label, "name": label, "tip": tips, "nodes": [[0.0, 0.5 * tip, tip] for tip in tips],
                "force": [max(0.0, tip / 1e-3 - 1.0) for tip in tips]}

    return {"gap": 1e-3, "amplitude": 2.0, "frequency": 150.0, "length": 0.5, "time": [i / 16 for i in range(16)],
            "pairs": [motion("one", 1.2e-3), motion("two", 0.7e-3)], "reference": motion("time stepping", 1.1e-3)}


def sums():
    """Three ways to form sums, under the second of which one curve is missing."""

    def way(points, place, of_text, second, errors, verdict):
        return {"name": f"{points} {place}", "choices": [points, place], "ofText": of_text, "curves": [[0, 4 if of_text else 6, 10], second], "errors": errors,
                "verdicts": [{"statement": 2, "verdict": verdict}]}

    return {"label": "u (mm)", "from": 0.0, "to": 1.0, "unit": 0.1, "level": None, "choices": ["Points", "Where"], "reference": [0, 5, 10],
            "pairs": [{"label": "sine", "steps": False}, {"label": "half", "steps": True}],
            "readings": [way("256", "left", True, [1, 5, 9], [0.125, 0.5], "agrees"), way("256", "middle", False, None, [0.25, None], "differs"),
                         way("64", "left", False, [1, 5, 9], [0.5, 0.5], "agrees")]}


def figure():
    """Panels of a sine and a constant, the second with points that were shifted for sight and a logarithmic abscissa, the third
    below the first, which leaves the name of the abscissa to it."""

    def axis(label, logarithmic=False, ticks=(), form="", texts=()):
        return {"label": label, "lower": None, "upper": None, "logarithmic": logarithmic, "ticks": ticks, "texts": texts, "format": form}

    def series(label, x, y, style="line", **more):
        return {"label": label, "style": style, "colour": "#000000", "dash": "", "width": 1.6, "marker": 0, "every": 1, "x": x, "y": y, **more}

    def panel(title, x, y, *curves):
        return {"title": title, "x": x, "y": y, "legend": True, "series": list(curves), "rectangles": [], "texts": [],
                "segments": [{"from": [None, 0.8], "to": [None, 0.8], "arrow": False, "colour": "#777777", "dash": "2 4", "width": 1.0,
                              "label": "gap"}]}

    half = [0.5] * 41
    shifted = series("dots", [9.8e-4, 0.031, 1.02], [-0.9, 0.0, 0.9], "line_points", told=[1e-3, 0.03, 1.0])
    long = "A title of an ordinate that is much longer than its axis is high (mm)"
    return {"title": "", "columns": 2, "letters": True, "panel": [480, 320],
            "panels": [panel("first", axis("", form="%.0f", ticks=[0.0, 1.0]), axis("u_{tip} (mm)"), series("sine", TIMES, SINE),
                             series("half", TIMES, half)),
                       panel("second", axis("Error", True, [1e-3, 1e-2, 0.1, 1.0], texts=["10^{-3}", "", "10^{-1}", "1"]), axis(long), series("half", [1e-3, 1.0], [0.5, 0.5]), shifted),
                       panel("third", axis("Time (periods)"), axis("u_{tip} (mm)"), series("half", TIMES, half))]}


def record(paper, stem, **more):
    """The record of a step in addition to its files."""
    return {"identity": {"paper": paper, "number": f"JL14 {stem}", "title": "Tip displacement", "stem": stem}, "caption": "The gap is $g_0 = 1$ mm.",
            "files": [], "data": [], "scenes": [], "notes": [], "statements": [], "checks": [], "unjudged": [], "slips": [], "table": [],
            "program": "jl14 fig06", "wall_seconds": 0.1, "version": "0", **more}


def statement(verdict, quote, readings=()):
    """A statement with all parts."""
    return {"place": "section 5.1", "quote": quote, "criterion": "x < 1", "measured": "0.5", "verdict": verdict, "because": "x is open",
            "readings": [{"name": name, "verdict": one, "measured": "1", "of_text": True} for name, one in readings], "panel": "(a)",
            "apart": "", "claim": "", "headline": ""}


def write(folder, paper, stem, one):
    """Writes the record of a step."""
    (folder / paper / "records").mkdir(parents=True, exist_ok=True)
    (folder / paper / "records" / f"{stem}.json").write_text(json.dumps(one))


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    """Results with a figure that has all that a page shows, and a table on a separate page."""
    program = os.environ.get("WAVEBALANCE_REPORT_PAGE")
    if not program:
        pytest.skip("the report on the papers is not built")
    folder = tmp_path_factory.mktemp("results")
    open_word = "It depends on a detail_with_a_name_that_has_no_blank_at_all_where_a_line_could_be_broken."
    write(folder, "jones_legrand_2014", STEM, record(
        "jones_legrand_2014", STEM, files=[f"{STEM}.svg"], notes=["A long formula: $\\omega^2 = r + \\langle\\lambda\\rangle g_0 / m$."],
        statements=[statement("agrees", "It holds."), statement("depends", open_word, [("x = 1", "agrees"), ("x = 2", "differs")])],
        checks=[{"place": "", "sentence": "The code is right.", "criterion": "error < 1", "measured": "0.1", "passes": True}]))
    own = folder / "jones_legrand_2014"
    (own / f"{STEM}.svg").write_text('<svg xmlns="http://www.w3.org/2000/svg" width="800" height="600"><text x="9" y="20">sine</text></svg>')
    for kind, data, suffix in (("figures", figure(), "figure"), ("readings", sums(), "readings"), ("motions", moving_bar(), "motion")):
        (own / f"{STEM}.{suffix}.js").write_text(f'((window.wavebalance ??= {{}}).{kind} ??= {{}})["{STEM}"] = {json.dumps(data)};\n')
    names = [f"a_rather_long_name_of_a_column_{i}" for i in range(5)]
    write(folder, "extremes", "extremes", record("extremes", "extremes", table=[names, ["1", "2", "3", "4", "$\\omega^2$"]]))
    subprocess.run([program, "--results", folder], check=True)
    return folder


def test_pages_of_small_results_are_sound(look, results):
    for page in ("index.html", "extremes/index.html"):
        look.sound(results / page)


def test_the_bar_stands_where_its_data_say(look, browser, results):
    look.open(results / "index.html")
    box = "document.querySelector('.motion')"
    look.near(box)
    bar = moving_bar()
    for pair in (0, 1, -1):
        for position in (2, 8, 12):
            tip = browser.value(f"""(() => {{ const box = {box}, set = (one, value, kind) => {{ one.value = value; one.dispatchEvent(new Event(kind)); }};
              set(box.querySelector("select"), {pair}, "change"); set(box.querySelector("input"), {position}, "input");
              const at = (name) => Number(box.querySelector(name).getAttribute("x1"));
              return Number(box.querySelector(".obstacle").dataset.gap) * (at(".tip") - at(".still")) / (at(".obstacle") - at(".still")); }})()""")
            motion = bar["reference"] if pair < 0 else bar["pairs"][pair]
            assert tip == pytest.approx(motion["tip"][(position + 8) % 16], abs=1e-9)  # shown from -1/2 to 1/2 of the period


def test_dragging_in_a_diagram_sets_the_time_and_ends_play_without_selecting_text(look, browser, results):
    look.open(results / "index.html")
    box = "document.querySelector('.motion')"
    look.near(box)
    browser.click(f"{box}.querySelector('button')")
    browser.drag(f"{box}.querySelector('.diagram')", (0.4, 0.5), (0.9, 0.5))
    assert browser.value(f"{box}.querySelector('button').textContent") == "Play"
    assert browser.value(f"Number({box}.querySelector('input').value)") >= 12
    assert browser.value("String(getSelection())") == ""


def test_choices_show_each_way_to_form_sums(look, browser, results):
    look.open(results / "index.html")
    look.near("document.querySelector('.sums')")

    def shown(option=None):
        """The page after the option is chosen."""
        return browser.value(f"""(() => {{ const box = document.querySelector(".sums");
          [...box.querySelectorAll("input")].find((one) => one.value === {json.dumps(option)})?.click();
          const texts = (list) => [...box.querySelectorAll(list)].map((one) => one.textContent);
          return {{ name: box.querySelector("output").textContent, titles: texts(".panel > p"), names: texts("legend"),
            chosen: [...box.querySelectorAll("input:checked")].map((one) => one.value),
            verdicts: [...box.querySelectorAll(".key a")].map((one) => `${{one.getAttribute("href")}} ${{one.textContent}}`),
            curves: [...box.querySelectorAll(".panel")].map((one) => [...one.querySelectorAll(".curve")].pop().getAttribute("d")) }}; }})()""")

    first, second = shown(), shown("middle")
    assert (first["names"], first["chosen"], second["chosen"]) == (["Points", "Where"], ["256", "left"], ["256", "middle"])
    assert first["name"] == "Allowed by the text of the paper."
    assert second["name"] == "A variant, which decides nothing."
    assert first["titles"] == ["(a) sine, error 12.5 %", "(b) half, error 50 %"]
    assert second["titles"] == ["(a) sine, error 25 %", "(b) half, no solution found"]
    assert first["verdicts"] == [f"#{STEM}-2 statement 2: ✓ agrees"]
    assert first["curves"][0] != second["curves"][0]
    assert second["curves"][1] is None
    assert shown("64")["chosen"] == ["64", "left"]  # 64 points at the middles were not computed


def told(look, browser, panel, curve, point):
    """Text of a panel at a point of one of its curves, ten pixels from it."""
    place = browser.value(f"""(() => {{ const svg = document.querySelectorAll(".plot svg")[{panel}]; svg.scrollIntoView({{ block: "center" }});
      const [left, top] = svg.querySelector("g").getAttribute("transform").match(/[\\d.]+/g).map(Number), box = svg.getBoundingClientRect();
      const points = svg.querySelectorAll(".curve")[{curve}].getAttribute("d").slice(1).split(/[ML]/).map((one) => one.split(",").map(Number));
      return [box.left + left + points[{point}][0], box.top + top + points[{point}][1]]; }})()""")
    browser.mouse("mouseMoved", place)
    return browser.value(f"document.querySelectorAll('.plot')[{panel}].querySelector('.values').innerText").split("\n")


def test_curves_zoom_tell_values_and_hide(look, browser, results):
    look.open(results / "index.html")
    browser.value("look.draw(true)")
    assert told(look, browser, 0, 0, 10) == ["sine", "Time (periods): 0.25", "utip (mm): 1"]
    assert told(look, browser, 1, 1, 1)[:2] == ["dots", "Error: 0.03"]  # drawn at 0.031, so that it is next to another
    count = "document.querySelectorAll('.plot .curve').length"
    assert browser.value(count) == 5
    browser.click("document.querySelector('.legend button')")
    assert browser.value(count) == 4
    browser.click("document.querySelector('.legend button')")
    path = "document.querySelector('.plot .curve').getAttribute('d')"
    whole = browser.value(path)
    place = browser.place("document.querySelector('.plot svg')")
    browser.mouse("mouseWheel", place, deltaX=0, deltaY=-200, modifiers=2)  # Ctrl
    browser.until(f"{path} !== {json.dumps(whole)}")
    browser.value("document.querySelector('.plot svg').focus()")
    for key, text in (("0", whole), ("+", None), ("0", whole)):
        browser.send("Input.dispatchKeyEvent", type="keyDown", key=key, text=key)
        assert (browser.value(path) == whole) == (text is not None)
    values = "document.querySelector('.plot .values').innerText.split('\\n')"
    for key, said in (("ArrowRight", ["sine", "Time (periods): 0", "utip (mm): 0"]), ("ArrowLeft", ["sine", "Time (periods): 1", None]),
                      ("ArrowDown", ["half", "Time (periods): 0", "utip (mm): 0.5"])):
        browser.send("Input.dispatchKeyEvent", type="keyDown", key=key)
        assert [told for told, wanted in zip(browser.value(values), said) if wanted] == [wanted for wanted in said if wanted], key
    browser.mouse("mouseWheel", browser.place("document.querySelector('.plot svg')"), deltaX=0, deltaY=200)
    browser.until("scrollY > 0")
    assert browser.value(path) == whole


def test_curves_without_room_wait_for_it(look, browser, results):
    look.open(results / "index.html")
    browser.value("look.draw(true)")
    browser.value("document.querySelectorAll('.curves').forEach((one) => { one.style.width = '0'; })")
    browser.resize(1000)  # draws them again, as a page does that is opened in a window without size
    browser.until("!(document.querySelector('.plot svg')?.getAttribute('width') > 20)")
    browser.value("document.querySelectorAll('.curves').forEach((one) => { one.style.width = ''; })")
    browser.resize(1400)
    browser.until("document.querySelector('.plot svg').getAttribute('width') > 200")
    assert browser.errors == []


def test_ticks_of_an_axis_are_numbers_of_one_kind(look, browser, results):
    look.open(results / "index.html")
    browser.value("look.draw(true)")
    ticks = [[one for one in browser.value(f"[...document.querySelectorAll('.plot')[{i}].querySelectorAll('.axis')[0].querySelectorAll('.tick text')]"
                                           ".map((one) => one.textContent)") if one] for i in (0, 1)]
    assert ticks == [["0", "1"], ["10⁻³", "10⁻²", "10⁻¹", "1"]]


def test_a_browser_without_webgl_says_so(look, browser, report, scenes):
    page = report("run", scenes / "blade/rotating_mode.toml", "--set", "analysis.harmonics=3") / "report.html"
    script = browser.send("Page.addScriptToEvaluateOnNewDocument", source="HTMLCanvasElement.prototype.getContext = () => null")["identifier"]
    look.open(page)
    browser.value("document.querySelector('.body-motion').scrollIntoView()")
    browser.until("document.querySelector('.body-motion').textContent.includes('This browser draws no bodies')")
    browser.send("Page.removeScriptToEvaluateOnNewDocument", identifier=script)


RESULTS = Path(os.environ.get("WAVEBALANCE_RESULTS", Path(__file__).resolve().parents[2] / "results"))
ASSETS = Path(__file__).resolve().parents[2] / "app/src/page/assets"


def test_page_of_bench_is_sound(look, tmp_path):
    shutil.copytree(ASSETS, tmp_path / "assets")
    page = tmp_path / "bench" / "index.html"
    page.parent.mkdir()
    cells = "".join(f"<td>B-spline:Fourier<br>12{i} µs<br><small>128 functions, 512 points</small></td>" for i in range(6))
    text = (ASSETS.parents[3] / "bench/index.html").read_text().replace("@cheapest_pairs@", f"<table><tr>{cells}</tr></table>")
    page.write_text(text)
    for target in re.findall(r'(?:href|src)="([^"#]+)', text):
        file = page.parent / target
        file.parent.mkdir(exist_ok=True)
        if not file.exists():
            file.write_text('<svg xmlns="http://www.w3.org/2000/svg" width="960" height="600"></svg>')
    look.sound(page)


def results_are_of_this_tree():
    """Whether `make reproduce` was run with the scripts and the style that the sources have."""
    return RESULTS.joinpath("index.html").exists() and all(
        (RESULTS / "assets" / one.name).exists() and (RESULTS / "assets" / one.name).read_bytes() == one.read_bytes()
        for one in ASSETS.iterdir())


@pytest.mark.parametrize("folder", [".", "extremes", "cases_of_others", "bench"])
def test_pages_of_make_reproduce_are_sound(look, folder):
    page = RESULTS / folder / "index.html"
    if not results_are_of_this_tree() or not page.exists():
        pytest.skip("make reproduce has not been run with this tree")
    look.sound(page)


def test_pictures_of_make_reproduce_are_legible(look):
    pictures = sorted(RESULTS.rglob("*.svg")) if results_are_of_this_tree() else []
    built = Path(os.environ["WAVEBALANCE_COMMAND"]).stat().st_mtime
    if not pictures or min(one.stat().st_mtime for one in pictures) < built:
        pytest.skip("the results are not those of this build: make reproduce")
    for picture in pictures:
        # Names of kernels instead of numbers; the states of a single contact.
        look.legible(picture, 0 if picture.name == "kernels.svg" else 1 if picture.parent.name == "cases_of_others" else 2)
