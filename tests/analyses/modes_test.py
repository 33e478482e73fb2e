"""Nonlinear modes of a rod with a rigid obstacle."""

import numpy as np
import pytest
import scipy.io
import wavebalance as wb
from rods_and_bars import ROD, figure_of, matrices_of, warns


@pytest.fixture(scope="module")
def backbone():
    """The record of the rod's first mode over its energy."""
    return wb.run(ROD)


def test_the_linear_frequency_is_that_of_the_paper():
    consistent = {"structure.lumped_mass_fraction": 0.0, "analysis.energy_ratio": 0.5}
    records = [wb.run(ROD, {**consistent, "analysis.mode": mode}) for mode in (1, 2)]
    first, second = (record.summary["linear_frequency_Hz"] for record in records)
    assert first == pytest.approx(1297.5197, abs=1e-4)  # found independently
    assert (second / first)**2 == pytest.approx(3.00617**2, abs=1e-4)


# By d'Alembert's formula: ExactBarMode of reproduce/laxalde_legrand_2010/modes, with the energy of LL10.
@pytest.mark.parametrize("energy, exact", [(1.8, 1.1025577713), (3.0, 1.1539553372), (5.0, 1.1946476340),
                                           (10.0, 1.2358187757)])
def test_the_mode_follows_the_exact_one_within_one_percent_off_internal_resonances(energy, exact):
    motion = wb.run(ROD, {"analysis.energy_ratio": energy})
    assert motion.status == "converged"
    assert motion.summary["frequency_ratio"] == pytest.approx(exact, rel=0.01)


def test_the_equation_of_motion_holds_at_every_accepted_point(backbone):
    table = backbone.backbone
    curve = np.array(table["status"]) == "converged"
    assert np.count_nonzero(curve) == backbone.summary["points_converged"] > 100
    assert np.all(table["residual"][curve] < 1e-9)
    assert np.all(table["virial_residual"][curve] < 1e-12)


def test_samples_are_the_motion(tmp_path):
    mass, stiffness = matrices_of(ROD["structure"])
    structure = {"type": "matrices", "mass": mass, "stiffness": stiffness, "contact_dofs": [20]}
    analysis = {**ROD["analysis"], "energy_ratio": 1.8, "motion_points": 1024}
    record = wb.run({"structure": structure, "contact": ROD["contact"], "analysis": analysis}, output=tmp_path / "out")
    everything, tip = np.asarray(scipy.io.mmread(tmp_path / "out" / "motion.mtx")), record.response["displacement_m"]
    assert everything.shape == (20, 1024)
    assert np.abs(everything[19] - tip).max() < 1e-12 * np.abs(tip).max()
    assert tip.max() == pytest.approx(1e-3 * (1.0 + record.summary["max_penetration_over_gap"]), abs=1e-6)
    # A central difference of a motion with 10 harmonics: its error is (2 pi 10/1024)^2/6 of the tenth at most.
    difference = 1024.0 * record.summary["frequency_Hz"] / 2.0 * (tip[2:] - tip[:-2])
    velocity = record.response["velocity_m_per_s"]
    assert np.abs(velocity[1:-1] - difference).max() <= 1e-3 * np.abs(velocity).max()
    of_rod = wb.run(ROD, {"analysis.energy_ratio": 1.8}).response["displacement_m"]
    assert of_rod == pytest.approx(tip, abs=1e-9 * tip.max())


def test_the_mode_does_not_depend_on_the_gap():
    near, far = (wb.run(ROD, {"analysis.energy_ratio": 3.0, "contact.gap": gap}).summary for gap in (1e-3, 0.5))
    assert far["frequency_ratio"] == pytest.approx(near["frequency_ratio"], abs=1e-6)


def test_a_curve_that_internal_resonances_interrupt_has_converged(backbone):
    assert backbone.converged and backbone.status == "converged"
    assert backbone.summary["interruptions"] == 3 and len(backbone.summary["tongues"]) >= 3


