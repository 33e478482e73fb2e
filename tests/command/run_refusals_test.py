"""Runs that are refused, interrupted or cannot be written leave no half results and change no foreign file."""

import json
import os
import signal
import subprocess

import pytest
from command_scenes import BAR, CHAIN_FILES, SWEEP, SYMMETRIC, changed, names_in, rows_of

QUICK = ("--no-report", "--quiet")


def test_bad_input_is_two_and_writes_nothing(command, tmp_path):
    bad = tmp_path / "bad.toml"
    bad.write_text(changed(BAR, ("gap = 1e-3", 'gap = "big"')))
    record = command("run", bad, "--output", "out")
    assert (record.code, record.errors) == (2, f'wavebalance: {bad}:13: contact.gap = "big": expected a number in m\n')
    assert not record.folder.exists()


@pytest.mark.parametrize("words", [("run", "--output", "out"), ("check",)])
def test_matrices_of_other_sizes_are_two_and_write_nothing(command, masses, tmp_path, words):
    (tmp_path / "m.mtx").write_text(SYMMETRIC + "2 2 2\n1 1 1\n2 2 1\n")
    record = command(words[0], masses, *words[1:])
    assert (record.code, record.errors) == (
        2, f'wavebalance: {masses}:3: structure.mass = "m.mtx": the matrix in {tmp_path}/m.mtx is 2 x 2; expected '
        f"3 x 3, the size of structure.stiffness in {tmp_path}/k.mtx\n")
    assert names_in(tmp_path) == {"case.toml", *CHAIN_FILES}


def test_output_under_a_file_is_two(command, bar):
    record = command("run", bar, "--output", bar / "out")
    assert record.code == 2
    assert "case.toml/out" in record.errors


def test_output_without_a_name_is_two(command, bar):
    record = command("run", bar, "--output", "")
    assert (record.code, record.errors) == (
        2, 'wavebalance: --output is ""; expected the name of a folder, which is made if it is missing\n')


