"""Two frequencies: a structure that flutters between two stops under a load, and the same motion by scipy."""

import csv

import numpy as np
import pytest
from scipy.integrate import solve_ivp

COUPLING, STOP, GAP, LOAD, RATE = 0.12, 1.5, 1.0, 0.4, 1.9
STIFFNESS = np.array([[1.0, COUPLING], [-COUPLING, 1.05]])
FREQUENCY = RATE / (2.0 * np.pi)
SAMPLES = 64

STRUCTURE = f"""
[structure]
type = "matrices"
mass = "m.mtx"
stiffness = "k.mtx"
damping = "c.mtx"
unsymmetric = true
[contact]
law = "linear"
stiffness = {STOP}
gap = {GAP}
[[contact.pairs]]
dofs = [1]
[[contact.pairs]]
dofs = [1]
coefficients = [-1.0]
[forcing]
load_dofs = [2]
amplitude = {LOAD}
"""
STEPPING = f"""frequency = {FREQUENCY!r}
[analysis]
type = "time_stepping"
max_periods = 300
outputs = [2]
"""
DIAGRAM = f"""[analysis]
type = "bifurcation_diagram"
frequency_from = {FREQUENCY!r}
frequency_to = {1.01 * FREQUENCY!r}
values = 2
transient_periods = 300
section_points = 512
exact_curve = false
outputs = [2]
"""


@pytest.fixture
def flutter(matrix):
    matrix("m.mtx", np.eye(2).tolist())
    matrix("k.mtx", STIFFNESS.tolist())
    matrix("c.mtx", (0.02 * np.eye(2)).tolist())


@pytest.fixture(scope="module")
def by_scipy():
    """The motion behind its transient, SAMPLES of each period: displacements of both degrees of freedom, and velocities."""

    def rate(t, y):
        stops = STOP * (max(y[0] - GAP, 0.0) - max(-y[0] - GAP, 0.0))
        force = -STIFFNESS @ y[:2] - 0.02 * y[2:]
        return [y[2], y[3], force[0] - stops, force[1] + LOAD * np.cos(RATE * t)]

    before, periods = 250, 250
    times = np.arange(SAMPLES * before, SAMPLES * (before + periods)) / SAMPLES / FREQUENCY
    return solve_ivp(rate, (0.0, times[-1]), np.zeros(4), rtol=1e-8, atol=1e-10, t_eval=times).y


def turns_of(motion):
    """Turns of the fluttering place per period of the load, the mean under the window of weighted Birkhoff averages."""
    angles = np.unwrap(np.angle(motion[0] - 1j * motion[2])) / (2.0 * np.pi)
    moved = angles[SAMPLES:] - angles[:-SAMPLES]
    t = np.arange(1, len(moved) + 1) / (len(moved) + 1.0)
    weights = np.exp(-1.0 / (t * (1.0 - t)))
    return weights @ moved / weights.sum()


def rows_of(file):
    with file.open() as text:
        return list(csv.DictReader(text))


def test_second_frequency_and_peaks_are_those_of_scipy(run, flutter, by_scipy):
    record = run(STRUCTURE + STEPPING)
    found = record.summary
    assert (found["status"], found["motion_kind"]) == ("aperiodic", "quasi_periodic")
    turns = turns_of(by_scipy) % 1.0
    assert found["rotation_number"] == pytest.approx(min(turns, 1.0 - turns), abs=1e-5)
    assert found["second_frequency_Hz"] == pytest.approx(found["rotation_number"] * FREQUENCY, rel=1e-12)
    assert found["max_displacement_m"] == pytest.approx(by_scipy[0].max(), rel=1e-3)
    peaks = {(row["place"], row["quantity"]): float(row["value"]) for row in rows_of(record.folder / "statistics.csv")}
    assert peaks["row 2", "max"] == pytest.approx(by_scipy[1].max(), rel=2e-3)
    # One period of a motion that does not repeat gives no motion of the structure.
    assert found["row_2_half_peak_to_peak_m"] == pytest.approx(0.5 * np.ptp(by_scipy[1]), rel=2e-3)
    assert not (record.folder / "outputs.csv").exists()
    assert 0.0 < found["curve_residual"] < 1e-3
    assert "invariant curve" in (record.folder / "response.svg").read_text()


def test_a_diagram_has_second_frequency_and_envelope_of_each_value(run, flutter, by_scipy):
    record = run(STRUCTURE + DIAGRAM)
    assert record.code == 0, record.errors
    assert record.summary["quasi_periodic_values"] == record.summary["aperiodic_values"] == 4
    rows = rows_of(record.folder / "envelope.csv")
    turns = turns_of(by_scipy) % 1.0
    for row in (rows[0], rows[-1]):
        assert float(row["rotation_number"]) == pytest.approx(min(turns, 1.0 - turns), abs=1e-5)
        assert float(row["contact_1_max_m"]) == pytest.approx(by_scipy[0].max(), rel=2e-3)
        assert float(row["row_2_min_m"]) == pytest.approx(by_scipy[1].min(), rel=2e-3)
        assert float(row["curve_residual"]) < 1e-3
    # The flutter keeps its frequency as the forcing frequency changes, so that both differ by a multiple of the latter.
    flutters = [[abs(k * FREQUENCY * factor + sign * float(row["second_frequency_Hz"])) for k in (0, 1) for sign in (1, -1)]
                for row, factor in ((rows[0], 1.0), (rows[1], 1.01))]
    assert min(abs(a - b) for a in flutters[0] for b in flutters[1]) < 1e-3


def test_outputs_that_are_no_displacements_are_left_out(run, flutter):
    """Their rows would be displacements under another name."""
    record = run(STRUCTURE + STEPPING, set=['analysis.outputs=["velocity of row 2", "row 2"]', "analysis.max_periods=40"])
    places = {row["place"] for row in rows_of(record.folder / "statistics.csv")}
    assert {"contact 1", "contact 2", "row 2"} <= places
    assert "velocity of row 2" not in places


def test_an_unstable_response_with_a_complex_pair_has_the_rotation_of_its_perturbations(run, flutter):
    bases = 'trial = "fourier"\nweight = "fourier"\nfunctions = 31\nquadrature_points = 64'
    response = f'frequency = {FREQUENCY!r}\n[time]\n{bases}\n[analysis]\ntype = "forced_response"\nstability = true\n'
    record = run(STRUCTURE + response)
    assert record.summary["unstable_multipliers"] == 2
    linear = np.block([[np.zeros((2, 2)), np.eye(2)], [-STIFFNESS, -0.02 * np.eye(2)]])  # no contact closes
    exponents = np.linalg.eigvals(linear) / FREQUENCY
    rotation = abs(np.angle(np.exp(exponents[np.argmax(exponents.real)]))) / (2.0 * np.pi)
    assert any(f"rotate at {rotation:.4g} times its frequency" in one for one in record.summary["warnings"])
