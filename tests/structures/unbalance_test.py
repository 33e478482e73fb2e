"""kind = "unbalance" of [[forcing.terms]]: m e (h w)^2, turning in a plane of two rows or along one."""

import numpy as np
import pytest
from structure_scenes import BAR, displacements, distance, refused, terms

import wavebalance as wb

MASS, STIFFNESS, DAMPING, UNBALANCE = 2.0, 8e3, 6.0, 3e-3  # kg, N/m, N s/m, kg m
ROTOR = """
[structure]
type = "matrices"
mass = "m.mtx"
stiffness = "k.mtx"
damping = "c.mtx"
contact_dofs = [1]
[contact]
{contact}
[forcing]
frequency = 9.0
[[forcing.terms]]
{term}
[time]
{time}
[analysis]
{analysis}
"""
TURNING = f'kind = "unbalance"\ndofs = [1, 2]\namplitude = {UNBALANCE}\nphase = 25.0'
BASES = 'trial = "fourier"\nweight = "fourier"\nfunctions = 31'
RESPONSE = 'type = "forced_response"\noutput_points = 64\noutputs = [1, 2]'
SWEEP = 'type = "frequency_sweep"\nfrequency_from = 6.0\nfrequency_to = 14.0'
STOP = 'law = "linear"\nstiffness = 2e4\ngap = 2e-3'


@pytest.fixture(autouse=True)
def matrices(matrix, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name, value in (("m", MASS), ("k", STIFFNESS), ("c", DAMPING)):
        matrix(f"{name}.mtx", [[value, 0.0], [0.0, value]])


def rotor(term=TURNING, analysis=RESPONSE, contact='law = "none"', time=BASES):
    return ROTOR.format(term=term, analysis=analysis, contact=contact, time=time)


def solved(scene):
    record = wb.run(scene)
    assert record.converged, record.status
    return record


def whirl(frequency, harmonic=1):
    """The complex amplitude along the first row; the second is a quarter of a turn later."""
    omega = 2.0 * np.pi * harmonic * frequency
    return UNBALANCE * omega**2 / (STIFFNESS - MASS * omega**2 + 1j * omega * DAMPING)


def two_forces(frequency):
    """The same load at one frequency, in newtons."""
    size = UNBALANCE * (2.0 * np.pi * frequency) ** 2
    return (f"dofs = [1]\namplitude = {size!r}\nphase = 25.0\n"
            f"[[forcing.terms]]\ndofs = [2]\namplitude = {size!r}\nphase = -65.0")


@pytest.mark.parametrize("rows, harmonic, turn", [("[1, 2]", 1, 1), ("[1, -2]", 1, -1), ("[1, 2]", 2, 1), ("[1]", 1, 0)])
def test_a_rotor_whirls_at_the_radius_of_the_closed_form_the_way_its_rows_say(rows, harmonic, turn):
    term = TURNING.replace("[1, 2]", rows) + f"\nharmonic = {harmonic}"
    record = solved(rotor(term))
    time = np.asarray(record.outputs["time_fraction"])
    moved = whirl(9.0, harmonic) * np.exp(1j * (2.0 * np.pi * harmonic * time + np.radians(25.0)))
    columns = [name for name in record.outputs if name != "time_fraction"]
    np.testing.assert_allclose(record.outputs[columns[0]], moved.real, rtol=0.0, atol=1e-12 * abs(moved[0]))
    np.testing.assert_allclose(record.outputs[columns[1]], turn * moved.imag, rtol=0.0, atol=1e-12 * abs(moved[0]))


@pytest.mark.parametrize("exact", ["false", "true"])
def test_a_curve_over_the_frequency_has_a_load_that_grows_with_its_square(exact):
    record = solved(rotor(analysis=SWEEP + f"\nexact = {exact}"))
    assert record.converged
    radius = np.abs([whirl(one) for one in record.sweep["frequency_Hz"]])
    assert len(radius) > 10
    np.testing.assert_allclose(record.sweep["rms_displacement_m"], radius / np.sqrt(2.0), rtol=1e-9)


@pytest.mark.parametrize("analysis, time, apart", [
    (RESPONSE, BASES, 1e-10), (RESPONSE, 'method = "exact"', 1e-10), ('type = "time_stepping"', "", 1e-8)])
def test_a_rotor_that_meets_a_stop_moves_as_under_two_forces_of_that_size(analysis, time, apart):
    unbalanced = solved(rotor(TURNING, analysis, STOP, time))
    forced = solved(rotor(two_forces(9.0), analysis, STOP, time))
    assert unbalanced.summary["contact_fraction"] > 0.1
    assert distance(displacements(unbalanced), displacements(forced)) <= apart


def test_an_exact_curve_with_a_stop_has_the_motions_of_two_forces_at_its_points():
    curve = solved(rotor(analysis=SWEEP + "\nexact = true", contact=STOP))
    touching = np.flatnonzero(np.asarray(curve.sweep["max_contact_force_N"]) > 1.0)
    for point in touching[[0, len(touching) // 2]]:
        frequency = float(curve.sweep["frequency_Hz"][point])
        scene = rotor(two_forces(frequency), 'type = "forced_response"', STOP, 'method = "exact"')
        forced = solved(scene.replace("frequency = 9.0", f"frequency = {frequency!r}"))
        assert curve.sweep["max_displacement_m"][point] == pytest.approx(forced.summary["max_displacement_m"], rel=1e-6)


def test_an_amplitude_sweep_is_over_mass_times_eccentricity(tmp_path):
    analysis = 'type = "amplitude_sweep"\namplitude_from = 1e-3\namplitude_to = 4e-3'
    record = wb.run(rotor(analysis=analysis, contact=STOP))
    assert record.converged and next(iter(record.sweep)) == "amplitude_kg_m"
    record.write(tmp_path / "out")
    assert "at an amplitude of 0.004 kg m" in (tmp_path / "out" / "report.html").read_text()
    assert record.summary["amplitude_at_max_displacement_kg_m"] == pytest.approx(4e-3, rel=1e-9)


@pytest.mark.parametrize("term, key", [
    (TURNING.replace("dofs = [1, 2]\n", ""), "dofs"),
    (TURNING.replace("[1, 2]", "[1, 2, -1]"), "dofs"),
    (TURNING.replace("phase = 25.0", "harmonic = 0"), "harmonic"),
    (TURNING.replace("phase = 25.0", 'samples = "load.csv"'), "samples"),
    (TURNING.replace(f"amplitude = {UNBALANCE}\n", ""), "amplitude"),
])
def test_an_unbalance_without_a_plane_or_a_turn_is_refused_by_key(term, key):
    refused(rotor(term), f"forcing.terms[1].{key}")


def test_a_bar_has_no_plane_to_turn_in():
    refused(BAR + terms('kind = "unbalance"\namplitude = 1e-3'), "forcing.terms[1].kind")
