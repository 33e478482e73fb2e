"""Motions of several periods of the load, and branches, as records, tables and pictures hold them."""

import math

import numpy as np
import pytest
from solved_scenes import BALANCE_KEYS, BAR, COLUMNS_OF_A_CURVE, FOURIER, JONES, STOP, figure_of, refusal, solved, warns

import wavebalance

TWO_PI = 2.0 * math.pi
# m = k = 1, c = 0.1, a stop of 10 N/m at 0.1 m, 0.8 N. The motion of one period is unstable between the period
# doublings at 2.206199894019 and 2.973736781998 rad/s.
DOUBLINGS = (2.206199894019, 2.973736781998)
OSCILLATOR = {
    "structure": {**STOP["structure"], "stiffness_damping": 0.1},
    "contact": {"law": "linear", "stiffness": 10.0, "gap": 0.1},
    "forcing": {"amplitude": 0.8, "frequency": 2.7 / TWO_PI},
    "time": {**FOURIER, "functions": 125, "quadrature_points": 1024},
    "analysis": {"type": "forced_response"},
}
SWEEP = {**OSCILLATOR, "time": {**FOURIER, "functions": 63, "quadrature_points": 512},
         "analysis": {"type": "frequency_sweep", "frequency_from": 0.33, "frequency_to": 0.5}}
BRANCHES = {"analysis.branches": True}
SIXTY_THREE = {"time.trial": "fourier", "time.weight": "fourier", "time.functions": 63}


def test_a_motion_of_two_periods_of_the_load_is_one():
    """At 2.7 rad/s. Both halves of the time, one forcing period each, are equal except for the doubling."""
    record = solved(OSCILLATOR, {"analysis.subharmonic": 2, "analysis.output_points": 2048})
    summary = record.summary
    assert record.converged, record.status
    assert summary["frequency_Hz"] == pytest.approx(2.7 / TWO_PI, abs=1e-12)
    assert summary["subharmonic"] == 2 and summary["period_of_motion"] == 2
    assert summary["change_after_one_period"] > 1.0 and summary["stability"] == "stable"
    assert figure_of(record)["panels"][0]["x"]["label"] == "Time (fraction of 2 forcing periods)"
    u, v = record.response["displacement_m"], record.response["velocity_m_per_s"]
    step = 2.0 * TWO_PI / 2.7 / 2048  # the velocity follows the time column
    np.testing.assert_allclose((u[2::97] - u[:-2:97]) / (2.0 * step), v[1:-1:97], rtol=0.0, atol=1e-3)


def test_a_record_says_that_the_motion_found_has_a_shorter_period():
    """The motion of one period is one of three periods, too, and at 2 rad/s no other is found."""
    record = solved(OSCILLATOR, {"analysis.subharmonic": 3, "forcing.frequency": 2.0 / TWO_PI})
    assert record.converged and record.summary["period_of_motion"] == 1
    assert warns(record, "repeats after one period")


@pytest.mark.parametrize("basis", ["fourier", "haar"])
def test_two_periods_without_contact_are_the_ordinary_response_twice(basis):
    pair = {"time.trial": basis, "time.functions": 64, "time.quadrature_points": 512, "contact.gap": 1e3}
    doubled = {**pair, "analysis.subharmonic": 2, "time.functions": 128, "time.quadrature_points": 1024,
               "analysis.output_points": 2048}
    once, twice = solved(OSCILLATOR, pair), solved(OSCILLATOR, doubled)
    np.testing.assert_allclose(twice.response["displacement_m"], np.tile(once.response["displacement_m"], 2), rtol=0.0,
                               atol=1e-13)
    assert twice.summary["period_of_motion"] == 1


def test_time_stepping_says_after_how_many_periods_a_motion_repeats():
    record = solved(OSCILLATOR, {"analysis.type": "time_stepping"})
    assert not record.converged and record.status == "subharmonic"
    assert record.summary["attractor_periods"] == 2
    assert warns(record, "analysis.subharmonic = 2")


def test_a_rigid_contact_says_that_its_motion_has_one_period():
    """Its points are no multiple of three, so that a motion of one period repeats to 1e-4 only."""
    record = solved(JONES / "case2_rigid.toml", {"analysis.subharmonic": 3, "time.functions": 127,
                                                 "time.quadrature_points": 1024})
    assert record.converged, record.status
    assert record.summary["period_of_motion"] == 1
    assert 1e-8 < record.summary["change_after_one_period"] < 2e-4


def test_a_curve_follows_the_motion_of_two_periods():
    """It starts at 2.7 rad/s of the load and turns back at 3.0243 rad/s."""
    record = solved(OSCILLATOR, {"analysis.type": "frequency_sweep", "analysis.subharmonic": 2,
                                 "analysis.frequency_from": 2.7 / TWO_PI, "analysis.frequency_to": 0.5})
    assert record.summary["period_of_motion"] == 2
    assert record.sweep["frequency_Hz"][0] == pytest.approx(2.7 / TWO_PI, abs=1e-12)
    turn = record.summary["turning_points_Hz"][0]
    assert TWO_PI * turn == pytest.approx(3.02430, abs=2e-4)
    special = record.summary["special_points"]
    assert special["type"][0] == "fold" and special["frequency_Hz"][0] == pytest.approx(turn, rel=1e-5)


