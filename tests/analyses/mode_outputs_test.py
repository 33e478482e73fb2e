"""Outputs along nonlinear modes: against linear modes, forced responses with the loads that hold the motion, and sweeps."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import scipy.io
import scipy.linalg
import wavebalance as wb

RECIPES = Path(__file__).resolve().parents[2] / "docs" / "recipes"
MASS = np.diag([2.0, 1.0, 3.0])
STIFFNESS = 1e4 * np.array([[5.0, -1.0, 0.0], [-1.0, 2.0, -1.0], [0.0, -1.0, 1.5]])
ROUNDING = 1e-9
TIP = "row_1_half_peak_to_peak_m"
AT = 3  # degree of freedom in contact, from 1


def structure(**more):
    return {"type": "matrices", "mass": MASS, "stiffness": STIFFNESS, "contact_dofs": [AT], **more}


def elastic(contact, **analysis):
    """Its first mode with an elastic contact, and outputs of all rows."""
    return {"structure": structure(), "contact": contact,
            "analysis": {"type": "nonlinear_mode", "outputs": [1, 2, 3], "stability": False, **analysis}}


STOP = {"law": "linear", "stiffness": 2e4, "gap": 1e-3}
SLIDER = {"law": "coulomb", "friction": 0.3, "tangential_stiffness": 5e3, "normal_load": 10.0}


def damped(**analysis):
    """The first mode with a slider, and outputs of all rows."""
    return {"structure": structure(stiffness_damping=2e-5), "contact": SLIDER,
            "analysis": {"type": "nonlinear_mode", "outputs": [1, 2, 3], **analysis}}


def shapes(stiffness=STIFFNESS):
    """The first linear mode over its displacement at the contact, and its frequency in Hz."""
    squares, vectors = scipy.linalg.eigh(stiffness, MASS)
    return vectors[:, 0] / vectors[AT - 1, 0], np.sqrt(squares[0]) / (2.0 * np.pi)


def vibrations(table):
    """Half the peak-to-peak values of the rows, rows x points."""
    return np.array([table[f"row_{n}_half_peak_to_peak_m"] for n in (1, 2, 3)])


def test_a_nearly_linear_contact_leaves_the_ratios_of_the_linear_mode():
    spring = {"law": "cubic", "cubic_stiffness": 1e-2}
    record = wb.run(elastic(spring, reference_length=1e-3, largest_energy=2.0, points=20))
    shape, frequency = shapes()
    table = record.backbone
    assert record.converged and len(table["frequency_Hz"]) > 3
    assert table["frequency_Hz"] == pytest.approx(frequency, rel=ROUNDING)
    for ratio, expected in zip(vibrations(table) / vibrations(table)[AT - 1], np.abs(shape)):
        assert ratio == pytest.approx(expected, rel=ROUNDING)


def test_below_contact_outputs_are_those_of_the_linear_mode():
    record = wb.run(elastic(STOP))
    table, summary = record.backbone, record.summary
    shape, _ = shapes()
    linear = np.array(table["status"]) == "linear"
    expected = np.sqrt(table["energy_ratio"][linear]) * 1e-3
    for values, share in zip(vibrations(table), np.abs(shape)):
        # The extremes are taken from 1024 samples, some of which are at the turns.
        assert values[linear] == pytest.approx(share * expected, rel=ROUNDING)
    assert summary["row_1_at_onset_m"] == pytest.approx(abs(shape[0]) * 1e-3, rel=ROUNDING)
    assert summary[TIP] == np.nanmax(table[TIP])
    assert table["frequency_Hz"][np.nanargmax(table[TIP])] == summary["row_1_peak_frequency_Hz"]


def test_before_slip_outputs_are_those_of_the_mode_that_sticks():
    record = wb.run(damped(largest_amplitude=1.1, points=20), {"structure.stiffness_damping": 0.0})
    stuck = STIFFNESS.copy()
    stuck[AT - 1, AT - 1] += SLIDER["tangential_stiffness"]
    shape, frequency = shapes(stuck)
    table = record.backbone
    stuck = table["amplitude_ratio"] < 1.0
    assert record.converged and np.count_nonzero(stuck) > 3
    assert table["frequency_Hz"][stuck] == pytest.approx(frequency, rel=ROUNDING)
    for values, share in zip(vibrations(table), np.abs(shape)):
        assert values[stuck] == pytest.approx(share * table["amplitude_m"][stuck], rel=ROUNDING)
    assert record.summary["row_1_at_onset_m"] == pytest.approx(abs(shape[0]) * record.summary["slip_amplitude_m"], rel=ROUNDING)


def loads_that_hold(damping, response, frequency, count):
    """[[forcing.terms]] of the force `damping` x velocity in each row and harmonic of a motion of all rows."""
    summary = response.summary["outputs"]
    rows = len(summary["output"])
    terms = []
    for n in range(1, count + 1):
        amplitude = np.array(summary[f"amplitude_{n}"]) * np.exp(1j * np.radians(summary[f"phase_{n}_degrees"]))
        force = damping @ (2j * np.pi * n * frequency * amplitude)
        terms += [{"harmonic": n, "dofs": [i + 1], "amplitude": float(abs(force[i])), "phase": float(np.degrees(np.angle(force[i])))}
                  for i in range(rows) if abs(force[i]) > 0.0]
    return terms


def response_to(scene, terms, damping, mode, functions, samples, start):
    """The forced response with a damping matrix, near the mode's motion."""
    kept = {name: value for name, value in scene["structure"].items() if name != "stiffness_damping"}
    return wb.run({"structure": {**kept, "damping": damping}, "contact": scene["contact"],
                   "forcing": {"frequency": mode.summary["frequency_Hz"], "terms": terms},
                   "time": {"trial": "fourier", "weight": "fourier", "functions": functions, "quadrature_points": samples},
                   "analysis": {"type": "forced_response", "outputs": [1, 2, 3], "phases": False, "stability": False}}, start_from=start)


