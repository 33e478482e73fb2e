"""Curves over frequency, amplitude and energy: they go on to where they were to end, and list what lies on them."""

import csv
import math
import shutil

import pytest

ISOLATOR = """
[structure]
type = "matrices"
mass = "m.mtx"
stiffness = "k.mtx"
damping = "c.mtx"
contact_dofs = [1]
[contact]
law = "clearance"
stiffness = 2.5e5
gap = 5.157894736842105e-3
[[forcing.terms]]
kind = "base_acceleration"
dofs = [1]
amplitude = 9.81
[time]
trial = "fourier"
weight = "fourier"
functions = 63
quadrature_points = 256
[analysis]
type = "frequency_sweep"
frequency_from = 5
frequency_to = 60
stability = false
"""

MODE = """
[structure]
type = "matrices"
mass = "m.mtx"
stiffness = "k.mtx"
contact_dofs = [1]
[contact]
{law}
[analysis]
type = "nonlinear_mode"
stability = false
{analysis}
"""


@pytest.fixture
def isolator(matrix):
    """A mass of 5 kg on a spring of 12 Hz with 5 % damping between stops, shaken with 1 g."""
    stiffness = 5.0 * (2.0 * math.pi * 12.0) ** 2
    matrix("m.mtx", [[5.0]])
    matrix("k.mtx", [[stiffness]])
    matrix("c.mtx", [[2.0 * 0.05 * math.sqrt(5.0 * stiffness)]])
    return ISOLATOR


@pytest.fixture
def one_mass(matrix):
    """A mass of 1 kg on a spring."""

    def make(stiffness):
        matrix("m.mtx", [[1.0]])
        matrix("k.mtx", [[stiffness]])

    return make


def test_a_curve_passes_two_samples_that_graze_together_and_come_back(run, isolator):
    # With an even number of points two reach the gaps of a symmetric law together.
    record = run(isolator)
    assert record.code == 0 and record.summary["status"] == "reached_end"
    assert record.summary["points"] < 2000
    low, high = sorted(record.summary["turning_points_Hz"])[0], sorted(record.summary["turning_points_Hz"])[-1]
    assert low == pytest.approx(13.5, abs=1.5) and 20.0 < high < 30.0


@pytest.mark.parametrize("stiffness, energy, frequency", [(5.0, 4.0, 0.2335633), (1.0, 4.0, None)])
def test_a_mode_reaches_the_energy_that_is_asked_for_at_any_frequency(run, one_mass, stiffness, energy, frequency):
    # A mass between two stops, free: closed form.
    one_mass(1.0)
    law = f'law = "clearance"\nstiffness = {stiffness}\ngap = 0.5'
    record = run(MODE.format(law=law, analysis=f"harmonics = 63\nenergy_ratio = {energy}"))
    amplitude = math.sqrt(energy)  # over the gap, without a stop
    fast = math.sqrt(1.0 + stiffness)
    rest = stiffness / (1.0 + stiffness)  # over the gap, where stop and spring balance
    closed = 2.0 / fast * math.atan2(math.sqrt(amplitude**2 - 1.0) / fast, 1.0 - rest)
    expected = 1.0 / (4.0 * math.asin(1.0 / amplitude) + 2.0 * closed)
    assert frequency is None or expected == pytest.approx(frequency, rel=1e-6)
    assert record.code == 0 and record.summary["status"] == "converged"
    assert record.summary["frequency_Hz"] == pytest.approx(expected, rel=1e-4)


def test_a_curve_of_energies_ends_at_its_energy_and_not_at_a_frequency_that_nobody_gave(run, one_mass):
    one_mass(10.0)
    law = 'law = "linear"\nstiffness = 50.0\ngap = 0.01'
    record = run(MODE.format(law=law, analysis="harmonics = 15\nlargest_energy = 100.0\npoints = 50"))
    assert record.code == 0 and record.summary["status"] == "converged"
    assert record.summary["largest_energy_ratio"] >= 100.0


