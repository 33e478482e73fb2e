"""Records of forced responses and ordinary curves: what they hold, and what they warn of."""

import math
import re

import numpy as np
import pytest
from rods_and_bars import matrices_of
from solved_scenes import BAR, BAR_SWEEP, COLUMNS_OF_A_CURVE, FOURIER, JONES, figure_of, folder_of, refusal, solved

import wavebalance

LAWS = {
    "exponential": (BAR["contact"], lambda depth: 1e8 * np.expm1(50.0 * depth)),
    "linear": ({"law": "linear", "stiffness": 1e6, "gap": 1e-3}, lambda depth: 1e6 * depth),
    "none": ({"law": "none"}, np.zeros_like),
}
FREE_BAR = {**BAR, "contact": {"law": "none"}}


def test_load_and_contact_of_a_bar_are_at_its_tip():
    record = solved(FREE_BAR)
    assert (record.summary["degrees_of_freedom"], record.summary["contacts"]) == (25, 1)
    mass, stiffness = matrices_of(BAR["structure"])
    omega = 2.0 * math.pi * 150.0
    load = 250e3 * np.eye(25)[-1]
    motion = np.linalg.solve(stiffness * (1.0 + 1e-4j * omega) - omega**2 * mass, load)
    instants = record.bar_motion.shape[1]
    expected = (motion[:, None] * np.exp(2j * math.pi * np.arange(instants) / instants)).real
    error = 1e-12 * np.abs(expected).max()
    np.testing.assert_allclose(record.bar_motion[1:], expected, rtol=0.0, atol=error)
    assert not record.bar_motion[0].any()
    tip = record.response["displacement_m"]
    np.testing.assert_allclose(tip[:: len(tip) // instants], expected[-1], rtol=0.0, atol=error)


@pytest.mark.parametrize("law", LAWS)
def test_the_contact_force_follows_the_law_of_the_scene(law):
    contact, force = LAWS[law]
    record = solved({**BAR, "contact": contact})
    assert record.converged
    depth = np.maximum(record.response["displacement_m"] - contact.get("gap", 0.0), 0.0)
    assert law == "none" or depth.max() > 0.0
    np.testing.assert_allclose(record.response["contact_force_N"], force(depth), rtol=1e-15, atol=1e-6)


@pytest.mark.parametrize("weight, products", [
    ("daubechies6", "exact"), ("fourier", "quadrature"), ("bspline", "quadrature")])
def test_daubechies_galerkin_alone_takes_connection_coefficients(weight, products):
    trial = "bspline" if weight == "bspline" else "daubechies6"
    record = solved(BAR, {"time.trial": trial, "time.weight": weight})
    assert record.summary["inner_products"] == products
    said = wavebalance.check(BAR, {"time.trial": trial, "time.weight": weight})
    assert ("(connection coefficients)" in said) == (products == "exact")


def test_exact_haar_fourier_sees_inertia_at_the_nyquist_function():
    inertia = np.abs(wavebalance.Pair("haar:fourier", 64, 256, inner_products="exact").symbol(2))
    assert inertia[32] > 1e-3 * inertia[31]


@pytest.mark.parametrize("weight, offset, dropped", [
    ("bspline", 0.0, False), ("bspline", 0.5, True), ("fourier", 0.5, False)])
def test_a_kept_nyquist_coefficient_of_haar_and_bspline_is_zero_at_the_middles(weight, offset, dropped):
    pair = {"time.trial": "haar", "time.weight": weight, "time.sample_offset": offset}
    kept, without = (solved(BAR, {**pair, "time.nyquist": one}).response["displacement_m"] for one in ("keep", "drop"))
    assert np.array_equal(kept, without) == dropped


@pytest.mark.parametrize("name, functions", [("fourie", 8), ("daubechies5", 8), ("haar", 12)])
def test_bases_of_unknown_names_and_sizes_are_refused(name, functions):
    with pytest.raises(ValueError):
        wavebalance.Pair(name, functions)
    assert wavebalance.Pair("fourier", 7).functions == 7


def test_a_forced_response_holds_its_fields_in_order():
    record = solved(BAR)
    assert list(record.summary)[:14] == [
        "converged", "status", "residual", "iterations", "unknowns", "wall_seconds", "solve_seconds",
        "max_displacement_m", "min_displacement_m", "rms_displacement_m", "vibration_m", "rms_vibration_m",
        "max_contact_force_N", "contact_fraction"]
    assert record.converged and record.summary["converged"] is True
    assert record.summary["unknowns"] == 64 and record.summary["residual"] < 1e-10
    assert list(record.response) == ["time_fraction", "displacement_m", "velocity_m_per_s", "contact_force_N"]
    assert len(record.response["time_fraction"]) == 1024
    assert len(figure_of(record)["panels"]) == 3
    assert not record.sweep


def test_a_point_of_a_curve_is_the_forced_response_at_its_frequency():
    curve = solved(BAR, {"analysis.type": "frequency_sweep", "analysis.frequency_from": 150,
                         "analysis.frequency_to": 155, "analysis.stability": False})
    motion, start = solved(BAR).summary, {name: values[0] for name, values in curve.sweep.items()}
    assert start["frequency_Hz"] == motion["frequency_Hz"]
    assert motion["contact_fraction"] > 0.0
    peak, least = motion["max_displacement_m"], motion["min_displacement_m"]
    assert start["max_displacement_m"] == pytest.approx(peak, rel=1e-9)
    assert start["min_displacement_m"] == pytest.approx(least, abs=1e-9 * peak)
    assert start["max_abs_displacement_m"] == pytest.approx(max(peak, -least), abs=1e-9 * peak)
    # A curve has forces at the 256 quadrature points, a motion at the 1024 points of its output.
    assert start["contact_fraction"] == pytest.approx(motion["contact_fraction"], abs=4.0 / 256)
    force = motion["max_contact_force_N"]
    assert 0.95 * force < start["max_contact_force_N"] <= force * (1.0 + 1e-9)
    assert curve.summary["contact_fraction"] == curve.sweep["contact_fraction"].max()
    assert curve.summary["min_displacement_m"] == curve.sweep["min_displacement_m"].min()


def test_the_summary_is_that_of_the_response():
    record = solved(BAR)
    u, force = record.response["displacement_m"], record.response["contact_force_N"]
    assert record.summary["max_displacement_m"] == u.max()
    assert record.summary["min_displacement_m"] == u.min()
    assert record.summary["contact_fraction"] == np.count_nonzero(force > 0.0) / 1024
    assert np.count_nonzero(force > 0.0) == np.count_nonzero(u > 1e-3)


def test_the_velocity_is_the_rate_of_the_displacement():
    record = solved(BAR, {"analysis.output_points": 4096})
    u, v = record.response["displacement_m"], record.response["velocity_m_per_s"]
    # The error of the central difference, h^2/6 u''', with u''' <= (2 pi 32 f)^3 max|u|, is far below 1e-2 max|v|.
    error = v[1:-1] - (u[2:] - u[:-2]) * 4096 * 150 / 2
    assert np.abs(error).max() < 1e-2 * np.abs(v[1:-1]).max()


def test_a_response_without_contact_is_the_linear_one():
    record = solved(FREE_BAR)
    assert record.converged
    assert record.summary["max_contact_force_N"] == 0.0 and record.summary["contact_fraction"] == 0.0
    peak = record.summary["max_displacement_m"]
    assert peak == pytest.approx(1.439e-3, abs=5e-7)  # of case 1 of the paper, found independently to four digits
    assert record.summary["rms_displacement_m"] == pytest.approx(peak / math.sqrt(2.0), abs=1e-5 * peak)


def test_a_sweep_gives_a_curve():
    record = solved(BAR, {"analysis.type": "frequency_sweep", "analysis.frequency_from": 100,
                          "analysis.frequency_to": 200, "analysis.first_step": 20, "analysis.largest_step": 20,
                          "time.functions": 31, "structure.elements": 5})
    assert record.converged, record.status
    assert list(record.sweep) == COLUMNS_OF_A_CURVE
    assert record.sweep["frequency_Hz"][0] == 100.0
    assert not record.response
    assert len(figure_of(record)["panels"]) == 1


def beside_resonance(share, contact=None):
    """An undamped oscillator at its natural frequency, 1 / (2 pi) Hz, and this share above it.

    One element: k = E A / l = 1 and m = rho A l / 3 = 1. The dynamic stiffness k - omega^2 m is twice the share of k.
    """
    return {
        **BAR,
        "structure": {"type": "bar", "youngs_modulus": 1, "density": 3, "area": 1, "length": 1, "elements": 1,
                      "stiffness_damping": 0},
        "contact": contact or {"law": "none"},
        "forcing": {"amplitude": 250e3, "frequency": (1.0 + share) / (2.0 * math.pi)},
        "time": {**FOURIER, "functions": 9, "quadrature_points": 256},
    }


def test_an_undamped_resonance_is_told_by_name():
    record = solved(beside_resonance(0.0, BAR["contact"]))
    assert not record.converged and "singular" in record.status
    assert math.isinf(record.summary["condition_estimate"])
    assert len(record.warnings) == 1
    assert math.isnan(record.summary["max_displacement_m"])


def test_ordinary_conditions_are_without_warning():
    record = solved(BAR)
    assert 1.0 < record.summary["condition_estimate"] < 1e12
    assert record.warnings == [] and record.summary["warnings"] == []
    stepped = solved(BAR, {"analysis.type": "time_stepping"})
    assert math.isnan(stepped.summary["condition_estimate"]) and stepped.warnings == []


def test_rounding_errors_past_1e_6_warn():
    record, ordinary = solved(beside_resonance(1e-11)), solved(beside_resonance(1e-6))
    assert record.converged, record.status
    assert record.summary["rounding_error_estimate"] == pytest.approx(9e-5, abs=1e-5)
    (warning,) = record.warnings
    assert "poor conditioning" in warning
    assert ordinary.summary["rounding_error_estimate"] < 1e-8 and ordinary.warnings == []


def test_rounding_errors_past_a_thousandth_of_the_motion_are_no_response():
    record = solved(beside_resonance(1e-13))
    assert not record.converged
    assert record.status.startswith("inaccurate: ") and "of the motion, more than 1e-03" in record.status
    assert record.summary["status"] == record.status
    assert not record.response  # the last iterate is no motion
    assert math.isnan(record.summary["max_displacement_m"])


def test_a_curve_whose_rounding_errors_pass_a_thousandth_has_not_converged():
    scene = beside_resonance(1e-13)
    start = scene["forcing"]["frequency"]
    analysis = {"type": "frequency_sweep", "frequency_from": start, "frequency_to": 2.0 * start,
                "largest_step": 0.1 * start, "first_step": 0.01 * start}
    record = solved({**scene, "analysis": analysis})
    assert not record.converged and record.status.startswith("inaccurate: ")


def test_a_motion_far_from_the_load_in_a_weakly_coupled_structure_is_accurate():
    """Ten equal oscillators in a ring; the load is five from the contact, whose modal sum cancels all digits."""
    beside = np.roll(np.eye(10), 1, axis=0)
    stiffness = (1e4 + 2.0) * np.eye(10) - beside - beside.T
    omega, load = 80.0, 1e18 * np.eye(10)[5]
    record = solved({
        "structure": {"type": "matrices", "mass": np.eye(10), "damping": 0.5 * np.eye(10), "stiffness": stiffness,
                      "contact_dofs": [1]},
        "contact": {"law": "none"},
        "forcing": {"load": load, "amplitude": 1.0, "frequency": omega / (2.0 * math.pi)},
        "time": {**FOURIER, "functions": 9, "quadrature_points": 256},
    })
    expected = abs(np.linalg.solve(stiffness + (0.5j * omega - omega**2) * np.eye(10), load)[0])
    assert record.converged, record.status
    assert np.abs(record.response["displacement_m"]).max() == pytest.approx(expected, rel=1e-3)
    assert record.summary["rounding_error_estimate"] < 1e-11


def test_conditions_past_1e12_warn():
    record = solved(beside_resonance(9e-13))
    assert record.converged, record.status
    assert record.summary["condition_estimate"] == pytest.approx(1.11e12, abs=1e10)
    assert len(record.warnings) == 2  # of the rounding error too
    assert record.warnings == record.summary["warnings"] and "past 10¹²" in record.warnings[0]
    assert '"warnings": [\n    "the condition' in (folder_of(record) / "summary.json").read_text()


def test_a_curve_has_the_largest_condition_of_its_points():
    near, far = (solved(BAR, {**BAR_SWEEP, "analysis.stability": False, "analysis.frequency_to": end}).summary
                 ["condition_estimate"] for end in (110, 200))
    assert 1.0 <= near <= far


def test_a_motion_that_has_not_converged_is_drawn_as_such():
    record = solved(BAR, {"analysis.type": "time_stepping", "analysis.max_periods": 1})
    figure = figure_of(record)
    assert not record.converged and "NOT CONVERGED" in figure["title"]
    assert figure["panels"][0]["series"][0]["colour"] == "#777777"  # grey


def test_a_rigid_curve_passes_folds_and_says_its_form():
    balance = {"time.trial": "fourier", "time.weight": "fourier", "time.functions": 63, "time.quadrature_points": 512}
    record = solved(JONES / "case2_sweep_rigid.toml", {**balance, "analysis.largest_step": 10})
    assert record.status == "reached_end" and record.summary["form"] == "force"
    first, second = record.summary["turning_points_Hz"]  # found independently
    assert first == pytest.approx(1331.0, abs=0.2) and second == pytest.approx(1314.839, abs=0.02)
    assert record.summary["max_contact_force_N"] > 0.0


def test_a_curve_says_at_which_frequency_it_is_largest():
    record = solved(BAR, {**BAR_SWEEP, "analysis.stability": False})
    highest = record.sweep["max_displacement_m"].argmax()
    assert record.summary["frequency_at_max_displacement_Hz"] == record.sweep["frequency_Hz"][highest]


def test_a_record_says_that_no_contact_closes_and_that_no_load_acts():
    open_contact, unloaded = solved(BAR, {"contact.gap": 5}), solved(BAR, {"forcing.amplitude": 0})
    assert open_contact.converged
    (warning,) = open_contact.warnings
    assert warning.startswith("No contact closes: the nearest stays ") and " short of its gap of 5 m." in warning
    assert solved(BAR).warnings == []
    assert unloaded.warnings[0].startswith("No load acts")


@pytest.mark.parametrize("part", ["25 elements", "64 unknowns", "1600 before", "admissible", "1273 Hz"])
def test_check_says_how_large_and_whether_admissible(part):
    assert part in wavebalance.check(BAR)


def test_a_pair_that_is_not_admissible_is_refused():
    assert "not an admissible trial basis" in str(refusal(BAR, {"time.trial": "haar", "time.weight": "haar"}))


def test_check_says_what_a_curve_costs_and_for_its_stability_a_range():
    (cost,) = [line for line in wavebalance.check(BAR, {**BAR_SWEEP, "analysis.frequency_to": 200}).splitlines()
               if line.startswith("cost")]
    found = re.search(r"s for the curve, (\d+) (.?)s to (\d+) (.?)s for its stability, and \d+ MB of memory$", cost)
    seconds = {"": 1.0, "m": 1e-3, "µ": 1e-6}
    assert found and 0.0 < float(found[1]) * seconds[found[2]] < float(found[3]) * seconds[found[4]]
    without = wavebalance.check(BAR, {**BAR_SWEEP, "analysis.stability": False})
    assert re.search(r"cost +about \d+ .?s and \d+ MB of memory$", without, re.MULTILINE)
