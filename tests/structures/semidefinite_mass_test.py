"""Masses that are semidefinite, as reduced integration leaves them, and matrices of CalculiX's elements."""

import re
import shutil
import subprocess

import numpy as np
import pytest
from structure_scenes import CHAIN, changed, refused

import wavebalance as wb

ONE = changed(CHAIN, ("[2, 3]", "[3]"))


@pytest.fixture
def together(chain_files, matrix):
    """The chain, of which the last two masses have one kinetic energy together, 0.5 x 2 kg (v2 + v3)^2."""

    def write(coupling=2.0):
        matrix("m.mtx", [[2.0, 0.0, 0.0], [0.0, 2.0, coupling], [0.0, coupling, 2.0]])

    write()
    return write


def linear_frequency(scene, overrides):
    """Hz, of the mode of the structure without contact."""
    short = {"analysis.type": "nonlinear_mode", "analysis.points": 2, "analysis.last_frequency_ratio": 1.01}
    return wb.run(scene, {**short, **overrides}).summary["linear_frequency_Hz"]


@pytest.mark.parametrize("mode, root", [(1, np.sqrt(20.0)), (2, -np.sqrt(20.0))])
def test_a_semidefinite_mass_is_solved_by_its_modes_with_mass(together, mode, root):
    # 1 / omega^2 are the eigenvalues of 2e-6 [1 2; 2 9], the flexibility of the two motions with mass times 2 kg.
    hertz = 1.0 / (2.0 * np.pi * np.sqrt(2e-6 * (5.0 + root)))
    # Beside a contact of the first mass the other motion with mass is one mode, and a reduction to it is exact.
    exact = changed(ONE, ("modal_damping = 0.01", ""), ("contact_dofs = [3]", "contact_dofs = [1]"),
                    ("load_dofs = [3]", ""))
    found = linear_frequency(exact, {"structure.kept_modes": 1, "analysis.mode": mode})
    assert found == pytest.approx(hertz, abs=1e-7)
    assert f"{hertz:.5g}" in re.search("modes .*", wb.check(ONE, {"structure.kept_modes": 1}))[0]
    record = wb.run(ONE, {"structure.kept_modes": 1})
    assert record.converged, record.status


def test_a_semidefinite_mass_is_refused_without_kept_modes_with_its_cause(together):
    refused(ONE, "structure.mass", "reduced integration", "Expected structure.kept_modes")


def test_fewer_modes_with_mass_than_are_kept_are_an_error(together):
    with pytest.raises(ValueError, match="structure.kept_modes = 2: the mass is semidefinite"):
        wb.run(ONE, {"structure.kept_modes": 2})


def test_an_indefinite_mass_is_refused(together):
    together(2.1)
    refused(ONE, "structure.mass", "not positive semidefinite", overrides={"structure.kept_modes": 1})


STEEL = "*MATERIAL, NAME=STEEL\n*ELASTIC\n2.1e11, 0.3\n*DENSITY\n7850.\n"
# Corners and mid edges of a hexahedron in half steps, in the order of CalculiX.
CORNERS = [(0, 0), (2, 0), (2, 2), (0, 2)]
MIDDLES = [(1, 0), (2, 1), (1, 2), (0, 1)]
HEXAHEDRON = [(*at, k) for places in (CORNERS, MIDDLES) for k in (0, 2) for at in places] + [(*at, 1) for at in CORNERS]


def input_of(element, nodes, elements, section, held):
    """An input file of CalculiX up to its steps; nodes by their number, held ones with their last direction."""
    lines = ["*NODE, NSET=ALL", *(f"{node}, {x}, {y}, {z}" for node, (x, y, z) in nodes.items()),
             f"*ELEMENT, TYPE={element}, ELSET=E"]
    for i, of in enumerate(elements):
        words = ", ".join(map(str, [i + 1, *of[:10]]))
        lines += [words] if len(of) <= 10 else [words + ",", ", ".join(map(str, of[10:]))]
    lines += [STEEL + section, "*BOUNDARY", *(f"{node}, 1, {held[1]}" for node in held[0])]
    return "\n".join(lines) + "\n"


def block(element):
    """0.2 m x 20 mm x 20 mm of 4 x 2 x 2 elements of 20 nodes, held at one end."""
    def number(i, j, k):
        return (i * 5 + j) * 5 + k + 1

    places = [at for at in np.ndindex(9, 5, 5) if sum(one % 2 for one in at) <= 1]
    nodes = {number(*at): (0.025 * at[0], 0.005 * at[1], 0.005 * at[2]) for at in places}
    elements = [[number(2 * i + a, 2 * j + b, 2 * k + c) for a, b, c in HEXAHEDRON] for i, j, k in np.ndindex(4, 2, 2)]
    ends = [number(*at) for at in places if at[0] == 0]
    return input_of(element, nodes, elements, "*SOLID SECTION, ELSET=E, MATERIAL=STEEL", (ends, 3))


