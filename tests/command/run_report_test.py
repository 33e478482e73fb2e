"""Pages of runs: the problem, the results, and the moving motion."""

import numpy as np
import pytest
import wavebalance as wb
from command_scenes import BAR, CHAIN, changed, curves_of, names_in, tables_of, words_of


@pytest.fixture(scope="module")
def solve(tmp_path_factory):
    """Solves a scene, given as path or text, with other values; returns its record and its folder."""

    def run(scene, overrides=None):
        folder = tmp_path_factory.mktemp("run") / "out"
        return wb.run(scene, overrides, folder), folder

    return run


def page_of(folder):
    return (folder / "report.html").read_text()


def lacking(page, *parts):
    return [part for part in parts if part not in page]


def test_the_report_tells_what_was_asked_and_what_came_out(command, bar):
    record = command("run", bar, "--output", "out", "--set", "contact.gap=1.1e-3", "--quiet")
    assert record.code == 0, record.errors
    assert lacking(record.page, "<h1>case: Forced response of a bar</h1>", "was solved", "the gap of 1.1 mm",
                   "--set</span> contact.gap=1.1e-3", "The motion is stable", 'href="response.csv"',
                   'src="response.svg"', 'alt="') == []
    assert "<h2>Warnings" not in record.page


@pytest.mark.parametrize("analysis", ["forced_response", "time_stepping"])
def test_the_moving_bar_of_the_report_is_the_motion_of_the_response(run, analysis):
    folder = run(BAR, "--quiet", set=[f"analysis.type={analysis}"]).folder
    tip = curves_of((folder / "response.motion.js").read_text())["reference"]["tip"]
    response = np.loadtxt(folder / "response.csv", delimiter=",", skiprows=1, usecols=1)
    assert tip == pytest.approx(response[np.arange(128) * len(response) // 128], rel=0, abs=1e-8)


def test_tables_have_the_digits_that_a_reader_needs_and_no_column_without_a_value(solve, scenes):
    record, folder = solve(scenes / "jones_legrand_2014" / "case2_sweep.toml")
    head, *shown = tables_of(page_of(folder))["Exact bifurcation and grazing points"]
    points = record.summary["structure_special_points"]
    assert head == list(points)
    assert set(points["type"]) == {"grazing", "fold"}

    def text(column, value):
        places = column == "frequency_Hz"
        if isinstance(value, str) or np.isnan(value):
            return value if isinstance(value, str) else ""
        shown = f"{value:.{10 if places else 6}g}"
        if "e" not in shown:
            return shown
        mantissa, exponent = shown.split("e")
        return f"{mantissa}·10" + str(int(exponent)).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))

    assert shown == [[text(name, points[name][i]) for name in head] for i in range(len(shown))]
    assert shown[0][head.index("multiplier_real")] == ""
    record, folder = solve(scenes / "jones_legrand_2014" / "case2_sweep.toml",
                           {"analysis.frequency_from": 1200.0, "analysis.frequency_to": 1250.0})
    assert record.summary["structure_special_points"]["type"] == ["grazing"]
    without = tables_of(page_of(folder))["Exact bifurcation and grazing points"][0]
    assert without == [name for name in head if not name.startswith("multiplier")]


def test_the_report_says_where_contacts_stand_and_what_outputs_do(command, masses):
    masses.write_text(changed(CHAIN, ("[time]", "[[forcing.terms]]\nharmonic = 0\namplitude = 300.0\n[time]")))
    gaps = ("--set", "contact.gap=[1.0, 1e-4]", "--quiet")
    motion = command("run", masses, "--output", "out", "--set", "analysis.outputs=[1]", *gaps).page
    assert lacking(motion, "At rest under the static loads 1 of 2 contacts is closed", "The vibration of row 1 is ",
                   'src="outputs.svg"', 'href="outputs.csv"') == []
    came_out = words_of(motion).split("At rest under")[0]
    assert "is between" in came_out and "gap of" not in came_out  # contacts have different gaps
    curve = command("run", masses, "--output", "out", "--analysis", "frequency_sweep", "--set",
                    "analysis.frequency_from=40", "--set", "analysis.frequency_to=50", *gaps).page
    assert "The vibration of contact 2 is at most " in curve


def test_the_report_says_what_impacts_do(solve, scenes):
    once = page_of(solve(scenes / "impacts" / "oscillator.toml")[1])
    assert lacking(once, "There is 1 impact in the period of the motion, at up to 1.696 m/s", "the gap of 1 m",
                   'href="impacts.csv"') == []
    assert "There is no contact" not in once
    lasts = page_of(solve(scenes / "impacts" / "bar_without_rebound.toml")[1])
    assert "Contact lasts for 8.4 % of the period" in lasts


def test_the_report_shows_the_motions_of_a_curve_below_the_curve(solve, scenes):
    record, folder = solve(scenes / "jones_legrand_2014" / "case2_sweep.toml", {"analysis.motion_at": "peak"})
    assert record.converged
    assert "motion_peak.svg" in names_in(folder)
    page = page_of(folder)
    assert page.index('src="sweep.svg"') < page.index('src="motion_peak.svg"')
    assert "Contact intervals" in page


def test_the_report_says_that_nothing_was_found(run, scenes):
    record = run(scenes / "jones_legrand_2014" / "case2_sweep.toml", "--quiet", set=["analysis.max_points=5"])
    assert record.code == 3, record.errors
    assert lacking(record.page, "The curve is not complete (point limit)",
                   "<h1>case2_sweep: Frequency response of a bar</h1>") == []