def assert_same_outputs(response, mode, rel):
    assert response.converged, response.status
    for column in ("max", "min", "half_peak_to_peak", "rms", "amplitude_1"):
        found, expected = (np.array(one.summary["outputs"][column]) for one in (response, mode))
        assert found == pytest.approx(expected, abs=rel * np.abs(expected).max()), column


def test_the_response_to_what_damping_takes_is_the_elastic_mode(tmp_path):
    """A load C q' in all rows and harmonics makes the motion of the undamped mode one of the damped structure."""
    count, samples = 8, 256
    scene = elastic(STOP, energy_ratio=2.5, harmonics=count, samples=samples, output_harmonics=count)
    mode = wb.run(scene, output=tmp_path / "mode")
    damping = 1e-4 * STIFFNESS
    terms = loads_that_hold(damping, mode, mode.summary["frequency_Hz"], count)
    assert_same_outputs(response_to(scene, terms, damping, mode, 2 * count + 1, samples, tmp_path / "mode"), mode, 1e-7)


def test_the_response_to_what_friction_takes_is_the_damped_mode(tmp_path):
    """With one harmonic a load xi M q' holds the motion whose mode has the damping C - xi M."""
    samples = 256
    scene = damped(amplitude_ratio=3.0, harmonics=1, samples=samples, output_harmonics=1)
    mode = wb.run(scene, output=tmp_path / "mode")
    assert mode.converged, mode.status
    frequency = mode.summary["frequency_Hz"]
    damping = 2e-5 * STIFFNESS
    terms = loads_that_hold(2.0 * 2.0 * np.pi * frequency * mode.summary["damping_ratio"] * MASS, mode, frequency, 1)
    response = response_to(scene, terms, damping, mode, 3, samples, tmp_path / "mode")
    assert_same_outputs(response, mode, 1e-7)


def test_the_peak_of_a_sweep_lies_on_the_mode_of_its_output():
    """The peak is 1e-3 of its frequency wide by the damping ratio, of which a tenth is allowed; it is within 2e-6."""
    mode = wb.run(elastic(STOP, harmonics=15, samples=256, largest_energy=5.0))
    sweep = wb.run({"structure": structure(modal_damping=1e-3), "contact": STOP, "forcing": {"load_dofs": [AT], "amplitude": 0.03},
                    "time": {"trial": "fourier", "weight": "fourier", "functions": 31, "quadrature_points": 256},
                    "analysis": {"type": "frequency_sweep", "frequency_from": 7.5, "frequency_to": 9.2, "outputs": [2],
                                 "stability": False}})
    assert sweep.converged, sweep.status
    known = np.array(mode.backbone["status"]) == "converged"
    frequency, vibration = mode.backbone["frequency_Hz"][known], vibrations(mode.backbone)[1][known]
    peak = sweep.summary["row_2_half_peak_to_peak_m"]
    assert sweep.summary["row_2_peak_frequency_Hz"] > 1.05 * shapes()[1]
    assert vibration.min() < peak < vibration.max()
    assert sweep.summary["row_2_peak_frequency_Hz"] == pytest.approx(np.interp(peak, vibration, frequency), rel=1e-4)


