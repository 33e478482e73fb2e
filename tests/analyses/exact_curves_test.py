"""Curves of the structure's own motions, analysis.exact, and the special points of the structure of ordinary curves."""

import numpy as np
import pytest
from solved_scenes import JONES, SCENES, STOP, STOP_AMPLITUDE, ZIGZAG, refusal, rows_of, solved, where

EXACT = {"analysis.exact": True}


def test_an_exact_curve_has_the_folds_of_the_oscillator_whatever_the_functions_of_its_start():
    coarse, fine = (solved(STOP, {**EXACT, "time.functions": functions, "time.quadrature_points": points})
                    for functions, points in ((15, 64), (255, 1024)))
    for record in (coarse, fine):
        assert record.converged, record.status
        assert record.summary["solved_by"] == "exact" and record.summary["stability"] == "converged"
    turns = coarse.summary["turning_points_Hz"]
    assert len(turns) == 2
    assert turns == pytest.approx(fine.summary["turning_points_Hz"], abs=1e-10)
    points = coarse.summary["special_points"]
    assert rows_of(where(points, type="grazing")) == 2
    assert set(points["status"]) == {"located"}
    others = np.array(points["type"]) != "grazing"
    multipliers = np.hypot(points["multiplier_real"], points["multiplier_imag"])[others]
    np.testing.assert_allclose(multipliers, 1.0, rtol=0.0, atol=1e-8)


def test_an_exact_curve_tells_of_each_point_its_measures_its_stability_and_what_it_is_by():
    sweep = solved(STOP, EXACT).sweep
    assert len(sweep["frequency_Hz"]) > 20 and next(iter(sweep)) == "frequency_Hz"
    assert set(sweep["stability_by"]) == {"phases"} and set(sweep["phases_status"]) == {"converged"}
    assert (sweep["error_of_displacement"] < 1e-8).all()
    np.testing.assert_array_equal(sweep["contacts"] > 0.0, sweep["max_contact_force_N"] > 0.0)
    assert (sweep["max_displacement_m"] <= sweep["max_abs_displacement_m"]).all()
    unstable = sweep["unstable"]
    assert unstable.max() == 1.0 and unstable[0] == 0.0 and unstable[-1] == 0.0


def test_an_exact_curve_is_followed_over_the_amplitude_too():
    record = solved(STOP_AMPLITUDE, EXACT)
    assert record.converged, record.status
    assert len(record.summary["turning_points_N"]) == 2
    assert next(iter(record.sweep)) == "amplitude_N"
    assert record.sweep["amplitude_N"][-1] == pytest.approx(0.5, abs=1e-12)


@pytest.mark.parametrize("key, value", [
    ("branches", True), ("motion_at", ["peak"]), ("phases", True), ("subharmonic", 2)])
def test_an_exact_curve_refuses_by_name_what_it_does_not_do(key, value):
    assert f"not with analysis.{key}" in str(refusal(STOP, {f"analysis.{key}": value, **EXACT}))


def expect_points_of(structure, exact, axis):
    """Every bifurcation point of the exact curve is once among the exact points that the ordinary sweep reports.

    Those have motions by phases with an estimated error of at most 1e-6.
    """
    assert rows_of(structure) == rows_of(exact) > 0
    for i, (kind, value) in enumerate(zip(exact["type"], exact[axis])):
        (k,) = [k for k in range(rows_of(structure))
                if structure["type"][k] == kind and abs(structure[axis][k] - value) <= 1e-9 * value]
        if np.isnan(exact["multiplier_real"][i]):
            continue
        assert structure["multiplier_real"][k] == pytest.approx(exact["multiplier_real"][i], abs=1e-6)
        assert abs(structure["multiplier_imag"][k]) == pytest.approx(exact["multiplier_imag"][i], abs=1e-6)
        assert structure["max_displacement_m"][k] == pytest.approx(exact["max_displacement_m"][i], rel=1e-5)


OF_THE_BAR = {"analysis.frequency_from": 1250, "analysis.frequency_to": 1400, "time.functions": 63,
              "time.nyquist": "drop"}


@pytest.mark.parametrize("scene, overrides, axis", [
    (STOP, {"time.functions": 15}, "frequency_Hz"),
    (STOP, {"time.functions": 63}, "frequency_Hz"),
    (STOP_AMPLITUDE, {}, "amplitude_N"),
    (JONES / "case2_sweep.toml", OF_THE_BAR, "frequency_Hz"),
    (SCENES / "laws" / "duffing.toml", {}, "frequency_Hz"),
], ids=["15 functions", "63 functions", "over the amplitude", "bar", "duffing"])
def test_special_points_of_the_structure_are_those_of_an_exact_curve_to_nine_digits(scene, overrides, axis):
    ordinary, exact = solved(scene, overrides), solved(scene, {**overrides, **EXACT})
    assert ordinary.converged and exact.converged
    expect_points_of(ordinary.summary["structure_special_points"], exact.summary["special_points"], axis)
    if scene is STOP:
        folds = where(ordinary.summary["special_points"], type="fold")
        assert set(folds["structure_status"]) == {"found"}
        np.testing.assert_allclose(folds["structure_frequency_Hz"], folds["frequency_Hz"], rtol=0.0, atol=1e-3)


def test_special_points_of_the_structure_stand_once_where_the_samples_make_many_of_them():
    ordinary, exact = solved(ZIGZAG), solved(ZIGZAG, EXACT)
    assert exact.converged
    balance = ordinary.summary["special_points"]
    assert rows_of(balance) > 20
    assert list(balance["structure_status"]).count("repeated") > 10
    expect_points_of(ordinary.summary["structure_special_points"], exact.summary["special_points"], "frequency_Hz")


def test_special_points_of_the_structure_are_not_sought_without_stability():
    assert "structure_special_points" not in solved(STOP, {"analysis.stability": False}).summary
