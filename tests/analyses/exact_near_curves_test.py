"""Exact solutions near points of a curve in its record."""

import numpy as np
import pytest
from solved_scenes import (
    FOURIER,
    JONES,
    LOSS_FACTOR,
    SCENES,
    STOP,
    STOP_AMPLITUDE,
    STOP_RESPONSE,
    TWO_MASSES,
    rows_of,
    solved,
)

PHASES = {"analysis.phases": True}
# At a fold a motion at its frequency is as uncertain as the root of its equations' error.
WITH_ERRORS = {"converged", "converged_beside", "tolerance_missed"}
# Up to a frequency below the folds, at which the curve is highest.
LOW = {"time.functions": 31, "analysis.frequency_to": 0.168}
# Three masses between stops of 14 to 141 kN/m that touch for a few per cent of the period.
THREE_MASSES = {
    "structure": {
        "type": "matrices", "mass": np.diag([1.2877028452601675, 1.8445934785249525, 1.0842696832647172]),
        "stiffness": np.array([[3950.5547299417126, -2670.645518305771, 0.0],
                               [-2670.645518305771, 4985.2918624310969, -2314.6463441253254],
                               [0.0, -2314.6463441253254, 2314.6463441253254]]),
        "damping": np.array([[3.9665853684625745, -1.7282177563625007, -0.28433599184748792],
                             [-1.7282177563625007, 4.8267707866039817, -1.6811063760824079],
                             [-0.28433599184748792, -1.6811063760824079, 2.6662432479887506]])},
    "contact": {"law": "clearance", "stiffness": 1.0, "gap": 0.0, "pairs": [
        {"dofs": [1], "coefficients": [-1.0], "stiffness": 141142.30477585082, "gap": 9.747021996955785e-05,
         "stiffness_below": 13738.43640600048, "gap_below": 0.0003557793476694954},
        {"dofs": [2], "coefficients": [-1.0], "stiffness": 60026.75970528996, "gap": 0.0001861640154736735,
         "stiffness_below": 24896.188958470753, "gap_below": 0.00014785866233082734}]},
    "forcing": {"load_dofs": [1], "amplitude": 0.07400215130981587},
    "time": {**FOURIER, "functions": 63, "quadrature_points": 512},
    "analysis": {"type": "frequency_sweep", "frequency_from": 1.0, "frequency_to": 2.0},
}


def between(begin, end, **more):
    return {"analysis.frequency_from": begin, "analysis.frequency_to": end,
            **{f"analysis.{key}": value for key, value in more.items()}}


def test_a_curve_has_the_errors_of_a_forced_response_at_its_peak():
    curve = solved(STOP, LOW)
    assert curve.converged and curve.summary["phases_status"] == "converged"
    peak = curve.summary["frequency_at_max_displacement_Hz"]
    response = solved(STOP_RESPONSE, {**PHASES, "time.functions": 31, "forcing.frequency": peak})
    for error in ("error_of_displacement", "error_of_force"):
        assert response.summary[error] > 1e-6
        assert curve.summary[error] == pytest.approx(response.summary[error], rel=0.02)
    assert "phases_status" not in curve.sweep


def test_errors_at_special_points_are_smaller_with_more_functions():
    worst = []
    for functions in (31, 127):
        points = solved(STOP, {"time.functions": functions}).summary["special_points"]
        assert rows_of(points) >= 2 and set(points["phases_status"]) <= WITH_ERRORS
        worst.append(np.nanmax(points["error_of_displacement"]))
    assert worst[0] > 0.0 and 0.0 < worst[1] < 0.3 * worst[0]


