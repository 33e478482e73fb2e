"""The command line: check, help, wrong usage, and the scenes of this project."""

import re
from pathlib import Path

import pytest
import wavebalance as wb
from command_scenes import BAR, ROD, names_in, with_tolerance

SCENES = Path(__file__).resolve().parents[2] / "reproduce" / "scenes"
PROJECT = (SCENES.parents[1] / "CMakeLists.txt").read_text()
VERSION = re.search(r"project\(wavebalance VERSION ([0-9.]+)", PROJECT).group(1)


@pytest.fixture
def check(command, tmp_path):
    """Output of check for the text of a valid scene, with --set for each pair."""

    def ask(text, *pairs):
        (tmp_path / "case.toml").write_text(text)
        checked = command("check", "case.toml", *[word for pair in pairs for word in ("--set", pair)])
        assert checked.code == 0, checked.errors
        return checked.text

    return ask


def test_check_says_what_a_scene_is_expected_to_take(check):
    assert re.search("cost       about [0-9]+ ms and ", check(BAR))
    assert " GB of memory" in check(BAR, "time.functions=1048576", "time.quadrature_points=16777216",
                                    "analysis.output_points=16777216")


@pytest.mark.parametrize("text, pairs, parts", [
    (BAR, ["time.functions=32"], ["32 unknowns", "admissible"]),
    (ROD, [], ["rigid obstacle", "10 harmonics", "200 points", "20 contact forces", "1297 Hz"]),
    (with_tolerance("1e-3"), [], ["chosen for a relative error of 0.001"]),
], ids=["response", "mode", "tolerance"])
def test_check_says_what_would_be_solved_and_writes_nothing(check, tmp_path, text, pairs, parts):
    said = check(text, *pairs)
    assert [part for part in parts if part not in said] == [], said
    assert ("forcing" in said) == ("[forcing]" in text)
    assert names_in(tmp_path) == {"case.toml"}


def test_check_of_an_inadmissible_pair_is_two(command, bar):
    checked = command("check", bar, "--set", "time.trial=haar", "--set", "time.weight=haar")
    assert checked.code == 2
    assert "--set time.trial=haar" in checked.errors


def test_help_holds_a_scene_that_loads(command):
    helped = command("--help")
    assert helped.code == 0
    text = helped.text[helped.text.index("[structure]"):helped.text.index("\nCommands to start with")]
    assert wb.complete(text) == wb.complete(BAR, {"time.functions": 63})  # an odd number has no Nyquist function
    for part in ("Exit codes", "wavebalance run", "wavebalance check", "keys"):
        assert part in helped.text


@pytest.mark.parametrize("words", [
    [], ["solve", "case.toml"], ["run"], ["run", "case.toml"], ["run", "case.toml", "--output"], ["check"],
    ["check", "case.toml", "--sett", "a.b=1"], ["check", "case.toml", "--set"], ["check", "case.toml", "--set", "gap"],
    ["check", "missing.toml"]], ids=" ".join)
def test_wrong_usage_is_two(command, bar, words):
    assert command(*words).code == 2


@pytest.mark.parametrize("words, answer", [
    (["chek"], "did you mean check?"),
    (["case.toml"], "did you mean run case.toml?"),
    ([], "no command; there are run, "),
    (["help"], "did you mean --help?"),
    (["run", "case.toml", "--outptu", "x"], "did you mean --output?"),
], ids=str)
def test_wrong_words_are_answered_with_what_is_probably_meant(command, bar, words, answer):
    assert answer in command(*words).errors


@pytest.mark.parametrize("words, answer", [
    (["nonsense"], "unknown command nonsense; there are run, check, compare, overlay, study, keys, init, convert"),
    (["run", "case.toml"], "--output is required; `wavebalance run --help` lists its options"),
    (["run", "case.toml", "--outpt", "x"],
     "there is no option --outpt (did you mean --output?); `wavebalance run --help` lists its options"),
    (["run", "{folder}/missing.toml", "--output", "results"],
     "{folder}/missing.toml: there is no such file; `wavebalance init` writes a scene to start from"),
    (["check", "{folder}/missing.toml"],
     "{folder}/missing.toml: there is no such file; `wavebalance init` writes a scene to start from"),
    (["compare", "{folder}/missing.toml", "--output", "results"],
     "{folder}/missing.toml: there is no such file; `wavebalance init` writes a scene to start from"),
], ids=str)
def test_wrong_words_are_named_beside_what_there_is(command, bar, tmp_path, words, answer):
    record = command(*[word.format(folder=tmp_path) for word in words])
    assert (record.code, record.errors) == (2, f"wavebalance: {answer.format(folder=tmp_path)}\n")


@pytest.mark.parametrize("threads", ["-1", "1.5", "two", "", "1025"])
def test_threads_that_are_none_are_named_with_what_is_allowed_and_nothing_is_written(command, bar, threads):
    record = command("run", bar, "--output", "out", "--threads", threads)
    assert record.code == 2
    assert f'--threads: "{threads}": expected a whole number from 0 to 1024; 0: one per core' in record.errors
    assert not record.folder.exists()


def test_the_version_is_the_projects(command):
    assert command("--version").text == f"wavebalance {VERSION}\n"


def test_the_scenes_of_this_project_load():
    def needs_calculix(scene):  # which makes its matrices; the test of the pipe's page has them
        folder = scene.parent
        return (folder / f"{folder.name}.inp").exists() and not (folder / f"{folder.name}.sti").exists()

    loaded = [wb.complete(scene) for scene in sorted(SCENES.rglob("*.toml")) if not needs_calculix(scene)]
    assert len(loaded) >= 3 and all(loaded)