def test_a_mode_leads_on_where_two_contacts_begin_to_slip_together(tmp_path):
    """The blade of the damper's recipe: the peak of a sweep, 4 Hz wide by the damping ratio, is within 0.01 Hz of its mode."""
    shutil.copy(RECIPES / "damper" / "damper.toml", tmp_path)
    subprocess.run([sys.executable, RECIPES / "damper" / "make.py"], cwd=tmp_path, check=True,
                   env={**os.environ, "PYTHONPATH": str(RECIPES)})
    scene, fewer = tmp_path / "damper.toml", {"time.functions": 31, "time.quadrature_points": 256}
    mode = wb.run(scene, {**fewer, "analysis.type": "nonlinear_mode"},
                  unset=["analysis.frequency_from", "analysis.frequency_to", "analysis.peak_of", "analysis.stability"])
    assert mode.converged, mode.status
    ratio, vibration = mode.backbone["amplitude_ratio"], mode.backbone["row_19_half_peak_to_peak_m"]
    assert ratio[-1] == pytest.approx(10.0, rel=ROUNDING) and mode.backbone["stick_fraction"][-1] < 0.5
    sweep = wb.run(scene, {**fewer, "analysis.frequency_from": 160.0, "analysis.frequency_to": 180.0})
    assert sweep.converged, sweep.status
    peak, frequency = (sweep.summary[f"row_19_{name}"] for name in ("half_peak_to_peak_m", "peak_frequency_Hz"))
    (at,) = np.flatnonzero((vibration[:-1] < peak) & (peak <= vibration[1:]))
    on_mode = np.interp(peak, vibration[at:at + 2], mode.backbone["frequency_Hz"][at:at + 2])
    assert frequency == pytest.approx(on_mode, abs=0.02)


def test_velocities_and_accelerations_are_derivatives_of_the_displacement():
    words = ["row 1", "velocity of row 1", "acceleration of row 1 in g"]
    table = wb.run(elastic({**STOP, "gap": 1.0}, outputs=words, energy_ratio=0.5)).summary["outputs"]
    omega = 2.0 * np.pi * shapes()[1]
    moved, speed, acceleration = table["half_peak_to_peak"]
    assert speed == pytest.approx(omega * moved, rel=1e-4)  # of 1024 samples, none at the turn of the velocity
    assert acceleration == pytest.approx(omega**2 * moved / 9.80665, rel=ROUNDING)


def test_the_mean_of_a_damped_mode_is_that_at_rest_under_static_loads():
    scene = damped(amplitude_ratio=0.8)
    scene["forcing"] = {"terms": [{"harmonic": 0, "dofs": [1], "amplitude": 1.0}]}
    record = wb.run(scene)
    assert record.converged, record.status
    stuck = STIFFNESS.copy()
    stuck[AT - 1, AT - 1] += SLIDER["tangential_stiffness"]
    at_rest = np.linalg.solve(stuck, [1.0, 0.0, 0.0])
    for n in (1, 2, 3):
        assert record.summary[f"row_{n}_mean_m"] == pytest.approx(at_rest[n - 1], rel=ROUNDING)


@pytest.mark.parametrize("outputs, contact, parts", [
    (["transmissibility of row 1"], STOP, ["a mode is a free motion, in which no support moves"]),
    (["absolute velocity of row 1"], SLIDER, ["a mode is a free motion, in which no support moves"]),
    (["acceleration of row 1"], {"law": "rigid", "gap": 1e-3}, ["no finite acceleration", "velocities"]),
    (["row 4"], STOP, ["there is no degree of freedom 4"]),
])
def test_outputs_that_a_mode_does_not_have_are_refused_with_the_reason(outputs, contact, parts):
    with pytest.raises(wb.SceneError) as refused:
        wb.check(elastic(contact, outputs=outputs), unset=["analysis.stability"])
    assert refused.value.key == "analysis.outputs"
    for part in parts:
        assert part in str(refused.value)


