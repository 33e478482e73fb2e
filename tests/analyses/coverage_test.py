"""Each analysis with each kind of load, coefficient and output: the motion of all others at the same values, or a refusal by key."""

import numpy as np
import pytest

import wavebalance as wb

STOP = '[[contact.pairs]]\ndofs = [1]\nlaw = "linear"\nstiffness = 2.0\ngap = 0.4\n'
RUB = '[[contact.pairs]]\ndofs = [1]\nlaw = "coulomb"\nfriction = 0.3\ntangential_stiffness = 3.0\nnormal_load = 0.4\n'
MESH = '[[contact.pairs]]\ndofs = [1]\nlaw = "periodic_stiffness"\nstiffness = 0.5\nstiffness_harmonics = [0.2]\n'
PUSH = "[[forcing.terms]]\ndofs = [1]\namplitude = 0.3\n"
TURNS = '[[forcing.terms]]\nkind = "unbalance"\ndofs = [1, 2]\namplitude = 0.3\n'
SHAKES = '[[forcing.terms]]\nkind = "base_acceleration"\ndofs = [1]\nunit = "g"\namplitude = 0.03\n'
# Changes of the structure, the contact, the load, and the outputs.
FEATURES = {
    "unbalance": ("", STOP, TURNS, []),
    "gyroscopic": ('gyroscopic = "g.mtx"\n', STOP.replace("0.4", "0.2"), PUSH, []),
    "spin": ('gyroscopic = "g.mtx"\nspin_speed = 0.9\n', STOP.replace("0.4", "0.2"), PUSH, []),
    "normal_load_speed2": ("", RUB + "normal_load_speed2 = 0.1\n", PUSH, []),
    "normal_load_table": ("", RUB.replace("0.4", "0.0") + 'normal_load_table = "loads.csv"\n', PUSH, []),
    "table of a term": ("", STOP, PUSH + 'amplitude_table = "table.csv"\n', []),
    "table of the force": ("", STOP, 'load_dofs = [1]\namplitude = 0.3\namplitude_table = "table.csv"\n', []),
    "periodic_stiffness": ("", MESH, PUSH, []),
    "g": ("", STOP, SHAKES, []),
    "units": ("", STOP, PUSH, ["row 2 in mm"]),
    "velocity": ("", STOP, PUSH, ["velocity of row 2 in mm/s"]),
    "frame": ("", STOP, SHAKES, ["absolute acceleration of row 1 in g"]),
}
BASES = 'trial = "fourier"\nweight = "fourier"\nfunctions = 63\nquadrature_points = 512\n'
AT, AMPLITUDE = 0.17, 0.3  # Hz, and of each load but SHAKES
SWEEP = f'type = "frequency_sweep"\nfrequency_from = 0.16\nfrequency_to = {AT}\nstability = true\n'
GROWS = 'type = "amplitude_sweep"\namplitude_from = {0}\namplitude_to = {1}\nstability = true\n'
DIAGRAM = 'type = "bifurcation_diagram"\n{}values = 2\ntransient_periods = 200\nsection_points = 8\nboth_ways = false\nexact_curve = false\n'
ANALYSES = {
    "response": (BASES, 'type = "forced_response"\n'),
    "sweep": (BASES, SWEEP + "branches = true\n"),
    "exact sweep": (BASES, SWEEP + "exact = true\n"),
    "amplitude sweep": (BASES, GROWS),
    "exact amplitude sweep": (BASES, GROWS + "exact = true\n"),
    "time stepping": ("", 'type = "time_stepping"\n'),
    "shooting": ("", 'type = "shooting"\n'),
    "motions": ("", 'type = "motions"\nrandom_starts = 2\n'),
    "diagram": ("", DIAGRAM.format(f"frequency_from = 0.165\nfrequency_to = {AT}\n")),
    "diagram over the amplitude": ("", DIAGRAM.replace("{}", "amplitude_from = {0}\namplitude_to = {1}\n")),
    "nonlinear mode": ("", 'type = "nonlinear_mode"\n'),
    "limit cycle": ("", 'type = "limit_cycle"\n'),
}
WITHOUT_LOAD = {"nonlinear mode", "limit cycle"}
OVER_AMPLITUDE = {"amplitude sweep", "exact amplitude sweep", "diagram over the amplitude"}
# Refused combinations, and the key that the message names.
REFUSED = {
    **{(one, name): key for one in OVER_AMPLITUDE for name, key in (
        ("table of a term", "forcing.terms[1].amplitude_table"), ("table of the force", "forcing.amplitude_table"),
        ("periodic_stiffness", "analysis.type"))},
    **{(one, name): "analysis.outputs" for one in ("shooting", "motions") for name in ("units", "velocity", "frame")},
    **{(one, name): "analysis.outputs" for one in ("diagram", "diagram over the amplitude") for name in ("velocity", "frame")},
    ("diagram", "gyroscopic"): "structure.spin_speed",
}


