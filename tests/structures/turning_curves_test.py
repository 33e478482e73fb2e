"""Curves over the frequency of a rotor whose gyroscopic matrix and spin stiffness follow the frequency."""

import numpy as np
import pytest
from overhung_disk import DAMPING, MASS, ROTOR, STIFFNESS, STOP, UNBALANCE, plane, whirl
from structure_scenes import modal_damping, refused

import wavebalance as wb

pytestmark = pytest.mark.usefixtures("rotor_files")

SWEEP = {"analysis.type": "frequency_sweep", "analysis.frequency_from": 30.0, "analysis.frequency_to": 60.0}
STIFFENED = {"structure.spin_stiffness": "s.mtx"}
PLAIN = {"analysis.stability": False, "analysis.phases": False}
BASES = ["time.trial", "time.weight", "time.functions"]


def solved(overrides=None, unset=(), scene=ROTOR, **how):
    record = wb.run(scene, overrides, unset=unset, **how)
    assert record.converged, record.status
    return record


def radii(record, spin_stiffness):
    return [abs(whirl(one, 2.0 * np.pi * one, spin_stiffness)) for one in record.sweep["frequency_Hz"]]


@pytest.mark.parametrize("keys", [{}, {"analysis.exact": True}, {"structure.kept_modes": 2}])
@pytest.mark.parametrize("spin_stiffness", [0.0, 1.0])
def test_a_curve_has_the_closed_form_at_the_speed_of_each_point(keys, spin_stiffness):
    record = solved({**SWEEP, **PLAIN, **keys, **(STIFFENED if spin_stiffness else {})})
    assert len(record.sweep["frequency_Hz"]) > 20
    np.testing.assert_allclose(np.sqrt(2.0) * record.sweep["rms_displacement_m"], radii(record, spin_stiffness), rtol=1e-9)


def test_spin_stiffness_alone_follows_the_frequency():
    record = solved({**SWEEP, **PLAIN, **STIFFENED}, unset=["structure.gyroscopic"])
    for frequency, rms in zip(record.sweep["frequency_Hz"], record.sweep["rms_displacement_m"]):
        omega = 2.0 * np.pi * frequency
        stiffness, _, mass = plane(omega, 1.0)
        dynamic = stiffness + 1j * omega * DAMPING[::2, ::2] - omega**2 * mass
        assert np.sqrt(2.0) * rms == pytest.approx(abs(np.linalg.solve(dynamic, [UNBALANCE * omega**2, 0.0])[0]), rel=1e-9)


def test_motions_of_two_periods_turn_at_the_frequency_of_the_load():
    record = solved({**SWEEP, **PLAIN, "analysis.subharmonic": 2, "time.functions": 31})
    np.testing.assert_allclose(np.sqrt(2.0) * record.sweep["rms_displacement_m"], radii(record, 0.0), rtol=1e-9)


def at_fixed_speed(frequency, keys, unset=(), **how):
    """The response at a frequency, to whose speed the matrices are set before anything is solved."""
    return solved({**STOP, **keys, "forcing.frequency": float(frequency)}, unset=unset, **how).summary


@pytest.mark.parametrize("keys", [{}, STIFFENED])
def test_points_with_contact_are_responses_at_fixed_speeds(keys):
    sweep = solved({**SWEEP, **STOP, **keys, "analysis.phases": False, "analysis.frequency_to": 40.0}).sweep
    touching = np.flatnonzero(sweep["max_contact_force_N"] > 1.0)
    assert len(touching) > 20
    for point in touching[[2, -3]]:
        response = at_fixed_speed(sweep["frequency_Hz"][point], {**keys, "analysis.phases": False})
        assert sweep["max_displacement_m"][point] == pytest.approx(response["max_displacement_m"], rel=1e-9)
        assert sweep["unstable"][point] == response["unstable_multipliers"]


def test_points_of_an_exact_curve_are_exact_responses_at_fixed_speeds():
    sweep = solved({**SWEEP, **STOP, **STIFFENED, "analysis.exact": True}).sweep
    touching = np.flatnonzero(sweep["max_contact_force_N"] > 1.0)
    for point in touching[[2, -3]]:
        response = at_fixed_speed(sweep["frequency_Hz"][point], {**STIFFENED, "time.method": "exact"}, BASES)
        assert sweep["max_displacement_m"][point] == pytest.approx(response["max_displacement_m"], rel=1e-8)


HARD = {**STOP, "contact.gap": 2e-3}


@pytest.fixture
def special_points(rotor_files):
    """Frequencies of the special points of an exact curve that bends, by their type."""
    points = solved({**SWEEP, **HARD, "analysis.exact": True}).summary["special_points"]
    return {kind: points["frequency_Hz"][np.array(points["type"]) == kind] for kind in set(points["type"])}


