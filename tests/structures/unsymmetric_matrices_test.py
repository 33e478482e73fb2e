"""Matrices without symmetry: the example reproduce/scenes/matrices/rotor and small changes of the chain."""

import numpy as np
import pytest
import scipy.io
from structure_scenes import (CHAIN, CHAIN_MASS, CHAIN_STIFFNESS, MATRICES, changed, displacements, distance, forces,
                              refused, solved, stepped)

import wavebalance as wb

ROTOR = MATRICES / "rotor" / "rotor.toml"
NO_CONTACT = ["contact.stiffness", "contact.gap"]


@pytest.fixture(scope="module")
def rotor():
    return solved(ROTOR)


def test_a_rotor_strikes_its_stop_as_time_stepping_says(rotor):
    assert forces(rotor).max() > 10.0
    assert distance(displacements(rotor), displacements(stepped(ROTOR))) < 1e-3


@pytest.mark.parametrize("circulatory, stability", [(6000.0, "stable"), (12000.0, "unstable")])
def test_a_rotor_flutters_where_the_damping_of_the_shaft_exceeds_that_outside(circulatory, stability):
    stiffness = np.array([[801577.366, circulatory, -200394.341, 0.0], [-circulatory, 801577.366, 0.0, -200394.341],
                          [-200394.341, 0.0, 66798.1138, 0.0], [0.0, -200394.341, 0.0, 66798.1138]])
    overrides = {"structure.stiffness": stiffness, "contact.law": "none", "analysis.stability": True}
    record = solved(ROTOR, overrides, NO_CONTACT)
    assert record.summary["stability"] == stability
    mass, damping = (scipy.io.mmread(MATRICES / "rotor" / name).toarray() for name in ("mass.mtx", "damping.mtx"))
    inverse = np.linalg.inv(mass)
    rates = np.linalg.eigvals(np.block([[np.zeros((4, 4)), np.eye(4)], [-inverse @ stiffness, -inverse @ damping]]))
    assert ("unstable" if rates.real.max() > 0.0 else "stable") == stability


def test_a_rotor_reduced_to_all_its_modes_is_the_whole_one_and_unsymmetric(rotor):
    kept = {"structure.kept_modes": 3}
    assert distance(displacements(solved(ROTOR, kept)), displacements(rotor)) < 1e-8
    # Without contact, damping and stiffness each matter only by their skew parts.
    linear = {**kept, "contact.law": "none"}
    mass, damping, stiffness = (scipy.io.mmread(MATRICES / "rotor" / f"{name}.mtx").toarray()
                                for name in ("mass", "damping", "stiffness"))
    omega = 2.0 * np.pi * 24.0

    def tip(c, k):
        return np.linalg.solve(k - omega**2 * mass + 1j * omega * c, [100.0, 0.0, 0.0, 0.0])[0]

    found = wb.harmonics_of(displacements(solved(ROTOR, linear, NO_CONTACT)), 1)[0, 1]
    exact = tip(damping, stiffness)
    assert abs(found - exact) < 1e-8 * abs(exact)
    for symmetric in (tip(0.5 * (damping + damping.T), stiffness), tip(damping, 0.5 * (stiffness + stiffness.T))):
        assert abs(symmetric - exact) > 1e-6 * abs(exact)


def test_a_rotor_takes_a_rigid_stop_at_a_contact_without_mass():
    rigid = {"contact.law": "rigid", "time.functions": 63, "time.quadrature_points": 512}
    assert forces(solved(ROTOR, rigid, ["contact.stiffness"])).max() > 10.0


def test_a_rotor_is_described_and_solved():
    assert "4 degrees of freedom" in wb.check(ROTOR)
    assert wb.run(ROTOR).converged


DAMPED = changed(CHAIN, ("modal_damping = 0.01 ", 'damping = "skew.mtx"'))
MEANT = changed(DAMPED, ("contact_dofs = [2, 3]", "unsymmetric = true\ncontact_dofs = [2, 3]"))


@pytest.fixture
def skew(chain_files, matrix):
    matrix("skew.mtx", [[9.0, 0.0, 1.0], [0.0, 9.0, 0.0], [-1.0, 0.0, 9.0]])
    matrix("weak.mtx", [[1.0, 0.0, 1.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0]])
    return chain_files


@pytest.mark.parametrize("scene, key, part", [
    (DAMPED, "structure.damping", "or say structure.unsymmetric = true"),
    (changed(MEANT, ("m.mtx", "skew.mtx")), "structure.mass", ""),
    (changed(MEANT, ("k.mtx", "weak.mtx")), "structure.stiffness", "positive definite"),
    (changed(MEANT, ("forced_response", "nonlinear_mode")), "structure.unsymmetric", ""),
], ids=["not meant", "mass", "stiffness", "mode"])
def test_matrices_without_symmetry_are_refused_unless_meant_and_of_a_mass_or_a_mode(skew, scene, key, part):
    refused(scene, key, part)
    assert "unsymmetric = true" in wb.complete(MEANT)


def test_a_skew_symmetric_file_is_a_gyroscopic_damping(skew):
    (skew / "gyroscopic.mtx").write_text(
        "%%MatrixMarket matrix coordinate real skew-symmetric\n3 3 2\n2 1 4\n3 2 4\n")
    gyroscopic = np.array([[0.0, -4.0, 0.0], [4.0, 0.0, -4.0], [0.0, 4.0, 0.0]])
    record = solved(changed(MEANT, ("skew.mtx", "gyroscopic.mtx")), {"contact.law": "none"}, NO_CONTACT)
    omega = 2.0 * np.pi * 50.0
    dynamic = CHAIN_STIFFNESS - omega**2 * CHAIN_MASS + 1j * omega * gyroscopic
    exact = np.linalg.solve(dynamic, [0.0, 0.0, 100.0])[1:]
    assert distance(wb.harmonics_of(displacements(record), 1)[:, 1], exact) < 1e-12