@pytest.fixture(autouse=True)
def files(matrix, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    matrix("m.mtx", [[1.0, 0.0], [0.0, 1.0]])
    matrix("k.mtx", [[1.2, -0.1], [-0.1, 1.0]])
    matrix("c.mtx", [[0.1, 0.0], [0.0, 0.1]])
    matrix("slow.mtx", [[1e-3, 0.0], [0.0, 1e-3]])
    matrix("g.mtx", [[0.0, 0.1], [-0.1, 0.0]])
    (tmp_path / "table.csv").write_text("frequency_Hz,amplitude\n0.05,0.8\n0.2,1.2\n0.5,1.0\n")
    (tmp_path / "loads.csv").write_text("frequency_Hz,normal_load\n0.05,0.3\n0.2,0.5\n0.5,0.4\n")


def scene(feature, analysis, time=None, outputs=True):
    structure, contact, load, asked = FEATURES[feature]
    bases, text = ANALYSES[analysis] if time is None else (time, 'type = "forced_response"\n')
    amplitude = 0.03 if load == SHAKES else AMPLITUDE
    if analysis in OVER_AMPLITUDE and time is None:
        text = text.format(0.5 * amplitude, amplitude)
    varies = "frequency_from" in text or analysis in WITHOUT_LOAD
    frequency = "" if varies else f"frequency = {AT}\n"
    listed = f"outputs = {asked}\n" if asked and outputs else ""
    return (f'[structure]\ntype = "matrices"\nmass = "m.mtx"\nstiffness = "k.mtx"\ndamping = "c.mtx"\n{structure}'
            f"{contact}[forcing]\n{frequency}{load}[time]\n{bases}[analysis]\n{text}{listed}")


def exact(feature):
    """The motion that all others are compared with, whose own tests hold it to closed forms and to SciPy."""
    record = wb.run(scene(feature, "response", 'method = "exact"\n'))
    assert record.converged and record.summary["unstable_multipliers"] == 0
    return record


def first_output(record):
    return [name for name in record.outputs if name != "time_fraction"][0]


@pytest.mark.parametrize("feature", FEATURES)
@pytest.mark.parametrize("analysis", ANALYSES)
def test_each_analysis_has_the_motion_or_refuses_by_key(analysis, feature):
    text = scene(feature, analysis)
    if analysis in WITHOUT_LOAD or (analysis, feature) in REFUSED:
        with pytest.raises(wb.SceneError) as refusal:
            wb.run(text)
        message = str(refusal.value)
        assert REFUSED.get((analysis, feature), ": ") in message
        assert "expected" in message or "only with" in message or "does not belong" in message
        return
    record, reference = wb.run(text), exact(feature)
    assert record.converged, record.status
    largest = reference.summary["max_displacement_m"]
    if "diagram" in analysis:
        asked = bool(FEATURES[feature][3])
        expected = reference.outputs[first_output(reference)][0] / 1e3 if asked else reference.response["displacement_m"][0]
        assert record.section["displacement_m"][-1] == pytest.approx(expected, abs=1e-6 * largest)
    elif "sweep" in analysis:
        assert record.sweep["max_displacement_m"][-1] == pytest.approx(largest, rel=1e-6 if "exact" in analysis else 2e-3)
        assert record.sweep["unstable"][-1] == 0
    else:
        assert record.summary["max_displacement_m"] == pytest.approx(largest, rel=2e-3 if analysis == "response" else 1e-6)
    if FEATURES[feature][3] and analysis in ("response", "time stepping"):
        name = first_output(reference)
        np.testing.assert_allclose(record.outputs[name], reference.outputs[name], atol=2e-2 * np.ptp(reference.outputs[name]))


@pytest.mark.parametrize("feature", FEATURES)
def test_studies_and_comparisons_take_each(feature, tmp_path):
    table = wb.study(scene(feature, "response", 'method = "exact"\n'), {"forcing.frequency": [0.165, AT]}, output=tmp_path / "study").table
    assert table["max_displacement_m"][1] == pytest.approx(exact(feature).summary["max_displacement_m"], rel=1e-9)
    assert table["max_displacement_m"][0] != table["max_displacement_m"][1]
    rows = wb.compare(scene(feature, "response", outputs=False), pairs="fourier:fourier").table
    assert np.nanmin(rows["displacement_error"][rows["converged"] == 1.0]) < 1e-3


def test_statistics_are_displacements_in_si_units_whatever_the_output(tmp_path):
    """Record of a motion that has not converged in its periods."""
    keys = {"analysis.max_periods": 33, "analysis.recorded_periods": 64, "analysis.tolerance": 1e-12}
    tables = []
    for asked in ("row 2", "row 2 in mm", "velocity of row 2 in mm/s"):
        folder = tmp_path / str(len(tables))
        record = wb.run(scene("units", "time stepping"), keys | {"analysis.outputs": [asked], "structure.damping": "slow.mtx"}, output=folder)
        assert not record.converged
        tables.append((folder / "statistics.csv").read_text())
    assert "row 2" in tables[0]
    assert tables[1] == tables[0] and tables[2] == tables[0]