def test_a_mode_has_no_peak():
    with pytest.raises(wb.SceneError) as refused:
        wb.check(elastic(STOP, peak_of="row 1"))
    assert refused.value.key == "analysis.peak_of" and "nonlinear_mode" in str(refused.value)


def test_a_rigid_mode_has_outputs_where_it_has_a_motion():
    record = wb.run(elastic({"law": "rigid", "gap": 1e-3}, harmonics=8), unset=["analysis.stability"])
    known = np.array(record.backbone["status"]) == "converged"
    assert known.any() and np.all(np.isfinite(vibrations(record.backbone)[:, known]))


@pytest.mark.parametrize("scene, panels", [(elastic(STOP), 2), (damped(), 2)])
def test_pictures_and_sentences_begin_with_the_output(scene, panels, tmp_path):
    record = wb.run(scene, output=tmp_path / "out")
    assert record.summary["leading_output"] == "row 1"
    assert {"outputs.svg", "backbone.svg"} <= {one.name for one in (tmp_path / "out").iterdir()}
    page = (tmp_path / "out" / "report.html").read_text()
    assert page.count("The vibration of row 1 (half peak to peak) is") == 1 and "where contacts begin to act" in page
    assert "Vibration of row 1" in (tmp_path / "out" / "backbone.svg").read_text()


@pytest.mark.parametrize("scene, words", [(elastic(STOP, outputs=[1]), "dotted: end of the linear range"),
                                          (damped(outputs=[1]), "dotted: slip onset")])
def test_a_single_output_is_drawn_once_with_what_ends_the_linear_range(scene, words, tmp_path):
    wb.run(scene, output=tmp_path / "out")
    assert {one.name for one in (tmp_path / "out").glob("*.svg")} == {"backbone.svg"}
    assert words in (tmp_path / "out" / "backbone.svg").read_text()


def test_one_motion_of_a_damped_mode_has_its_outputs_and_the_whole_structure(tmp_path):
    record = wb.run(damped(amplitude_ratio=2.0, motion_points=64), output=tmp_path / "out")
    assert record.converged, record.status
    assert list(record.outputs) == ["time_fraction", "row_1_m", "row_2_m", "row_3_m"]
    contact = record.response["displacement_m"]
    assert record.outputs["row_3_m"] == pytest.approx(contact, abs=ROUNDING * np.abs(contact).max())
    motion = scipy.io.mmread(tmp_path / "out" / "motion.mtx")
    assert motion[0] == pytest.approx(record.outputs["row_1_m"][::16], abs=ROUNDING * np.abs(motion).max())


def test_a_study_over_modes_has_columns_of_their_outputs():
    table = wb.study(damped(largest_amplitude=2.0, points=20), {"contact.normal_load": [10.0, 20.0]}).table
    # Friction of constant limits scales with them, but for the rounding of the curve's first step.
    assert table["row_1_at_onset_m"][1] == pytest.approx(2.0 * table["row_1_at_onset_m"][0], rel=1e-6)
    assert "row_1_at_largest_damping_m" in table


def structure_of_python():
    return wb.Structure(MASS, 2e-5 * STIFFNESS, STIFFNESS, np.zeros(3), contacts=[AT - 1])


def test_modes_of_python_have_the_motion_of_the_whole_structure():
    law = wb.Coulomb(SLIDER["friction"], SLIDER["tangential_stiffness"], SLIDER["normal_load"])
    mode = wb.damped_mode(structure_of_python(), law, points=10)
    last = mode.structure_motion(-1, mode.displacement(-1).shape[1])
    assert last.displacement[AT - 1] == pytest.approx(mode.displacement(-1)[0], abs=1e-8 * np.abs(last.displacement).max())
    curve = wb.backbone(structure_of_python(), wb.Penalty(2e4, 1e-3), harmonics=8, points=20)
    motion = curve.structure_motion(-1, 256)
    assert motion.displacement.shape == motion.velocity.shape == (3, 256)
    assert motion.displacement[AT - 1].max() > 1e-3
