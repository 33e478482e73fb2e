"""Files of results appear together or not at all, and hold every number as it was."""

import csv
import json
import math
import os
import subprocess

import pytest
import wavebalance as wb
from command_scenes import BAR, names_in

QUICK = ("--no-report", "--quiet")
ENDLESS = ("--set", "analysis.type=time_stepping", "--set", "analysis.tolerance=1e-300", "--set",
           "analysis.max_periods=100000000")


@pytest.fixture
def limited(tmp_path):
    """Runs the command where files may hold so many blocks of 512 bytes, as on a full disk."""

    def run(blocks, *words):
        shell = ["sh", "-c", f'ulimit -f {blocks}; exec "$0" "$@"', os.environ["WAVEBALANCE_COMMAND"], *words]
        return subprocess.run(shell, cwd=tmp_path, capture_output=True, text=True, check=False, timeout=60)

    return run


def test_a_folder_below_others_appears_with_its_files(command, bar, tmp_path):
    assert command("run", bar, "--output", "deep/down", *QUICK).code == 0
    assert names_in(tmp_path / "deep") == {"down"}
    assert names_in(tmp_path / "deep" / "down") == {"summary.json", "scene.toml", "response.csv", "response.svg"}


def test_a_full_disk_leaves_no_folder_that_was_not_there(limited, bar, tmp_path):
    ended = limited(16, "run", bar, "--no-report", "--output", "deep/down")
    assert ended.returncode == 2
    assert "response.csv: cannot be written: File too large" in ended.stderr
    assert names_in(tmp_path) == {"case.toml"}


def test_a_full_disk_is_an_error_before_work_starts(limited, bar, tmp_path):
    ended = limited(0, "run", bar, "--output", "out", *ENDLESS)
    assert ended.returncode == 2
    assert "out" in ended.stderr and "cannot be written" in ended.stderr
    assert names_in(tmp_path) == {"case.toml"}


def test_the_earlier_record_stays_where_the_next_one_cannot_be_written(run, limited):
    first = run(BAR)
    assert first.code == 0, first.errors
    (first.folder / "foreign.csv").write_text("old\n")
    before = {one.name: one.read_bytes() for one in first.folder.iterdir()}
    words = ("run", "scene.toml", "--output", "out", "--no-report", "--set", "contact.gap=2e-3")
    assert limited(16, *words).returncode == 2
    assert {one.name: one.read_bytes() for one in first.folder.iterdir()} == before
    second = run(BAR, *QUICK, set=["contact.gap=2e-3"])
    assert second.code == 0, second.errors
    assert before.keys() - names_in(second.folder) == {"report.html", "response.figure.js", "response.motion.js"}
    assert (second.folder / "response.csv").read_bytes() != before["response.csv"]
    assert (second.folder / "foreign.csv").read_text() == "old\n"


@pytest.mark.parametrize("output, reason", [
    ("case.toml", "is not a folder"),
    ("case.toml/below", "cannot be created: Not a directory"),
    ("/proc/wavebalance/out", "cannot be created: No such file or directory"),
])
def test_a_folder_that_cannot_be_is_named_with_the_reason(command, bar, output, reason):
    record = command("run", bar, "--output", output)
    assert (record.code, record.errors) == (2, f"wavebalance: {output}: {reason}\n")


def test_a_folder_in_place_of_a_file_of_the_record_is_an_error(run):
    first = run(BAR, *QUICK)
    (first.folder / "response.csv").unlink()
    (first.folder / "response.csv").mkdir()
    second = run(BAR, *QUICK)
    assert second.code == 2
    assert "response.csv: " in second.errors
    assert (first.folder / "response.csv").is_dir()


@pytest.mark.parametrize("make, reason", [
    (os.mkfifo, "it is not a regular file"),
    (lambda file: file.symlink_to("/dev/zero"), "it is not a regular file"),
    (lambda file: file.mkdir(), "it is a folder"),
    (lambda file: file.write_text("#" * (1 << 20) + "\n"), "it has more than 1048576 bytes"),
], ids=["pipe", "device", "folder", "large file"])
def test_no_device_pipe_or_file_that_is_too_large_is_read(command, tmp_path, make, reason):
    make(tmp_path / "scene.toml")
    checked = command("check", "scene.toml")
    assert (checked.code, checked.errors) == (2, f"wavebalance: scene.toml: cannot be read: {reason}\n")


def test_a_file_of_the_largest_size_is_read(command, tmp_path):
    (tmp_path / "scene.toml").write_text(BAR + "#" * ((1 << 20) - len(BAR)))
    assert (tmp_path / "scene.toml").stat().st_size == 1 << 20
    assert command("check", "scene.toml").code == 0


CELLS = ", as in the first line (a comma separates cells; decimals take a point)"


@pytest.mark.parametrize("text, reason", [
    ("\n", "holds no line of column names"),
    ("# a comment\na,b\n", "line 2: 2 cells; expected 1" + CELLS),
    ("a,b\n1,2\n3\n", "line 3: 1 cells; expected 2" + CELLS),
    ('a,b\n"1,2\n', "line 2: a quote is not closed"),
])
def test_tables_that_are_none_are_errors_with_the_line(command, bar, tmp_path, text, reason):
    (tmp_path / "start.csv").write_text(text)
    refused = command("run", bar, "--output", "out", "--start-from", "start.csv")
    assert (refused.code, refused.errors) == (2, f"wavebalance: start.csv: {reason}\n")


