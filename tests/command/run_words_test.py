"""Sentences of a report agree with the numbers in its summary."""

import numpy as np
import pytest
import wavebalance as wb
from command_scenes import BAR, ROD, words_of


@pytest.fixture(scope="module")
def told(tmp_path_factory):
    """Solves a scene, given as path or text, with other values; returns the summary and the words of its report."""

    def run(scene, overrides=None):
        folder = tmp_path_factory.mktemp("run") / "out"
        record = wb.run(scene, overrides, folder)
        return record.summary, words_of((folder / "report.html").read_text())

    return run


def lacking(text, *parts):
    return [part for part in parts if part not in text]


def test_a_motion_is_told_with_its_contact_and_its_distance_from_the_gap(told):
    summary, text = told(BAR)
    low, high = (1e3 * summary[name] for name in ("min_displacement_m", "max_displacement_m"))
    assert lacking(text, "was solved in ", "relative residual below 10⁻¹².", "At 150 Hz",
                   f"{low:.4g} mm and {high:.4g} mm", f"{100 * (high - 1.0):.3g} % past the gap of 1 mm",
                   f"{100 * summary['contact_fraction']:.3g} % of the period",
                   f"{1e-3 * summary['max_contact_force_N']:.4g} kN") == []


@pytest.mark.parametrize("functions, large", [(9, True), (255, False)])
def test_large_errors_name_the_sizes_that_reduce_them(told, functions, large):
    summary, text = told(BAR, {"time.functions": functions, "time.quadrature_points": 4 * functions})
    assert (max(summary["error_of_displacement"], summary["error_of_force"]) > 1e-2) == large
    words = f"More time.quadrature_points (now {4 * functions}) and more time.functions ({functions}) reduce these errors."
    assert (words in text) == large


def test_a_motion_that_has_not_converged_is_called_no_solution(told):
    _, text = told(BAR, {"analysis.type": "time_stepping", "analysis.max_periods": 1})
    assert lacking(text, "was not solved (iteration limit)", "The motion below is not a solution.") == []


def test_without_a_motion_nothing_is_said_to_follow(told):
    _, text = told(ROD, {"analysis.energy_ratio": 1e9})
    assert "There is no motion to show." in text
    assert "is not a solution" not in text


def test_words_of_modes_are_explained_where_they_stand(told):
    summary, text = told(ROD)
    assert summary["points_tongue"] > 0
    assert lacking(text, "Points with the status tongue are on an internal resonance",
                   "exact motions, is at most ") == []


def test_special_points_are_listed_by_type_and_are_the_structures_where_its_whole_curve_is_known(told, scenes):
    summary, text = told(scenes / "jones_legrand_2014" / "case2_sweep.toml")
    assert summary["structure_curve"] == "whole"
    points = summary["structure_special_points"]
    pairs = list(zip(points["type"], points["frequency_Hz"]))
    places = {kind: ", ".join(f"{place:.7g} Hz" for one, place in pairs if one == kind) for kind in ("fold", "grazing")}
    assert places["fold"] == "1337.739 Hz, 1315.015 Hz"
    assert lacking(text, f"Folds, where the curve turns back: {places['fold']}.",
                   f"split or merged: {places['grazing']}.") == []
    balance = summary["special_points"]
    assert f"{balance['frequency_Hz'][list(balance['type']).index('fold')]:.7g}" == "1337.768"
    assert "1337.768 Hz" not in text


def test_unstable_parts_of_a_curve_and_of_its_branches_are_named(told, scenes):
    summary, text = told(scenes / "cases_of_others" / "small_gap_bar.toml",
                         {"time.functions": 31, "time.quadrature_points": 256})
    parts, known = summary["unstable_parts"], summary["points"] - summary["points_stability_not_known"]
    places = [", ".join(f"{begin:.7g} to {end:.7g} Hz" for begin, end, one in
                        zip(parts["begin_Hz"], parts["end_Hz"], parts["branch"]) if one == branch) for branch in (0, 1)]
    assert np.bincount(np.asarray(parts["branch"], dtype=int)).tolist() == [2, 1]
    assert lacking(text, f"Along the curve motions are unstable at {places[0]}.",
                   f"Along branch 1 motions are unstable at {places[1]}.",
                   f"Stability is known at {known} of {summary['points']} points. Near grazing, contact lasts less") == []


DUFFING = {"structure": {"type": "matrices", "mass": np.eye(1), "stiffness": np.eye(1), "damping": 0.05 * np.eye(1),
                         "contact_dofs": [1]},
           "contact": {"law": "cubic", "cubic_stiffness": 1.0}, "forcing": {"amplitude": 0.3, "frequency": 0.25, "load_dofs": [1]},
           "time": {"trial": "fourier", "weight": "fourier", "functions": 31},
           "analysis": {"type": "amplitude_sweep", "amplitude_from": 0.05, "amplitude_to": 0.9, "outputs": [1]}}


def test_places_on_a_curve_have_the_same_unit_in_all_sentences(told):
    summary, text = told(DUFFING)
    begin, end = (1e3 * summary["unstable_parts"][f"{which}_N"][0] for which in ("begin", "end"))
    fold = 1e3 * summary["special_points"]["amplitude_N"][0]
    assert lacking(text, f"motions are unstable at {begin:.7g} to {end:.7g} mN.",
                   f"where the curve turns back: {fold:.7g} mN") == []


def test_harmonics_that_are_zero_are_not_in_the_legend(tmp_path):
    wb.run(DUFFING, output=tmp_path / "out")
    drawn = (tmp_path / "out" / "outputs.figure.js").read_text()
    assert '"harmonic 3"' in drawn and '"harmonic 2"' not in drawn


def two_masses(**analysis):
    """The first meets a stop, the second has a weight and hardly a link to the first."""
    return {"structure": {"type": "matrices", "mass": np.eye(2), "stiffness": np.array([[1e4, -1e-6], [-1e-6, 4e4]]),
                          "modal_damping": 0.05, "contact_dofs": [1]},
            "contact": {"law": "linear", "stiffness": 2e4, "gap": 1e-3},
            "forcing": {"amplitude": 2.0, "load_dofs": [1], "terms": [{"harmonic": 0, "dofs": [2], "amplitude": 40.0}]},
            "time": {"trial": "fourier", "weight": "fourier", "functions": 31},
            "analysis": {"type": "frequency_sweep", "frequency_from": 12.0, "frequency_to": 24.0, "outputs": [1, 2],
                         "stability": False} | analysis}


def test_an_output_that_only_rounding_moves_has_a_vibration_of_zero(told):
    _, text = told(two_masses())
    assert "The vibration of row 2 is zero, about a mean of 1 mm." in text


@pytest.mark.parametrize("analysis, words", [
    ({}, "of it, which were not compared with an exact periodic solution."),
    ({"exact": True}, "It is resolved to "),
    ({"stability": True}, "confirmed by the nearest exact periodic solution."),
])
def test_the_digits_of_a_peak_say_what_confirms_them(told, analysis, words):
    _, text = told(two_masses(**analysis))
    assert text.count("The peak was solved for between the points of the curve.") == 1
    assert words in text
