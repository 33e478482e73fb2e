"""Scenes that `wavebalance init` writes to start from."""

import re
from pathlib import Path

import pytest
from command_scenes import names_in

README = Path(__file__).resolve().parents[2] / "README.md"


@pytest.mark.parametrize("kind", ["bar", "matrices", "blade"])
def test_a_scene_that_it_writes_is_solved_as_it_is(command, tmp_path, kind):
    scene = tmp_path / "mine.toml"
    written = command("init", kind, "--output", scene)
    assert written.code == 0, written.errors
    assert f"wavebalance run {scene}" in written.text
    solved = command("run", scene, "--output", "out")
    assert solved.code == 0, solved.errors
    assert solved.summary["converged"] is True
    assert solved.summary.get("contact_fraction") != 0.0


def test_the_beam_of_matrices_has_the_first_frequency_of_an_euler_bernoulli_cantilever(command):
    command("init", "matrices", "--output", "beam.toml")
    # (1.8751 / l)^2 / (2 pi) sqrt(E h^2 / (12 rho)) = 16.77 Hz
    modes = re.search("modes +([0-9.]+)", command("check", "beam.toml").text).group(1)
    assert modes.startswith("16.7")


def test_it_overwrites_nothing_and_leaves_nothing_behind(command, tmp_path):
    (tmp_path / "mine_mass.mtx").write_text("precious")
    refused = command("init", "matrices", "--output", "mine.toml")
    assert refused.code == 2
    assert "mine_mass.mtx exists and is not overwritten" in refused.errors
    assert (tmp_path / "mine_mass.mtx").read_text() == "precious"
    assert names_in(tmp_path) == {"mine_mass.mtx"}


def test_wrong_names_are_answered_with_what_is_allowed(command):
    kinds = command("init", "matrixes")
    assert kinds.errors == "wavebalance: init matrixes: there are bar, matrices, blade, study; did you mean matrices?\n"
    file = command("init", "--output", "scene.txt")
    assert file.code == 2
    assert "expected the name of a file that ends in .toml" in file.errors


def test_a_study_is_one_that_runs(command):
    written = command("init", "study", "--output", "map.toml")
    assert written.code == 0, written.errors
    assert "next:    wavebalance study " in written.text
    solved = command("study", "map.toml", "--output", "map")
    assert solved.code == 0, solved.errors
    assert "117 of 117 runs have ended, and 117 of them converged." in solved.text


def test_it_writes_the_scene_of_the_readme(command, tmp_path):
    command("init", "bar")
    assert f"```toml\n{(tmp_path / 'bar.toml').read_text()}```" in README.read_text()


def test_next_steps_are_said_where_a_run_does_not_converge(command):
    command("init", "matrices", "--output", "beam.toml")
    record = command("run", "beam.toml", "--output", "out", "--no-report", "--set", "analysis.max_points=3")
    assert record.code == 3
    assert "what may help: a larger analysis.max_points" in record.errors
