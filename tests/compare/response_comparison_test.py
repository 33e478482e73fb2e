"""Pairs of bases against each other in forced responses."""

import json

import numpy as np
import pytest
import wavebalance as wb
from comparisons import CLOSED_STOP, TWO_PAIRS, errors_of, motion_of, rows_of
from rods_and_bars import BAR, matrices_of

PHASES = {"method": "exact", "tolerance": 1e-12}


@pytest.fixture(scope="module")
def elastic():
    """Two pairs in the bar with an elastic contact."""
    return wb.compare(BAR, pairs=TWO_PAIRS, budget=2.0)


@pytest.fixture(scope="module")
def linear():
    """Two pairs in the bar where contact never closes."""
    return wb.compare(BAR, {"contact.gap": 1.0}, pairs=TWO_PAIRS, budget=1.0)


@pytest.fixture(scope="module")
def all_pairs():
    """Every admissible pair in the bar."""
    return wb.compare(BAR, budget=2.0)


def test_the_reference_of_a_linear_scene_is_the_closed_form_and_three_fourier_functions_are_exact(linear):
    assert (linear.summary["reference"], linear.summary["reference_stability"]) == ("linear", "stable")
    # Re (K + i w C - w^2 M)^-1 load exp(i w t) at the tip.
    mass, stiffness = matrices_of(BAR["structure"])
    omega = 2.0 * np.pi * BAR["forcing"]["frequency"]
    dynamic = stiffness * (1.0 + 1j * omega * BAR["structure"]["stiffness_damping"]) - omega**2 * mass
    tip = np.linalg.solve(dynamic, BAR["forcing"]["amplitude"] * np.eye(25)[-1])[-1]
    record = wb.run(BAR, {"contact.gap": 1.0, "time.functions": 3, "time.quadrature_points": 4})
    exact = np.real(tip * np.exp(2j * np.pi * record.response["time_fraction"]))
    assert np.linalg.norm(record.response["displacement_m"] - exact) < 1e-12 * np.linalg.norm(exact)
    (coarsest,) = rows_of(linear.table, trial="fourier", functions=3.0, points=4.0)
    assert linear.table["functions"][0] == 3 and coarsest["error"] < 1e-12


def test_choices_in_a_linear_scene_keep_to_their_errors_and_splines_are_never_exact(linear):
    # Solves of few functions take microseconds, whose order depends on the load of the machine.
    choices = rows_of(linear.summary["recommendations"])
    assert len(choices) == 3
    for choice in choices:
        assert choice["trial"] and choice["displacement_error"] <= choice["error"]
        of_fourier = rows_of(linear.table, trial="fourier", functions=choice["fourier_functions"])
        assert of_fourier and all(row["error"] < 1e-12 for row in of_fourier)
    # Splines approximate a cosine.
    assert linear.summary["pairs"]["trial"][1] == "bspline" and linear.summary["pairs"]["smallest_error"][1] > 1e-10


def test_the_reference_without_an_obstacle_is_the_linear_response():
    scene = {**BAR, "contact": {"law": "none"}}
    assert wb.compare(scene, pairs=TWO_PAIRS, budget=1.0).summary["reference"] == "linear"


def test_a_recommendation_holds_when_it_is_pasted(elastic):
    assert elastic.summary["reference"] == "phases" and elastic.converged
    choice = rows_of(elastic.summary["recommendations"])[0]
    assert choice["stability"] == "stable"
    assert max(choice["displacement_error"], choice["force_error"]) <= 1e-2
    reference = motion_of(wb.run({**BAR, "time": PHASES}))
    rest = wb.complete({**BAR, "time": {"trial": "haar", "weight": "fourier", "functions": 8}})
    begin, end = rest.index("[time]"), rest.index("[analysis]")
    again = wb.run(rest[:begin] + choice["time_table"] + rest[end:])
    assert again.converged
    displacement_error, force_error = errors_of(motion_of(again), reference)
    assert displacement_error == pytest.approx(choice["displacement_error"], abs=1e-9)
    assert force_error == pytest.approx(choice["force_error"], abs=1e-6)
    # Order 2 of the points, at least, where the force has kinks.
    assert elastic.summary["pairs"]["order"][0] > 1.5


def test_exact_solutions_are_beside_the_pairs_and_have_no_order(elastic):
    last = rows_of(elastic.summary["pairs"])[-1]
    assert last["trial"] == "phases" and last["converged"] >= 2 and np.isnan(last["order"])


def test_the_reference_of_a_rigid_bar_is_exact_solutions(scenes):
    scene = scenes / "jones_legrand_2014" / "case1_rigid.toml"
    found = wb.compare(scene, pairs="fourier:fourier", error="displacement", budget=10.0)
    assert found.summary["reference"] == "phases"
    assert found.summary["reference_error"] < 1e-11
    assert found.summary["recommendations"]["trial"][0]
    assert found.summary["pairs"]["trial"][-1] == "phases"


@pytest.mark.parametrize("nyquist, some", [("drop", False), ("keep", True)])
def test_even_numbers_of_fourier_functions_are_taken_where_the_nyquist_coefficient_is_kept(nyquist, some):
    table = wb.compare(BAR, {"contact.gap": 1.0, "time.nyquist": nyquist}, pairs=TWO_PAIRS, budget=1.0).table
    assert any(row["functions"] % 2 == 0 for row in rows_of(table, trial="fourier")) == some


