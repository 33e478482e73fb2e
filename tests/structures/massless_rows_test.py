"""Matrices of which rows have no mass, as rotations have none where mass is lumped."""

import numpy as np
import pytest
import scipy.linalg
from structure_scenes import changed, displacements, distance, forces, modal_damping, refused, solved, terms

import wavebalance as wb

ELEMENTS = 6
SIZE = 2 * ELEMENTS  # deflection and rotation of each node
DEFLECTIONS, ROTATIONS = np.arange(0, SIZE, 2), np.arange(1, SIZE, 2)

SCENE = """[structure]
type = "matrices"
mass = "m.mtx"
stiffness = "k.mtx"
contact_dofs = [11]
modal_damping = 0.01
[contact]
law = "linear"
stiffness = 1e5
gap = 1e-3
[forcing]
load = "f.mtx"
amplitude = 1.0
frequency = 15.0
[time]
trial = "fourier"
weight = "fourier"
functions = 31
"""
NO_CONTACT = {"contact.law": "none"}, ["contact.stiffness", "contact.gap"]


def beam_stiffness():
    """Stiffness of a clamped Euler-Bernoulli beam of steel, 0.5 m x 20 mm x 5 mm."""
    length = 0.5 / ELEMENTS
    bending = 2.1e11 * 0.02 * 0.005**3 / 12.0 / length**3
    turned = 6.0 * length
    element = bending * np.array([[12.0, turned, -12.0, turned], [turned, 4.0 * length**2, -turned, 2.0 * length**2],
                                  [-12.0, -turned, 12.0, -turned], [turned, 2.0 * length**2, -turned, 4.0 * length**2]])
    whole = np.zeros((SIZE + 2, SIZE + 2))
    for e in range(0, SIZE, 2):
        whole[e:e + 4, e:e + 4] += element
    return whole[2:, 2:]


STIFFNESS = beam_stiffness()
LOAD = np.linspace(0.1, 0.4, SIZE)  # forces and moments
LUMPED = np.zeros(SIZE)  # half of each element's mass at either end, none for rotations
LUMPED[DEFLECTIONS] = 7850.0 * 0.02 * 0.005 * 0.5 / ELEMENTS
LUMPED[SIZE - 2] *= 0.5
MASS = np.diag(LUMPED)

FOLLOW = -np.linalg.solve(STIFFNESS[np.ix_(ROTATIONS, ROTATIONS)], STIFFNESS[np.ix_(ROTATIONS, DEFLECTIONS)])
CONDENSED = STIFFNESS[np.ix_(DEFLECTIONS, DEFLECTIONS)] + STIFFNESS[np.ix_(DEFLECTIONS, ROTATIONS)] @ FOLLOW
CONDENSED = 0.5 * (CONDENSED + CONDENSED.T)
CONDENSED_MASS = np.diag(LUMPED[DEFLECTIONS])
CONDENSED_LOAD = LOAD[DEFLECTIONS] + FOLLOW.T @ LOAD[ROTATIONS]


@pytest.fixture
def write(matrix, tmp_path, monkeypatch):
    """Writes matrices and a load into the current folder."""
    monkeypatch.chdir(tmp_path)

    def files(stiffness, mass, load):
        matrix("k.mtx", stiffness.tolist())
        matrix("m.mtx", mass.tolist())
        matrix("f.mtx", load[:, None].tolist())

    return files


@pytest.fixture
def beam(write):
    write(STIFFNESS, MASS, LOAD)


def tip(load, damping, frequency=15.0):
    """The complex amplitude of the tip of the beam condensed by hand, without contact."""
    omega = 2.0 * np.pi * frequency
    return np.linalg.solve(CONDENSED - omega**2 * CONDENSED_MASS + 1j * omega * damping, load)[-1]


def harmonic_of(record):
    return wb.harmonics_of(displacements(record), 1)[0, 1]


@pytest.mark.parametrize("mode", [1, 2, 6])
def test_its_modes_are_those_of_the_structure_condensed_by_hand(beam, mode):
    overrides = {"analysis.type": "nonlinear_mode", "analysis.mode": mode, "analysis.points": 2,
                 "analysis.last_frequency_ratio": 1.01, "contact.law": "rigid"}
    scene = changed(SCENE.split("[forcing]")[0], ("modal_damping = 0.01\n", ""), ("stiffness = 1e5\n", ""))
    omega = np.sqrt(scipy.linalg.eigvalsh(CONDENSED, CONDENSED_MASS)[mode - 1])
    found = wb.run(scene + "[analysis]\n", overrides).summary["linear_frequency_Hz"]
    assert found == pytest.approx(omega / (2.0 * np.pi), rel=1e-12)


