"""Rows of a study equal its runs with any number of threads, and after the study was killed."""

import concurrent.futures
import itertools
import json
import os
import re
import subprocess

import numpy as np
import pytest
import wavebalance as wb
from command_scenes import BAR, curves_of

QUICK = {"time.functions": 15, "time.quadrature_points": 64}


def bar_study(count, **more):
    """The bar at so many frequencies, with few functions."""
    return wb.study(BAR, {"forcing.frequency": {"from": 120, "to": 160, "count": count}}, QUICK, **more)


def same(one, other):
    """Equal tables but for the times."""
    assert list(one.table) == list(other.table)
    for name in set(one.table) - {"seconds"}:
        np.testing.assert_array_equal(one.table[name], other.table[name], err_msg=name)


@pytest.fixture(scope="module")
def twelve(tmp_path_factory):
    """A study of 12 runs on one thread, with its journal."""
    folder = tmp_path_factory.mktemp("twelve")
    return bar_study(12, threads=1, output=folder), (folder / "study.journal").read_bytes()


@pytest.fixture
def resumed(twelve, tmp_path):
    """The study of 12 runs that goes on from a journal with other lines."""

    def go_on(change):
        header, *rows = twelve[1].splitlines(keepends=True)
        assert [json.loads(row)["run"] for row in rows] == list(range(1, 13))
        (tmp_path / "study.journal").write_bytes(header + b"".join(change(rows)))
        return bar_study(12, output=tmp_path)

    return go_on


def test_rows_are_those_of_the_record_with_any_number_of_threads(twelve):
    one, three = twelve[0], bar_study(12, threads=3)
    assert [study.summary["workers"] for study in (one, three)] == [1, 3]
    assert [study.summary["runs_solved_now"] for study in (one, three)] == [12, 12]
    same(one, three)
    alone = wb.run(BAR, {**QUICK, "forcing.frequency": one.table["forcing.frequency"][5]})
    assert one.table["status"][5] == "converged"
    assert one.table["max_displacement_m"][5] > 1e-4
    assert one.table["max_displacement_m"][5] == alone.summary["max_displacement_m"]


def test_runs_that_share_a_structure_have_the_digits_of_each_alone(scenes):
    keys = {"structure.modal_damping": [0.01, 0.02], "contact.stiffness": [1e4, 2e4], "forcing.frequency": [70.0, 75.0]}
    scene = scenes / "matrices" / "strip_forced.toml"
    study = wb.study(scene, keys, {"time.functions": 15}, threads=1)
    assert study.converged and len(study) == 8
    for run, values in enumerate(itertools.product(*keys.values())):
        alone = wb.study(scene, {key: [value] for key, value in zip(keys, values)}, {"time.functions": 15})
        for name in set(study.table) - {"run", "seconds"}:
            np.testing.assert_array_equal(study.table[name][run], alone.table[name][0], err_msg=name)


def test_a_run_that_is_refused_is_a_row_and_the_others_go_on():
    study = wb.study(BAR, {"time.functions": [15, 0, 31]})
    assert study.status == "not_converged"
    assert study.table["status"] == ["converged", "refused", "converged"]
    assert "time.functions = 0" in study.table["message"][1]
    assert study.table["converged"][2]


def test_a_run_that_does_not_converge_has_no_results_and_is_not_drawn():
    study = wb.study(BAR, {"analysis.max_periods": [1, 2]}, {"analysis.type": "time_stepping"},
                     quantity="max_contact_force_N")
    assert study.table["status"] == ["iteration_limit"] * 2
    for name in ("max_displacement_m", "min_displacement_m", "rms_displacement_m", "max_contact_force_N",
                 "contact_fraction"):
        assert np.isnan(study.table[name]).all(), name
    assert np.isfinite([study.table["iterations"], study.table["frequency_Hz"]]).all()
    assert study.svg() == ""
    assert len(study.summary["quantiles"]["quantity"]) == 0


def row(run, **values):
    """A line of a journal."""
    head = {"run": run, "status": "converged", "converged": True, "seconds": 0.25, "message": ""}
    return json.dumps({**head, **values}).encode() + b"\n"


def test_values_of_a_row_survive_its_journal(resumed):
    given = {"status": "stalled", "converged": False, "message": 'a "message"\nof two lines', "number": 0.1,
             "whole": 1.0, "count": 3, "truth": True, "text": "newton", "missing": None}
    study = resumed(lambda rows: [row(7, **given), b'{"run": 1}\n'])
    assert study.summary["runs_solved_now"] == 11  # the line without a status is none
    assert study.summary["journal_lines_unreadable"] == 1
    read = {name: study.table[name][6] for name in given}
    assert np.isnan(read.pop("missing"))
    assert read == {name: value for name, value in given.items() if name != "missing"}
    assert study.table["seconds"][6] == 0.25


def test_a_study_shows_results_below_the_least_normal_number(resumed):
    study = resumed(lambda rows: [row(7, max_displacement_m=5e-324), *rows[7:]])
    assert study.table["max_displacement_m"][6] == 5e-324
    assert "<svg" in study.svg()