def test_every_branch_is_written_with_its_period():
    record = solved(SWEEP, BRANCHES)
    assert record.converged, record.status
    branches = record.summary["branches"]
    assert TWO_PI * branches["frequency_Hz"][0] == pytest.approx(DOUBLINGS[0], abs=1e-4)
    assert TWO_PI * branches["end_frequency_Hz"][0] == pytest.approx(DOUBLINGS[1], abs=1e-4)
    assert list(branches["end"]) == ["special_point", "special_point"] and list(branches["period"]) == [2.0, 4.0]
    branch, omega = record.sweep["branch"], TWO_PI * record.sweep["frequency_Hz"]
    assert set(branch) == {0.0, 1.0, 2.0}
    np.testing.assert_array_equal(record.sweep["period"], np.where(branch == 0.0, 1.0, 2.0 * branch))
    assert omega.min() > 2.07 and omega.max() < 3.15
    between = (branch == 0.0) & (omega > 2.21) & (omega < 2.97)
    assert between.any() and (record.sweep["unstable"][between] == 1.0).all()
    # The branch turns back at two folds, and is itself doubled between two frequencies on its way to the first.
    doubled, top = omega[branch == 1.0], omega[branch == 1.0].argmax()
    assert doubled[top] == pytest.approx(3.02430, abs=2e-4) and doubled[top:].min() == pytest.approx(2.92686, abs=2e-4)
    begin, end = TWO_PI * branches["frequency_Hz"][1], TWO_PI * branches["end_frequency_Hz"][1]
    assert (begin, end) == pytest.approx((2.36300, 2.44572), abs=2e-4)
    way = doubled[:top][doubled[:top] < 3.024]
    np.testing.assert_array_equal(record.sweep["unstable"][branch == 1.0][: len(way)], (way > begin) & (way < end))


def test_samples_at_the_middles_change_no_motion_of_two_periods_and_no_branch():
    middles = {"time.sample_offset": 0.5}
    doubled = {"analysis.subharmonic": 2, "analysis.output_points": 2048, "forcing.frequency": 2.5 / TWO_PI}
    left, middle = (solved(OSCILLATOR, {**doubled, **more}).response["displacement_m"] for more in ({}, middles))
    apart = min(np.linalg.norm(np.roll(middle, turn) - left) for turn in (0, 1024))
    assert apart < 1e-4 * np.linalg.norm(left)  # half a sample late it would be 1e-2
    left, middle = (solved(SWEEP, {**BRANCHES, **more}).summary for more in ({}, middles))
    assert list(left["special_points"]["type"]) == list(middle["special_points"]["type"])
    np.testing.assert_allclose(left["special_points"]["frequency_Hz"], middle["special_points"]["frequency_Hz"], rtol=0,
                               atol=1e-4)
    for column in ("end", "period"):
        assert list(left["branches"][column]) == list(middle["branches"][column])


# At the frequency of the first period doubling under 0.8 N.
OVER_AMPLITUDE = {**SWEEP, "forcing": {"amplitude": 0.8, "frequency": DOUBLINGS[0] / TWO_PI},
                  "analysis": {"type": "amplitude_sweep", "amplitude_from": 0.5, "amplitude_to": 1.2}}


def test_branches_of_an_amplitude_sweep_begin_where_those_of_a_frequency_sweep_do():
    record = solved(OVER_AMPLITUDE, BRANCHES)
    assert record.converged, record.status
    branches = record.summary["branches"]
    assert branches["amplitude_N"][0] == pytest.approx(0.8, abs=1e-4)
    assert branches["period"][0] == 2.0
    branch, amplitude = record.sweep["branch"], record.sweep["amplitude_N"]
    assert amplitude[branch == 1.0][0] == branches["amplitude_N"][0]
    assert branches["end_amplitude_N"][0] == amplitude[branch == 1.0][-1]
    assert set(branches["end"]) <= {"amplitude_from", "amplitude_to", "special_point", "parent_curve"}


def test_a_motion_of_a_branch_over_the_amplitude_is_that_of_a_response():
    record = solved(OVER_AMPLITUDE, BRANCHES)
    mine = record.sweep["branch"] == 1.0
    amplitude, highest = (record.sweep[name][mine] for name in ("amplitude_N", "max_displacement_m"))
    at = len(amplitude) // 2
    response = solved(OSCILLATOR, {"forcing.frequency": DOUBLINGS[0] / TWO_PI, "forcing.amplitude": float(amplitude[at]),
                                   "analysis.subharmonic": 2, "analysis.output_points": 2048})
    assert response.summary["period_of_motion"] == 2
    assert response.summary["max_displacement_m"] == pytest.approx(highest[at], rel=1e-8, abs=0.0)


