"""Pages of every command in a browser: page and pictures of each kind of analysis, of study, comparison and
overlay."""

import csv
import json

import pytest

FEW = ("--budget", "1", "--pairs", "fourier:fourier,haar:fourier,daubechies6:daubechies6")
REPORTS = {
    "forced response": ("run", "jones_legrand_2014/case1.toml"),
    "far from the gap": ("run", "jones_legrand_2014/case1.toml", "--set", "forcing.amplitude=1"),
    "far beyond the gap": ("run", "jones_legrand_2014/case1.toml", "--set", "forcing.amplitude=1e10"),
    "sweep": ("run", "jones_legrand_2014/case2_sweep.toml", "--set", "analysis.motion_at=peak", "--set", "analysis.stability=true"),
    "exact curve": ("run", "jones_legrand_2014/case2_sweep.toml", "--set", "analysis.exact=true"),
    "branches": ("run", "cases_of_others/small_gap_bar.toml", "--set", "time.functions=31", "--set", "time.quadrature_points=256"),
    "amplitude sweep": ("run", "jones_legrand_2014/case1.toml", "--set", "analysis.type=amplitude_sweep", "--set",
                        "analysis.amplitude_from=1e5", "--set", "analysis.amplitude_to=2e5", "--unset", "analysis.output_points",
                        "--set", "time.functions=31"),
    "nonlinear mode": ("run", "laxalde_legrand_2010/rod.toml"),
    "mode with stability": ("run", "matrices/strip_mode.toml"),
    "mode with friction": ("run", "cases_of_others/slider_mode.toml"),
    "friction": ("run", "friction/lift_off.toml"),
    "impacts": ("run", "impacts/oscillator.toml"),
    "coexisting motions": ("run", "laws/duffing.toml"),
    "motions": ("run", "impacts/between_stops.toml", "--analysis", "motions", "--set", "forcing.frequency=0.26"),
    "time stepping": ("run", "jones_legrand_2014/stepping_case1.toml"),
    "aperiodic motion": ("run", "impacts/hammer_diagram.toml", "--analysis", "time_stepping", "--set", "analysis.max_periods=100"),
    "bifurcation diagram": ("run", "impacts/hammer_diagram.toml", "--set", "analysis.values=9"),
    "tolerance": ("run", "tolerance/case1.toml"),
    "blade with a mesh": ("run", "blade/rotating_mode.toml", "--set", "analysis.harmonics=3"),
    "comparison": ("compare", "jones_legrand_2014/case1.toml", *FEW),
    "comparison of sweeps": ("compare", "jones_legrand_2014/case2_sweep.toml", *FEW),
}


def made(report, scenes, name):
    """The folder of the results of that name."""
    command, scene, *more = REPORTS[name]
    return report(command, scenes / scene, *more)


def sound(look, folder, page="report.html", least=2):
    """The page, and all pictures of the folder, whose axes have so many numbers."""
    look.sound(folder / page)
    for picture in folder.glob("*.svg"):
        look.legible(picture, least)


@pytest.mark.parametrize("name", REPORTS)
def test_report_is_sound(look, report, scenes, name):
    sound(look, made(report, scenes, name), least=1 if name == "friction" else 2)  # an axis of one contact


def test_facts_have_the_names_that_the_description_gives_them(look, browser, report, scenes):
    look.open(made(report, scenes, "friction") / "report.html")
    browser.value("document.querySelectorAll('details').forEach((one) => { one.open = true; })")
    names = browser.value("[...document.querySelectorAll('dt')].map((one) => one.textContent)")
    assert {"structure", "compliance", "at rest", "forcing"} <= set(names), names
    assert all(0 < len(name) <= 10 for name in names), names
    rest = browser.value("[...document.querySelectorAll('dt')].find((one) => one.textContent === 'at rest').nextElementSibling.innerText")
    assert [line.split(":")[0] for line in rest.split("\n")[1:]] == ["contact 1 normal (row 2)", "contact 1 tangent (row 1)"], rest


def test_a_tiny_motion_has_a_unit_in_which_it_can_be_read(look, browser, report, scenes):
    look.open(made(report, scenes, "far from the gap") / "report.html")
    look.near("document.querySelector('.motion')")
    assert browser.value("document.querySelector('.motion output').textContent") == "t = \u22120.5 T, u = \u22125.728 nm, force 0"
    assert "the nearest stays 1 mm short of its gap" in words_of(browser)
    look.open(made(report, scenes, "far beyond the gap") / "report.html")
    look.near("document.querySelector('.motion')")
    assert " m, force" in browser.value("document.querySelector('.motion output').textContent")