def beam(element):
    """1 m in six elements, held at one end."""
    each = 2 if element == "B32" else 1
    nodes = {i + 1: (i / (6 * each), 0.0, 0.0) for i in range(6 * each + 1)}
    elements = [[each * e + i + 1 for i in range(each + 1)] for e in range(6)]
    section = "*BEAM SECTION, ELSET=E, MATERIAL=STEEL, SECTION=RECT\n0.02, 0.01\n0., 1., 0."
    return input_of(element, nodes, elements, section, ([1], 6))


def plate(element):
    """0.4 m x 0.2 m x 4 mm in 4 x 2 elements, held at one edge."""
    each = 1 if element == "S4" else 2
    row = 4 * each + 1

    def number(i, j):
        return j * row + i + 1

    nodes = {number(i, j): (0.1 * i / each, 0.1 * j / each, 0.0) for i, j in np.ndindex(row, 2 * each + 1)
             if each == 1 or i % 2 == 0 or j % 2 == 0}
    places = [(a // (3 - each), b // (3 - each)) for a, b in CORNERS] + (MIDDLES if each == 2 else [])
    elements = [[number(each * i + a, each * j + b) for a, b in places] for i, j in np.ndindex(4, 2)]
    section = "*SHELL SECTION, ELSET=E, MATERIAL=STEEL\n0.004"
    return input_of(element, nodes, elements, section, ([number(0, j) for j in range(2 * each + 1)], 6))


SCENE = """[structure]
type = "matrices"
mass = "matrices.mas"
stiffness = "matrices.sti"
dof_map = "matrices.dof"
modal_damping = 0.02
kept_modes = 5
[contact]
law = "linear"
stiffness = 1e4
gap = 1e-3
[[contact.pairs]]
dofs = [{beside}, {row}]
coefficients = [0.6, 0.8]
[forcing]
load_dofs = [{row}]
amplitude = 1.0
frequency = 5.0
weight = [0, 0, -9.81]
[time]
trial = "fourier"
weight = "fourier"
functions = 31
"""


def printed_frequencies(text, count=5):
    """The column "cycles/time" of the table of eigenvalues."""
    found = []
    for words in map(str.split, text.splitlines()):
        if len(words) >= 4 and words[0] == str(len(found) + 1) and len(found) < count:
            found.append(float(words[3]))
    return found


@pytest.mark.skipif(shutil.which("ccx") is None, reason="there is no ccx (Debian: calculix-ccx)")
@pytest.mark.parametrize("element, mesh, volume", [
    ("C3D20R", block, 0.2 * 0.02 * 0.02), ("S8R", plate, 0.4 * 0.2 * 0.004), ("S4", plate, 0.4 * 0.2 * 0.004),
    ("B31", beam, 1.0 * 0.02 * 0.01), ("B32", beam, 1.0 * 0.02 * 0.01)])
def test_elements_of_calculix_have_the_frequencies_that_it_prints(tmp_path, monkeypatch, element, mesh, volume):
    monkeypatch.chdir(tmp_path)
    for job, solver in (("matrices", ", SOLVER=MATRIXSTORAGE"), ("modes", "")):
        (tmp_path / f"{job}.inp").write_text(f"{mesh(element)}*STEP\n*FREQUENCY{solver}\n5\n*END STEP\n")
        subprocess.run(["ccx", job], check=True, capture_output=True)
    row = len((tmp_path / "matrices.dof").read_text().split())
    scene = SCENE.format(row=row, beside=row - 1)  # askew, since modes of a square section may lie in either plane
    printed = printed_frequencies((tmp_path / "modes.dat").read_text())
    assert len(printed) == 5
    rigid = changed(scene, ('"linear"\nstiffness = 1e4', '"rigid"'), ("modal_damping = 0.02\n", ""),
                    ("weight = [0, 0, -9.81]\n", ""))
    for i, hertz in enumerate(printed):
        found = linear_frequency(rigid, {"structure.kept_modes": 30, "analysis.mode": i + 1})
        assert found == pytest.approx(hertz, rel=1e-5)
    record = wb.run(scene)
    assert record.converged, record.status
    # The weight of the steel, without what the held nodes carry.
    said = wb.check(scene)
    for hertz, words in zip(printed, re.search("modes +(.*) Hz", said)[1].split(", ")):
        assert float(words) == pytest.approx(hertz, rel=6e-5)  # five digits
    found = float(re.search(r"m/s\^2, (\S+) N in all", said)[1])
    assert 0.85 * 9.81 * 7850.0 * volume <= found <= 9.81 * 7850.0 * volume
