"""Records that can be moved: names of files relative to the record, or copies of them in it."""

import re
import shutil

import pytest
import wavebalance as wb
from command_scenes import CHAIN, CHAIN_FILES, changed


@pytest.fixture
def project(tmp_path):
    """A folder with a scene and its matrices in a separate folder."""
    (tmp_path / "project" / "data").mkdir(parents=True)
    for name, text in CHAIN_FILES.items():
        (tmp_path / "project" / "data" / name).write_text(text)
    (tmp_path / "project" / "case.toml").write_text(changed(
        CHAIN, ('"m.mtx"', '"data/m.mtx"'), ('"k.mtx"', '"data/k.mtx"'), ("load_dofs = [3]", 'load = "data/f.mtx"')))
    return tmp_path / "project"


@pytest.fixture
def solve(project, command):
    """Solves the scene of the project into one of its folders."""
    return lambda output, *more: command("run", project / "case.toml", "--output", project / output, "--quiet", *more)


def stiffness_of(scene):
    return re.search('\nstiffness = "(.*)"', wb.complete(scene)).group(1)


def test_a_project_is_moved_with_its_records(project, solve, tmp_path):
    assert solve("results/a").code == 0
    assert 'mass = "../../data/m.mtx"' in (project / "results/a/scene.toml").read_text()
    assert str(project / "data") not in (project / "results/a/report.html").read_text()
    project.rename(tmp_path / "elsewhere")
    assert "\nfrequency = 50.0 " in wb.complete(tmp_path / "elsewhere/results/a/scene.toml")


def test_a_record_with_copies_stands_alone(project, solve, command, tmp_path):
    record = solve("a", "--copy-inputs")
    assert record.code == 0, record.errors
    assert (project / "a/input_m.mtx").read_text() == CHAIN_FILES["m.mtx"]
    (project / "a").rename(tmp_path / "sent")
    shutil.rmtree(project)
    assert stiffness_of(tmp_path / "sent/scene.toml") == str(tmp_path / "sent/input_k.mtx")
    again = command("run", "sent/scene.toml", "--output", "b")
    assert again.code == 0, again.errors


def test_a_comparison_with_copies_stands_alone(project, command, tmp_path):
    compared = command("compare", project / "case.toml", "--output", project / "c", "--quiet", "--budget", "0.2",
                       "--pairs", "fourier:fourier", "--copy-inputs")
    assert compared.code in (0, 3), compared.errors  # 3: the time was too short for a reference
    (project / "c").rename(tmp_path / "sent")
    shutil.rmtree(project)
    assert stiffness_of(tmp_path / "sent/scene.toml") == str(tmp_path / "sent/input_k.mtx")


def test_copies_of_one_name_are_kept_apart(project, solve):
    (project / "other").mkdir()
    (project / "other/m.mtx").write_text(CHAIN_FILES["k.mtx"])
    assert solve("a", "--copy-inputs", "--set", "structure.stiffness=other/m.mtx").code == 0
    assert (project / "a/input_m.mtx").read_text() == CHAIN_FILES["m.mtx"]
    assert (project / "a/input_2_m.mtx").read_text() == CHAIN_FILES["k.mtx"]


def test_copies_of_an_earlier_record_are_replaced_and_no_other_file(project, solve):
    assert solve("a", "--copy-inputs").code == 0
    assert (project / "a/input_m.mtx").exists()
    assert solve("a").code == 0
    assert not (project / "a/input_m.mtx").exists()
    (project / "b").mkdir()
    (project / "b/input_m.mtx").write_text("mine")
    assert solve("b", "--copy-inputs").code == 2
    assert (project / "b/input_m.mtx").read_text() == "mine"
