"""Responses and modes of one structure over each other."""

import math

import numpy as np
import pytest
import wavebalance as wb
from command_scenes import STOP, STOP_AT, names_in, rows_of

UNDAMPED_MODE = {"analysis.type": "nonlinear_mode", "structure.stiffness_damping": 0,
                 "analysis.last_frequency_ratio": 1.4, "analysis.points": 60, "analysis.largest_energy": 20}
DIAGRAM = {"analysis.type": "bifurcation_diagram", "analysis.values": 4, "analysis.transient_periods": 200,
           "analysis.section_points": 16, "analysis.exact_curve": False, "analysis.both_ways": False}
OVER_AMPLITUDE = {"analysis.amplitude_from": 0.05, "analysis.amplitude_to": 0.15}
BASES = [f"time.{key}" for key in ("trial", "weight", "functions", "quadrature_points")]
RECORDS = {
    "low": (STOP, {"forcing.amplitude": 0.1}),
    "high": (STOP, {}),
    "heavy": (STOP, {"structure.density": 2.1}),
    "near": (STOP, {"contact.gap": 0.9}),
    "point": (STOP_AT, {"analysis.type": "forced_response"}),
    "mode": (STOP_AT, UNDAMPED_MODE),
    "high_tip": (STOP, {"analysis.outputs": ["velocity of node 1", "node 1"], "plot.log": True}),
    "mode_tip": (STOP_AT, {**UNDAMPED_MODE, "analysis.outputs": ["velocity of node 1", "node 1"]}),
    "diagram": (STOP_AT, {**DIAGRAM, "analysis.frequency_from": 0.2, "analysis.frequency_to": 0.24}),
    "loads": (STOP_AT, {"analysis.type": "amplitude_sweep", **OVER_AMPLITUDE}),
    "load_diagram": (STOP_AT, {**DIAGRAM, **OVER_AMPLITUDE}),
}


@pytest.fixture(scope="module")
def records(tmp_path_factory):
    """The folder of the records, each solved once."""
    folder = tmp_path_factory.mktemp("records")
    for name, (scene, changes) in RECORDS.items():
        unset = BASES if "diagram" in name else ()
        unset = [*unset, "forcing.frequency"] if name == "diagram" else unset
        assert wb.run(scene, changes, folder / name, unset=unset).converged, name
    return folder


@pytest.fixture
def overlay(command, records):
    """Lays records over each other into the folder `out`."""
    return lambda *names, more=(): command("overlay", *[records / name for name in names], "--output", "out", *more)


def columns_of(rows):
    return [np.array([float(row[name]) for row in rows]) for name in ("frequency_Hz", "displacement_m")]


def frequency_at(rows, level):
    """Frequency of a curve where its displacement first reaches a value."""
    frequency, displacement = columns_of(rows)
    i = np.flatnonzero((displacement[:-1] < level) & (displacement[1:] >= level))[0]
    return np.interp(level, displacement[i:i + 2], frequency[i:i + 2])


def test_no_file_that_no_record_lists_is_replaced(overlay, tmp_path):
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "overlay.csv").write_text("measured\n")
    refused = overlay("low")
    assert refused.code == 2
    assert "overlay.csv: would be replaced" in refused.errors
    assert (tmp_path / "out" / "overlay.csv").read_text() == "measured\n"


def test_peaks_of_lightly_damped_responses_lie_on_the_backbone(overlay):
    drawn = overlay("mode", "low", "high")
    assert (drawn.code, drawn.errors) == (0, "")
    assert names_in(drawn.folder) == {"overlay.svg", "overlay.png", "overlay.html", "overlay.figure.js", "overlay.csv",
                                      "summary.json"}
    rows = rows_of(drawn.folder / "overlay.csv")
    backbone = [row for row in rows if row["kind"] == "nonlinear_mode"]
    for name in ("low", "high"):
        frequency, displacement = columns_of([row for row in rows if row["curve"] == name])
        peak = displacement.argmax()
        assert displacement[peak] > 1.0
        assert frequency_at(backbone, displacement[peak]) == pytest.approx(frequency[peak], rel=0.01), name
    assert "overlay.svg" in (drawn.folder / "overlay.html").read_text()


@pytest.mark.parametrize("quantity, column", [("node 1", "node_1_half_peak_to_peak_m"),
                                              ("velocity of node 1", "velocity_of_node_1_half_peak_to_peak_m_per_s")])
