"""Results of `wavebalance run`: its files, its summary and its exit codes."""

import json
import os
import re
import subprocess

import pytest
import wavebalance as wb
from command_scenes import BAR, ROD, SWEEP, names_in, rows_of, with_tolerance

QUICK = ("--no-report", "--quiet")


def test_a_response_is_written_with_its_table_picture_page_and_scene(command, bar):
    record = command("run", bar, "--output", "out")
    assert (record.code, record.errors) == (0, "")
    assert names_in(record.folder) == {"report.html", "summary.json", "response.csv", "response.svg", "scene.toml",
                                       "response.figure.js", "response.motion.js"}
    assert record.summary["converged"] is True
    assert "response.csv" in {file["name"] for file in record.summary["files"]}
    assert len(rows_of(record.folder / "response.csv")) == 1024
    assert (record.folder / "response.csv").read_text().startswith("time_fraction,displacement_m,")
    assert wb.complete(record.folder / "scene.toml") == wb.complete(bar)


def test_quiet_says_nothing(command, bar):
    record = command("run", bar, "-o", "out", "--quiet")
    assert (record.code, record.text, record.errors) == (0, "", "")


def test_the_terminal_has_one_line_per_finding_with_four_digits_and_the_path_of_the_report(command, bar):
    record = command("run", bar, "--output", "out")
    lines = record.text.splitlines()
    assert len(lines) <= 8
    assert lines[0].startswith("The scene was solved in ") and lines[-1].startswith("Report: out/report.html")
    assert any("the displacement is between" in line and "mm" in line for line in lines)
    assert any("is stable" in line for line in lines)
    assert not re.search(r"\d{5}", record.text)
    values = command("run", bar, "--output", "out", "--verbose").text
    assert "max_displacement_m" in values and "written to out: summary.json, report.html" in values


@pytest.mark.parametrize("scene", ["impacts/between_stops.toml", "laws/duffing.toml", "friction/slider.toml", "cases_of_others/slider_mode.toml"])
def test_curves_and_modes_print_at_most_eight_lines_as_responses_do(command, scenes, scene):
    record = command("run", scenes / scene, "--output", "out")
    lines = record.text.splitlines()
    assert 3 <= len(lines) <= 8
    assert "solved in " in lines[0] and lines[-1].endswith("all values: summary.json, --verbose")
    page = (record.folder / "report.html").read_text()
    more = re.search(r"Report with (\d+) more findings?: ", lines[-1])
    if "points" in record.summary and "mode" not in scene:  # folds before branches, which the page has too
        assert more and len(lines) == 8
        assert any(line.startswith("Folds, where the curve turns back: ") for line in lines)
    if scene == "impacts/between_stops.toml":
        assert not any(line.startswith("Along branch") for line in lines) and "Along branch 1 motions are unstable at" in page


def test_a_condition_past_1e12_is_warned_of_also_when_quiet(run, scenes):
    near_resonance = "forcing.frequency=1273.14709322245"  # a part in 1e12 above the bar's first natural frequency
    record = run(scenes / "extremes" / "bar_linear.toml", "--quiet",
                 set=("contact.gap=1e15", "structure.stiffness_damping=0", near_resonance))
    assert "wavebalance: warning: the condition estimate " in record.errors
    assert any(one.startswith("the condition estimate ") for one in record.summary["warnings"])


def test_a_tolerance_chooses_the_sizes_and_says_how(run):
    record = run(with_tolerance("1e-3"), "--verbose")
    assert record.code == 0, record.errors
    assert "estimated_error" in record.text
    summary = record.summary
    assert (summary["converged"], summary["tolerance"], summary["trial"]) == (True, 1e-3, "fourier")
    assert isinstance(summary["ladder"], list) and "seconds" in summary["ladder"][0]
    assert {"estimated_error", "functions", "quadrature_points"} <= summary.keys()


def test_a_tolerance_out_of_reach_is_three(run):
    # A loss factor, so that phases do not apply, and contact that lasts, so that rounding ends the refinement.
    record = run(with_tolerance("1e-13"), *QUICK, set=("contact.gap=-5e-3", "structure.loss_factor=0.2",
                                                       "structure.stiffness_damping=0"))
    assert record.code == 3, record.errors
    assert "stagnated" in record.errors
    assert record.summary["converged"] is False


def test_overrides_are_in_the_results(command, bar):
    record = command("run", bar, "--output", "out", "--set", "time.trial=haar", "--set", "contact.gap=2e-3", *QUICK)
    assert record.code == 0, record.errors
    assert "\ngap = 0.002 " in wb.complete(record.folder / "scene.toml")
    text = (record.folder / "summary.json").read_text()
    for part in ('case.toml"', '"time.trial=haar"', '"contact.gap=2e-3"', '"version": '):
        assert part in text


def test_matrices_write_every_contact_and_the_whole_motion(run, scenes):
    scene = scenes / "matrices" / "strip_forced.toml"
    record = run(scene)
    assert record.code == 0, record.errors
    names = names_in(record.folder)
    assert {"summary.json", "response.csv", "response.svg", "contacts.csv", "motion.mtx", "scene.toml"} <= names
    assert len(names) == 8
    assert len(rows_of(record.folder / "contacts.csv")) == 2 * 1024
    assert "\n72 32\n" in (record.folder / "motion.mtx").read_text()
    assert record.summary["degrees_of_freedom"] == 72
    assert wb.complete(record.folder / "scene.toml") == wb.complete(scene)


