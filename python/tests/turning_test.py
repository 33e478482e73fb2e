"""Structures that turn with their load: an overhung disk with a gyroscopic matrix and an unbalance."""

import pickle
import tomllib

import numpy as np
import pytest

import wavebalance as wb

MASS = np.diag([10.0, 10.0, 0.3, 0.3])
STIFFNESS = np.array([[1e6, 0.0, -3e5, 0.0], [0.0, 1e6, 0.0, -3e5], [-3e5, 0.0, 2.5e5, 0.0], [0.0, -3e5, 0.0, 2.5e5]])
DAMPING = 2e-5 * STIFFNESS
POLAR, AMOUNT = 0.5, 5e-3  # kg m^2, kg m
GYROSCOPIC = np.zeros((4, 4))
GYROSCOPIC[2, 3], GYROSCOPIC[3, 2] = POLAR, -POLAR
SPIN_STIFFNESS = np.diag([0.0, 0.0, 0.2, 0.2])
STOP = wb.Penalty(stiffness=1e6, gap=2e-4)


def rotor(**turning):
    return wb.Structure(MASS, DAMPING, STIFFNESS, np.zeros(4), [0], unbalance=[(AMOUNT, (0, 1))],
                        **{"gyroscopic": GYROSCOPIC, **turning})


@pytest.mark.parametrize("turning", [{}, {"spin_speed": 200.0}, {"spin_stiffness": SPIN_STIFFNESS}])
def test_a_rotor_against_a_stop_has_the_curve_of_its_scene(turning):
    pair, keys = wb.Pair("fourier", 31, 256), {"type": "frequency_sweep", "frequency_from": 30.0, "frequency_to": 40.0}
    record = wb.run(rotor(**turning).scene(STOP, pair=pair, output_points=256, **keys))
    steps = {key: tomllib.loads(record.scene)["analysis"][key] for key in ("first_step", "largest_step")}
    curve = wb.frequency_sweep(rotor(**turning), STOP, 30.0, 40.0, pair, output_points=256, **steps)
    # G is added to C here and there in another order.
    np.testing.assert_allclose(curve.frequency, record.sweep["frequency_Hz"], rtol=1e-12)
    np.testing.assert_allclose(curve.max_displacement, record.sweep["max_displacement_m"], rtol=1e-9)
    assert curve.max_force.max() > 1.0


def test_a_law_of_ones_own_follows_the_speed():
    own = wb.Function(lambda u: 1e6 * np.maximum(u - 2e-4, 0.0), lambda u: 1e6 * (u > 2e-4), kinks=[2e-4])
    mine, known = (wb.forced_response(rotor(), law, 33.0) for law in (own, STOP))
    assert known.contact_force.max() > 1.0
    np.testing.assert_allclose(mine.displacement, known.displacement, rtol=0.0, atol=1e-12)


def test_an_unbalance_may_turn_with_a_harmonic_of_the_load():
    """As of a second shaft that turns three times as fast."""
    shaft = wb.Structure(MASS, DAMPING, STIFFNESS, np.zeros(4), [0], unbalance=[(AMOUNT, (0, 1), 20.0, 3)],
                         gyroscopic=3.0 * GYROSCOPIC)
    far, omega = wb.Penalty(stiffness=1e6, gap=1.0), 2.0 * np.pi * 33.0
    damping = DAMPING[::2, ::2] - 1j * omega * np.diag([0.0, POLAR])  # of the forward whirl, in x + iy and its rotation
    dynamic = STIFFNESS[::2, ::2] + 1j * omega * damping - omega**2 * MASS[::2, ::2]
    expected = abs(np.linalg.solve(dynamic, [AMOUNT * omega**2, 0.0])[0])
    found = wb.forced_response(shaft, far, 11.0).displacement
    record = wb.run(shaft.scene(far, frequency=11.0, type="forced_response"))
    for moved in (found, record.response["displacement_m"]):
        assert np.sqrt(2.0) * np.std(moved) == pytest.approx(expected, rel=1e-9)


def test_a_structure_that_turns_is_pickled():
    copy = pickle.loads(pickle.dumps(rotor(spin_stiffness=SPIN_STIFFNESS)))
    same = [wb.forced_response(one, STOP, 33.0).displacement for one in (copy, rotor(spin_stiffness=SPIN_STIFFNESS))]
    np.testing.assert_array_equal(*same)


@pytest.mark.parametrize("turning, words", [
    ({"gyroscopic": SPIN_STIFFNESS}, "gyroscopic is not skew-symmetric"),
    ({"spin_stiffness": GYROSCOPIC}, "spin_stiffness is not symmetric"),
    ({"gyroscopic": None, "spin_speed": 3.0}, "expected gyroscopic or spin_stiffness"),
    ({"spin_speed": -3.0}, "spin_speed is -3.0"),
    ({"gyroscopic": np.zeros((2, 2))}, "gyroscopic is 2 x 2; expected 4 x 4"),
])
def test_parts_that_do_not_turn_are_refused(turning, words):
    with pytest.raises(ValueError, match=words):
        rotor(**turning)


@pytest.mark.parametrize("load", [(1.0, (0, 0)), (1.0, (0, 1, 2)), (1.0, (4,)), (1.0,), ("much", (0, 1)), (1.0, (0, 1), 0.0, 0),
                                  (1.0, (0, 1), 0.0, 1.5), (1.0, (0, 1), 0.0, 1, 1)])
def test_an_unbalance_names_its_degrees_of_freedom(load):
    with pytest.raises(ValueError, match="unbalance"):
        wb.Structure(MASS, DAMPING, STIFFNESS, np.zeros(4), [0], unbalance=[load])


def test_a_mode_takes_no_structure_that_turns():
    with pytest.raises(ValueError, match="nonlinear mode"):
        wb.backbone(rotor(), STOP)
