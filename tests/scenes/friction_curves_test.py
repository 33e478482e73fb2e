"""Exact curves with friction, also with stops, and their records."""

import csv
import math

import pytest

MIXTURE = """
[structure]
type = "matrices"
mass = "m.mtx"
stiffness = "k.mtx"
stiffness_damping = 0.02
[[contact.pairs]]
dofs = [1]
law = "coulomb"
friction = 0.4
normal_load = 1.0
tangential_stiffness = 2.0
[[contact.pairs]]
dofs = [2]
law = "linear"
stiffness = 4.0
gap = 0.5
[forcing]
load_dofs = [2]
amplitude = 0.3
[time]
trial = "fourier"
weight = "fourier"
functions = 63
quadrature_points = 512
[analysis]
type = "frequency_sweep"
exact = true
frequency_from = 0.1
frequency_to = 0.3
"""


@pytest.fixture
def two_masses(matrix):
    matrix("m.mtx", [[1.0, 0.0], [0.0, 1.0]])
    matrix("k.mtx", [[2.0, -1.0], [-1.0, 2.0]])


def rows_of(record):
    with open(record.folder / "sweep.csv", encoding="utf-8") as table:
        return list(csv.DictReader(table))


def test_an_exact_curve_with_friction_slips_up_to_its_closed_form(run, scenes):
    """The slider holds beyond the frequency where |k + k_t - w^2 + i c w| = k_t F / limit."""
    record = run(scenes / "friction" / "slider.toml", "--analysis", "frequency_sweep",
                 set=("analysis.exact=true", "analysis.frequency_from=0.25", "analysis.frequency_to=0.35"))
    summary = record.summary
    assert summary["status"] == "reached_end", record.errors
    middle, damping = 2.0, 0.05
    square = middle - damping ** 2 / 2 + math.sqrt((middle - damping ** 2 / 2) ** 2 - middle ** 2 + 2.0 ** 2)
    assert [point["type"] for point in summary["special_points"]] == ["slip"]
    slip = summary["special_points"][0]["frequency_Hz"]
    assert slip == pytest.approx(math.sqrt(square) / (2.0 * math.pi), rel=1e-7)
    for row in rows_of(record):
        sticks = float(row["stick_fraction"]) == 1.0
        assert sticks == (float(row["frequency_Hz"]) > slip * (1.0 - 1e-7))
        assert (float(row["friction_work_J"]) > 1e-9) != sticks or abs(float(row["frequency_Hz"]) - slip) < 1e-6
        assert row["contacts"] == "0" and row["phases_status"] == "converged"
    assert "Contacts slip for up to" in record.page and "Contact lasts" not in record.page


def test_an_exact_curve_of_friction_beside_a_stop_has_the_peak_of_exact_motions(run, two_masses):
    record = run(MIXTURE)
    summary = record.summary
    assert summary["status"] == "reached_end", record.errors
    assert {"grazing", "slip"} <= {point["type"] for point in summary["special_points"]}
    peak = max(rows_of(record), key=lambda row: float(row["vibration_m"]))
    alone = MIXTURE.split("[time]")[0] + f"frequency = {peak['frequency_Hz']}\n"
    motion = run(alone + '[time]\nmethod = "exact"\n[analysis]\ntype = "forced_response"\n').summary
    assert motion["status"] == "converged"
    assert motion["vibration_m"] == pytest.approx(float(peak["vibration_m"]), rel=1e-6)


def test_an_exact_curve_goes_on_where_a_stop_with_a_dashpot_lets_go(run, two_masses):
    """Its force vanishes before the stop opens."""
    friction, stop = MIXTURE.split("[[contact.pairs]]")[1:]
    scene = MIXTURE.replace("[[contact.pairs]]" + friction, "").replace(stop.split("[forcing]")[0], """
dofs = [2]
law = "kelvin_voigt"
stiffness = 8.0
damping = 0.8
gap = 0.4
""")
    summary = run(scene).summary
    assert summary["status"] == "reached_end"
    assert [point["type"] for point in summary["special_points"]].count("grazing") >= 2
    assert summary["phases_status"] == "converged"


def test_a_contact_that_slips_all_along_begins_to_stick_at_its_closed_form(run, matrix):
    """Den Hartog's oscillator, whose velocity is known in closed form, until it vanishes within a half period."""
    for name in ("m", "k"):
        matrix(f"{name}.mtx", [[1.0]])
    record = run("""[structure]
type = "matrices"
mass = "m.mtx"
stiffness = "k.mtx"
[contact]
law = "coulomb"
mass = "keep"
friction = 0.3
normal_load = 1.0
[[contact.pairs]]
dofs = [1]
[forcing]
load_dofs = [1]
amplitude = 1.0
[analysis]
type = "frequency_sweep"
frequency_from = 0.1
frequency_to = 0.06
""")

    limit = 0.3

    def largest(w):  # velocity over the part of the half period in which it is about to vanish
        whole, way = math.pi / w, 1.0 / (1.0 - w**2)
        sine = -limit * (1.0 - math.cos(whole)) / (w * math.sin(whole))  # way sin(phase)
        phase = math.atan2(sine, math.sqrt(way**2 - sine**2))
        return max(limit * math.sin(t) + w * sine * math.cos(t) - way * w * math.sin(w * t + phase)
                   for t in (whole * k / 20000 for k in range(40, 10000)))

    low, high = 0.45, 0.499
    for _ in range(25):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if largest(middle) < 0.0 else (middle, high)
    assert record.summary["status"] == "reached_end", record.errors
    assert [point["type"] for point in record.summary["special_points"]] == ["stick"]
    assert record.summary["special_points"][0]["frequency_Hz"] == pytest.approx(low / (2.0 * math.pi), rel=1e-5)


def test_an_exact_curve_goes_on_where_stops_with_dashpots_begin_to_touch(run, scenes):
    """Both stops at once, where the linear motion reaches them; the force of a dashpot jumps there."""
    record = run(scenes / "cases_of_others" / "harvester_dashpots.toml", "--analysis", "frequency_sweep",
                 set=("analysis.exact=true", "analysis.frequency_from=290.0", "analysis.frequency_to=300.0"))
    summary = record.summary
    assert summary["status"] == "reached_end", record.errors
    reach = 3.0 / (80e-6 * math.pi**2)
    grazing = math.sqrt((179991.0 - math.sqrt(179991.0**2 - 4.0 * (90000.0**2 - reach**2))) / 2.0)
    assert [point["type"] for point in summary["special_points"]] == ["grazing"]
    assert summary["special_points"][0]["frequency_Hz"] == pytest.approx(grazing, rel=1e-9)
    assert float(rows_of(record)[-1]["max_displacement_m"]) == pytest.approx(2.0075021778e-5, rel=1e-6)