@pytest.mark.parametrize("trial, weight", [("bspline", "bspline"), ("daubechies6", "bspline"), ("fourier", "fourier")])
def test_branches_are_those_of_every_pair_of_bases(trial, weight):
    """Motions of two periods have twice the functions and points, so that one of the curve repeated is one."""
    record = solved(SWEEP, {**BRANCHES, "time.trial": trial, "time.weight": weight, "time.functions": 64})
    branches = record.summary["branches"]
    assert TWO_PI * branches["frequency_Hz"][0] == pytest.approx(DOUBLINGS[0], abs=2e-4)
    assert TWO_PI * branches["end_frequency_Hz"][0] == pytest.approx(DOUBLINGS[1], abs=2e-4)
    assert list(branches["period"]) == [2.0, 4.0]


def test_branches_are_drawn_with_a_colour_for_each_and_dashed_where_unstable():
    series = figure_of(solved(SWEEP, BRANCHES))["panels"][0]["series"]
    labels = [one["label"] for one in series]
    first = labels.index("branch 1, 2 periods")
    assert series[first]["colour"] != series[labels.index("branch 2, 4 periods")]["colour"]
    assert series[first]["dash"] == "" and series[first + 1]["dash"] != ""
    assert series[first + 1]["colour"] == series[first]["colour"]
    assert "period doubling" in labels


def test_check_names_the_periods_and_the_branches():
    assert "motions of 2 periods, with branches" in wavebalance.check(SWEEP, {**BRANCHES, "analysis.subharmonic": 2})


def test_a_curve_without_branches_has_the_columns_of_one_curve():
    assert list(solved(SWEEP).sweep) == COLUMNS_OF_A_CURVE


def test_a_curve_warns_that_motions_become_quasi_periodic_at_neimark_sacker_points():
    record = solved(JONES / "case2_sweep.toml", {**SIXTY_THREE, "structure.stiffness_damping": 5e-7,
                                                 "analysis.frequency_from": 1308, "analysis.frequency_to": 1342})
    assert warns(record, "quasi-periodic") and warns(record, "1312.")


def test_a_curve_warns_of_neimark_sacker_points_on_branches_too():
    """Motion of two periods that begins just after contact, at 2734.17 Hz."""
    record = solved(JONES / "case2_sweep.toml", {**SIXTY_THREE, **BRANCHES, "time.quadrature_points": 512,
                                                 "contact.gap": 1e-4, "structure.stiffness_damping": 1.25e-6,
                                                 "analysis.frequency_from": 2550, "analysis.frequency_to": 3000})
    assert warns(record, "2916.")


OVER_FREQUENCY = {"analysis.type": "frequency_sweep", "analysis.frequency_from": 0.3, "analysis.frequency_to": 0.4}
RIGID = {**OSCILLATOR, "contact": {"law": "rigid", "gap": 0.1},
         "structure": {**OSCILLATOR["structure"], "elements": 2, "massless_tip": True}}


@pytest.mark.parametrize("scene, overrides, unset, parts", [
    (OSCILLATOR, {"analysis.subharmonic": 0}, (), ["analysis.subharmonic = 0", "1..1024"]),
    (OSCILLATOR, {"analysis.subharmonic": "two"}, (), ['analysis.subharmonic = "two"', "integer"]),
    (OSCILLATOR, {"analysis.subharmonic": 2.5}, (), ["analysis.subharmonic = 2.5", "integer"]),
    (OSCILLATOR, {"analysis.subharmonic": 63}, (), ["analysis.subharmonic = 63", "<= 62"]),
    (OSCILLATOR, BRANCHES, (), ["analysis.branches = true", "frequency_sweep"]),
    (OSCILLATOR, {"analysis.type": "time_stepping", "analysis.subharmonic": 2}, (),
     ["analysis.subharmonic = 2", "forced_response"]),
    (OSCILLATOR, {**OVER_FREQUENCY, "analysis.branches": 1}, (), ["analysis.branches = 1", "true or false"]),
    (OSCILLATOR, {**OVER_FREQUENCY, **BRANCHES, "analysis.stability": False}, (),
     ["analysis.branches = true", "analysis.stability = true"]),
    (RIGID, {**OVER_FREQUENCY, **BRANCHES}, (), ["analysis.branches = true", "rigid"]),
    (BAR, {"time.tolerance": 1e-3, "analysis.subharmonic": 2}, BALANCE_KEYS,
     ["analysis.subharmonic = 2", "time.tolerance"]),
])
def test_several_periods_and_branches_are_refused_where_there_are_none(scene, overrides, unset, parts):
    message = str(refusal(scene, overrides, unset))
    assert all(part in message for part in parts), message