@pytest.mark.parametrize("frequency", [1e-3, 15.0, 80.0, 600.0])
def test_without_contact_it_moves_as_the_structure_condensed_by_hand(beam, frequency):
    record = solved(SCENE, {**NO_CONTACT[0], "forcing.frequency": frequency}, NO_CONTACT[1])
    exact = tip(CONDENSED_LOAD, modal_damping(CONDENSED, CONDENSED_MASS, 0.01), frequency)
    assert abs(harmonic_of(record) - exact) <= 1e-12 * abs(exact)


def test_in_contact_it_moves_as_the_structure_condensed_by_hand(beam, write):
    found = solved(SCENE)
    assert found.summary["reduced_degrees_of_freedom"] == ELEMENTS
    assert forces(found).max() > 1.0
    write(CONDENSED, CONDENSED_MASS, CONDENSED_LOAD)
    by_hand = solved(SCENE, {"structure.contact_dofs": [6]})
    assert distance(displacements(found), displacements(by_hand)) < 1e-9


def test_it_is_the_limit_of_rotations_with_vanishing_mass(beam, write):
    condensed = displacements(solved(SCENE, *NO_CONTACT))
    mass = LUMPED.copy()
    mass[ROTATIONS] = 1e-12
    write(STIFFNESS, np.diag(mass), LOAD)
    assert distance(condensed, displacements(solved(SCENE, *NO_CONTACT))) < 1e-6


@pytest.mark.parametrize("frequency", [15.0, 16.6])
def test_proportional_damping_of_a_file_is_that_of_the_condensed_structure(beam, matrix, frequency):
    matrix("c.mtx", (1e-5 * STIFFNESS + 2.0 * MASS).tolist())
    scene = changed(SCENE, ("modal_damping = 0.01", 'damping = "c.mtx"'))
    record = solved(scene, {**NO_CONTACT[0], "forcing.frequency": frequency}, NO_CONTACT[1])
    assert record.summary["reduced_degrees_of_freedom"] == ELEMENTS
    exact = tip(CONDENSED_LOAD, 1e-5 * CONDENSED + 2.0 * CONDENSED_MASS, frequency)
    assert abs(harmonic_of(record) - exact) <= 1e-10 * abs(exact)


def test_an_accelerated_base_is_the_masses_times_it(beam):
    moved = SCENE + terms('kind = "base_acceleration"\namplitude = 3.0\ndofs = [1, 3, 5, 7, 9, 11]')
    record = solved(moved, {**NO_CONTACT[0], "forcing.amplitude": 0.0}, NO_CONTACT[1])
    exact = tip(-3.0 * LUMPED[DEFLECTIONS], modal_damping(CONDENSED, CONDENSED_MASS, 0.01))
    assert abs(harmonic_of(record) - exact) <= 1e-12 * abs(exact)


def test_it_is_described_and_taken_by_reductions_and_exact_solutions(beam):
    assert "6 rows without mass condensed, 6 degrees of freedom" in wb.check(SCENE)
    reduced = changed(SCENE, ('load = "f.mtx"', "load_dofs = [11]"))
    record = solved(reduced, {"structure.kept_modes": 2})
    assert record.summary["reduced_degrees_of_freedom"] == 3
    assert record.summary.get("contacts", 1) == 1
    assert wb.run(SCENE, {"time.method": "exact"}, unset=["time.trial", "time.weight", "time.functions"]).converged


def test_damping_on_a_rotation_alone_is_refused(beam, matrix):
    damping = np.zeros((SIZE, SIZE))
    damping[1, 1] = 0.1
    matrix("c.mtx", damping.tolist())
    refused(changed(SCENE, ("modal_damping = 0.01", 'damping = "c.mtx"')), "structure.mass",
            "6 rows have no mass: 2, 4, 6, 8, 10, ...")


@pytest.mark.parametrize("tangent", [3, 4, -1])
@pytest.mark.parametrize("key", ["tangent", "second_tangent"])
def test_a_tangent_along_a_row_without_mass_or_no_row_is_refused(key, tangent):
    stiffness = np.array([[12.0, -3.0, 0.0], [-3.0, 10.0, -5.0], [0.0, -5.0, 5.0]])
    pair = {"dofs": [1], "law": "coulomb", "friction": 0.5, "normal_load": 0.6, "normal_stiffness": 21.0,
            "tangential_stiffness": 5.0, "tangent": [2], key: [tangent]}
    scene = {"structure": {"type": "matrices", "mass": np.diag([1.0, 1.0, 0.0]), "stiffness": stiffness},
             "contact": {"pairs": [pair]}, "forcing": {"load_dofs": [1], "amplitude": 1.0, "frequency": 0.3},
             "time": {"trial": "fourier", "weight": "fourier", "functions": 15, "quadrature_points": 64},
             "analysis": {"type": "forced_response"}}
    with pytest.raises(wb.SceneError, match="no mass" if tangent == 3 else "expected") as refusal:
        wb.check(scene)
    assert refusal.value.key.endswith("." + key)