def test_exact_solutions_correct_the_counts_of_the_balance():
    """At the first point all multipliers of the structure lie inside the circle."""
    balance, exact = (solved(TWO_MASSES, between(14.77656632196452, 14.7768, type="frequency_sweep", phases=one)).sweep
                       for one in (False, True))
    assert rows_of(exact) == rows_of(balance) > 0
    assert balance["unstable"][0] == 1.0 and exact["unstable"][0] == 0.0
    assert exact["stability_by"][0] == "phases" and exact["phases_status"][0] == "converged"
    none = np.array(exact["phases_status"]) == "not_found"
    np.testing.assert_array_equal(np.isnan(exact["unstable"]), none)
    np.testing.assert_array_equal(exact["stability_by"], np.where(none, "none", "phases"))


@pytest.mark.parametrize("begin, end, count", [(2.124, 2.1241, 0.0), (2.29704, 2.29714, 1.0)])
def test_exact_solutions_correct_the_counts_of_short_contacts(begin, end, count):
    """Newton's method on the map of the period and variational equations give these counts, the balance one more."""
    balance, exact = (solved(THREE_MASSES, between(begin, end, **more)) for more in ({}, {"phases": True}))
    assert balance.converged and exact.converged
    assert balance.sweep["unstable"][0] == count + 1.0
    assert exact.sweep["unstable"][0] == count and exact.sweep["stability_by"][0] == "phases"


def test_a_curve_sums_up_the_errors_of_all_points():
    record = solved(STOP, {**LOW, **PHASES})
    assert record.converged
    assert record.summary["largest_error_of_displacement"] == np.nanmax(record.sweep["error_of_displacement"])
    assert record.summary["points_phases_converged"] == rows_of(record.sweep)
    assert record.summary["points_not_found"] == 0 and record.summary["points_phases_not_known"] == 0


def test_exact_solutions_of_a_curve_need_no_stability():
    without = {**LOW, "analysis.stability": False}
    record = solved(STOP, {**without, **PHASES})
    assert record.converged and "stability_by" not in record.sweep
    assert record.sweep["phases_status"][0] == "converged"
    assert "phases_status" not in solved(STOP, without).summary


def test_exact_solutions_are_those_of_a_curve_over_the_amplitude_too():
    record = solved(STOP_AMPLITUDE, {**PHASES, "time.functions": 31})
    assert record.converged and record.summary["phases_status"] in WITH_ERRORS
    errors, highest = record.sweep["error_of_displacement"], record.sweep["max_displacement_m"]
    known = ~np.isnan(errors)
    assert known.any() and (errors < np.where(highest < 1.0, 1e-9, 0.01))[known].all()


def test_exact_solutions_are_those_of_branches_too():
    """A branch of two periods has its own functions and points."""
    record = solved(SCENES / "cases_of_others" / "oscillator_with_stop.toml", PHASES)
    assert "branches" in record.summary
    doubled = record.sweep["period"] >= 2.0
    assert np.count_nonzero(doubled) > 10
    converged = doubled & (np.array(record.sweep["phases_status"]) == "converged")
    assert (record.sweep["error_of_displacement"][converged] < 0.05).all()
    assert record.summary["points_phases_converged"] > int(0.9 * rows_of(record.sweep))


def test_a_curve_names_why_exact_solutions_are_not_known():
    record = solved(JONES / "case2_sweep.toml", {**PHASES, **LOSS_FACTOR, **between(1225, 1235)})
    assert record.summary["phases_status"] == "structural_damping"
    assert np.isnan(record.summary["error_of_displacement"])
    assert record.summary["points_phases_not_known"] == rows_of(record.sweep) > 0
    assert set(record.sweep["phases_status"]) == {"structural_damping"}
    assert set(record.sweep["stability_by"]) == {"balance"}


def test_exact_solutions_are_known_against_a_rigid_obstacle_at_a_tip_without_mass():
    record = solved(JONES / "case2_sweep_rigid.toml", {**PHASES, **between(1225, 1235)})
    assert record.summary["phases_status"] == "converged" and record.summary["error_of_displacement"] < 1e-2
    converged = np.array(record.sweep["phases_status"]) == "converged"
    assert set(np.array(record.sweep["stability_by"])[converged]) == {"phases"}
    assert (record.sweep["unstable"][converged] >= 0.0).all()