def test_as_many_fourier_functions_as_points_are_refused_at_the_middles_of_the_intervals():
    found = wb.compare(BAR, {"time.sample_offset": 0.5, "time.nyquist": "keep"}, pairs=TWO_PAIRS, budget=1.0)
    assert found.summary["reference"] == "phases"
    refused = rows_of(found.table, status="refused")
    assert refused and all(row["functions"] == row["points"] for row in refused)


def test_every_admissible_pair_is_taken_and_of_the_others_the_reason_is_said(all_pairs):
    pairs = rows_of(all_pairs.summary["pairs"])
    assert len(pairs) == 19
    assert (pairs[0]["trial"], pairs[0]["weight"]) == ("fourier", "fourier")
    (haar,) = [pair for pair in pairs if (pair["trial"], pair["weight"]) == ("haar", "haar")]
    assert not haar["admissible"] and haar["failures"]
    for pair in pairs:
        assert bool(pair["admissible"]) == (pair["solves"] > 0), pair
        assert pair["admissible"] or pair["failures"]
    assert rows_of(all_pairs.summary["pairs"], trial="phases")[0]["admissible"]


def test_pairs_are_drawn_each_in_a_way_of_its_own_and_those_of_the_paper_solid(command, tmp_path):
    (tmp_path / "bar.toml").write_text(wb.complete(BAR))
    assert command("compare", "bar.toml", "--output", "out", "--budget", "2", "--quiet").code == 0

    def lines(name):
        text = (tmp_path / "out" / f"{name}.figure.js").read_text()
        return json.loads(text[text.index('"] = ') + 5:].rstrip().rstrip(";"))["panels"][0]["series"]

    over_functions, over_time = lines("error_over_functions"), lines("error_over_time")
    (phases,) = [line for line in over_time if line["label"] == "exact solution"]
    assert len(phases["x"]) >= 2
    # Their functions belong to the balance that they start from.
    assert "exact solution" not in [line["label"] for line in over_functions]
    looks = {(line["colour"], line["dash"]) for line in [*over_functions, phases]}
    assert len(looks) == len(over_functions) + 1 == 12
    assert sum(line["dash"] == "" for line in over_functions) == 6


@pytest.mark.parametrize("changes, options, message", [
    ({}, {"pairs": "haar:haar"}, "--pairs haar:haar: not an admissible pair: "),
    ({"analysis.type": "time_stepping"}, {}, 'analysis.type = "time_stepping"'),
    ({"analysis.subharmonic": 2}, {}, "analysis.subharmonic = 2"),
    ({}, {"budget": 0.0}, "--budget 0: expected seconds > 0"),
    ({}, {"threads": -1}, "--threads -1: expected at least 1, or 0 for one per core"),
    ({}, {"pairs": "haar"}, '"haar" is no pair; expected TRIAL:WEIGHT'),
    ({}, {"pairs": "harr:fourier"}, '"harr" is no basis; expected "fourier"'),
    ({}, {"pairs": "haar:fourier,haar:fourier"}, "haar:fourier is there twice"),
    ({}, {"pairs": "haar:fourier,"}, '"" is no pair'),
])
def test_what_cannot_be_compared_is_refused_with_what_is_allowed(changes, options, message):
    unset = [f"time.{key}" for key in BAR["time"]] if "analysis.type" in changes else []
    with pytest.raises(ValueError) as refused:
        wb.compare(BAR, changes, unset=unset, **{"pairs": TWO_PAIRS, "budget": 1.0, **options})
    assert message in str(refused.value)


def test_pairs_are_those_that_are_named():
    found = wb.compare(BAR, {"contact.gap": 1.0}, pairs="daubechies6:bspline,haar:fourier", budget=0.2)
    assert found.summary["pairs"]["trial"] == ["daubechies6", "haar"]
    assert found.summary["pairs"]["weight"] == ["bspline", "fourier"]
    assert "DB6:B-spline" in wb.compare(BAR, {"contact.gap": 1.0}, pairs="daubechies6:bspline", budget=0.2).text


def test_a_long_reference_leaves_time_for_the_pairs():
    # A stop that stays closed, and a loss factor, which exact solutions do not support. Its Newton matrix has a row
    # for every point, so that the finest level of a tolerance needs many times the budget.
    found = wb.compare(CLOSED_STOP, {"structure.loss_factor": 1e-6}, pairs=TWO_PAIRS, budget=2.0)
    assert (found.summary["reference"], found.status) == ("finer_balance", "converged")
    assert len(found.table["trial"]) > 0


def test_a_comparison_without_time_for_a_reference_says_so():
    found = wb.compare(BAR, pairs=TWO_PAIRS, budget=1e-6)
    assert not found.converged and found.status == "no_reference"
    assert len(found.table["trial"]) == len(found.summary["recommendations"]["error"]) == 0


def test_motions_on_two_threads_are_those_on_one_to_the_last_digit():
    def solved(threads):
        found = wb.compare(BAR, pairs=TWO_PAIRS, budget=2.0, threads=threads)
        assert found.status == "converged"
        names = ("trial", "functions", "points", "tolerance")
        return {tuple(str(row[name]) for name in names): (row["error"], row["force_error"])
                for row in rows_of(found.table, converged=1.0)}  # a solve may end for the time it takes

    one, two = solved(1), solved(2)
    common = set(one) & set(two)
    assert len(common) >= 20
    assert {key: one[key] for key in common} == {key: two[key] for key in common}
