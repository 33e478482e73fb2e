"""Bodies that turn together without force, and contacts at supports that move: the motion relative to both belongs to
one mass."""

import copy

import numpy as np
import pytest
import wavebalance as wb

M1, M2, STIFFNESS, GAP, ERROR = 0.3, 0.6, 2e8, 40e-6, 0.8e-6
REDUCED = M1 * M2 / (M1 + M2)
DAMPER = 2 * 0.04 * np.sqrt(STIFFNESS * REDUCED)
TIME = {"trial": "fourier", "weight": "fourier", "functions": 63, "quadrature_points": 1024}
MESH = np.array([1.0, -1.0, -1.0])


def gears(frequency=3900.0):
    """Both gears, and the transmission error as a row that moves."""
    return {
        "structure": {"type": "matrices", "mass": np.diag([M1, M2, 1e-3]), "stiffness": np.zeros((3, 3)),
                      "damping": DAMPER * np.outer(MESH, MESH), "free": True},
        "contact": {"pairs": [{"law": "clearance", "stiffness": STIFFNESS, "gap": GAP, "dofs": [1, 2, 3], "coefficients": list(MESH)}]},
        "forcing": {"frequency": frequency, "terms": [{"harmonic": 0, "dofs": [1, -2], "amplitude": 400.0},
                                                      {"kind": "base_displacement", "dofs": [3], "amplitude": ERROR}]},
        "time": dict(TIME),
    }


def mass_of_both(frequency=3900.0):
    """The same teeth as one mass, which the acceleration of the error shakes."""
    return {
        "structure": {"type": "matrices", "mass": [[REDUCED]], "stiffness": [[0.0]], "damping": [[DAMPER]], "free": True},
        "contact": {"pairs": [{"law": "clearance", "stiffness": STIFFNESS, "gap": GAP, "dofs": [1]}]},
        "forcing": {"frequency": frequency, "terms": [{"harmonic": 0, "dofs": [1], "amplitude": 400.0},
                                                      {"kind": "base_acceleration", "dofs": [1], "amplitude": -ERROR * (2 * np.pi * frequency)**2}]},
        "time": dict(TIME),
    }


def arrays(scene):
    scene = copy.deepcopy(scene)
    for key in ("mass", "stiffness", "damping"):
        scene["structure"][key] = np.array(scene["structure"][key])
    return scene


@pytest.mark.parametrize("frequency", [3700.0, 5200.0])
def test_teeth_of_two_free_gears_move_as_one_mass_does(frequency):
    both, one = wb.run(gears(frequency)), wb.run(arrays(mass_of_both(frequency)))
    assert both.status == one.status == "converged"
    own, other = both.response["displacement_m"], one.response["displacement_m"]
    np.testing.assert_allclose(own, other, rtol=0, atol=1e-9 * np.abs(other).max())
    for part in ("real", "imag"):
        key = f"leading_multiplier_{part}"
        assert both.summary[key] == pytest.approx(one.summary[key], abs=1e-7)


def test_outputs_have_the_motion_with_which_a_support_carries_its_contacts():
    """Momentum: m1 x1'' + m2 x2'' = 0 apart from the dampers' share, which is inner; the teeth have x1 - x2 - e."""
    record = wb.run({**gears(5200.0), "analysis": {"type": "forced_response", "outputs": ["row 1", "row 2"]}})
    first, second = record.outputs["row_1_m"], record.outputs["row_2_m"]
    time = record.outputs["time_fraction"]
    teeth = record.response["displacement_m"]
    moved = first - second - ERROR * np.cos(2 * np.pi * time)
    np.testing.assert_allclose(moved - moved.mean(), teeth - teeth.mean(), rtol=0, atol=1e-12)
    both = M1 * first + M2 * second
    np.testing.assert_allclose(both - both.mean(), 0.0, rtol=0, atol=1e-9 * M1 * np.ptp(first))


def test_curves_of_two_free_gears_know_their_stability_and_the_folds_of_the_structure():
    sweep = {"type": "frequency_sweep", "frequency_from": 3300.0, "frequency_to": 4600.0}
    curve = wb.run({**gears(), "analysis": sweep}).summary
    exact = wb.run({**gears(), "analysis": {**sweep, "exact": True}}).summary
    assert curve["status"] == exact["status"] == "reached_end" and curve["points_stability_not_known"] == 0
    folds = [[hertz for kind, hertz in zip(points["type"], points["frequency_Hz"]) if kind == "fold"]
             for points in (curve["structure_special_points"], exact["special_points"])]
    assert len(folds[1]) == 2 and folds[0] == pytest.approx(folds[1], rel=1e-9)


def test_a_table_that_moves_strikes_a_ball_as_its_acceleration_does():
    """0.2616 m/s at restitution 0.5, the closed form of a ball that strikes its table once a period."""
    amplitude, frequency = 20.0, 25.0
    scene = {
        "structure": {"type": "matrices", "mass": np.eye(2), "stiffness": np.zeros((2, 2)), "free": True},
        "contact": {"pairs": [{"law": "rigid", "restitution": 0.5, "gap": 0.0, "dofs": [2, 1]}]},
        "forcing": {"frequency": frequency, "terms": [
            {"harmonic": 0, "dofs": [1], "amplitude": -9.81},
            {"kind": "base_displacement", "dofs": [2], "amplitude": amplitude / (2 * np.pi * frequency)**2}]},
    }
    summary = wb.run(scene).summary
    assert summary["max_impact_velocity_m_per_s"] == pytest.approx(0.2616, rel=1e-9)
    assert summary["leading_multiplier_real"] == pytest.approx(-2.58922383, abs=1e-7)


@pytest.mark.parametrize("key, value", [("modal_damping", 0.01), ("loss_factor", 0.01)])
def test_what_a_moving_support_in_contact_leaves_out_is_refused(key, value):
    scene = gears()
    del scene["structure"]["damping"]
    scene["structure"][key] = value
    scene["structure"]["free"] = False
    scene["structure"]["stiffness"] = np.diag([1e3, 1e3, 1e3])
    with pytest.raises(wb.SceneError, match=f"structure.{key}.*not with a contact at a row that a base displacement moves"):
        wb.run(scene)
