"""The examples of bodies of finite elements: a bracket from CalculiX, and two cantilevers one above the other."""

import re
import shutil
import subprocess
import tomllib

import numpy as np
import pytest
import scipy.linalg
from structure_scenes import MATRICES, displacements, forces, solved

import wavebalance as wb

BRACKET = MATRICES / "bracket" / "bracket.toml"
CANTILEVERS = MATRICES / "cantilevers.toml"
SEVEN_DIGITS = 5e-7
# Angular frequencies that CalculiX 2.20 prints to bracket.dat without SOLVER=MATRIXSTORAGE.
PRINTED = np.array([1209.001, 2116.397, 4139.416, 12790.14, 16661.76, 26761.51, 34920.78, 52844.25])


def calculix_matrix(file):
    """A symmetric matrix from a line "row column value" for each entry of one triangle."""
    rows, columns, values = np.loadtxt(file, unpack=True)
    rows, columns = rows.astype(int) - 1, columns.astype(int) - 1
    matrix = np.zeros((rows.max() + 1, rows.max() + 1))
    matrix[rows, columns] = matrix[columns, rows] = values
    return matrix


def mesh_nodes(file):
    """Number and x, y, z of each node of an input file of CalculiX."""
    lines = re.search(r"\*NODE.*\n((?:[^*].*\n)+)", file.read_text())[1].splitlines()
    return [(int(words[0]), *map(float, words[1:])) for words in (line.split(",") for line in lines)]


@pytest.fixture(scope="module")
def bracket():
    return solved(BRACKET)


def test_the_matrices_of_the_bracket_have_the_frequencies_that_calculix_prints():
    stiffness, mass = (calculix_matrix(BRACKET.with_suffix(suffix)) for suffix in (".sti", ".mas"))
    squares = scipy.linalg.eigh(stiffness, mass, subset_by_index=(0, len(PRINTED) - 1), eigvals_only=True)
    np.testing.assert_allclose(np.sqrt(squares), PRINTED, rtol=SEVEN_DIGITS)


@pytest.mark.parametrize("mode", range(1, len(PRINTED) + 1))
def test_the_bracket_has_the_frequencies_that_calculix_prints(mode):
    record = wb.run(BRACKET, {"analysis.type": "nonlinear_mode", "analysis.mode": mode, "analysis.points": 2,
                              "analysis.harmonics": 1, "analysis.last_frequency_ratio": 1.01, "contact.law": "rigid"},
                    unset=["structure.modal_damping", "structure.kept_modes", "contact.stiffness"])
    assert record.summary["linear_frequency_Hz"] == pytest.approx(PRINTED[mode - 1] / (2.0 * np.pi), rel=SEVEN_DIGITS)


def test_the_bracket_meets_its_stop_with_the_corners_that_it_names(bracket):
    # An upright of 60 mm, a bend of radius 20 mm and an arm of 60 mm, 20 mm wide and 4 mm thick: where the arm ends.
    names = BRACKET.with_suffix(".dof").read_text().split()
    lower, upper = ([names.index(f"{node}.3") + 1 for node, *place in mesh_nodes(BRACKET.with_suffix(".inp"))
                     if any(np.allclose(place, [0.08, y, z], atol=1e-9) for y in (0.0, 0.02))] for z in (0.078, 0.082))
    scene = tomllib.loads(wb.complete(BRACKET))
    assert len(lower) == len(upper) == 2
    assert scene["structure"]["contact_dofs"] == [-row for row in lower]
    assert scene["forcing"]["load_dofs"] == upper
    assert forces(bracket).max() > 1.0
    deepest = displacements(bracket).max() - scene["contact"]["gap"]
    assert deepest == pytest.approx(forces(bracket).max() / scene["contact"]["stiffness"], rel=1e-3)


@pytest.mark.parametrize("part", [
    "modes      192.42, 336.84, 658.81, 2035.6, 2651.8 Hz, damping ratios 0.01 each",
    "compliance 24.128 µm/N at -node 73 z; 24.128 µm/N at -node 75 z"])
def test_the_bracket_is_described_by_its_frequencies_and_by_compliances_at_its_nodes(part):
    assert part in wb.check(BRACKET)


@pytest.fixture
def calculix(tmp_path):
    """Runs CalculiX on the bracket's input, changed, in the test's folder."""
    if shutil.which("ccx") is None:
        pytest.skip("there is no ccx (Debian: calculix-ccx)")

    def run(*removed):
        text = BRACKET.with_suffix(".inp").read_text()
        for part in removed:
            before, _, after = text.rpartition(part)
            text = before + after
        (tmp_path / "bracket.inp").write_text(text)
        subprocess.run(["env", "OMP_NUM_THREADS=1", "ccx", "bracket"], cwd=tmp_path, check=True, capture_output=True)
        return tmp_path / "bracket"

    return run


def test_calculix_writes_the_files_of_the_bracket_again(calculix):
    again = calculix()
    assert again.with_suffix(".dof").read_text() == BRACKET.with_suffix(".dof").read_text()
    for suffix in (".sti", ".mas"):
        kept = calculix_matrix(BRACKET.with_suffix(suffix))
        difference = calculix_matrix(again.with_suffix(suffix)) - kept
        assert np.linalg.norm(difference) < 1e-12 * np.linalg.norm(kept)  # of fourteen digits


def test_calculix_prints_the_frequencies_of_the_bracket(calculix):
    found = []
    for line in calculix(", SOLVER=MATRIXSTORAGE").with_suffix(".dat").read_text().splitlines():
        words = line.split()
        if len(words) >= 3 and words[0] == str(len(found) + 1) and len(found) < len(PRINTED):
            found.append(float(words[2]))
    np.testing.assert_allclose(found, PRINTED, rtol=SEVEN_DIGITS)


def test_cantilevers_touch_and_do_not_penetrate_further_than_their_springs_yield():
    record = solved(CANTILEVERS)
    assert len(forces(record)) == 30
    assert np.count_nonzero(forces(record).max(axis=1) > 0.0) >= 6
    deepest = displacements(record).max() - 1e-5
    assert deepest == pytest.approx(forces(record).max() / 1e5, rel=1e-3)


@pytest.mark.parametrize("overrides", [
    {"forcing.amplitude": 0.5, "forcing.frequency": 95.0},
    {"time.trial": "bspline", "time.weight": "bspline", "time.functions": 64},
], ids=["a larger load", "B-splines"])
def test_cantilevers_are_solved_by_lowering_the_upper_one(overrides):
    # They are symmetric about their middle: pairs of contacts reach their gaps together.
    assert solved(CANTILEVERS, overrides).summary["strategy"] == "gap_continuation"
