"""Structures of matrices move as the corresponding bars, and contacts of a chain as in time stepping."""

import numpy as np
import pytest
import rods_and_bars
import scipy.io
from rods_and_bars import matrices_of
from structure_scenes import (BAR, CHAIN, CHAIN_MASS, CHAIN_STIFFNESS, MATRICES, ROD, changed, displacements, distance,
                              forces, modal_damping, solved, stepped)

import wavebalance as wb


@pytest.fixture
def as_matrices(matrix, tmp_path, monkeypatch):
    """The scene of a bar with its structure replaced by files of matrices, and these lines with them."""

    def scene(bar, matrices, lines=""):
        monkeypatch.chdir(tmp_path)
        mass, stiffness = matrices
        for name, rows in (("m.mtx", mass), ("k.mtx", stiffness), ("c.mtx", 1e-4 * stiffness)):
            matrix(name, rows.tolist())
        tip = len(mass)
        files = '[structure]\ntype = "matrices"\nmass = "m.mtx"\nstiffness = "k.mtx"\n'
        files += f"contact_dofs = [{tip}]\n{lines}\n"
        return files + bar[bar.index("[contact]"):].replace("[forcing]\n", f"[forcing]\nload_dofs = [{tip}]\n")

    return scene


BAR_MATRICES, ROD_MATRICES = (matrices_of(scene["structure"]) for scene in (rods_and_bars.BAR, rods_and_bars.ROD))


def largest(found, expected):
    assert np.shape(found) == np.shape(expected)
    return np.abs(found - expected).max() / np.abs(expected).max()


def test_a_bar_given_as_matrices_has_the_same_nonlinear_mode(as_matrices):
    expected, found = wb.run(ROD).backbone, wb.run(as_matrices(ROD, ROD_MATRICES)).backbone
    assert len(found["status"]) > 10 and found["status"] == expected["status"]
    np.testing.assert_array_equal(np.isfinite(found["energy_ratio"]), np.isfinite(expected["energy_ratio"]))
    np.testing.assert_allclose(found["energy_ratio"], expected["energy_ratio"], rtol=1e-10)


def test_a_bar_given_as_matrices_responds_alike(as_matrices):
    expected, found = solved(BAR), solved(as_matrices(BAR, BAR_MATRICES, 'damping = "c.mtx"'))
    assert largest(displacements(found), displacements(expected)) < 1e-10
    assert largest(forces(found), forces(expected)) < 1e-10


def test_a_bar_given_as_matrices_has_the_same_sweep(as_matrices):
    overrides = {"analysis.type": "frequency_sweep", "analysis.frequency_from": 1250.0, "analysis.frequency_to": 1260.0}
    expected = solved(BAR, overrides, ["forcing.frequency"]).sweep
    found = solved(as_matrices(BAR, BAR_MATRICES, "stiffness_damping = 1e-4"), overrides, ["forcing.frequency"]).sweep
    for name in ("frequency_Hz", "max_displacement_m"):
        np.testing.assert_allclose(found[name], expected[name], rtol=1e-10)


def test_all_modes_kept_change_nothing(as_matrices, tmp_path):
    at_energy = {"analysis.energy_ratio": 3.0, "analysis.output_points": 64}
    whole = wb.run(ROD, at_energy)
    at_energy["analysis.motion_points"] = 64
    scene = as_matrices(ROD, ROD_MATRICES)
    full = wb.run(scene, at_energy, output=tmp_path / "full")
    reduced = wb.run(scene, {**at_energy, "structure.kept_modes": 19}, output=tmp_path / "reduced")
    assert "reduced to 20 (19 modes)" in wb.check(scene, {"structure.kept_modes": 19})
    for record in (full, reduced):
        assert record.summary["frequency_Hz"] == pytest.approx(whole.summary["frequency_Hz"], rel=1e-8)
    u, v = (scipy.io.mmread(tmp_path / name / "motion.mtx") for name in ("reduced", "full"))
    assert u.shape == (20, 64) and largest(u, v) < 1e-6
    assert largest(u[-1], whole.response["displacement_m"]) < 1e-6


