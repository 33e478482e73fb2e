"""Poincare sections over the frequency or the amplitude, by integration from event to event, there and back."""

import csv
import os
import signal
import subprocess
import time

import numpy as np
import pytest
from hammer_flights import GAP, LOAD, MASS, STIFFNESS, STRUCTURE, Hammer
from scipy.integrate import solve_ivp

import wavebalance as wb

DIAGRAM = """[analysis]
type = "bifurcation_diagram"
amplitude_from = 30.0
amplitude_to = 40.0
"""


def rows_of(file):
    with file.open() as text:
        return list(csv.DictReader(text))


def section_at(rows, value, way="there", place="amplitude_m_per_s2"):
    """The period and the points, displacement and velocity, of a value."""
    chosen = [row for row in rows if row["way"] == way and float(row[place]) == pytest.approx(value, rel=1e-9)]
    points = [(float(row["displacement_m"]), float(row["velocity_m_per_s"])) for row in chosen]
    return int(chosen[0]["period"]), np.array(points)


@pytest.fixture
def hammer(matrix):
    matrix("m.mtx", [[MASS]])
    matrix("k.mtx", [[STIFFNESS]])


def test_periods_double_where_they_do_by_exact_flights(run, hammer):
    """From right to left 1, 2, 4 periods and none; each section agrees with the flights."""
    record = run(STRUCTURE + DIAGRAM, set=["analysis.amplitude_from=38.0", "analysis.amplitude_to=28.0", "analysis.values=11",
                                           "analysis.both_ways=false", "analysis.exact_curve=false"])
    assert record.code == 0, record.errors
    rows = rows_of(record.folder / "section.csv")
    for amplitude, period in [(37.0, 1), (32.0, 2), (30.0, 2), (29.0, 4)]:
        found, points = section_at(rows, amplitude)
        assert (found, len(points)) == (period, period), amplitude
        flights = Hammer(amplitude, *points[0]).section(0, period + 1)
        assert flights[:period] == pytest.approx(points, abs=1e-4 * GAP), amplitude
        assert flights[period] == pytest.approx(points[0], abs=1e-3 * GAP), amplitude
        assert period == 1 or np.abs(flights[period // 2] - points[0]).max() > 1e-2 * GAP
    assert section_at(rows, 28.0)[0] == 0
    own = Hammer(37.0).section(300, 1)  # from rest, to the same motion
    assert section_at(rows, 37.0)[1] == pytest.approx(own, abs=1e-4 * GAP)


def test_motions_that_coexist_are_met_on_different_ways(run, hammer):
    """At 34 m/s^2 motions of two periods and of one are both stable."""
    record = run(STRUCTURE + DIAGRAM, set=["analysis.amplitude_from=32.0", "analysis.amplitude_to=36.0", "analysis.values=9"])
    rows = rows_of(record.folder / "section.csv")
    assert section_at(rows, 34.0)[0] == 2 and section_at(rows, 34.0, "back")[0] == 1
    (apart,) = record.summary["hysteresis"]
    assert (apart["from"], apart["to"], apart["period_there"], apart["period_back"]) == (34.0, 34.0, 2, 1)
    for way in ("there", "back"):
        period, points = section_at(rows, 34.0, way)
        assert Hammer(34.0, *points[0]).section(60, 2 * period)[::period][0] == pytest.approx(points[0], abs=1e-3 * GAP)
    page = record.page
    assert "Both directions lead to different motions at 34 m/s^2." in page
    assert "Backward (m/s^2): period 1 at 36 to 34; period 2 at 33.5 to 32." in page


def test_the_largest_displacement_of_impacts_is_the_gap(run, hammer):
    record = run(STRUCTURE + DIAGRAM, set=["analysis.values=2", "analysis.both_ways=false", "analysis.exact_curve=false"])
    for row in rows_of(record.folder / "envelope.csv"):
        assert float(row["contact_1_max_m"]) == pytest.approx(GAP, rel=1e-9)


def test_a_motion_that_still_settles_is_not_quasi_periodic(run, hammer):
    record = run(STRUCTURE + DIAGRAM, set=["analysis.amplitude_from=5.0", "analysis.amplitude_to=6.0", "analysis.values=2",
                                           "analysis.transient_periods=20", "analysis.both_ways=false",
                                           "analysis.exact_curve=false"])
    assert "still transient" in record.errors
    assert all(np.isnan(float(row["rotation_number"])) for row in rows_of(record.folder / "envelope.csv"))
    assert "quasi-periodic" not in (record.folder / "bifurcation.svg").read_text()


def test_the_exact_curve_passes_through_the_dots(run, hammer):
    record = run(STRUCTURE + DIAGRAM, set=["analysis.amplitude_from=40.0", "analysis.amplitude_to=30.0", "analysis.values=3",
                                           "analysis.both_ways=false"])
    assert record.summary["exact_curve"] == "reached_end"
    curve = rows_of(record.folder / "exact_curve.csv")
    rows = rows_of(record.folder / "section.csv")
    first = curve[0]
    assert float(first["displacement_m"]) == pytest.approx(section_at(rows, 40.0)[1][0, 0], abs=1e-4 * GAP)
    assert first["unstable"] == "0"
    ends = {row["point"]: row for row in curve if row["period"] == "2"}  # the last row of each of both points
    found = sorted(float(row["displacement_m"]) for row in ends.values())
    assert float(ends["1"]["amplitude_m_per_s2"]) == pytest.approx(30.0)
    assert found == pytest.approx(sorted(section_at(rows, 30.0)[1][:, 0]), abs=1e-4 * GAP)
    ordinary = [row for row in curve if row["period"] == "1"]
    assert float(ordinary[-1]["amplitude_m_per_s2"]) == pytest.approx(30.0) and ordinary[-1]["unstable"] == "1"
    assert "exact, unstable" in (record.folder / "bifurcation.svg").read_text()


ELASTIC = """
[structure]
type = "matrices"
mass = "m.mtx"
stiffness = "k.mtx"
damping = "c.mtx"
contact_dofs = [1]
[contact]
law = "linear"
stiffness = 30.0
gap = 0.0
[forcing]
load_dofs = [1]
amplitude = 1.0
[analysis]
type = "bifurcation_diagram"
frequency_from = 0.2
frequency_to = 0.3
values = 3
exact_curve = false
"""


def test_an_elastic_stop_over_the_frequency_against_runge_kutta(run, matrix):
    matrix("m.mtx", [[1.0]])
    matrix("k.mtx", [[1.0]])
    matrix("c.mtx", [[0.2]])
    record = run(ELASTIC)
    assert record.code == 0, record.errors
    rows = rows_of(record.folder / "section.csv")
    for frequency in (0.2, 0.25, 0.3):
        period, points = section_at(rows, frequency, place="frequency_Hz")
        assert period == 1
        w = 2.0 * np.pi * frequency
        rate = lambda t, y: [y[1], np.cos(w * t) - 0.2 * y[1] - y[0] - 30.0 * max(0.0, y[0])]  # noqa: B023
        end = solve_ivp(rate, (0.0, 1.0 / frequency), points[0], rtol=1e-10, atol=1e-12, max_step=0.02).y[:, -1]
        assert end == pytest.approx(points[0], abs=1e-6)


def test_an_output_without_contact_has_the_linear_response(run, matrix):
    mass, stiffness, damping = np.diag([1.0, 0.5]), np.array([[3.0, -1.0], [-1.0, 1.0]]), np.array([[0.3, -0.1], [-0.1, 0.1]])
    for name, values in {"m": mass, "k": stiffness, "c": damping}.items():
        matrix(f"{name}.mtx", values.tolist())
    scene = ELASTIC.replace("gap = 0.0", "gap = 100.0").replace("values = 3", "values = 3\noutputs = [-2]")
    record = run(scene)
    assert record.summary["section_of"] == "-row 2" and "Exact curves are drawn for sections of contacts only." in record.page
    for row in rows_of(record.folder / "section.csv"):
        w = 2.0 * np.pi * float(row["frequency_Hz"])
        response = np.linalg.solve(stiffness - w**2 * mass + 1j * w * damping, [1.0, 0.0])[1]
        assert float(row["displacement_m"]) == pytest.approx(-response.real, abs=1e-5)
        assert float(row["velocity_m_per_s"]) == pytest.approx(-(1j * w * response).real, abs=1e-5)


def test_the_same_scene_gives_the_same_points_and_reads_back(run, hammer, command, tmp_path):
    sets = ["analysis.values=3", "analysis.amplitude_from=19.0", "analysis.amplitude_to=21.0", "analysis.exact_curve=false"]
    first = run(STRUCTURE + DIAGRAM, set=sets)
    points = (first.folder / "section.csv").read_text()
    again = command("run", first.folder / "scene.toml", "--output", "again")
    assert again.code == 0, again.errors
    assert (tmp_path / "again" / "section.csv").read_text() == points
    assert int(first.summary["aperiodic_values"]) >= 1


def test_what_was_found_before_an_interruption_stays(tmp_path, hammer):
    (tmp_path / "scene.toml").write_text(STRUCTURE + DIAGRAM + "values = 2000\n")
    with subprocess.Popen([os.environ["WAVEBALANCE_COMMAND"], "run", "scene.toml", "--output", "out"], cwd=tmp_path,
                          stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True) as running:
        time.sleep(1.0)
        running.send_signal(signal.SIGINT)
        _, errors = running.communicate(timeout=20)
    assert running.returncode == 130, errors
    rows = rows_of(tmp_path / "out" / "section.csv")
    assert 0 < len(rows) < 4000
    assert "interrupted" in (tmp_path / "out" / "report.html").read_text()


@pytest.mark.parametrize(("sets", "words"), [
    (["analysis.frequency_from=10.0", "analysis.frequency_to=14.0"], ["analysis.amplitude_from = ", "the frequency has an interval, too"]),
    (["analysis.transient_periods=-1"], ["transient_periods", "-1"]),
    (["analysis.values=1"], ["values", "1"]),
    (["analysis.amplitude_to=30.0"], ["amplitude_to", "another amplitude"]),
    (["analysis.max_points=10"], ["max_points", "bifurcation_diagram"]),
])
def test_what_does_not_fit_is_refused_by_key(run, hammer, sets, words):
    record = run(STRUCTURE + DIAGRAM, set=sets)
    assert record.code == 2
    assert all(word in record.errors for word in words), record.errors


@pytest.mark.parametrize("left_out", ["amplitude_from", "amplitude_to"])
def test_the_end_of_an_interval_that_is_missing_is_named(run, hammer, left_out):
    lines = [line for line in DIAGRAM.splitlines() if not line.startswith(left_out)]
    record = run(STRUCTURE + "\n".join(lines) + "\n")
    assert record.code == 2 and f"analysis.{left_out}: missing; expected one interval" in record.errors


def test_a_transient_is_not_told_as_aperiodic(run, matrix):
    # With a damping ratio of 0.01 a tenth of the free vibration is left after 37 of its periods.
    matrix("one.mtx", [[1.0]])
    scene = """[structure]
type = "matrices"
mass = "one.mtx"
stiffness = "one.mtx"
stiffness_damping = 0.02
contact_dofs = [1]
[contact]
law = "cubic"
cubic_stiffness = 0.001
[forcing]
load_dofs = [1]
amplitude = 1.0
[analysis]
type = "bifurcation_diagram"
frequency_from = 0.05
frequency_to = 0.06
values = 2
both_ways = false
exact_curve = false
section_points = 48
transient_periods = {}
"""
    early = run(scene.format(0))
    assert early.code == 0 and early.summary["aperiodic_values"] == 0, early.errors
    assert "still transient" in early.errors and "aperiodic" not in early.text
    back = run(scene.format(0).replace("both_ways = false", "both_ways = true"))
    assert back.summary["hysteresis_values"] == 0, back.text
    late = run(scene.format(100))
    assert late.code == 0 and "transient" not in late.errors
    assert late.summary["longest_period_found"] == 1 and late.summary["aperiodic_values"] == 0


def test_compare_refuses_a_diagram(command, tmp_path, hammer):
    (tmp_path / "scene.toml").write_text(STRUCTURE + DIAGRAM)
    record = command("compare", "scene.toml", "--output", "out")
    assert record.code == 2 and "bifurcation_diagram" in record.errors


def test_python_has_the_points_and_draws_them():
    structure = {"type": "matrices", "mass": np.array([[MASS]]), "stiffness": np.array([[STIFFNESS]]), "contact_dofs": [1],
                 "modal_damping": 0.02}
    scene = {"structure": structure, "contact": {"law": "rigid", "restitution": 0.7, "gap": GAP},
             "forcing": {"frequency": LOAD, "terms": [{"kind": "base_acceleration", "dofs": [1], "amplitude": 20.0}]},
             "analysis": {"type": "bifurcation_diagram", "amplitude_from": 36.0, "amplitude_to": 40.0, "values": 3}}
    record = wb.run(scene)
    assert record.converged and record.status == "converged"
    assert list(record.section["period"]) == [1] * 6
    assert record.section["amplitude_m_per_s2"].tolist() == [36.0, 38.0, 40.0, 40.0, 38.0, 36.0]
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    axes = record.plot()
    assert axes.get_xlabel() == "amplitude m per s2"
    assert sum(len(line.get_xdata()) for line in axes.lines) == 6
