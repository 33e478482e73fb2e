"""Exact solutions instead of a balance: time.method = "exact", and small tolerances."""

import tomllib

import numpy as np
import pytest
from period_oracle import RigidTip
from rods_and_bars import matrices_of
from solved_scenes import (
    BALANCE_KEYS,
    BAR,
    CHAIN,
    JONES,
    LOSS_FACTOR,
    SIZES,
    refusal,
    relative_rms_error,
    rows_of,
    solved,
)

import wavebalance

PHASES = {"time.method": "exact"}
RIGID_BAR = JONES / "case1_rigid.toml"
ALL_BALANCE_KEYS = (*BALANCE_KEYS, "time.formulation", "time.inner_products")


def by_collocation(**more):
    """The bar by collocation; keys of the section time are given by their names."""
    return solved(BAR, {**PHASES, **{f"time.{key}": value for key, value in more.items()}}, BALANCE_KEYS)


def tip(record):
    return record.response["displacement_m"]


def test_the_motion_by_exact_solutions_is_that_to_which_fine_balances_tend():
    collocated = by_collocation()
    assert collocated.converged, collocated.status
    before = 1.0
    for functions in (63, 255, 1023):
        balance = solved(BAR, {"time.functions": functions, "time.quadrature_points": 8192})
        assert balance.converged
        error = relative_rms_error(tip(balance), tip(collocated))
        assert error < 0.2 * before
        before = error
    assert before < 1e-5


def test_the_motion_by_exact_solutions_is_that_at_which_time_stepping_arrives():
    collocated, stepped = by_collocation(), solved(BAR, {"analysis.type": "time_stepping"})
    assert collocated.converged and stepped.converged
    assert relative_rms_error(tip(collocated), tip(stepped)) < 1e-4


@pytest.mark.parametrize("tolerance", [1e-4, 1e-7, 1e-10])
def test_exact_solutions_meet_their_tolerance_and_say_from_where_they_started(tolerance):
    exact, record = by_collocation(tolerance=1e-12), by_collocation(tolerance=tolerance)
    summary = record.summary
    assert exact.converged and record.converged, record.status
    assert summary["phases_estimated_error"] <= tolerance and summary["tolerance"] == tolerance
    assert relative_rms_error(tip(record), tip(exact)) < tolerance
    assert summary["strategy"] == "from_balance" and summary["start_functions"] == 63
    assert rows_of(summary["phases"]) == 1
    assert (summary["stability"], summary["stability_by"]) == ("stable", "phases")
    assert "functions" not in summary
    assert summary["structure_left_out"] <= 1.001e-4
    assert record.bar_motion.shape[0] == 26


def test_exact_solutions_take_a_rigid_obstacle_at_a_tip_without_mass():
    record = solved(RIGID_BAR, PHASES, ALL_BALANCE_KEYS)
    assert record.converged, record.status
    assert record.summary["max_penetration_m"] < 1e-9 * 1e-3  # of the gap
    assert record.summary["min_contact_force_N"] > -1e-6 * record.summary["max_contact_force_N"]


@pytest.mark.parametrize("gap", [3e-4, 1e-4, 3e-5])
def test_exact_solutions_divide_the_panels_of_long_contact(gap):
    """One panel of many nodes loses its digits over half a period of a bar with fast modes."""
    record = solved(RIGID_BAR, {**PHASES, "time.tolerance": 1e-12, "forcing.frequency": 90, "contact.gap": gap},
                    ALL_BALANCE_KEYS)
    assert record.converged, record.status
    mass, stiffness = matrices_of(BAR["structure"])
    mass[-2, -2] += mass[-1, -1] + 2.0 * mass[-1, -2]  # the tip's mass is its neighbour's
    mass[-1], mass[:, -1] = 0.0, 0.0
    joined = RigidTip(mass, 1e-4 * stiffness, stiffness, 250e3, gap, 90.0).displacement()
    assert relative_rms_error(tip(record), joined) < 1e-7


def test_exact_solutions_name_why_they_do_not_apply_and_write_no_motion():
    record = solved(BAR, {**PHASES, **LOSS_FACTOR}, BALANCE_KEYS)
    assert not record.converged and record.status == "structural_damping"
    assert not record.response


