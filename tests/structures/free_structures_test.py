"""Structures that are free to move, with the example reproduce/scenes/matrices/free_rod, and structural damping."""

import tomllib

import numpy as np
import pytest
import scipy.io
from structure_scenes import (BAR, CHAIN, CHAIN_STIFFNESS, MATRICES, ROD, changed, displacements, distance, forces,
                              refused, solved, stepped, terms)

import wavebalance as wb

FREE_ROD = MATRICES / "free_rod" / "free_rod.toml"
LOSSY = changed(BAR, ("stiffness_damping = 1e-4", "loss_factor = 0.1"))


@pytest.fixture(scope="module")
def rod():
    return solved(FREE_ROD)


def test_a_free_rod_moves_between_its_stops_as_time_stepping_says(rod):
    assert forces(rod).max(axis=1).min() > 100.0 and len(forces(rod)) == 2
    assert distance(displacements(rod), displacements(stepped(FREE_ROD))) < 5e-3


def test_a_free_rod_is_described_and_solved():
    assert "free to move" in wb.check(FREE_ROD)
    assert wb.run(FREE_ROD).converged


def test_a_free_rod_moves_in_a_sweep_as_in_the_forced_response(tmp_path):
    alike = {"analysis.stability": False, "analysis.phases": False, "analysis.motion_points": 8}
    wb.run(FREE_ROD, {**alike, "forcing.frequency": 60.0}, tmp_path / "response")
    wb.run(FREE_ROD, {**alike, "analysis.type": "frequency_sweep", "analysis.frequency_from": 58.0,
                      "analysis.frequency_to": 62.0, "analysis.motion_at": 60.0}, tmp_path / "curve",
           unset=["forcing.frequency"])
    expected = scipy.io.mmread(tmp_path / "response" / "motion.mtx")
    assert distance(scipy.io.mmread(tmp_path / "curve" / "motion_60Hz.mtx"), expected) < 1e-6


def test_a_free_rod_reduced_to_its_modes_moves_like_the_whole_one(rod):
    assert distance(displacements(solved(FREE_ROD, {"structure.kept_modes": 7})), displacements(rod)) < 1e-6


def test_a_load_that_nothing_balances_has_no_periodic_motion():
    text = FREE_ROD.read_text()
    for name in ("mass", "stiffness", "damping"):
        text = changed(text, (f'"{name}.mtx"', f'"{FREE_ROD.parent}/{name}.mtx"'))
    # Both stops on one side, and a static load away from them.
    away = changed(text, ("[9, -1]", "[9, 5]")) + terms("harmonic = 0\ndofs = [9]\namplitude = -50.0")
    record = wb.run(away, {"analysis.phases": False, "analysis.stability": False})
    assert not record.converged
    assert record.summary["status"] == "unbalanced"


FREE_CHAIN = (CHAIN_STIFFNESS - np.diag([1e6, 0.0, 0.0])).tolist()
MEANT = changed(CHAIN, ("contact_dofs = [2, 3]", "free = true\ncontact_dofs = [2, 3]"))


def test_a_structure_that_is_free_to_move_is_refused_unless_it_is_meant(chain_files, matrix):
    matrix("k.mtx", FREE_CHAIN)
    refused(CHAIN, "structure.stiffness", "Say structure.free = true")
    assert "(1 rigid motion)" in wb.check(MEANT)
    refused(changed(MEANT, ('"linear"', '"rigid"'), ("stiffness = 1e7 ", "")), "structure.free")
    refused(changed(MEANT, ("forced_response", "nonlinear_mode")), "structure.free")


def test_a_stiffness_that_is_indefinite_is_refused_of_a_free_structure_too(chain_files, matrix):
    matrix("k.mtx", [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0]])
    refused(MEANT, "structure.stiffness", "not positive semidefinite")


def test_a_loss_factor_limits_the_resonance_of_a_bar_of_unknown_stability():
    linear = ({"contact.law": "none", "forcing.frequency": 300.0},
              ["contact.constant", "contact.exponent", "contact.gap"])
    assert tomllib.loads(wb.complete(LOSSY, linear[0], unset=linear[1]))["structure"]["loss_factor"] == 0.1
    record = solved(LOSSY, {**linear[0], "analysis.stability": True}, linear[1])
    assert record.summary["stability"] == "structural_damping"
    written = wb.complete(LOSSY, linear[0], unset=linear[1])
    assert wb.complete(written) == written
    # A clamped rod in the continuum has u(L) = F L / (E A) tan(k L) / (k L), k = omega sqrt(rho / E), E (1 + 0.1 i).
    for hertz in (300.0, 1273.0):  # below and at its first resonance
        found = wb.harmonics_of(displacements(solved(LOSSY, {**linear[0], "forcing.frequency": hertz,
                                                            "structure.elements": 400}, linear[1])), 1)[0, 1]
        modulus = 70e9 * (1.0 + 0.1j)
        wave = 2.0 * np.pi * hertz * np.sqrt(2700.0 / modulus)
        assert found == pytest.approx(250e3 / (modulus * 25e-4) * np.tan(wave) / wave, rel=1e-4)


@pytest.mark.parametrize("scene, overrides, key, part", [
    (LOSSY, {"analysis.type": "time_stepping"}, "structure.loss_factor", "no equation in time"),
    (LOSSY, {"structure.loss_factor": -0.1}, "structure.loss_factor", ""),
    (ROD, {"structure.loss_factor": 0.1}, "structure.loss_factor", ""),
], ids=["time stepping", "negative", "mode"])
def test_a_loss_factor_is_refused_where_motions_follow_time(scene, overrides, key, part):
    refused(scene, key, part, overrides=overrides)