def test_special_points_are_those_of_fixed_speeds(special_points):
    for frequency in special_points["grazing"]:
        assert abs(whirl(frequency, 2.0 * np.pi * frequency)) == pytest.approx(2e-3, rel=1e-8)
    assert len(special_points["neimark_sacker"]) == 4
    for frequency in special_points["neimark_sacker"]:
        found = at_fixed_speed(frequency, {**HARD, "time.method": "exact"}, BASES)
        multiplier = found["leading_multiplier_real"] + 1j * found["leading_multiplier_imag"]
        assert abs(multiplier) == pytest.approx(1.0, abs=1e-6) and multiplier.imag > 0.1


def test_a_fold_over_the_frequency_is_one_over_the_amplitude_at_its_speed(special_points):
    over = {"analysis.type": "amplitude_sweep", "analysis.amplitude_from": 1e-4, "analysis.amplitude_to": 2e-2}
    assert len(special_points["fold"]) == 2
    for frequency in special_points["fold"]:
        keys = {**HARD, **over, "analysis.exact": True, "forcing.frequency": float(frequency)}
        points = solved(keys).summary["special_points"]
        folds = points["amplitude_kg_m"][np.array(points["type"]) == "fold"]
        assert np.min(np.abs(folds / UNBALANCE - 1.0)) < 1e-6


def test_a_curve_that_starts_from_a_response_at_its_speed_begins_with_it(tmp_path):
    at = {**HARD, "forcing.frequency": 44.0}
    start = wb.run(ROTOR, at, output=tmp_path / "start")
    sweep = solved({**at, **SWEEP, "analysis.frequency_from": 44.0}, start_from=tmp_path / "start").sweep
    assert start.summary["max_contact_force_N"] > 0.0
    assert sweep["max_displacement_m"][0] == pytest.approx(start.summary["max_displacement_m"], rel=1e-9)


def test_a_study_of_curves_has_the_curves_of_single_runs(tmp_path):
    values = [2e-4, 3e-4]
    keys = {**SWEEP, **STOP, **PLAIN, "analysis.frequency_to": 40.0}
    table = wb.study(ROTOR, {"contact.gap": values}, overrides=keys, output=tmp_path / "study").table
    for value, peak in zip(values, table["max_displacement_m"]):
        alone = solved({**keys, "contact.gap": value}).summary
        assert peak == pytest.approx(alone["max_displacement_m"], rel=1e-9)


def test_a_study_over_the_speed_tells_a_rotor_that_follows_from_one_that_does_not(tmp_path):
    keys = {"analysis.type": "frequency_sweep", "analysis.frequency_from": 55.0, "analysis.frequency_to": 60.0}
    table = wb.study(ROTOR, {"structure.spin_speed": [0.0, 80.0 * np.pi]}, overrides=keys, output=tmp_path / "study").table
    fixed = solved({**keys, "structure.spin_speed": 80.0 * np.pi}).summary
    assert table["max_displacement_m"][1] == pytest.approx(fixed["max_displacement_m"], rel=1e-9)
    assert abs(table["max_displacement_m"][0] / table["max_displacement_m"][1] - 1.0) > 1e-3


def test_modal_damping_adds_to_gyroscopic_forces():
    record = solved({"structure.modal_damping": 0.03}, unset=["structure.damping"])
    omega = 80.0 * np.pi
    damping = modal_damping(STIFFNESS[::2, ::2], MASS[::2, ::2], 0.03) - 1j * omega * np.diag([0.0, 0.5])
    dynamic = STIFFNESS[::2, ::2] + 1j * omega * damping - omega**2 * MASS[::2, ::2]
    radius = abs(np.linalg.solve(dynamic, [UNBALANCE * omega**2, 0.0])[0])
    assert np.sqrt(2.0) * record.summary["rms_displacement_m"] == pytest.approx(radius, rel=1e-9)


def test_material_damping_is_that_of_the_stiffness_at_rest():
    record = solved({"structure.stiffness_damping": 2e-5, **STIFFENED}, unset=["structure.damping"])
    radius = abs(whirl(40.0, 80.0 * np.pi, 1.0))
    assert np.sqrt(2.0) * record.summary["rms_displacement_m"] == pytest.approx(radius, rel=1e-9)


@pytest.mark.parametrize("key, keys, unset", [
    ("structure.modal_damping", {"structure.modal_damping": 0.01}, ["structure.damping"]),
    ("structure.free", {"structure.free": True}, []),
])
def test_what_is_taken_from_one_stiffness_is_refused_by_key(key, keys, unset):
    refused(ROTOR, key, "spin_speed", overrides={**SWEEP, **STIFFENED, **keys}, unset=unset)


def test_check_says_the_range_of_the_speed():
    assert "turning with the load at 188.4956 to 376.9911 rad/s" in wb.check(ROTOR, SWEEP)