def test_a_scene_of_exact_solutions_comes_back_as_it_is_written():
    overrides = {**PHASES, "time.tolerance": 1e-11}
    written = wavebalance.complete(BAR, overrides, unset=BALANCE_KEYS)
    assert wavebalance.complete(written) == written
    assert tomllib.loads(written)["time"] == {"method": "exact", "tolerance": 1e-11}
    assert "exact periodic solution to a relative error of 10⁻¹¹" in wavebalance.check(BAR, overrides, unset=BALANCE_KEYS)


@pytest.mark.parametrize("key, value", [
    ("time.trial", "fourier"), ("time.weight", "haar"), ("time.functions", 63), ("time.quadrature_points", 256),
    ("time.formulation", "weak"), ("time.inner_products", "exact"), ("time.nyquist", "keep"),
    ("time.sample_offset", 0.5), ("contact.form", "force"), ("analysis.phases", True), ("analysis.subharmonic", 2)])
def test_exact_solutions_refuse_the_keys_of_a_balance_by_name(key, value):
    unset = tuple(one for one in BALANCE_KEYS if one != key)
    error = refusal(BAR, {**PHASES, key: value}, unset)
    assert error.key == key and "time.method" in str(error)


@pytest.mark.parametrize("overrides, unset", [
    ({**PHASES, "time.tolerance": 1e-14}, BALANCE_KEYS),
    ({**PHASES, "time.tolerance": 0}, BALANCE_KEYS),
    ({**PHASES, "analysis.type": "time_stepping"}, ()),
    ({"time.tolerance": 9e-14}, SIZES),
])
def test_tolerances_out_of_range_and_exact_solutions_of_time_stepping_are_refused(overrides, unset):
    refusal(BAR, overrides, unset)
    assert wavebalance.check(BAR, {"time.tolerance": 1e-13}, unset=SIZES)


@pytest.mark.parametrize("tolerance", [1e-7, 1e-9, 1e-11])
def test_small_tolerances_are_met_by_exact_solutions_from_a_coarse_balance(tolerance):
    record = solved(BAR, {"time.tolerance": tolerance}, SIZES)
    assert record.converged, record.status
    assert record.summary["solved_by"] == "exact" and record.summary["start_functions"] == 63
    assert record.summary["estimated_error"] <= tolerance
    assert relative_rms_error(tip(record), tip(by_collocation(tolerance=1e-12))) < tolerance


@pytest.mark.parametrize("overrides, trial", [
    ({"time.tolerance": 1e-6}, "fourier"),
    ({"time.tolerance": 5e-7, **LOSS_FACTOR}, "fourier"),
    ({"time.tolerance": 5e-7, "time.trial": "bspline", "time.weight": "bspline"}, "bspline"),
], ids=["large", "loss factor", "named bases"])
def test_a_refined_balance_meets_tolerances_where_exact_solutions_do_not_apply_and_in_bases_that_are_named(overrides, trial):
    record = solved(BAR, overrides, SIZES)
    assert record.converged, record.status
    assert record.summary["solved_by"] == "balance" and record.summary["trial"] == trial
    assert rows_of(record.summary["ladder"]) > 0


def test_a_small_tolerance_has_a_picture_where_the_scene_names_no_basis():
    record = solved(BAR, {"time.tolerance": 1e-8}, BALANCE_KEYS)
    assert record.converged, record.status
    assert record.summary["solved_by"] == "exact"
    assert "<svg" in record.svg()


def test_a_small_tolerance_is_met_with_several_contacts():
    record = solved(CHAIN, {"time.tolerance": 1e-10}, ("time.functions",))
    assert record.converged, record.status
    assert record.summary["solved_by"] == "exact" and record.summary["phases_estimated_error"] <= 1e-10


def test_exact_solutions_take_several_contacts():
    collocated = solved(CHAIN, PHASES, ("time.trial", "time.weight", "time.functions"))
    balance = solved(CHAIN, {"time.functions": 1023, "time.quadrature_points": 4096})
    assert collocated.converged and balance.converged, collocated.status
    assert set(collocated.contacts["contact"]) == {1, 2}
    np.testing.assert_array_equal(collocated.contacts["contact"], balance.contacts["contact"])
    assert relative_rms_error(collocated.contacts["displacement_m"], balance.contacts["displacement_m"]) < 1e-4
