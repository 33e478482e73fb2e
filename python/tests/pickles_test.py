"""Structures, laws, responses and curves in pickles and copies, as pools of processes need them."""

import copy
import pickle

import numpy as np
import pytest

import wavebalance as wb

LAWS = [
    wb.Penalty(5.0, 0.5),
    wb.Rigid(0.5),
    wb.Coulomb(0.3, 10.0, 1.0),
    wb.Clearance(5.0, 0.5),
    wb.Polynomial([1.0, 0.0, 2.0]),
    wb.Table([-1.0, 0.0, 1.0], [-1.0, 0.0, 2.0]),
    wb.KelvinVoigt(5.0, 0.2, 0.1),
    wb.NoContact(),
]


def stop(u):
    return 5.0 * max(u - 0.5, 0.0)


def damped_stop(u, v):
    return max(5.0 * (u - 0.5) + 0.3 * v, 0.0) if u > 0.5 else 0.0


def both(one):
    return pickle.loads(pickle.dumps(one)), copy.deepcopy(one)


@pytest.mark.parametrize("law", LAWS, ids=lambda law: type(law).__name__)
def test_laws_come_back_with_their_values(law):
    for again in both(law):
        assert type(again) is type(law) and repr(again) == repr(law)
        assert again.gap == law.gap
        if not isinstance(law, (wb.Rigid, wb.Coulomb)):
            assert again.force(0.9) == law.force(0.9)


def test_laws_of_functions_with_names_come_back():
    for again in both(wb.Function(stop, gap=0.5, unilateral=True, kinks=[0.5])):
        assert again.force(0.9) == 5.0 * 0.4 and again.gap == 0.5


def test_a_structure_and_its_pair_come_back(oscillator):
    structure = oscillator(static_load=[0.2], forces=[([0.5], [0.0, 0.0, 1.0j])], loss_factor=0.01)
    pair = wb.Pair("haar:fourier", 64, nyquist="keep")
    law = wb.Penalty(5.0, 0.5)
    expected = wb.forced_response(structure, law, 0.2, pair).displacement
    for again, other in zip(both(structure), both(pair)):
        np.testing.assert_array_equal(wb.forced_response(again, law, 0.2, other).displacement, expected)
        assert repr(other) == repr(pair)


def test_a_response_comes_back_with_its_motions(oscillator):
    response = wb.forced_response(oscillator(), wb.Penalty(5.0, 0.5), 0.2)
    for again in both(response):
        np.testing.assert_array_equal(again.displacement, response.displacement)
        np.testing.assert_array_equal(again.motion(64).velocity, response.motion(64).velocity)
        np.testing.assert_array_equal(again.structure_motion(64).displacement, response.structure_motion(64).displacement)
        assert (again.status, again.iterations, again.strategy) == (response.status, response.iterations, response.strategy)
        assert again.stability().stable == response.stability().stable


def test_a_curve_comes_back_with_its_points_and_stability(oscillator):
    curve = wb.frequency_sweep(oscillator(), wb.Penalty(5.0, 0.5), 0.1, 0.4)
    for again in both(curve):
        np.testing.assert_array_equal(again.frequency, curve.frequency)
        np.testing.assert_array_equal(again.unstable, curve.unstable)
        assert again.special_points[0]["type"] == curve.special_points[0]["type"]
        np.testing.assert_array_equal(again.response(3).displacement, curve.response(3).displacement)
        assert len(again) == len(curve) and again.status == curve.status


def test_a_record_comes_back(bar):
    record = wb.run(bar)
    again = pickle.loads(pickle.dumps(record))
    np.testing.assert_array_equal(again.response["displacement_m"], record.response["displacement_m"])
    with pytest.raises(KeyError, match="the analysis has no such table"):
        again.sweep["frequency_Hz"]


def test_a_law_of_the_velocity_is_that_of_the_compiled_one(oscillator):
    compiled = wb.forced_response(oscillator(), wb.KelvinVoigt(5.0, 0.3, 0.5), 0.2)
    own = wb.Function(damped_stop, gap=0.5, unilateral=True, kinks=[0.5])
    assert own.depends_on_velocity and own.force(0.7, 1.0) == pytest.approx(1.3)
    found = wb.forced_response(oscillator(), own, 0.2)
    assert found.converged
    np.testing.assert_allclose(found.displacement, compiled.displacement, atol=1e-6)
    with pytest.raises(ValueError, match="takes a displacement alone"):
        wb.Function(stop, damping=lambda u, v: 0.0)
    with pytest.raises(ValueError, match="monotone"):
        wb.Function(damped_stop, monotone=True)
