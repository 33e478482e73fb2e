"""Scenes that the tests of laws share, each test changing one thing, and the fixtures that read and solve them."""

import tomllib
from pathlib import Path

import pytest
from scene_texts import BAR, CHAIN

import wavebalance as wb

CHAIN_STIFFNESS = [[2e6, -1e6, 0.0], [-1e6, 2e6, -1e6], [0.0, -1e6, 1e6]]
CHAIN_MASS = [[2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0]]


@pytest.fixture
def bar_text():
    """A bar against an exponential spring."""
    return BAR


@pytest.fixture
def chain_text(matrix, monkeypatch, tmp_path):
    """Three masses of 2 kg between springs of 1e6 N/m, the last two at stops, with the files of their matrices."""
    monkeypatch.chdir(tmp_path)
    matrix("k.mtx", CHAIN_STIFFNESS)
    matrix("m.mtx", CHAIN_MASS)
    return CHAIN


@pytest.fixture(scope="session")
def changed():
    """A text with the first occurrence of each left part, which must be there, replaced by the right one."""

    def change(text, *changes):
        for old, new in changes:
            assert old in text, f"no such text: {old}"
            text = text.replace(old, new, 1)
        return text

    return change


@pytest.fixture
def scene_file(tmp_path, monkeypatch):
    """Writes the text of a scene as case.toml of the current folder, which is the test's, and returns its name."""
    monkeypatch.chdir(tmp_path)

    def write(text):
        (tmp_path / "case.toml").write_text(text)
        return "case.toml"

    return write


@pytest.fixture
def completed(scene_file):
    """The values of a scene's text with every default filled in, by sections."""

    def values(text, overrides=None, unset=()):
        return tomllib.loads(wb.complete(scene_file(text), overrides, unset=unset))

    return values


@pytest.fixture
def refusal(scene_file):
    """The error that loading a scene's text ends with."""

    def error(text, overrides=None, unset=()):
        with pytest.raises(wb.SceneError) as raised:
            wb.complete(scene_file(text), overrides, unset=unset)
        return raised.value

    return error


@pytest.fixture
def solved(scene_file):
    """The record of a scene's text."""

    def record(text, overrides=None, unset=()):
        return wb.run(scene_file(text), overrides, unset=unset)

    return record


@pytest.fixture(scope="session")
def written_equal():
    """Asserts that a scene, completed, has every value that its text gives and is complete."""

    def check(scene):
        text = wb.complete(scene)
        assert wb.complete(text) == text
        given = tomllib.loads(scene.read_text() if hasattr(scene, "read_text") else scene)
        assert_holds(tomllib.loads(text), given)
        return text

    return check


def assert_holds(whole, part):
    """Whether tables hold all of others; names of files and of degrees of freedom are resolved."""
    for key, value in part.items():
        if isinstance(value, dict):
            assert_holds(whole[key], value)
        elif isinstance(value, list) and value and isinstance(value[0], dict):
            assert len(whole[key]) == len(value)
            for one, other in zip(whole[key], value):
                assert_holds(one, other)
        elif isinstance(value, str) and value.endswith((".mtx", ".csv")):
            assert whole[key].endswith(value), key
        else:
            assert whole[key] == value, key


@pytest.fixture(scope="session")
def scenes_folder():
    """The folder of the scenes of this project, for what is solved once."""
    return Path(__file__).resolve().parents[2] / "reproduce" / "scenes"


@pytest.fixture(scope="module")
def solve(folder):
    """The record of one of the scenes of a folder, the test module's fixture, which converged."""

    def record(name, *overrides, unset=()):
        found = wb.run(folder / name, overrides, unset=unset)
        assert found.converged, found.status
        return found

    return record
