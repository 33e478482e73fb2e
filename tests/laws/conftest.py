"""Scenes that the tests of laws share, each test changing one thing, and the fixtures that read and solve them."""

import tomllib
from pathlib import Path

import pytest

import wavebalance as wb

# The number at the end of a line is that line's.
BAR = """[structure]
type = "bar"                    # 2
youngs_modulus = 70e9           # 3
density = 2700                  # 4, an integer where a number is wanted
area = 25e-4                    # 5
length = 1.0                    # 6
elements = 25                   # 7
stiffness_damping = 1e-4        # 8
[contact]
law = "exponential"             # 10
constant = 1e8                  # 11
exponent = 50.0                 # 12
gap = 1e-3                      # 13
[forcing]
amplitude = 250e3               # 15
frequency = 150.0               # 16
[time]
trial = "fourier"               # 18
weight = "fourier"              # 19
functions = 64                  # 20
quadrature_points = 256         # 21
[analysis]
type = "forced_response"        # 23
"""

CHAIN = """[structure]
type = "matrices"               # 2
mass = "m.mtx"                  # 3
stiffness = "k.mtx"             # 4
contact_dofs = [2, 3]           # 5
modal_damping = 0.01            # 6
[contact]
law = "linear"                  # 8
stiffness = 1e7                 # 9
gap = 1e-4                      # 10
[forcing]
load_dofs = [3]                 # 12
amplitude = 100.0               # 13
frequency = 50.0                # 14
[time]
trial = "fourier"
weight = "fourier"
functions = 32
[analysis]
type = "forced_response"        # 20
"""
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
