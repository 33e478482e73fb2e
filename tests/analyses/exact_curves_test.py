"""Curves of the structure's own motions, analysis.exact, and the special points of the structure of ordinary curves."""

import numpy as np
import pytest
import wavebalance as wb
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


def bumper(damping=100.0, **analysis):
    """5 kg at 12 Hz on 1 g between stops of a spring and a dashpot, whose force jumps where they are met with a velocity."""
    mass, stiffness = 5.0, 5.0 * (24.0 * np.pi) ** 2
    return {
        "structure": {"type": "matrices", "mass": np.array([[mass]]), "stiffness": np.array([[stiffness]]),
                      "damping": np.array([[0.1 * np.sqrt(stiffness * mass)]])},
        "contact": {"law": "kelvin_voigt", "stiffness": 2.5e5, "damping": damping, "gap": 6e-3, "pairs": [{"dofs": [1], "side": "both"}]},
        "forcing": {"frequency": 15.0, "terms": [{"kind": "base_acceleration", "dofs": [1], "amplitude": 9.81}]},
        "analysis": {"type": "frequency_sweep", "exact": True, **analysis},
    }


def swept(scene, frequencies, periods=60, steps=400):
    """The largest displacement in the last period at each frequency, from the last state before, by Runge-Kutta steps."""
    (mass,), (stiffness,), (damping,) = (np.ravel(scene["structure"][name]) for name in ("mass", "stiffness", "damping"))
    stop = scene["contact"]
    u, v, largest = 0.0, 0.0, []

    def push(d, v):
        return max(stop["stiffness"] * d + stop["damping"] * v, 0.0) if d > 0.0 else 0.0

    for frequency in frequencies:
        w, h = 2.0 * np.pi * frequency, 1.0 / frequency / steps

        def rate(t, u, v):
            force = push(u - stop["gap"], v) - push(-u - stop["gap"], -v)
            return v, (-9.81 * mass * np.cos(w * t) - damping * v - stiffness * u - force) / mass

        largest.append(-np.inf)
        for k in range(periods * steps):
            a = rate(k * h, u, v)
            b = rate((k + 0.5) * h, u + 0.5 * h * a[0], v + 0.5 * h * a[1])
            c = rate((k + 0.5) * h, u + 0.5 * h * b[0], v + 0.5 * h * b[1])
            d = rate((k + 1) * h, u + h * c[0], v + h * c[1])
            u, v = u + h / 6.0 * (a[0] + 2.0 * b[0] + 2.0 * c[0] + d[0]), v + h / 6.0 * (a[1] + 2.0 * b[1] + 2.0 * c[1] + d[1])
            if k >= (periods - 1) * steps:
                largest[-1] = max(largest[-1], u)
    return largest


def test_an_exact_curve_passes_the_contact_of_a_dashpot_whose_force_jumps():
    scene = bumper(frequency_from=5.0, frequency_to=40.0)
    record = wb.run(scene)
    assert record.converged, record.status
    points = record.summary["special_points"]
    upper, lower = sorted(where(points, type="fold")["frequency_Hz"])[::-1]
    # Grazing of the linear oscillator.
    mass, stiffness = 5.0, 5.0 * (24.0 * np.pi) ** 2
    for frequency in set(where(points, type="grazing")["frequency_Hz"]):
        w = 2.0 * np.pi * frequency
        assert 9.81 * mass / abs(stiffness - mass * w**2 + 1j * w * 0.1 * np.sqrt(stiffness * mass)) == pytest.approx(6e-3, rel=1e-8)
    largest = swept(scene, [14.0, 16.0, 17.0, 17.4, 17.7, upper - 0.05, upper + 0.1])
    assert largest[-2] > 6e-3 > largest[-1]
    back = swept(scene, [20.0, 16.0, 14.5, 14.0, 13.7, lower + 0.05, lower - 0.1])
    assert back[-2] < 6e-3 < back[-1]


def test_an_exact_curve_without_a_dashpot_has_the_folds_of_the_spring_alone():
    frequencies = {"frequency_from": 5.0, "frequency_to": 40.0}
    elastic = bumper(**frequencies)
    elastic["contact"] = {"law": "clearance", "stiffness": 2.5e5, "gap": 6e-3, "pairs": [{"dofs": [1]}]}
    weak = wb.run(bumper(damping=1e-6, **frequencies))
    assert weak.converged
    assert weak.summary["turning_points_Hz"] == pytest.approx(wb.run(elastic).summary["turning_points_Hz"], rel=1e-6)
