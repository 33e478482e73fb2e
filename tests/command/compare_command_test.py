"""Pairs of bases against each other by `wavebalance compare`."""

import json
import re
import signal

import pytest
import wavebalance as wb
from command_scenes import BAR, names_in, rows_of

TWO_PAIRS = "fourier:fourier,haar:fourier"
SWEEP = [word for pair in ("analysis.type=frequency_sweep", "analysis.frequency_from=100", "analysis.frequency_to=110")
         for word in ("--set", pair)]


@pytest.fixture
def compare(command, bar):
    """Compares pairs for the scene of the bar."""
    return lambda *more: command("compare", bar, "--output", "out", *more)


def with_value(rows, name, value):
    return [row for row in rows if row[name] == value]


def test_files_and_page_say_what_to_take(compare, bar):
    record = compare("--pairs", TWO_PAIRS, "--budget", "2")
    assert record.code == 0, record.errors
    assert names_in(record.folder) == {
        "summary.json", "comparison.csv", "comparison.md", "error_over_time.svg", "error_over_functions.svg",
        "scene.toml", "report.html", "error_over_time.figure.js", "error_over_functions.figure.js"}
    on_page = ("For an error of 10⁻⁴ in displacement and force", "[time]\ntrial = ",
               "Reference: the exact periodic solution, accurate to ", "Results of each pair", "The motion is stable.",
               "error_over_time.figure.js", "wavebalance compare ",
               f'{TWO_PAIRS} <span class="whole">--budget</span> 2')
    assert [part for part in on_page if part not in record.page] == []
    said = ("The reference is the exact periodic solution", "For an error of 0.01 in displacement and force the cheapest pair is ",
            '[time]\ntrial = "')
    assert [part for part in said if part not in record.text] == [], record.text
    rows = rows_of(record.folder / "comparison.csv")
    assert len(with_value(rows, "trial", "haar")) > 4
    assert len(with_value(rows, "on_front", "true")) > 2
    assert len(with_value(with_value(rows, "trial", "phases"), "converged", "true")) >= 2
    assert "exact solution" in (record.folder / "error_over_time.svg").read_text()
    summary = record.summary
    assert (summary["converged"], summary["reference"], summary["budget_seconds"]) == (True, "phases", 2.0)
    in_summary = (record.folder / "summary.json").read_text()
    for part in ('"time_table": "[time]', '"basis_matters": ', '"fourier_time_ratio": '):
        assert part in in_summary
    assert wb.complete(record.folder / "scene.toml") == wb.complete(bar)


def test_the_report_names_pairs_that_are_none_and_is_left_out_on_demand(compare):
    record = compare("--budget", "1")
    assert record.code == 0, record.errors
    assert "Not admissible" in record.page
    without = compare("--pairs", "fourier:fourier", "--budget", "1", "--no-report", "--quiet")
    assert without.code == 0, without.errors
    assert not {"report.html", "error_over_time.figure.js"} & names_in(without.folder)
    assert "error_over_time.svg" in names_in(without.folder)


def test_curves_of_a_sweep_are_drawn_over_each_other(compare):
    record = compare("--pairs", "fourier:fourier,bspline:bspline", "--budget", "2", *SWEEP)
    assert record.code == 0, record.errors
    assert {"summary.json", "comparison.csv", "comparison.md", "sweeps.svg", "scene.toml", "report.html",
            "sweeps.figure.js"} <= names_in(record.folder)
    assert "distance from the finest" in record.page
    assert len(with_value(rows_of(record.folder / "comparison.csv"), "status", "reached_end")) > 2


@pytest.mark.parametrize("words, answer", [
    (("--pairs", "haar:haar"), "wavebalance: --pairs haar:haar: not an admissible pair: "),
    (("--pairs", "harr:fourier"), '"harr" is no basis; expected "fourier", "haar"'),
    (("--pairs", "haar"), '"haar" is no pair; expected TRIAL:WEIGHT'),
    (("--budget", "0"), "wavebalance: --budget 0: expected seconds > 0\n"),
    (("--budget", "soon"), "--budget"),
    (("--error", "energy"), "wavebalance: --error energy: expected displacement, force or both\n"),
    (("--threads", "two"), '--threads: "two": expected a whole number from 0 to 1024; 0: one per core'),
    (("--threads", "-1"), '--threads: "-1": expected a whole number from 0 to 1024'),
    (("--threads", "1025"), '--threads: "1025": expected a whole number from 0 to 1024'),
    (("--set", "contact.gab=1"), "unknown key; did you mean contact.gap?"),
    (("--set", "analysis.type=time_stepping"), 'analysis.type = "time_stepping": pairs of bases are compared'),
], ids=str)
def test_what_cannot_be_compared_is_two_and_names_what_is_allowed(compare, words, answer):
    refused = compare(*words)
    assert refused.code == 2
    assert answer in refused.errors
    assert not refused.folder.exists()


def test_without_a_reference_it_is_three_with_the_record(compare):
    record = compare("--budget", "1e-6")
    assert record.code == 3, record.errors
    assert "no reference to compare with (no_reference)" in record.errors
    assert record.summary["converged"] is False


def test_no_file_that_no_record_lists_and_not_its_scene_is_replaced(command, tmp_path):
    scene = tmp_path / "scene.toml"
    scene.write_text(BAR)
    own = command("compare", scene, "--output", tmp_path)
    assert own.code == 2
    assert "scene.toml: is read by this command" in own.errors
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "comparison.md").write_text("notes\n")
    foreign = command("compare", scene, "--output", "out")
    assert foreign.code == 2
    assert "comparison.md: would be replaced" in foreign.errors
    assert (tmp_path / "out" / "comparison.md").read_text() == "notes\n"


# Small problems of sweeps end before the signal arrives, which may then be between two curves.
@pytest.mark.parametrize("more, begun", [
    ((), " functions"),
    (("--threads", "2", *SWEEP), "[0-9]{3} functions: step [0-9][0-9]"),
], ids=["responses", "sweeps on two threads"])
def test_an_interrupted_comparison_writes_what_was_measured_so_far(begin, bar, tmp_path, more, begun):
    running = begin("compare", bar, "--output", "out", "--budget", "600", *more, terminal=True)
    running.wait_until(lambda: re.search(begun, running.errors()))
    running.send(signal.SIGINT)
    ended = running.wait()
    assert ended.code == 130, ended.errors
    assert "the results so far are written" in ended.errors
    assert json.loads((tmp_path / "out" / "summary.json").read_text())["status"] == "interrupted"
    rows = rows_of(tmp_path / "out" / "comparison.csv")
    assert len(rows) > 1
    if more:
        assert len(with_value(rows, "status", "reached_end")) > 1
        assert len(with_value(rows, "status", "interrupted")) >= 1
