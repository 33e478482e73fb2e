"""Common parts of the tests of scenes: the command as a user runs it, and small structures as files."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
SCENES = ROOT / "reproduce" / "scenes"
# Small matrices gain nothing from threads, and wait for cores that other tests use.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
os.environ.setdefault("WAVEBALANCE_COMMAND", str(ROOT / "build" / "default" / "wavebalance"))
os.environ.pop("LD_PRELOAD", None)  # of sanitizers, which this process has loaded and the command has built in
if "PYTHONPATH" not in os.environ:  # CTest names the package of its build
    sys.path.insert(0, str(ROOT / "build" / "default" / "python"))


class Record:
    """Result of one call of the command: its exit code, its texts and, where it wrote one, its results folder."""

    def __init__(self, ended, folder):
        self.code = ended.returncode
        self.text = ended.stdout
        self.errors = ended.stderr
        self.folder = folder

    @property
    def summary(self):
        return json.loads((self.folder / "summary.json").read_text())

    @property
    def page(self):
        return (self.folder / "report.html").read_text()


@pytest.fixture
def scenes():
    """The folder of the scenes of this project."""
    return SCENES


@pytest.fixture
def command(tmp_path):
    """Runs the command with arguments in a temporary folder."""

    def run(*arguments, timeout=200):
        program = os.environ["WAVEBALANCE_COMMAND"]
        ended = subprocess.run([program, *map(str, arguments)], cwd=tmp_path, capture_output=True, text=True,
                               check=False, timeout=timeout)
        return Record(ended, tmp_path / "out")

    return run


@pytest.fixture
def run(command, tmp_path):
    """Runs a scene, given as a path or as the text of a TOML file, with --set for each keyword-like pair."""

    def solve(scene, *arguments, set=(), timeout=200):
        if not isinstance(scene, Path):
            (tmp_path / "scene.toml").write_text(scene)
            scene = "scene.toml"
        sets = [word for pair in set for word in ("--set", pair)]
        return command("run", scene, "--output", tmp_path / "out", *sets, *arguments, timeout=timeout)

    return solve


@pytest.fixture
def matrix(tmp_path):
    """Writes a dense symmetric matrix, or a column, as a Matrix Market file of the test's folder."""

    def write(name, rows):
        entries = [(i + 1, j + 1, value) for i, row in enumerate(rows) for j, value in enumerate(row) if value != 0.0]
        lines = [f"{len(rows)} {len(rows[0])} {len(entries)}", *(f"{i} {j} {value!r}" for i, j, value in entries)]
        (tmp_path / name).write_text("%%MatrixMarket matrix coordinate real general\n" + "\n".join(lines) + "\n")
        return name

    return write


@pytest.fixture
def structure(matrix):
    """Writes mass, stiffness and damping, numbers of one mass or rows of matrices; the [structure] of a scene."""

    def text(mass, stiffness, damping):
        given = (("mass", mass), ("stiffness", stiffness), ("damping", damping))
        files = [(key, matrix(f"{key[0]}.mtx", rows if isinstance(rows, list) else [[rows]])) for key, rows in given]
        return '[structure]\ntype = "matrices"\n' + "".join(f'{key} = "{name}"\n' for key, name in files)

    return text


@pytest.fixture
def absorber(structure):
    """The text of a sweep over a driven mass of 1 kg with an absorber of 0.05 kg."""

    def text(stiffness, damping, contact, amplitude, analysis):
        masses = structure([[1.0, 0.0], [0.0, 0.05]], stiffness, damping)
        return masses + f"""[contact]
{contact}
[forcing]
load_dofs = [1]
amplitude = {amplitude}
[time]
trial = "fourier"
weight = "fourier"
functions = 31
quadrature_points = 128
[analysis]
type = "frequency_sweep"
{analysis}
"""

    return text


CHAIN = """
[structure]
type = "matrices"
mass = "m.mtx"
stiffness = "k.mtx"
{damping}
contact_dofs = [2]
[contact]
{contact}
{forcing}
{time}
[analysis]
{analysis}
"""


@pytest.fixture
def chain(matrix):
    """The text of a scene of two masses between springs, of which the second is in contact and the first loaded."""

    def text(contact, analysis, time="", damped=True, forcing="[forcing]\nload_dofs = [1]\namplitude = 5.0\nfrequency = 4.0"):
        matrix("m.mtx", [[1.0, 0.0], [0.0, 0.5]])
        matrix("k.mtx", [[2e3, -1e3], [-1e3, 1e3]])
        damping = "modal_damping = 0.02" if damped else ""
        return CHAIN.format(contact=contact, analysis=analysis, time=time, damping=damping, forcing=forcing)

    return text
