"""A scene over values of its keys by `wavebalance study`."""

import json
import signal

import pytest
from command_scenes import BAR, names_in, rows_of

SAMPLES = """set = ["time.functions=15", "time.quadrature_points=64"]
[[parameters]]
key = "forcing.frequency"
from = 120
to = 160
count = 5
[[parameters]]
key = "forcing.amplitude"
values = [150e3, 250e3]
"""
SMALL = 'scene = "case.toml"\n' + SAMPLES


@pytest.fixture
def study(command, bar, tmp_path):
    """Solves a study of the bar, given as text."""

    def solve(text, *more):
        (tmp_path / "study.toml").write_text(text)
        return command("study", "study.toml", "--output", "out", *more)

    return solve


def test_a_row_per_run_a_picture_and_a_page_are_written(study):
    record = study(SMALL)
    assert record.code == 0, record.errors
    assert names_in(record.folder) >= {"study.csv", "study.npz", "study.svg", "summary.json", "report.html",
                                       "scene.toml", "study.journal"}
    assert "10 of 10 runs have ended, and 10 of them converged." in record.text
    rows = rows_of(record.folder / "study.csv")
    assert len(rows) == 10
    assert float(rows[-1]["run"]) == 10.0
    assert float(rows[1]["forcing.amplitude"]) == 250e3
    on_page = ("10 of 10 runs have ended", "wavebalance study ", "Quantiles", "max_displacement_m")
    assert [part for part in on_page if part not in record.page] == []
    assert "quantiles" in record.summary


def test_a_run_has_the_values_of_the_command_run(study, run):
    record = study(SMALL)
    assert record.code == 0, record.errors
    row = rows_of(record.folder / "study.csv")[3]
    record.folder.rename(record.folder.with_name("map"))
    alone = run(BAR, "--no-report", set=("time.functions=15", "time.quadrature_points=64", "forcing.frequency=130",
                                         "forcing.amplitude=250e3"))
    assert alone.code == 0, alone.errors
    assert f'"max_displacement_m": {row["max_displacement_m"]},' in (alone.folder / "summary.json").read_text()


def test_a_run_that_does_not_converge_is_three_and_the_page_names_the_command_that_repeats_it(study):
    record = study('scene = "case.toml"\n[[parameters]]\nkey = "time.functions"\nvalues = [15, 0, 31]\n')
    assert record.code == 3, record.errors
    assert "refused               1" in record.text
    assert "\nconverged" not in record.text  # set by the previous line
    assert '--set</span> time.functions=0 <span class="whole">--output</span> run2' in record.page


@pytest.mark.parametrize("text, more, answer", [
    ('scene = "none.toml"\n' + SAMPLES, (), "none.toml: cannot be read"),
    (SMALL + "vallues = 3\n", (), "study.toml:11: parameters[2].vallues = 3: unknown key; did you mean values?"),
    (SMALL, ("--threads", "-1"), '--threads: "-1": expected a whole number from 0 to 1024'),
    (SMALL, ("--threads", "100000"), '--threads: "100000": expected a whole number from 0 to 1024'),
    (SMALL, ("--thread", "1"), "did you mean --threads?"),
], ids=["scene", "key", "negative threads", "many threads", "option"])
def test_wrong_studies_and_options_are_two_and_nothing_is_written(study, text, more, answer):
    refused = study(text, *more)
    assert refused.code == 2
    assert answer in refused.errors
    assert not refused.folder.exists()


def test_its_scene_and_files_that_no_record_lists_are_not_replaced(command, tmp_path):
    (tmp_path / "scene.toml").write_text(BAR)
    (tmp_path / "study.toml").write_text('scene = "scene.toml"\n' + SAMPLES)
    own = command("study", "study.toml", "--output", tmp_path)
    assert own.code == 2
    assert "scene.toml: is read by this command" in own.errors
    assert names_in(tmp_path) == {"scene.toml", "study.toml"}
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "study.csv").write_text("measured\n")
    foreign = command("study", "study.toml", "--output", "out")
    assert foreign.code == 2
    assert "study.csv: would be replaced" in foreign.errors
    assert (tmp_path / "out" / "study.csv").read_text() == "measured\n"


def test_another_study_in_the_same_folder_is_refused_and_the_first_stays(study):
    first = study(SMALL)
    assert first.code == 0, first.errors
    before = (first.folder / "study.csv").read_text()
    second = study(SMALL + '# other\n[[parameters]]\nkey = "contact.gap"\nvalues = [1e-3]\n')
    assert second.code == 2
    assert "belongs to another study or scene; name another folder" in second.errors
    assert (first.folder / "study.csv").read_text() == before


@pytest.fixture
def killed(begin, bar, tmp_path):
    """A study of a second or more, which gets a signal once its journal has rows."""
    (tmp_path / "long.toml").write_text(
        'scene = "case.toml"\nset = ["time.functions=127", "time.quadrature_points=4096"]\n'
        '[[parameters]]\nkey = "forcing.frequency"\nfrom = 120\nto = 160\ncount = 3000\n')
    words = ("study", "long.toml", "--output", "out", "--threads", "1")
    journal = tmp_path / "out" / "study.journal"

    def end(sent):
        running = begin(*words)
        running.wait_until(lambda: journal.exists() and journal.stat().st_size > 8000)
        running.send(sent)
        return running.wait(), words

    return end


def test_an_interrupted_study_writes_the_runs_so_far_and_goes_on(killed, tmp_path):
    ended, _ = killed(signal.SIGINT)
    assert ended.code == 130, ended.errors
    assert "the same command goes on from here" in ended.errors
    assert 1 < len(rows_of(tmp_path / "out" / "study.csv")) < 3000
    assert json.loads((tmp_path / "out" / "summary.json").read_text())["status"] == "interrupted"


def test_a_killed_study_keeps_its_rows_in_the_journal(killed, begin, tmp_path):
    ended, words = killed(signal.SIGKILL)
    assert ended.code == -signal.SIGKILL
    assert not (tmp_path / "out" / "study.csv").exists()
    again = begin(*words)
    again.wait_until(lambda: "are there already" in again.errors())
    again.send(signal.SIGKILL)
    assert " of 3000 runs are there already" in again.wait().errors
