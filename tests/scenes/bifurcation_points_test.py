"""Bifurcation points of curves: none is dropped silently, and none is listed twice."""

import csv
import math

import pytest

TWO_STOPS = """
[structure]
type = "matrices"
mass = "m.mtx"
stiffness = "m.mtx"
stiffness_damping = 0.1
[contact]
{law}
gap = 1.2
[[contact.pairs]]
dofs = [1]
{side}
[forcing]
load_dofs = [1]
amplitude = 1.0
[analysis]
type = "frequency_sweep"
frequency_from = {start}
frequency_to = 0.35
{exact}
"""

ELASTIC = {"law": 'law = "linear"\nstiffness = 100.0', "side": 'side = "both"', "exact": "exact = true"}
RIGID = {"law": 'law = "rigid"\nrestitution = 0.8', "side": 'side = "both"', "exact": ""}
TIME = "[time]\ntrial = 'fourier'\nweight = 'fourier'\nfunctions = 127\nquadrature_points = 2048\n"


@pytest.mark.parametrize("start", [0.05, 0.051])
def test_every_change_of_stability_of_an_exact_curve_has_its_point(run, matrix, start):
    # A mass between two equal elastic stops: pitchforks of the symmetric motion at w = 0.43098, 0.78457, 0.89242.
    matrix("m.mtx", [[1.0]])
    record = run(TWO_STOPS.format(start=start, **ELASTIC) + TIME)
    assert record.code == 0
    points = record.summary["special_points"]
    branches = sorted(2.0 * math.pi * point["frequency_Hz"] for point in points if point["type"] == "branch")
    for expected in (0.43098, 0.78457, 0.89242):
        assert min(abs(one - expected) for one in branches) < 1e-5
    assert not any("changes without a listed bifurcation point" in warning for warning in record.summary.get("warnings", []))
    for point in points:
        if point["type"] in ("branch", "period_doubling"):
            assert abs(math.hypot(point["multiplier_real"], point["multiplier_imag"]) - 1.0) < 1e-3


def test_a_curve_with_impacts_passes_the_grazing_of_both_stops_at_once(run, matrix):
    # Equal stops graze at one frequency, |1 - w^2 + 0.1 i w| = 1 / 1.2, beyond which both have impacts.
    matrix("m.mtx", [[1.0]])
    record = run(TWO_STOPS.format(start=0.05, **RIGID))
    assert record.code == 0 and record.summary["status"] == "reached_end"
    grazing = [2.0 * math.pi * point["frequency_Hz"] for point in record.summary["special_points"]
               if point["type"] == "grazing"]
    b = 0.01 - 2.0
    first = math.sqrt(0.5 * (-b - math.sqrt(b * b - 4.0 * (1.0 - 1.0 / 1.44))))
    assert min(abs(one / first - 1.0) for one in grazing) < 1e-8
    with open(record.folder / "sweep.csv") as file:
        impacts = [row["impacts"] for row in csv.DictReader(file)]
    assert "1" not in impacts and impacts[0] == "0" and impacts[-1] == "2"


def test_two_folds_within_one_step_of_the_exact_curve_are_not_withdrawn(run, absorber):
    # A nonlinear energy sink: w = 1.0155921 and 1.0155087, by shooting.
    summary = run(absorber([[1.01, -0.01], [-0.01, 0.01]], [[0.012, -0.01], [-0.01, 0.01]], """law = "polynomial"
polynomial = [-0.01, 0.0, 0.05]
[[contact.pairs]]
dofs = [1, 2]""", 0.012, """frequency_from = 0.143239449
frequency_to = 0.175070437""")).summary
    folds = sorted(2.0 * math.pi * frequency for frequency in summary["turning_points_Hz"])
    assert folds == pytest.approx([1.0155087, 1.0155921], abs=2e-7)
    assert all(point["structure_status"] == "found" for point in summary["special_points"])
    assert not any("discretisation artefact" in warning for warning in summary["warnings"])


MIXED = """
[structure]
type = "matrices"
mass = "m.mtx"
stiffness = "k.mtx"
stiffness_damping = 0.02
[contact]
law = "coulomb"
friction = 1.0
normal_load = 1.0
tangential_stiffness = 20.0
[[contact.pairs]]
dofs = [1]
[[contact.pairs]]
dofs = [2, 1]
[[contact.pairs]]
law = "cubic"
cubic_stiffness = 1.0
dofs = [2]
[[contact.pairs]]
law = "cubic"
cubic_stiffness = 1.0
dofs = [3, 2]
[[contact.pairs]]
law = "linear"
stiffness = 1.0
gap = 0.25
dofs = [3]
[forcing]
load_dofs = [2]
amplitude = 1.0
[time]
trial = "fourier"
weight = "fourier"
functions = 9
quadrature_points = 64
[analysis]
type = "frequency_sweep"
frequency_from = 0.24
frequency_to = 0.27
first_step = 0.001
largest_step = 0.003
max_points = 119
"""


def test_what_a_count_does_beside_a_fold_is_no_row_of_neimark_sacker_points(run, matrix):
    matrix("m.mtx", [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
    matrix("k.mtx", [[2.0, -1.0, 0.0], [-1.0, 2.0, -1.0], [0.0, -1.0, 2.0]])
    points = run(MIXED).summary["special_points"]
    pairs = [point for point in points if point["type"] == "neimark_sacker"]
    for point in pairs:
        assert abs(math.hypot(point["multiplier_real"], point["multiplier_imag"]) - 1.0) < 1e-3
        assert point["multiplier_imag"] > 0.0
    places = sorted(point["frequency_Hz"] for point in points)
    assert all(b - a > 1e-8 for a, b in zip(places, places[1:]))
