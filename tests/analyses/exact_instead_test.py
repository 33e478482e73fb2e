"""Where a balance has no solution, time integration decides: its motion is the answer, or the load has none of its period."""

import numpy as np
import pytest
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


# From rest the stops press the body so that its first period took all operations, of which a hundred are needed.
def test_no_motion_of_the_period_is_told_where_time_integration_leads_to_none():
    scene = pressed_body()
    record = wb.run(scene, {"analysis.recorded_periods": 0})
    assert not record.converged and record.summary["attractor_periods"] == 0
    assert any("did not repeat" in told for told in record.warnings)
    assert wb.run(scene, {"analysis.recorded_periods": 64}).status == "aperiodic"
    in_time = stepped(scene, max_periods=150)
    assert in_time.summary["attractor_periods"] == 0
