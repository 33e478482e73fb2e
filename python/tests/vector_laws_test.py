"""Laws of Python functions along several directions: a squeeze-film damper, against scipy's integration."""

import pickle

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import wavebalance as wb

CLEARANCE, FILM = 2e-4, 20.0  # m, N s/m
STIFFNESS, DAMPING, WHIRL = 4e4, 2.0, 1.5  # N/m, N s/m, N s/m: of a rotor of 1 kg in a soft cage


def squeeze_film(u, v):
    """A short film without cavitation: damping along the radius and the tangent, which grow without bound at the clearance."""
    r2 = np.sum(u * u, axis=0)
    e2 = np.minimum(r2 / CLEARANCE**2, 0.999)
    tangential, radial = FILM * (1 - e2) ** -1.5, FILM * (1 + 2 * e2) * (1 - e2) ** -2.5
    return tangential * v + (radial - tangential) * np.sum(u * v, axis=0) / np.maximum(r2, 1e-30) * u


def stretched(u):
    """Force of a ring with friction, away from its center."""
    r = np.hypot(*u)
    w = 5e3 * np.maximum(1.0 - 1e-3 / np.maximum(r, 1e-12), 0.0)
    return w * np.array([u[0] - 0.2 * u[1], u[1] + 0.2 * u[0]])


def rotor(load=30.0):
    """Isotropic, with its weight and a load that turns."""
    C = DAMPING * np.eye(2) + WHIRL * np.array([[0.0, 1.0], [-1.0, 0.0]])
    turning = [(np.array([0.0, load]), np.array([0.0, -1j]))]
    return wb.Structure(np.eye(2), C, STIFFNESS * np.eye(2), [load, 0.0], [0, 1], static_load=[0.0, -3.0], forces=turning, unsymmetric=True)


def period_from(state, frequency, load):
    """The state (u, v) a period later, rtol 1e-12."""
    omega = 2 * np.pi * frequency
    C = DAMPING * np.eye(2) + WHIRL * np.array([[0.0, 1.0], [-1.0, 0.0]])

    def rate(t, z):
        u, v = z[:2], z[2:]
        outer = load * np.array([np.cos(omega * t), np.sin(omega * t)]) + [0.0, -3.0]
        return np.r_[v, outer - C @ v - STIFFNESS * u - squeeze_film(u[:, None], v[:, None])[:, 0]]

    return solve_ivp(rate, (0.0, 1.0 / frequency), state, method="LSODA", rtol=1e-12, atol=1e-17).y[:, -1]


@pytest.fixture
def film():
    return wb.VectorFunction(squeeze_film, length=1e-5, speed=1e-3)


def test_a_squeeze_film_has_the_motion_and_the_multipliers_of_an_integration(film):
    response = wb.forced_response(rotor(), film, 30.0, wb.Pair("fourier", 255, 2048))
    motion = response.structure_motion(64)
    assert response.converged and 0.95 < np.hypot(*motion.displacement).max() / CLEARANCE < 0.99
    state = np.r_[motion.displacement[:, 0], motion.velocity[:, 0]]
    scale = np.repeat([CLEARANCE, CLEARANCE * 2 * np.pi * 30.0], 2)
    np.testing.assert_allclose(period_from(state, 30.0, 30.0) / scale, state / scale, atol=1e-7)

    step = 2e-5 * scale
    map = [(period_from(state + d, 30.0, 30.0) - period_from(state - d, 30.0, 30.0)) / (2 * d.max()) for d in np.diag(step)]
    expected = np.linalg.eigvals(np.array(map).T)
    stability = response.stability()
    assert stability.status == "converged"
    largest = [max(all, key=abs) for all in (expected, stability.multipliers)]
    assert abs(largest[0].real - largest[1].real) + abs(abs(largest[0].imag) - abs(largest[1].imag)) < 2e-5


def test_a_function_of_a_ring_has_the_curve_and_the_stability_of_the_ring():
    M, C, K = np.eye(2), 0.5 * np.eye(2), 1e4 * np.diag([1.0, 1.1])
    structure = wb.Structure(M, C, K, [8.0, 3.0], [0, 1])
    pair = wb.Pair("fourier", 15, 128)
    curves = [wb.frequency_sweep(structure, law, 14.0, 17.0, pair) for law in (wb.VectorFunction(stretched), wb.Ring(5e3, 1e-3, 0.2))]
    at = [np.interp([14.5, 15.5, 16.5], curve.frequency, curve.rms_displacement) for curve in curves]
    assert all(curve.converged for curve in curves)
    np.testing.assert_allclose(at[0], at[1], rtol=2e-3)
    own, ring = [wb.forced_response(structure, law, 15.5, pair) for law in (wb.VectorFunction(stretched), wb.Ring(5e3, 1e-3, 0.2))]
    np.testing.assert_allclose(own.displacement, ring.displacement, rtol=1e-7, atol=1e-12)
    assert np.hypot(*own.displacement).max() > 1e-3
    np.testing.assert_allclose(abs(own.stability().multipliers), abs(ring.stability().multipliers), atol=2e-3)


def test_curves_over_the_frequency_pass_through_the_responses_with_a_law_of_velocities(film):
    pair = wb.Pair("fourier", 31, 256)
    curve = wb.frequency_sweep(rotor(), film, 28.0, 32.0, pair)
    assert curve.converged and np.all(curve.stable)
    k = int(np.argmax(curve.max_displacement))
    single = wb.forced_response(rotor(), film, float(curve.frequency[k]), pair)
    assert curve.max_displacement[k] == pytest.approx(single.motion(1024).displacement.max(), rel=1e-9, abs=0.0)


def test_what_it_is_given_and_asked_for_is_checked(film):
    with pytest.raises(ValueError, match="rows is 0; expected at least 1"):
        wb.VectorFunction(squeeze_film, rows=0)
    with pytest.raises(ValueError, match=r"force returned an array of shape \(64,\); expected \(2, 64\), 2 rows of as many instants"):
        wb.forced_response(rotor(), wb.VectorFunction(lambda u: u[0]), 30.0, wb.Pair("fourier", 15, 64))
    with pytest.raises(ValueError, match="the laws act along 2 contact directions, but the structure has 1"):
        wb.forced_response(wb.Structure([[1.0]], None, [[1.0]], [1.0], [0]), film, 30.0)
    with pytest.raises(ValueError, match="no keys"):
        film.scene_keys()
    assert film.rows == 2 and film.depends_on_velocity and not wb.VectorFunction(stretched).depends_on_velocity


def test_its_force_and_a_copy_from_a_pickle_are_those_of_the_function(film):
    u, v = np.array([[1e-4, 0.0], [0.0, 5e-5]]), np.array([[0.01, 0.0], [0.02, 0.01]])
    for law in (film, pickle.loads(pickle.dumps(film))):
        np.testing.assert_array_equal(law.force(u, v), squeeze_film(u, v))