NUMBERS = [1.0 / 3.0, 5e-324, -1.7976931348623157e308, -0.0, 1e22, 0.1]


@pytest.fixture(scope="module")
def table(tmp_path_factory):
    """The folder of a study whose rows are given by its journal."""
    folder = tmp_path_factory.mktemp("study")
    gaps = {"contact.gap": [i + 0.5 for i in range(len(NUMBERS))]}
    few = {"time.functions": 15, "time.quadrature_points": 64}
    wb.study(BAR, gaps, few, output=folder)
    header = (folder / "study.journal").read_text().splitlines()[0]
    ends = [("stalled", False)] * 5 + [("converged", True)]
    rows = [{"run": i + 1, "status": status, "converged": converged, "seconds": 0.25,
             "message": "" if i else 'a,"b"\nc', "error": number, "missing": 0.5 if i else None, "count": i}
            for i, (number, (status, converged)) in enumerate(zip(NUMBERS, ends))]
    (folder / "study.journal").write_text("\n".join([header, *map(json.dumps, rows)]) + "\n")
    assert wb.study(BAR, gaps, few, output=folder).summary["runs_solved_now"] == 0
    return folder


def test_a_table_has_its_names_in_the_first_row_and_quotes_where_a_text_needs_them(table):
    text = (table / "study.csv").read_text()
    assert text.startswith("run,contact.gap,status,converged,seconds,error,missing,count,message\n"
                           '1,0.5,stalled,false,0.25,0.3333333333333333,nan,0,"a,""b""\nc"\n'
                           "2,1.5,stalled,false,0.25,5e-324,0.5,1,\n")


def test_a_table_holds_every_number_as_it_was(table):
    with open(table / "study.csv", newline="", encoding="utf-8") as lines:
        rows = list(csv.DictReader(lines))
    assert [float(row["error"]) for row in rows] == NUMBERS
    assert math.copysign(1.0, float(rows[3]["error"])) == -1.0
    assert rows[0]["message"] == 'a,"b"\nc'
    assert math.isnan(float(rows[0]["missing"]))
    assert [row["converged"] for row in rows] == ["false"] * 5 + ["true"]


def test_a_summary_keeps_its_order_and_makes_missing_numbers_null(run):
    record = run(BAR, *QUICK, set=("analysis.type=time_stepping", "analysis.max_periods=1"))
    text = (record.folder / "summary.json").read_text()
    assert text == json.dumps(record.summary, indent=2, ensure_ascii=False) + "\n"
    assert list(record.summary)[:4] == ["converged", "status", "residual", "iterations"]
    assert record.summary["residual"] is None and type(record.summary["iterations"]) is int


def test_a_summary_holds_texts_with_quotes_and_lists(run, tmp_path):
    record = run(BAR, *QUICK, set=['time.trial="fourier"', "analysis.outputs=[25]"])
    assert record.code == 0, record.errors
    assert record.summary["set"] == ['time.trial="fourier"', "analysis.outputs=[25]"]


def test_a_name_that_is_no_utf_8_is_replaced(command, tmp_path):
    folder = os.fsencode(tmp_path)
    with open(folder + b"/\xff\xfe.toml", "w", encoding="utf-8") as file:
        file.write(BAR)
    words = [os.environ["WAVEBALANCE_COMMAND"], "run", b"\xff\xfe.toml", "-o", "out", *QUICK]
    ended = subprocess.run(words, cwd=tmp_path, capture_output=True, check=False)
    assert ended.returncode == 0, ended.stderr
    assert json.loads((tmp_path / "out" / "summary.json").read_text(encoding="utf-8"))["converged"] is True


def test_files_of_a_record_are_plain_names(run):
    first = run(BAR, *QUICK)
    (first.folder / "a.csv").write_text("of the record\n")
    (first.folder.parent / "b").write_text("foreign\n")
    listed = {"version": "1", "files": [{"name": "a.csv"}, {"name": "../b"}, {"name": 3}, 4]}
    (first.folder / "summary.json").write_text(json.dumps(listed))
    for name in ("scene.toml", "response.csv", "response.svg"):
        (first.folder / name).unlink()
    second = run(BAR, *QUICK)
    assert second.code == 0, second.errors
    assert "a.csv" not in names_in(second.folder)
    assert (first.folder.parent / "b").read_text() == "foreign\n"


@pytest.mark.parametrize("text", ["", "[1]", "{", '{"files": [{"name": "response.csv"}]}', '{"version": "1"}'])
def test_a_summary_of_others_lists_no_files(command, bar, tmp_path, text):
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "summary.json").write_text(text)
    (tmp_path / "out" / "response.csv").write_text("measured\n")
    refused = command("run", bar, "--output", "out")
    assert refused.code == 2
    assert ": would be replaced, and no summary.json" in refused.errors
    assert (tmp_path / "out" / "response.csv").read_text() == "measured\n"
    assert (tmp_path / "out" / "summary.json").read_text() == text