@pytest.mark.parametrize("dofs, signs", [([2, 3], [1, 1]), ([-2, 3], [-1, 1])])
def test_negative_contact_dofs_look_the_other_way(chain_files, tmp_path, dofs, signs):
    scene = changed(CHAIN, ("[2, 3]", str(dofs)))
    overrides = {"analysis.motion_points": 64, "analysis.phases": False, "analysis.stability": False}
    for contact in ({}, {"contact.law": "none"}):
        record = wb.run(scene, {**overrides, **contact}, tmp_path / "out",
                        unset=["contact.stiffness", "contact.gap"] if contact else [])
        whole = scipy.io.mmread(tmp_path / "out" / "motion.mtx")
        at_instants = displacements(record)[:, ::16]
        expected = np.array(signs)[:, None] * whole[1:]
        np.testing.assert_allclose(at_instants, expected, rtol=0.0, atol=1e-12 * np.linalg.norm(whole))
    omega = 2.0 * np.pi * 50.0  # without contact all rows move as they do without those that look anywhere
    dynamic = CHAIN_STIFFNESS - omega**2 * CHAIN_MASS + 1j * omega * modal_damping(CHAIN_STIFFNESS, CHAIN_MASS, 0.01)
    exact = np.linalg.solve(dynamic, [0.0, 0.0, 100.0])
    np.testing.assert_allclose(wb.harmonics_of(whole, 1)[:, 1], exact, rtol=1e-12)


@pytest.mark.parametrize("mode", [0, 1, 2])
def test_modal_damping_is_the_ratio_of_every_mode(chain_files, mode):
    omega = 2.0 * np.sqrt(1e6 / 2.0) * np.sin((2 * mode + 1) * np.pi / 14.0)
    dynamic = CHAIN_STIFFNESS - omega**2 * CHAIN_MASS + 1j * omega * modal_damping(CHAIN_STIFFNESS, CHAIN_MASS, 0.01)
    record = solved(CHAIN, {"forcing.frequency": omega / (2.0 * np.pi), "contact.law": "none"},
                    ["contact.stiffness", "contact.gap"])
    found = wb.harmonics_of(displacements(record), 1)[:, 1]
    assert distance(found, np.linalg.solve(dynamic, [0.0, 0.0, 100.0])[1:]) < 1e-12


@pytest.mark.parametrize("scene", ["strip_mode.toml", "strip_forced.toml"])
def test_the_strip_has_72_degrees_of_freedom(scene):
    assert "matrices, 72 degrees of freedom" in wb.check(MATRICES / scene)


# A chain whose transients decay within few periods.
DAMPED = {"forcing.frequency": 35.0, "structure.modal_damping": 0.1, "contact.gap": [5e-5, 1e-4]}
SOFT = {**DAMPED, "contact.stiffness": 1e6}


def test_two_contacts_of_a_chain_move_as_time_stepping_says(chain_files):
    found = solved(CHAIN, {**SOFT, "time.functions": 127, "time.quadrature_points": 2048})
    reference = stepped(CHAIN, {**SOFT, "analysis.tolerance": 1e-7})
    assert found.summary["contacts"] == 2
    # A kink of the force leaves Fourier coefficients of the displacement of order k^-4: together 63^-3.5 of the motion,
    # below the error of stepping to 1e-7 per period.
    for a, b in zip(displacements(found), displacements(reference)):
        assert np.sqrt(np.mean((a - b)**2) / np.mean(b**2)) < 5e-6
    assert forces(reference).max(axis=1).min() > 0.0
    leading = int(found.summary["leading_contact"]) - 1
    np.testing.assert_array_equal(found.response["displacement_m"], displacements(found)[leading])


@pytest.mark.parametrize("functions", [15, 31, 63])
def test_rigid_contacts_hold_up_to_the_error_of_the_functions(chain_files, functions):
    # One mode is left in addition to the two contacts, and the load drives it at its resonance.
    record = wb.run(changed(CHAIN, ('"linear"', '"rigid"'), ("stiffness = 1e7", "# ")),
                    {**DAMPED, "time.functions": functions, "time.quadrature_points": 8 * functions})
    assert record.converged, record.status
    assert record.summary["min_contact_force_N"] >= 0.0
    assert record.summary["max_penetration_m"] < 0.5 * 5e-5
    assert forces(record).max() > 0.0


def test_obstacles_on_either_side_are_mirror_images(chain_files):
    up, down = (displacements(solved(CHAIN, {**DAMPED, **more})) for more in (
        {}, {"structure.contact_dofs": [-2, -3], "forcing.load_dofs": [-3]}))
    assert distance(down, up) < 1e-12


@pytest.mark.parametrize("trial, weight, tolerance", [
    ("bspline", "bspline", 5e-3), ("daubechies6", "daubechies6", 5e-3), ("daubechies6", "fourier", 5e-3),
    ("haar", "fourier", 5e-2), ("haar", "bspline", 5e-2)])
def test_all_pairs_agree_on_the_chain(chain_files, trial, weight, tolerance):
    overrides = {**SOFT, "time.functions": 64, "time.quadrature_points": 256}
    wavelet = displacements(solved(CHAIN, {**overrides, "time.trial": trial, "time.weight": weight}))
    assert distance(wavelet, displacements(solved(CHAIN, overrides))) < tolerance
