"""Where a balance has no solution, time integration decides: its motion is the answer, or one to which it nearly returns."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import wavebalance as wb


def between(rows, springs):
    """The matrix of springs between rows from 1, or to the ground (0)."""
    matrix = np.zeros((rows, rows))
    for one, other, stiffness in springs:
        ends = np.zeros(rows + 1)
        ends[one], ends[other] = 1.0, -1.0
        matrix += stiffness * np.outer(ends[1:], ends[1:])
    return matrix


def pressed_chain():
    """Four masses on a spring a millionth as stiff as those between them, before stops on both sides."""
    return {
        "structure": {"type": "matrices", "mass": np.diag([0.86, 1.7, 1.4, 0.64]),
                      "stiffness": between(4, [(1, 0, 0.022), (1, 2, 12200.0), (2, 3, 7400.0), (3, 4, 16000.0)]),
                      "damping": between(4, [(1, 2, 360.0), (1, 3, 99.0), (2, 3, 1.5), (3, 4, 1.8), (2, 4, 0.4)]),
                      "contact_dofs": [-2, 1, 4, -3]},
        "contact": {"law": "linear", "stiffness": 45700.0, "gap": [1.9e-4, 2.3e-4, 3.5e-4, 2.2e-4]},
        "forcing": {"load": np.array([-2.9, -6.4, -7.6, 0.0]), "amplitude": 1.0, "frequency": 16.7},
        "time": {"trial": "fourier", "weight": "fourier", "functions": 31, "quadrature_points": 124}, "analysis": {}}


def pressed_body():
    """Stops a hundred times as stiff as the body, which press on all its rows at rest."""
    return {
        "structure": {"type": "matrices",
                      "mass": np.array([[0.591, -0.321, -0.171, -0.0695], [-0.321, 1.06, 0.268, 0.629],
                                        [-0.171, 0.268, 0.491, 0.167], [-0.0695, 0.629, 0.167, 1.09]]),
                      "damping": np.array([[60.5, -3.69, -60.1, 2.01], [-3.69, 19.7, -0.54, 16.4],
                                           [-60.1, -0.54, 93.7, -7.96], [2.01, 16.4, -7.96, 27.4]]),
                      "stiffness": np.array([[5010.0, 739.0, -8750.0, 9460.0], [739.0, 26100.0, -11600.0, 32200.0],
                                             [-8750.0, -11600.0, 21400.0, -29200.0],
                                             [9460.0, 32200.0, -29200.0, 57900.0]]),
                      "contact_dofs": [-3, -2, -4, -1]},
        "contact": {"law": "linear", "stiffness": 4.96e6, "gap": [-8.98e-4, -1.17e-4, -4.66e-4, -1.52e-3]},
        "forcing": {"load": np.array([-3.82, 2.51, -1.78, 0.0]), "amplitude": 1.0, "frequency": 11.97},
        "time": {"trial": "fourier", "weight": "fourier", "functions": 31, "quadrature_points": 124}, "analysis": {}}


def mass_between_stops():
    """One mass between two stops 150 times as stiff as its spring, whose motion from rest never repeats."""
    return {
        "structure": {"type": "matrices", "mass": np.array([[0.849]]), "stiffness": np.array([[1375.0]]),
                      "damping": np.array([[5.11]]), "contact_dofs": [1]},
        "contact": {"law": "clearance", "stiffness": 2.11e5, "gap": 4.43e-4, "stiffness_below": 1.94e5,
                    "gap_below": 1.09e-4},
        "forcing": {"load": np.array([1.0]), "amplitude": 0.982, "frequency": 1.8467},
        "time": {"trial": "fourier", "weight": "fourier", "functions": 63, "quadrature_points": 256}, "analysis": {}}


def change_over_a_period(scene, record):
    """By how much SciPy's integration from the first state leaves the motion, over its size; all rows are in contact."""
    body, contact = scene["structure"], scene["contact"]
    rows, signs = np.abs(body["contact_dofs"]) - 1, np.sign(body["contact_dofs"])
    table = record.contacts or record.response
    motion = (signs * table["displacement_m"].reshape(-1, len(rows)))[:, np.argsort(rows)].T
    size, points = motion.shape
    rate = 2.0 * np.pi * scene["forcing"]["frequency"]
    spectrum = 1j * rate * np.fft.fftfreq(points, 1.0 / points) * np.fft.fft(motion)

    def rates(time, state):
        place = signs * state[rows]
        force = contact["stiffness"] * np.maximum(place - contact["gap"], 0.0)
        if "gap_below" in contact:
            force -= contact["stiffness_below"] * np.maximum(-place - contact["gap_below"], 0.0)
        total = scene["forcing"]["amplitude"] * scene["forcing"]["load"] * np.cos(rate * time)
        np.subtract.at(total, rows, signs * force)
        total -= body["stiffness"] @ state[:size] + body["damping"] @ state[size:]
        return np.r_[state[size:], np.linalg.solve(body["mass"], total)]

    period = 2.0 * np.pi / rate
    begin = np.r_[motion[:, 0], np.fft.ifft(spectrum).real[:, 0]]
    found = solve_ivp(rates, (0.0, period), begin, method="DOP853", rtol=1e-10, atol=1e-13,
                      t_eval=np.arange(points) * period / points)
    return np.abs(found.y[:size] - motion).max() / np.abs(motion).max()


def stepped(scene, **analysis):
    return wb.run({**{key: value for key, value in scene.items() if key != "time"},
                   "analysis": {"type": "time_stepping", "recorded_periods": 0, **analysis}})


def test_the_motion_in_time_is_the_answer_where_the_functions_hold_none():
    scene = pressed_chain()
    record = wb.run(scene)
    assert record.converged and record.summary["solved_by"] == record.summary["form"] == "exact", record.status
    assert record.summary["strategy"] == "from_settling" and record.summary["stability"] == "stable"
    assert any("functions of the scene do not hold this motion" in told for told in record.warnings)
    in_time = stepped(scene, tolerance=1e-8).summary
    for quantity in ("max_displacement_m", "max_contact_force_N", "contact_fraction"):
        assert record.summary[quantity] == pytest.approx(in_time[quantity], rel=1e-3), quantity


# The motion from rest comes close to an unstable one, near which the functions have no solution.
# From rest the stops press the body so that its first period took all operations, of which a hundred are needed.
@pytest.mark.parametrize("make", [mass_between_stops, pressed_body])
def test_an_unstable_motion_is_the_answer_where_that_from_rest_never_repeats(make):
    scene = make()
    record = wb.run(scene)
    assert record.converged and record.summary["solved_by"] == "exact", record.status
    assert record.summary["strategy"] == "recurrence" and record.summary["unstable_multipliers"] == 1
    assert record.summary["attractor_periods"] == 0
    assert any("nearly returns" in told for told in record.warnings)
    assert change_over_a_period(scene, record) < 1e-3  # velocities are derivatives of samples; multipliers up to 10
    in_time = stepped(scene, max_periods=150)
    assert in_time.summary["attractor_periods"] == 0