def test_a_curve_that_fails_on_no_internal_resonance_has_not_converged():
    record = wb.run(ROD, {"analysis.harmonics": 12, "analysis.samples": 24, "analysis.points": 100})
    assert not record.converged
    table = record.backbone
    failed = [ratio for ratio, status in zip(table["frequency_ratio"], table["status"]) if status == "cycling"]
    assert record.status.startswith("cycling at frequency ratio 1.200333"), record.status
    assert any(f"{ratio:.6f}" == "1.200333" for ratio in failed)


def test_a_curve_without_a_motion_off_internal_resonances_has_not_converged():
    structure = {"type": "matrices", "mass": np.eye(2), "stiffness": np.diag([1.0, 9.0])}
    contact = {"law": "rigid", "gap": 1e-4, "pairs": [{"dofs": [1, 2], "coefficients": [0.6, 0.8]}]}
    analysis = {"type": "nonlinear_mode", "points": 2, "last_frequency_ratio": 1.002}
    record = wb.run({"structure": structure, "contact": contact, "analysis": analysis})
    assert not record.converged and record.status == "no motion with contact was found"


def test_a_curve_that_ends_before_its_energy_has_not_converged_and_says_where_it_ends(tmp_path):
    # Few points of the second mode lie on no internal resonance, none beyond 1.04 times its linear frequency.
    record = wb.run(ROD, {"analysis.mode": 2})
    assert not record.converged
    assert "ended at frequency ratio 1.0" in record.status
    assert "before the energy ratio 10 asked for: beyond it is the internal resonance" in record.status
    assert "INCOMPLETE" in figure_of(record, tmp_path, "backbone")["title"]


def test_a_curve_below_its_energy_at_the_last_frequency_has_converged_and_says_so():
    record = wb.run(ROD, {"analysis.last_frequency_ratio": 1.05, "analysis.points": 50})
    assert record.converged and not record.warnings
    assert "ended at frequency ratio 1.0500" in record.status
    assert "last_frequency_ratio is reached" in record.status


# Some points of the rod cycle with 40 samples for 15 harmonics, near internal resonances.
def test_points_without_a_motion_are_a_warning_with_their_number_and_places():
    record = wb.run(ROD, {"analysis.harmonics": 15, "analysis.samples": 40, "analysis.points": 100})
    failed = sum(record.summary[f"points_{kind}"] for kind in ("cycling", "no_contact", "singular"))
    assert failed > 0
    points = record.summary["points"]
    assert warns(record, f"{failed} of {points} points of the branch no motion was found"), record.warnings
    assert warns(record, f"{record.summary['points_cycling']} cycling")
    assert warns(record, "at frequency ratios 1.")
    assert record.summary["warnings"] == record.warnings


def test_the_curve_holds_the_linear_branch_and_contact(backbone):
    assert backbone.converged, backbone.status
    table, status = backbone.backbone, np.array(backbone.backbone["status"])
    assert table["energy_ratio"][0] == 0.0
    assert table["frequency_ratio"][status == "linear"] == pytest.approx(1.0, rel=4e-16)
    on_curve = status == "converged"
    assert np.all(table["rayleigh_frequency_ratio"][on_curve] <= table["frequency_ratio"][on_curve])
    assert np.all(np.isnan(table["energy_ratio"][status == "cycling"]))
    assert backbone.summary["residual"] < 1e-9
    assert backbone.summary["largest_energy_ratio"] >= 10.0
    assert backbone.summary["points"] == np.count_nonzero(status != "linear")


def test_a_motion_of_an_energy_below_contact_is_the_linear_mode():
    record = wb.run(ROD, {"analysis.energy_ratio": 0.25})
    assert record.converged and record.status == "linear"
    assert record.summary["max_displacement_m"] == pytest.approx(0.5e-3, abs=1e-12)
    assert record.summary["max_contact_force_N"] == 0.0
    assert record.summary["frequency_ratio"] == 1.0


def test_the_published_formulation_is_refused_with_the_place_where_it_is_solved():
    with pytest.raises(wb.SceneError) as refused:
        wb.run(ROD, {"analysis.formulation": "published"})
    for part in ("analysis.formulation", "published", "reproduce/laxalde_legrand_2010"):
        assert part in str(refused.value)


def test_the_consistent_formulation_of_an_earlier_record_is_accepted():
    assert wb.complete(ROD, {"analysis.formulation": "consistent"}) == wb.complete(ROD)
