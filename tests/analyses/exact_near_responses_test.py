"""The exact solution near a response, analysis.phases: instants of contact, errors and stability."""

import numpy as np
import pytest
from solved_scenes import BAR, JONES, LOSS_FACTOR, SCENES, TWO_MASSES, folder_of, refusal, rows_of, solved

PHASES = {"analysis.phases": True}
# A nonlinear mode.
ROD = {
    "structure": {"type": "bar", "youngs_modulus": 2.1e11, "density": 7800.0, "area": 9e-4, "length": 1.0,
                  "elements": 20, "lumped_mass_fraction": 0.5},
    "contact": {"law": "rigid", "gap": 1e-3},
    "analysis": {"type": "nonlinear_mode", "points": 200},
}


def test_exact_solutions_hold_the_instants_of_contact_and_the_errors_of_the_response():
    coarse, fine = (solved(BAR, {**PHASES, "time.functions": functions, "time.quadrature_points": points})
                    for functions, points in ((31, 128), (255, 1024)))
    assert coarse.converged and fine.converged
    assert coarse.summary["phases_status"] == "converged"
    assert coarse.summary["error_of_displacement"] > 10.0 * fine.summary["error_of_displacement"]
    assert coarse.summary["error_of_force"] > fine.summary["error_of_force"]
    exact, same = coarse.summary["phases"], fine.summary["phases"]
    assert rows_of(exact) == rows_of(same) > 0
    for end in ("begin", "end"):
        np.testing.assert_allclose(exact[end], same[end], rtol=0.0, atol=1e-8)


def test_exact_solutions_have_the_stability_that_the_record_names():
    summary = solved(BAR, PHASES).summary
    assert (summary["stability"], summary["stability_by"]) == ("stable", "phases")


@pytest.fixture(scope="module")
def two_masses():
    """Records of two masses with short contacts: one motion is an attractor, and the others start from it."""
    settled = solved(TWO_MASSES, {"time.functions": 127})
    start = folder_of(settled) / "contacts.csv"

    def near(functions, points, exact):
        overrides = {"time.functions": functions, "time.quadrature_points": points, "analysis.phases": exact}
        return solved(TWO_MASSES, overrides, start_from=start)

    return {"settled": settled, "near": near(63, 512, True), "coarse": near(63, 512, False),
            "fine": near(1023, 8192, False)}


@pytest.mark.parametrize("name", ["settled", "near"])
def test_exact_solutions_have_the_stability_of_the_structure_where_that_of_the_balance_is_another(two_masses, name):
    fine, found = two_masses["fine"], two_masses[name].summary
    assert fine.converged and two_masses[name].converged, fine.status
    assert two_masses["coarse"].summary["stability"] == "unstable"
    assert found["phases_status"] == "converged" and rows_of(found["phases"]) == 5
    assert found["stability"] == "stable"
    for part in ("leading_multiplier_real", "leading_multiplier_imag"):
        assert found[part] == pytest.approx(fine.summary[part], abs=1e-4)


def test_exact_solutions_name_why_they_are_not_known():
    record = solved(BAR, {**PHASES, **LOSS_FACTOR})
    assert record.converged, record.status
    assert record.summary["phases_status"] == "structural_damping" and record.summary["stability_by"] == "balance"
    assert rows_of(record.summary["phases"]) == 0


def test_exact_solutions_are_those_of_a_rigid_obstacle_at_a_tip_without_mass():
    record = solved(JONES / "case1_rigid.toml", PHASES)
    assert record.converged, record.status
    assert record.summary["phases_status"] == "converged" and record.summary["error_of_displacement"] < 1e-2
    assert rows_of(record.summary["phases"]) == 1


def test_exact_solutions_are_there_unless_the_scene_turns_them_off():
    usual, without = solved(BAR), solved(BAR, {"analysis.phases": False})
    assert usual.converged and without.converged
    assert usual.summary["phases_status"] == "converged" and usual.summary["stability_by"] == "phases"
    assert usual.summary["error_of_displacement"] > 0.0
    assert not {"phases_status", "phases", "error_of_displacement", "stability_by"} & set(without.summary)


def test_exact_solutions_are_not_sought_without_contact():
    record = solved({**BAR, "contact": {"law": "none"}})
    assert record.converged and "phases_status" not in record.summary


def test_exact_solutions_tell_the_error_up_to_their_own():
    """A contact a million times as stiff as the bar strikes some 1700 times in a period: rounding decides what is found."""
    record = solved(SCENES / "extremes" / "found_stiff.toml")
    assert record.converged, record.status
    if record.summary["phases_status"] == "not_found":
        assert np.isnan(record.summary["error_of_displacement"]) and record.summary["stability"] == "not_found"
        return
    assert record.summary["phases_status"] == "tolerance_missed" and record.summary["phases_estimated_error"] < 1e-5
    assert record.summary["error_of_displacement"] == pytest.approx(0.0190883, abs=1e-5)
    assert record.summary["stability_by"] == "balance"


def test_exact_solutions_of_many_contacts_are_found():
    """Event-driven integration resolves motions that collocation panels do not."""
    record = solved(SCENES / "matrices" / "cantilevers.toml")
    assert record.converged, record.status
    assert record.summary["phases_status"] == "converged" and record.summary["stability_by"] == "phases"
    assert record.summary["error_of_displacement"] < 0.1


def test_exact_solutions_are_refused_for_modes():
    assert refusal(ROD, PHASES).key == "analysis.phases"