def test_the_motion_of_a_blade_is_a_series_for_paraview(run, scenes):
    record = run(scenes / "laxalde_legrand_2010" / "blade_mode.toml", *QUICK,
                 set=("structure.chord_elements=3", "structure.span_elements=4", "analysis.energy_ratio=0.5",
                      "analysis.motion_points=4"))
    assert record.code == 0, record.errors
    series = (record.folder / "motion.pvd").read_text()
    for name in ("motion_0000.vtu", "motion_0003.vtu"):
        assert name in series
        assert 'Name="stress"' in (record.folder / name).read_text()
    assert len(rows_of(record.folder / "contacts.csv")) == 8 * 1024


def test_failure_to_converge_is_three_with_the_record(run):
    record = run(BAR, set=("analysis.type=time_stepping", "analysis.max_periods=1"))
    assert record.code == 3
    assert "not converged" in record.errors
    assert record.summary["converged"] is False


def test_without_gnuplot_the_numbers_remain(bar, tmp_path):
    words = [os.environ["WAVEBALANCE_COMMAND"], "run", bar, "--no-report", "--output", "out"]
    ended = subprocess.run(words, cwd=tmp_path, env={**os.environ, "PATH": "/nowhere"}, capture_output=True,
                           text=True, check=False)
    assert ended.returncode == 0
    assert "no picture" in ended.stderr
    assert "summary.json" in names_in(tmp_path / "out")
    assert "response.svg" not in names_in(tmp_path / "out")


def test_a_sweep_says_with_what_it_was_solved_and_where_its_peak_is(run):
    record = run(BAR, *QUICK, set=SWEEP)
    assert record.code == 0, record.errors
    expected = {"trial": "fourier", "weight": "fourier", "functions": 64, "quadrature_points": 256,
                "formulation": "distributional"}
    assert {name: record.summary[name] for name in expected} == expected
    assert record.summary["version"]
    assert 100.0 <= record.summary["frequency_at_max_displacement_Hz"] < 200.0


def test_a_nonlinear_mode_writes_its_backbone(command, tmp_path):
    (tmp_path / "rod.toml").write_text(ROD)
    record = command("run", "rod.toml", "--output", "out")
    assert record.code == 0, record.errors
    assert {"summary.json", "backbone.csv", "backbone.svg", "scene.toml", "report.html"} <= names_in(record.folder)
    assert len(names_in(record.folder)) == 6
    rows = rows_of(record.folder / "backbone.csv")
    assert "rayleigh_frequency_ratio" in rows[0] and len(rows) > 50
    assert wb.complete(record.folder / "scene.toml") == wb.complete(tmp_path / "rod.toml")


def test_a_mode_of_a_prescribed_energy_writes_a_response(run):
    record = run(ROD, *QUICK, set=["analysis.energy_ratio=0.7"])
    assert record.code == 0, record.errors
    assert "response.csv" in names_in(record.folder)
    assert record.summary["status"] == "linear"


def test_a_mode_without_a_motion_of_that_energy_is_three(run):
    record = run(ROD, *QUICK, set=["analysis.energy_ratio=1e9"])
    assert record.code == 3
    assert record.summary["converged"] is False
    assert "response.csv" not in names_in(record.folder)


@pytest.mark.parametrize("large", ["analysis.output_points=16777216", "time.quadrature_points=16777216"])
def test_more_memory_than_allowed_is_two_before_anything_is_taken(run, large):
    record = run(BAR, "--max-memory", "0.5", set=[large])
    assert record.code == 2
    assert "this scene would need about " in record.errors
    assert " GB of memory and --max-memory allows 500 MB" in record.errors
    assert not record.folder.exists()


def test_a_scene_that_takes_less_memory_than_allowed_is_solved(run):
    assert run(BAR, "--max-memory", "0.5", *QUICK).code == 0


def test_runs_on_several_threads_have_the_digits_of_one(command, scenes, tmp_path):
    def response(threads):
        record = command("run", scenes / "matrices" / "strip_forced.toml", *QUICK, "--output", threads, "--threads",
                         threads)
        assert record.code == 0, record.errors
        return (tmp_path / threads / "response.csv").read_text()

    one = response("1")
    assert one
    assert [threads for threads in ("0", "2", "3") if response(threads) != one] == []


def test_a_response_starts_from_a_motion_of_an_earlier_sweep(command, stop, tmp_path):
    assert command("run", stop(sweep=True), "-o", "curve", *QUICK, "--set",
                   'analysis.motion_at=["peak", 0.18, 0.185]').code == 0
    response = ("run", stop(sweep=False), "--set", "analysis.type=forced_response", "-o", "upper", "--start-from")
    several = command(*response, "curve")
    assert several.code == 2
    assert "name the one to start from" in several.errors
    assert command(*response, "nowhere").code == 2
    assert not (tmp_path / "upper").exists()
    found = command(*response, "curve/motion_0.185Hz_1.csv", "--verbose")
    assert found.code == 0, found.errors
    assert "start_distance" in found.text
    motions = [[float(row["displacement_m"]) for row in rows_of(tmp_path / name)]
               for name in ("upper/response.csv", "curve/motion_0.18Hz_1.csv")]
    assert motions[0] == pytest.approx(motions[1], rel=0, abs=1e-7)
    assert "--start-from" in (tmp_path / "upper" / "report.html").read_text()
    assert json.loads((tmp_path / "upper" / "summary.json").read_text())["converged"]