def test_a_killed_study_goes_on_with_nothing_lost_and_nothing_twice(twelve, resumed, tmp_path):
    # Killed as it wrote a row, which is cut off.
    study = resumed(lambda rows: [rows[3], rows[0], rows[8], b'{"run":5,"status":"conv'])
    assert study.summary["runs_solved_now"] == 9
    assert study.summary["journal_lines_unreadable"] == 0
    same(study, twelve[0])
    again = bar_study(12, output=tmp_path)
    assert again.summary["runs_solved_now"] == 0
    same(again, study)


def test_lines_of_the_journal_that_cannot_be_read_are_counted_and_their_runs_solved_again(twelve, resumed, tmp_path):
    def damaged(rows):
        return [rows[0], rows[1][:3] + b"\xff" + rows[1][4:], rows[2], 4 * b"\0" + rows[3][4:],
                b'{"run":99,"status":"converged"}\n']

    study = resumed(damaged)
    assert study.summary["journal_lines_unreadable"] == 3
    assert study.summary["runs_solved_now"] == 10
    same(study, twelve[0])
    again = bar_study(12, output=tmp_path)
    assert again.summary["runs_solved_now"] == 0
    same(again, study)


class Second(concurrent.futures.Executor):
    """Begins the same study a second time while the first one goes on."""

    def submit(self, function, /, *arguments, **keywords):
        bar_study(12, output=self.folder)


def test_the_journal_of_another_study_or_one_in_use_is_refused(twelve, tmp_path):
    executor = Second()
    executor.folder = tmp_path
    with pytest.raises(OSError, match="another study writes to this folder now"):
        bar_study(12, output=tmp_path, executor=executor)
    with pytest.raises(OSError, match="belongs to another study"):
        bar_study(11, output=tmp_path)
    (tmp_path / "study.journal").write_text("something else\n")
    with pytest.raises(OSError, match="is no journal of a study"):
        bar_study(12, output=tmp_path)


def test_a_journal_that_cannot_be_written_ends_the_study(bar, tmp_path):
    (tmp_path / "study.toml").write_text(
        'scene = "case.toml"\n[[parameters]]\nkey = "forcing.frequency"\nfrom = 120\nto = 160\ncount = 50\n')
    limited = ["sh", "-c", 'ulimit -f 8; exec "$0" "$@"', os.environ["WAVEBALANCE_COMMAND"], "study", "study.toml"]
    ended = subprocess.run([*limited, "--output", "out"], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert ended.returncode == 2
    assert "study.journal: cannot be written" in ended.stderr
    with pytest.raises(ValueError, match="threads"):
        bar_study(2, threads=-1)


def test_quantiles_are_those_of_the_runs_that_converged(tmp_path):
    gaps = {"contact.gap": [1, 2, 3, 4, 5, 6]}
    wb.study(BAR, gaps, QUICK, output=tmp_path)
    header = (tmp_path / "study.journal").read_bytes().splitlines(keepends=True)[0]
    rows = [row(i + 1, max_displacement_m=10.0 * i, same=1.0) for i in (4, 1, 2, 3, 0)]
    rows.append(row(6, status="stalled", converged=False, max_displacement_m=1e9, same=1.0))
    (tmp_path / "study.journal").write_bytes(header + b"".join(rows))
    study = wb.study(BAR, gaps, QUICK, output=tmp_path)
    assert (study.summary["runs_solved_now"], study.status) == (0, "not_converged")
    assert list(study.table["run"]) == [1, 2, 3, 4, 5, 6]
    quantiles = study.summary["quantiles"]
    assert list(quantiles["quantity"]) == ["max_displacement_m"]
    expected = {"mean": 20.0, "min": 0.0, "q05": 2.0, "q25": 10.0, "median": 20.0, "q95": 38.0, "max": 40.0}
    assert {name: quantiles[name][0] for name in expected} == pytest.approx(expected, rel=0, abs=1e-13 * 40.0)
    assert study.svg().count("</svg>") == 1


def test_axes_of_a_map_are_numbered_by_what_the_parameters_are_in_readable_units(tmp_path):
    gaps = {"from": 1e-4, "to": 1e-2, "count": 5, "spacing": "logarithmic"}
    loads = {"from": 5e4, "to": 1e5, "count": 3}
    study = wb.study(BAR, {"contact.gap": gaps, "forcing.amplitude": loads}, QUICK, output=tmp_path)
    (panel,) = curves_of((tmp_path / "study.figure.js").read_text())["panels"]
    assert panel["x"]["label"] == "contact.gap (mm)"
    assert panel["x"]["texts"] == ["0.1", "1", "10"]
    assert panel["x"]["ticks"] == pytest.approx([-1.0, 0.0, 1.0], rel=0, abs=1e-12)
    assert panel["y"]["label"] == "forcing.amplitude (kN)"
    assert panel["series"][0]["y"][-1] == pytest.approx(100.0, rel=0, abs=1e-9)
    places = [float(x) for text in panel["x"]["texts"] for x in re.findall(
        rf"translate\(([0-9.]+),[0-9.]+\)[^>]*>\s*<text><tspan[^>]*>{text}<", study.svg())]
    assert len(places) == 3 and places[2] - places[1] == pytest.approx(places[1] - places[0], rel=0, abs=0.02)