def test_the_table_of_motions_is_whole_or_keeps_the_names_of_its_rows(look, browser, report, scenes):
    look.open(made(report, scenes, "motions") / "report.html")
    box = "[...document.querySelectorAll('h3')].find((one) => one.textContent === 'Motions at this frequency').nextElementSibling"
    assert browser.value(f"{box}.querySelectorAll('thead th').length") > 2
    assert browser.value(f"{box}.scrollWidth - {box}.clientWidth") == 0
    browser.resize(400)
    left = f"{box}.querySelector('tbody td').getBoundingClientRect().left"
    before = browser.value(left)
    browser.value(f"{box}.scrollLeft = 1000")
    assert browser.value(left) == before


def test_statistics_have_units_and_are_whole_beside_the_picture(look, browser, report, scenes):
    look.open(made(report, scenes, "aperiodic motion") / "report.html")
    browser.value("document.querySelectorAll('details').forEach((one) => { one.open = true; })")
    box = "[...document.querySelectorAll('summary')].find((one) => one.textContent === 'Statistics').nextElementSibling"
    assert browser.value(f"{box}.scrollWidth - {box}.clientWidth") == 0
    rows = browser.value(f"[...{box}.querySelectorAll('tbody tr')].map((one) => [...one.children].map((cell) => cell.textContent))")
    assert all(len(row) == 4 for row in rows), rows
    speed = next(row for row in rows if row[1] == "velocity_rms")
    assert speed[2].endswith(" mm/s") and speed[3].endswith("m/s"), speed


def test_a_dark_screen_prints_dark_letters_on_white(look, browser, report, scenes):
    look.open(made(report, scenes, "sweep") / "report.html", dark=True)
    browser.send("Emulation.setEmulatedMedia", media="print", features=[{"name": "prefers-color-scheme", "value": "dark"}])
    shades = browser.value("['backgroundColor', 'color'].map((name) => getComputedStyle(document.body)[name])")
    browser.send("Emulation.setEmulatedMedia", media="")
    assert shades == ["rgb(255, 255, 255)", "rgb(29, 35, 41)"]


def test_on_a_wide_screen_what_follows_the_picture_stands_beside_it(look, browser, report, scenes):
    look.open(made(report, scenes, "forced response") / "report.html")
    places = browser.value("""["figure", ".motion"].map((one) => document.querySelector(one).getBoundingClientRect())
      .map(({ left, right, top, bottom }) => [left, right, top, bottom])""")
    (_, right, _, bottom), (left, _, top, _) = places
    assert top < bottom and left >= right
    browser.resize(800)
    assert browser.value("document.querySelector('.motion').getBoundingClientRect().top > document.querySelector('figure').getBoundingClientRect().bottom")


def test_an_enlarged_axis_stays_readable(look, browser, report, scenes):
    look.open(made(report, scenes, "comparison") / "report.html", 1000)
    browser.value("look.draw(true)")
    browser.value("document.querySelector('.plot svg').focus()")
    for _ in range(6):
        browser.send("Input.dispatchKeyEvent", type="keyDown", key="+", text="+")
        assert browser.value("look.unreadable()") == []


def words_of(browser):
    """The text of the page, folded or not."""
    return browser.value("document.querySelector('main').textContent")


def test_frequencies_are_told_in_hz_with_the_digits_that_a_reader_takes_in(look, browser, report, scenes):
    look.open(made(report, scenes, "friction") / "report.html")
    text = words_of(browser)
    assert "At 0.4775 Hz" in text and "0.4774648 Hz" in text and "-40.10705 degrees" in text and "mHz" not in text
    look.open(made(report, scenes, "blade with a mesh") / "report.html")
    assert "mode 1 has the frequency" in words_of(browser)


def test_a_comparison_gives_each_reason_once(look, browser, report, scenes):
    look.open(report("compare", scenes / "jones_legrand_2014/case1.toml", "--budget", "1") / "report.html")
    box = "[...document.querySelectorAll('h3')].find((one) => one.textContent === 'Not admissible').nextElementSibling"
    why = browser.value(f"[...{box}.querySelectorAll('td:last-child')].map((one) => one.textContent)")
    assert len(why) == len(set(why)) > 2
    look.open(made(report, scenes, "comparison of sweeps") / "report.html")
    places = browser.value("[...document.querySelectorAll('.named tbody tr')].map((one) => one.children[5].textContent)")
    assert len(places) > 3 and not any("e+" in place for place in places), places


def test_overlay_is_sound(look, report, scenes):
    folder = report("overlay", made(report, scenes, "sweep"), made(report, scenes, "exact curve"))
    sound(look, folder, "overlay.html")


def rows_of(file):
    """The rows of a CSV file as dictionaries."""
    with open(file, newline="") as text:
        return list(csv.DictReader(text))


