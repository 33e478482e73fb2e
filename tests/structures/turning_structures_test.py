"""structure.gyroscopic and spin_stiffness: a rotor at a fixed speed, or at the speed of its load."""

import numpy as np
import pytest
from overhung_disk import ROTOR, STOP, UNBALANCE, whirl
from structure_scenes import displacements, distance, refused

import wavebalance as wb

pytestmark = pytest.mark.usefixtures("rotor_files")


def solved(overrides=None, unset=()):
    record = wb.run(ROTOR, overrides, unset=unset)
    assert record.converged, record.status
    return record


@pytest.mark.parametrize("speed", [None, 100.0])
@pytest.mark.parametrize("spin_stiffness", [0.0, 1.0])
def test_a_rotor_whirls_at_the_radius_of_the_closed_form(speed, spin_stiffness):
    keys = {} if speed is None else {"structure.spin_speed": speed}
    keys |= {"structure.spin_stiffness": "s.mtx"} if spin_stiffness else {}
    expected = abs(whirl(40.0, 80.0 * np.pi if speed is None else speed, spin_stiffness))
    assert solved(keys).summary["rms_displacement_m"] == pytest.approx(expected / np.sqrt(2.0), rel=1e-10)


def test_a_study_over_the_frequency_turns_the_rotor_with_its_load(tmp_path):
    frequencies = np.array([30.0, 38.0, 45.0])
    table = wb.study(ROTOR, {"forcing.frequency": frequencies}, output=tmp_path / "study").table
    expected = [abs(whirl(one, 2.0 * np.pi * one)) / np.sqrt(2.0) for one in frequencies]
    np.testing.assert_allclose(table["rms_displacement_m"], expected, rtol=1e-9)


def test_a_curve_at_a_speed_of_its_own_has_one_speed():
    sweep = {"analysis.type": "frequency_sweep", "analysis.frequency_from": 30.0, "analysis.frequency_to": 45.0}
    record = solved({**sweep, "structure.spin_speed": 200.0})
    expected = [abs(whirl(one, 200.0)) / np.sqrt(2.0) for one in record.sweep["frequency_Hz"]]
    np.testing.assert_allclose(record.sweep["rms_displacement_m"], expected, rtol=1e-9)


def exact(overrides=None):
    """The exact motion of the rotor that meets a stop."""
    keys = {**STOP, "time.method": "exact", **(overrides or {})}
    return solved(keys, unset=["time.trial", "time.weight", "time.functions"])


def test_a_rotor_that_meets_a_stop_moves_as_time_stepping_has_it():
    stepped = solved({**STOP, "analysis.type": "time_stepping"}, unset=["time.trial", "time.weight", "time.functions"])
    found = exact()
    assert found.summary["contact_fraction"] > 0.2
    assert distance(displacements(found), displacements(stepped)) <= 1e-5  # the tolerance of time stepping


def test_an_amplitude_sweep_of_a_rotor_comes_to_its_exact_motion():
    sweep = {"analysis.type": "amplitude_sweep", "analysis.amplitude_from": 1e-3, "analysis.amplitude_to": UNBALANCE}
    last = float(solved({**STOP, **sweep, "analysis.exact": True}).sweep["max_displacement_m"][-1])
    assert last == pytest.approx(exact().summary["max_displacement_m"], rel=1e-7)


def test_the_motions_of_a_rotor_are_its_exact_motion_with_its_multipliers():
    record = wb.run(ROTOR, {**STOP, "analysis.type": "motions"}, unset=["time.trial", "time.weight", "time.functions"])
    response = exact()
    assert record.summary["motions"]["max_displacement_m"][0] == pytest.approx(response.summary["max_displacement_m"], rel=1e-9)
    assert record.summary["motions"]["unstable_multipliers"][0] == response.summary["unstable_multipliers"]


@pytest.mark.parametrize("name, rows, key, part", [
    ("g", np.eye(4), "structure.gyroscopic", "skew-symmetric"),
    ("g", np.zeros((3, 3)) + np.diag([1.0, 1.0], 1) - np.diag([1.0, 1.0], -1), "structure.gyroscopic", ""),
    ("s", np.diag([1.0, 1.0, 1.0], 1), "structure.spin_stiffness", "symmetric"),
])
def test_a_part_that_is_not_what_it_says_is_refused_by_key(rotor_files, name, rows, key, part):
    rotor_files(f"{name}.mtx", rows.tolist())
    error = refused(ROTOR, key, overrides={"structure.spin_stiffness": "s.mtx"})
    assert part in str(error)


def test_check_says_the_speed_and_whose_frequencies_it_has():
    text = wb.check(ROTOR)
    assert "4 degrees of freedom, turning at 251.3274 rad/s" in text
    assert "without gyroscopic forces" in text


def test_a_speed_needs_a_part_that_it_turns():
    refused(ROTOR, "structure.spin_speed", "structure.gyroscopic", overrides={"structure.spin_speed": 10.0}, unset=["structure.gyroscopic"])