def test_an_output_is_drawn_along_sweeps_and_modes(overlay, quantity, column):
    drawn = overlay("mode_tip", "high_tip", more=("--quantity", quantity))
    assert (drawn.code, drawn.errors) == (0, "")
    assert drawn.summary["quantity"] == quantity
    curves = {}
    for row in rows_of(drawn.folder / "overlay.csv"):
        if row[column]:
            curves.setdefault(row["kind"], []).append((float(row[column]), float(row["frequency_Hz"])))
    peak, frequency = max(curves["frequency_sweep"])
    vibration, of_mode = np.array(sorted(curves["nonlinear_mode"])).T
    assert np.interp(peak, vibration, of_mode) == pytest.approx(frequency, rel=0.01)
    assert '"logarithmic":true' in (drawn.folder / "overlay.figure.js").read_text().replace(" ", "")


@pytest.mark.parametrize("name", ["node 2", "velocity", "tip"])
def test_a_wrong_quantity_is_answered_with_the_outputs_there_are(overlay, name):
    refused = overlay("mode_tip", "high_tip", more=("--quantity", name))
    assert refused.code == 2
    assert f'--quantity is "{name}"' in refused.errors
    assert "the outputs velocity of node 1, node 1" in refused.errors


@pytest.mark.parametrize("quantity", ["max", "min", "max_abs", "rms"])
def test_responses_are_points_of_every_quantity(overlay, quantity):
    drawn = overlay("high", "point", more=("--quantity", quantity, "-q"))
    assert (drawn.code, drawn.text) == (0, ""), drawn.errors
    (point,) = [row for row in rows_of(drawn.folder / "overlay.csv") if row["kind"] == "response"]
    assert float(point["frequency_Hz"]) == 0.18
    assert math.isfinite(float(point["displacement_m"]))


@pytest.mark.parametrize("curve, diagram, column", [("high", "diagram", "frequency_Hz"),
                                                    ("loads", "load_diagram", "amplitude_N")])
def test_values_of_a_diagram_lie_on_the_curve_of_stable_motions(overlay, curve, diagram, column):
    drawn = overlay(curve, diagram)
    assert drawn.code == 0, drawn.errors
    rows = rows_of(drawn.folder / "overlay.csv")
    along = [(float(row[column]), float(row["displacement_m"])) for row in rows if row["curve"] == curve]
    points = [row for row in rows if row["kind"] == "periodic"]
    assert len(points) == 4 and {row["curve"] for row in points} == {f"{diagram}, repeats"}
    place, height = np.array(sorted(along)).T
    for row in points:
        expected = np.interp(float(row[column]), place, height)
        assert float(row["displacement_m"]) == pytest.approx(expected, rel=0.01)


def test_curves_over_the_frequency_and_the_amplitude_are_not_laid_over_each_other(overlay):
    refused = overlay("high", "loads")
    assert refused.code == 2
    assert "loads is over the amplitude in N, and the first folder over the frequency in Hz" in refused.errors


def test_a_diagram_has_no_rms(overlay):
    refused = overlay("high", "diagram", more=("--quantity", "rms"))
    assert refused.code != 0 and "has no rms" in refused.errors


def test_another_structure_is_refused_with_where_it_differs(overlay, tmp_path):
    refused = overlay("high", "heavy")
    assert refused.code == 2
    assert "heavy is of another structure than the first folder: structure.density is 2.1 and not 2.0" in refused.errors
    assert not (tmp_path / "out").exists()


def test_another_gap_is_warned_of(overlay):
    warned = overlay("high", "near")
    assert warned.code == 0
    assert "has another gap" in warned.errors


@pytest.mark.parametrize("words, answer", [
    (("empty", "-o", "out"), "holds no scene.toml"),
    (("{records}/high", "-o", "{records}/high"), "expected another folder"),
    (("{records}/high", "-o", "out", "--quantity", "peak"), "expected max, min, max_abs or rms"),
], ids=["no results", "its own input", "quantity"])
def test_what_cannot_be_drawn_is_refused_and_nothing_is_lost(command, records, tmp_path, words, answer):
    (tmp_path / "empty").mkdir()
    refused = command("overlay", *[word.format(records=records) for word in words])
    assert refused.code == 2
    assert answer in refused.errors
    assert (records / "high" / "sweep.csv").exists()