def test_a_full_disk_is_two_and_leaves_nothing(bar, tmp_path):
    # A limit of 16 blocks lets the summary pass and stops the response half-way.
    limited = ["sh", "-c", 'ulimit -f 16; exec "$0" "$@"', os.environ["WAVEBALANCE_COMMAND"], "run", bar, "--no-report"]
    ended = subprocess.run([*limited, "--output", "out"], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert ended.returncode == 2
    assert "response.csv: cannot be written: File too large" in ended.stderr
    assert names_in(tmp_path) == {"case.toml"}


def catches(process, sent):
    """Whether a process has a handler for the signal, from /proc."""
    with open(f"/proc/{process.pid}/status", encoding="utf-8") as status:
        caught = next(line.split()[1] for line in status if line.startswith("SigCgt:"))
    return bool(int(caught, 16) >> (sent - 1) & 1)


def test_an_interrupted_motion_leaves_nothing(begin, bar, tmp_path):
    # No two periods agree to 1e-300: without the signal it would go on for hours.
    sets = ("analysis.type=time_stepping", "analysis.tolerance=1e-300", "analysis.max_periods=100000000",
            "structure.elements=200")
    running = begin("run", bar, "--output", "out", *[word for one in sets for word in ("--set", one)])
    running.wait_until(lambda: catches(running.process, signal.SIGINT))
    running.send(signal.SIGINT)
    ended = running.wait()
    assert ended.code == 130, ended.errors
    assert "interrupted, no results written" in ended.errors
    assert not (tmp_path / "out").exists()


def test_an_interrupted_sweep_leaves_its_points(begin, bar, tmp_path):
    sets = (*SWEEP[:2], "analysis.frequency_to=200", "analysis.first_step=1e-4", "analysis.largest_step=1e-4",
            "analysis.max_points=1000000")
    running = begin("run", bar, "--output", "out", *[word for one in sets for word in ("--set", one)], terminal=True)
    running.wait_until(lambda: "frequency sweep: step " in running.errors())
    running.send(signal.SIGINT)
    ended = running.wait()
    assert ended.code == 130, ended.errors
    assert "the results so far are written" in ended.errors
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert (summary["converged"], summary["status"]) == (False, "interrupted")
    assert len(rows_of(tmp_path / "out" / "sweep.csv")) > 1


def test_a_sweep_interrupted_in_its_stability_keeps_the_outputs_of_its_points(begin, bar, tmp_path):
    sets = (*SWEEP[:2], "analysis.frequency_to=200", "analysis.first_step=2e-2", "analysis.largest_step=2e-2",
            "analysis.max_points=1000000", "analysis.outputs=[3]")
    running = begin("run", bar, "--output", "out", *[word for one in sets for word in ("--set", one)], terminal=True)
    running.wait_until(lambda: "stability: step " in running.errors())
    running.send(signal.SIGINT)
    ended = running.wait()
    assert ended.code == 130, ended.errors
    rows = rows_of(tmp_path / "out" / "sweep.csv")
    assert len(rows) > 1000 and rows[-1]["unstable"] == "nan"
    assert all(float(row["node_3_half_peak_to_peak_m"]) > 0.0 for row in rows)


def test_a_folder_used_twice_holds_the_second_record_and_foreign_files(run):
    first = run(BAR)
    assert first.code == 0
    (first.folder / "backbone.csv").write_text("not of this record\n")
    second = run(BAR, set=SWEEP)
    assert second.code == 0, second.errors
    names = names_in(second.folder)
    assert {"summary.json", "sweep.csv", "sweep.svg", "scene.toml", "backbone.csv", "report.html"} <= names
    assert len(names) == 7
    assert (second.folder / "backbone.csv").read_text() == "not of this record\n"


def test_no_report_leaves_it_out_and_removes_that_of_an_earlier_run(run):
    assert "report.html" in names_in(run(BAR, "--quiet").folder)
    record = run(BAR, *QUICK)
    assert record.code == 0, record.errors
    assert names_in(record.folder) == {"summary.json", "scene.toml", "response.csv", "response.svg"}


def test_no_file_that_the_command_reads_is_replaced(command, tmp_path):
    scene, response = tmp_path / "scene.toml", tmp_path / "out" / "response.csv"
    scene.write_text(BAR)
    record = command("run", scene, "--output", tmp_path)
    assert (record.code, record.errors) == (
        2, f"wavebalance: {scene}: is read by this command and would be replaced; expected another folder of results\n")
    assert (scene.read_text(), names_in(tmp_path)) == (BAR, {"scene.toml"})
    assert command("run", scene, "--output", "out", *QUICK).code == 0
    before = response.read_text()
    for start in (tmp_path / "out", response):
        again = command("run", scene, "--output", "out", "--start-from", start)
        assert again.code == 2, start
        assert "is read by this command" in again.errors
    assert command("run", "out/scene.toml", "--output", "out").code == 2
    assert response.read_text() == before


@pytest.mark.parametrize("name", ["response.csv", "scene.toml", "summary.json", "response.svg"])
def test_no_file_that_no_record_lists_is_replaced(command, bar, tmp_path, name):
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / name).write_text("measured\n")
    record = command("run", bar, "--output", "out")
    assert record.code == 2
    assert f"{name}: would be replaced, and no summary.json" in record.errors
    assert (record.folder / name).read_text() == "measured\n"
    assert names_in(record.folder) == {name}


def test_a_foreign_file_that_a_run_does_not_write_stays(command, bar, tmp_path):
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "sweep.csv").write_text("measured\n")
    record = command("run", bar, "--output", "out", *QUICK)
    assert record.code == 0, record.errors
    assert (record.folder / "sweep.csv").read_text() == "measured\n"


def test_unset_leaves_keys_of_the_file_out(command, bar):
    left_out = [word for key in ("constant", "exponent", "gap") for word in ("--unset", f"contact.{key}")]
    checked = command("check", bar, "--set", "contact.law=none", *left_out)
    assert checked.code == 0, checked.errors
    wrong = command("check", bar, "--unset", "contact.constnt")
    assert (wrong.code, wrong.errors) == (
        2, f"wavebalance: --unset contact.constnt: there is no such key in {bar}; did you mean contact.constant?\n")