def test_responses_alone_are_laid_over_each_other_as_motions(look, browser, report, scenes):
    first, second = (made(report, scenes, name) for name in ("forced response", "time stepping"))
    folder = report("overlay", first, second, "--quantity", "rms")
    sound(look, folder, "overlay.html")
    look.open(folder / "overlay.html")
    browser.value("look.draw(true)")
    axes = browser.value("[...document.querySelectorAll('.plot .label')].map((one) => one.textContent)")
    assert axes == ["Time (fraction of a period)", "Displacement (mm)"]
    drawn = [row for row in rows_of(folder / "overlay.csv") if row["curve"].endswith(", 150 Hz")]
    motions = [row for one in (first, second) for row in rows_of(one / "response.csv")]
    assert [(row["time_fraction"], row["displacement_m"]) for row in drawn] == \
        [(row["time_fraction"], row["displacement_m"]) for row in motions]


def test_motions_of_one_contact_are_laid_over_each_other(report, scenes):
    first, second = (report("run", scenes / "impacts/between_stops.toml", "--analysis", "forced_response",
                            "--set", f"forcing.frequency={frequency}") for frequency in (0.1, 0.2))
    leading = json.loads((first / "summary.json").read_text())["leading_contact"]
    drawn = rows_of(report("overlay", first, second) / "overlay.csv")
    motions = [row for one in (first, second) for row in rows_of(one / "contacts.csv") if row["contact"] == str(leading)]
    assert [row["displacement_m"] for row in drawn] == [row["displacement_m"] for row in motions]


def test_names_of_a_curve_with_impacts_stand_beside_each_other(browser, report, scenes):
    folder = report("run", scenes / "cases_of_others/impact_oscillator.toml")
    browser.open(folder / "sweep.svg", 2200, 6000)
    places = browser.value("""["half peak to peak", "rms without mean", "fold", "grazing"].map((name) =>
      [...document.querySelectorAll("text")].find((one) => one.textContent.trim() === name).getBoundingClientRect().left)""")
    assert len({round(place) for place in places}) == 2, places


def test_a_state_is_hidden_in_the_map_of_states_alone(look, browser, report, scenes):
    look.open(made(report, scenes, "friction") / "report.html")
    browser.value("look.draw(true)")
    count = "[...document.querySelectorAll('.plot')].map((one) => one.querySelectorAll('rect[opacity]').length)"
    before = browser.value(count)
    shade = browser.value("[...document.querySelectorAll('.plot')].pop().querySelector('rect[opacity]').getAttribute('opacity')")
    assert browser.value("document.querySelector('.legend .swatch rect').getAttribute('opacity')") == shade
    browser.click("document.querySelector('.legend button')")
    after = browser.value(count)
    assert before[0] > 0 and after[:-1] == before[:-1] and after[-1] < before[-1]


@pytest.mark.parametrize("sampling", ["grid", "list", "samples"])
def test_study_is_sound(look, report, scenes, tmp_path_factory, sampling):
    frequency = '[[parameters]]\nkey = "forcing.frequency"\nfrom = 100.0\nto = 200.0\n'
    others = {"grid": 'count = 5\n[[parameters]]\nkey = "contact.gap"\nfrom = 1e-4\nto = 1e-2\ncount = 3\nspacing = "logarithmic"\n',
              "list": 'count = 5\n[[parameters]]\nkey = "contact.constant"\nvalues = [1e7, 1e8]\n',
              "samples": '[[parameters]]\nkey = "contact.constant"\nfrom = 1e7\nto = 4e8\nspacing = "logarithmic"\n'}
    head = 'sampling = "sobol"\nsamples = 8\n' if sampling == "samples" else ""
    study = tmp_path_factory.mktemp("study") / f"{sampling}.toml"
    study.write_text(f'scene = "{scenes}/jones_legrand_2014/case1.toml"\nset = ["time.functions=15"]\n'
                     f'quantity = "max_displacement_m"\n{head}{frequency}{others[sampling]}')
    folder = report("study", study)
    sound(look, folder)
    look.open(folder / "report.html")
    quantities = look.browser.value("[...document.querySelectorAll('.named tbody td:first-child')].map((one) => one.textContent)")
    assert "max_displacement_m" in quantities and not {"condition_estimate", "leading_multiplier_real"} & set(quantities)
    rows = rows_of(folder / "study.csv")
    largest = max(rows, key=lambda row: float(row["max_displacement_m"]))
    commands = look.browser.value("[...document.querySelectorAll('pre')].map((one) => one.textContent)")
    assert any(f"forcing.frequency={largest['forcing.frequency']} " in one and f"run{largest['run']}" in one for one in commands), commands
    if sampling != "grid":
        return
    look.browser.value("look.draw(true)")
    place = look.browser.place("document.querySelector('.plot svg')")
    look.browser.mouse("mouseMoved", place)
    middle = next(row for row in rows if (row["forcing.frequency"], row["contact.gap"]) == ("150", "0.001"))
    told = look.browser.value("document.querySelector('.plot .values').innerText").split("\n")
    assert told[:3] == [f"run: {middle['run']}", "forcing.frequency (Hz): 150", "contact.gap (mm): 1"]
    assert float(told[3].split(": ")[1]) == pytest.approx(1e3 * float(middle["max_displacement_m"]), rel=1e-4)
    assert look.browser.errors == []