def test_a_rigid_mode_reaches_the_energy_that_is_asked_for(run, one_mass):
    one_mass(10.0)
    record = run(MODE.format(law='law = "rigid"\ngap = 0.01', analysis="harmonics = 15\nenergy_ratio = 9.0"))
    assert record.code == 0 and record.summary["status"] == "converged"
    assert record.summary["energy_ratio"] == pytest.approx(9.0, rel=1e-6) and record.summary["frequency_ratio"] > 1.3


def test_a_mode_that_was_to_end_at_a_frequency_says_so_and_what_helps(run, one_mass):
    one_mass(1.0)
    law = 'law = "clearance"\nstiffness = 5.0\ngap = 0.5'
    record = run(MODE.format(law=law, analysis="harmonics = 15\nenergy_ratio = 4.0\nlast_frequency_ratio = 1.2"))
    assert record.code == 3
    assert record.summary["status"].startswith("ended at frequency ratio 1.2")
    assert "a higher analysis.last_frequency_ratio" in record.errors


SPRING = """
[structure]
type = "matrices"
mass = "m.mtx"
stiffness = "m.mtx"
stiffness_damping = 0.05
contact_dofs = [1]
[contact]
law = "cubic"
cubic_stiffness = 1.0
[forcing]
load_dofs = [1]
amplitude = 0.3
frequency = {frequency}
[time]
trial = "fourier"
weight = "fourier"
functions = 15
quadrature_points = 64
[analysis]
{analysis}
"""


@pytest.fixture
def motions_of_spring(run, matrix, tmp_path):
    """Three motions of a hardening spring at 0.3 Hz, on the upper branch, the unstable one and the lower branch."""
    matrix("m.mtx", [[1.0]])
    steps = 'type = "frequency_sweep"\nfrequency_from = 0.1\nfrequency_to = 0.5\nstability = false\nmotion_at = [0.3]'
    record = run(SPRING.format(frequency=0.3, analysis=steps))
    assert record.code == 0
    shutil.copytree(record.folder, tmp_path / "starts")
    return [tmp_path / "starts" / f"motion_0.3Hz_{number}.csv" for number in (1, 2, 3)]


def test_an_amplitude_sweep_starts_near_a_motion(run, motions_of_spring):
    scene = SPRING.format(frequency=0.3, analysis='type = "amplitude_sweep"\namplitude_from = 0.3\namplitude_to = 0.31')
    largest = []
    for start in motions_of_spring:
        record = run(scene, "--start-from", start)
        assert record.code == 0, record.errors
        with open(record.folder / "sweep.csv") as file:
            largest.append(float(next(csv.DictReader(file))["max_displacement_m"]))
        assert any("was not searched for" in text for text in record.summary["warnings"])
    assert largest[0] > 1.02 * largest[1] and largest[1] > 1.02 * largest[2]


def test_a_sweep_whose_motions_are_all_unstable_has_a_warning(run, motions_of_spring):
    scene = SPRING.format(frequency=0.3, analysis='type = "frequency_sweep"\nfrequency_from = 0.3\nfrequency_to = 0.31')
    for number, start in enumerate(motions_of_spring):
        warnings = run(scene, "--start-from", start).summary["warnings"]
        assert any("All motions of the curve are unstable" in text for text in warnings) == (number == 1)


def test_an_exact_curve_of_a_bar_with_fast_modes_begins_and_ends_soon(run):
    """Its fastest modes decay within a thousandth of the period, behind a contact that begins after t = 0."""
    record = run("""
[structure]
type = "bar"
youngs_modulus = 70e9
density = 2700.0
area = 25e-4
length = 1.0
elements = 25
stiffness_damping = 1e-4
[contact]
law = "linear"
stiffness = 1e9
gap = 1e-3
[forcing]
amplitude = 250e3
frequency = 150.0
[time]
trial = "fourier"
weight = "fourier"
functions = 64
[analysis]
type = "frequency_sweep"
exact = true
frequency_from = 1000.0
frequency_to = 1500.0
""", timeout=20)
    assert record.summary["status"] == "reached_end"
    assert record.summary["largest_error_of_displacement"] < 1e-9
    assert record.summary["frequency_at_largest_vibration_Hz"] == pytest.approx(1153.5, abs=2.0)
