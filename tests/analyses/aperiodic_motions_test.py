"""Time stepping of what does not repeat: statistics with their errors, a Poincare section, a spectrum and what kind of motion it is."""

import csv
import math

import numpy as np
import pytest
from hammer_flights import GAP, LOAD, MASS, REBOUND, STIFFNESS, STRUCTURE, Hammer, mean_with_error

STEPPING = '[analysis]\ntype = "time_stepping"\nmax_periods = 300\n'


def columns(file):
    with file.open() as text:
        rows = list(csv.DictReader(text))
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}


@pytest.fixture
def hammer(matrix):
    matrix("m.mtx", [[MASS]])
    matrix("k.mtx", [[STIFFNESS]])


@pytest.fixture(scope="module")
def long_motion():
    """2500 periods of the chaotic hammer by exact flights: mean squares, impacts and their energies of each."""
    hammer = Hammer(20.0)
    hammer.section(200, 0)
    squares, counts, impulses, energies = [], [], [], []
    for _ in range(2500):
        speeds, displacement = hammer.period_on(64)
        squares.append(np.mean(displacement**2))
        counts.append(len(speeds))
        impulses.append(MASS * (1.0 + REBOUND) * sum(speeds))
        energies.append(0.5 * MASS * (1.0 - REBOUND**2) * sum(speed**2 for speed in speeds))
    return {"squares": squares, "counts": counts, "impulses": impulses, "energies": energies}


def test_statistics_of_a_chaotic_hammer_are_those_of_a_long_motion_by_flights(run, hammer, long_motion):
    record = run(STRUCTURE + STEPPING)
    assert record.code == 3  # it is a result, but no periodic motion
    found = record.summary
    assert (found["status"], found["motion_kind"], found["converged"]) == ("aperiodic", "chaotic", False)
    assert not found["warnings"]
    assert "Over the next 512 periods contact 1 vibrates by" in record.text
    assert found["curve_residual"] > 0.1  # of the size of the section, which no closed curve is near
    assert "second_frequency_Hz" not in found
    square, error = mean_with_error(long_motion["squares"])
    rms = math.sqrt(square)
    assert found["rms_displacement_m"] == pytest.approx(rms, abs=found["rms_displacement_error_m"] + 0.5 * error / rms)
    for name, values in {"impacts": "counts", "impact_energy": "energies"}.items():
        unit = "_J" if name == "impact_energy" else ""
        mean, error = mean_with_error(long_motion[values])
        assert found[name + unit] == pytest.approx(mean, abs=found[f"{name}_error{unit}"] + error), name
    mean, error = mean_with_error(long_motion["impulses"])
    assert found["mean_contact_force_N"] == pytest.approx(mean * LOAD, abs=found["mean_contact_force_error_N"] + error * LOAD)
    # A significant error: none is above 5 % of its value, and none vanishes.
    assert 0.0 < found["impacts_error"] < 0.05 * found["impacts"]
    assert found["max_displacement_m"] == pytest.approx(GAP, rel=1e-3)


def test_its_lyapunov_exponent_is_that_of_two_motions_by_flights(run, hammer):
    found = run(STRUCTURE + STEPPING).summary
    growth, distance = [], 1e-9
    one = Hammer(20.0)
    one.section(200, 0)
    other = Hammer(20.0, one.u + distance, one.v)
    for _ in range(900):
        one.period_on()
        other.period_on()
        apart = math.hypot(other.u - one.u, (other.v - one.v) / one.w0)
        growth.append(math.log(apart / distance))
        other.u = one.u + (other.u - one.u) * distance / apart
        other.v = one.v + (other.v - one.v) * distance / apart
    mean, error = mean_with_error(growth[100:])
    assert found["lyapunov_exponent"] == pytest.approx(mean, abs=found["lyapunov_exponent_error"] + error)
    assert found["lyapunov_exponent"] > 5.0 * found["lyapunov_exponent_error"]


def test_section_and_spectrum_belong_to_the_same_motion(run, hammer):
    record = run(STRUCTURE + STEPPING)
    section = columns(record.folder / "section.csv")
    assert len(section["period"]) == record.summary["recorded_periods"] == 512
    # Each point of the section leads to the next one by exact flights.
    for i in (0, 100, 400):
        hammer = Hammer(20.0, section["contact_1_displacement_m"][i], section["contact_1_velocity_m_per_s"][i])
        hammer.period_on()
        assert hammer.u == pytest.approx(section["contact_1_displacement_m"][i + 1], abs=1e-7 * GAP)
    spectrum = columns(record.folder / "spectrum.csv")
    distance = spectrum["frequency_Hz"][1] - spectrum["frequency_Hz"][0]
    variance = np.sum(spectrum["contact_1_density_m2_per_Hz"]) * distance
    assert variance == pytest.approx(record.summary["rms_vibration_m"] ** 2, rel=0.02)
    at = np.argmax(spectrum["contact_1_density_m2_per_Hz"])
    assert spectrum["frequency_Hz"][at] % LOAD == pytest.approx(0.0, abs=distance)
    assert "chaotic" in record.page and "± " in record.page


def oscillator(matrix, damping):
    matrix("m.mtx", [[1.0]])
    matrix("k.mtx", [[1.0]])
    matrix("c.mtx", [[damping]])
    return """
[structure]
type = "matrices"
mass = "m.mtx"
stiffness = "k.mtx"
damping = "c.mtx"
contact_dofs = [1]
[contact]
law = "rigid"
restitution = 0.5
gap = 100.0
[forcing]
load_dofs = [1]
amplitude = 1.0
frequency = 0.0983631643
[analysis]
type = "time_stepping"
max_periods = 40
"""


def test_two_frequencies_without_damping_are_quasi_periodic_with_their_rms(run, matrix):
    """From rest: 1 / (1 - w^2) (cos w t - cos t), so that the mean square is twice half the square of that amplitude."""
    found = run(oscillator(matrix, 0.0)).summary
    assert (found["status"], found["motion_kind"]) == ("aperiodic", "quasi_periodic")
    assert found["lyapunov_exponent"] == pytest.approx(0.0, abs=1e-3)
    amplitude = 1.0 / (1.0 - (2.0 * math.pi * 0.0983631643) ** 2)
    assert found["rms_displacement_m"] == pytest.approx(amplitude, rel=1e-3)
    assert found["rms_displacement_m"] == pytest.approx(amplitude, abs=max(1e-3, found["rms_displacement_error_m"]))


@pytest.mark.parametrize(("decay", "kind"), [(0.05, "settling"), (0.018, "not_known")])
def test_what_has_not_settled_yet_is_not_called_aperiodic(run, matrix, decay, kind):
    """A free vibration loses c T / 2 of its logarithm in a period, which is the exponent."""
    record = run(oscillator(matrix, 2.0 * decay * 0.0983631643))
    found = record.summary
    assert (found["status"], found["motion_kind"]) == ("iteration_limit", kind)
    assert found["lyapunov_exponent"] == pytest.approx(-decay, rel=0.05)
    assert any("decayed yet" if kind == "settling" else "still transient" in one for one in found["warnings"])
    assert record.code == 3


def test_a_motion_that_repeats_has_no_record_and_0_asks_for_none(run, hammer):
    settled = run(STRUCTURE + STEPPING, set=["forcing.terms[1].amplitude=38.0"])
    assert settled.code == 0, settled.errors
    assert "motion_kind" not in settled.summary and not (settled.folder / "section.csv").exists()
    none = run(STRUCTURE + STEPPING, set=["analysis.recorded_periods=0"])
    assert none.summary["status"] == "iteration_limit" and "statistics" not in none.summary


def test_too_few_periods_for_batches_are_refused_by_key(run, hammer):
    record = run(STRUCTURE + STEPPING, set=["analysis.recorded_periods=12"])
    assert record.code == 2
    assert "recorded_periods" in record.errors and "12" in record.errors and "at least 40" in record.errors


def test_a_study_keeps_the_statistics(command, tmp_path, hammer):
    (tmp_path / "scene.toml").write_text(STRUCTURE + STEPPING)
    (tmp_path / "study.toml").write_text(
        'scene = "scene.toml"\nquantity = "impact_energy_J"\n[[parameters]]\nkey = "forcing.terms[1].amplitude"\nvalues = [20.0, 23.0]\n')
    command("study", "study.toml", "--output", "out")
    with (tmp_path / "out" / "study.csv").open() as text:
        rows = list(csv.DictReader(text))
    assert [row["status"] for row in rows] == ["aperiodic"] * 2
    assert all(float(row["impact_energy_J"]) > 0.0 and float(row["impact_energy_error_J"]) > 0.0 for row in rows)


RATTLE = """
[structure]
type = "matrices"
mass = "m.mtx"
stiffness = "k.mtx"
damping = "c.mtx"
[contact]
law = "linear"
stiffness = 30.0
gap = 0.0
[[contact.pairs]]
dofs = [1]
[[contact.pairs]]
dofs = [1]
law = "coulomb"
friction = 0.1
normal_load = 0.2
tangential_stiffness = 5.0
wear_coefficient = 1e-3
[forcing]
load_dofs = [1]
amplitude = 1.0
frequency = 0.45
[analysis]
type = "time_stepping"
max_periods = 150
output_points = 256
"""


def rattle_ensemble(count=300, settling=50, periods=25, steps=500):
    """Mean square of the displacement and friction work per period of many oscillators from random states, by Runge-Kutta steps."""
    random = np.random.default_rng(20140817)
    w, step, limit, stiffness = 2.0 * np.pi * 0.45, 1.0 / 0.45 / steps, 0.02, 5.0
    u, v, slider = random.normal(0.0, 0.3, count), random.normal(0.0, 0.3, count), np.zeros(count)

    def rate(t, u, v, slider):
        friction = np.clip(stiffness * (u - slider), -limit, limit)
        return v, np.cos(w * t) - 0.2 * v - u - 30.0 * np.maximum(0.0, u) - friction

    squares, work = np.zeros(count), np.zeros(count)
    for k in range((settling + periods) * steps):
        t = k * step
        a = rate(t, u, v, slider)
        b = rate(t + 0.5 * step, u + 0.5 * step * a[0], v + 0.5 * step * a[1], slider)
        c = rate(t + 0.5 * step, u + 0.5 * step * b[0], v + 0.5 * step * b[1], slider)
        d = rate(t + step, u + step * c[0], v + step * c[1], slider)
        u = u + step / 6.0 * (a[0] + 2.0 * b[0] + 2.0 * c[0] + d[0])
        v = v + step / 6.0 * (a[1] + 2.0 * b[1] + 2.0 * c[1] + d[1])
        moved = np.clip(slider, u - limit / stiffness, u + limit / stiffness)
        if k >= settling * steps:
            squares += u**2 / (periods * steps)
            work += limit * np.abs(moved - slider) / periods
        slider = moved
    return [(values.mean(), 2.0 * values.std(ddof=1) / np.sqrt(count)) for values in (squares, work)]


def test_friction_beside_a_stop_has_the_work_and_the_wear_of_an_ensemble(run, matrix):
    matrix("m.mtx", [[1.0]])
    matrix("k.mtx", [[1.0]])
    matrix("c.mtx", [[0.2]])
    found = run(RATTLE).summary
    assert found["motion_kind"] == "chaotic", found["status"]
    (square, square_error), (work, work_error) = rattle_ensemble()
    rms = math.sqrt(square)
    assert found["rms_displacement_m"] == pytest.approx(rms, abs=found["rms_displacement_error_m"] + 0.5 * square_error / rms)
    assert found["friction_work_J"] == pytest.approx(work, abs=found["friction_work_error_J"] + work_error)
    assert found["wear_m3"] == pytest.approx(1e-3 * 0.2 * found["friction_work_J"] / 0.02, rel=1e-5)
    assert found["wear_error_m3"] == pytest.approx(1e-2 * found["friction_work_error_J"], rel=1e-2)


def tube(matrix, recorded=64):
    """A tube by two modes along y and two along z, which lift and drag press against two baffles, where it rubs along y."""
    matrix("m.mtx", np.eye(4))
    matrix("c.mtx", np.diag([0.72, 1.99, 0.72, 1.99]))
    matrix("k.mtx", np.diag([1300.0, 9870.0, 1300.0, 9870.0]))
    contacts, dofs = "", "dofs = [1, 2, 3, 4]\n"
    for first, second in ((0.424, 0.709), (0.78, 0.0)):
        y, z = f"[{first}, {second}, 0.0, 0.0]\n", f"[0.0, 0.0, {first}, {second}]\n"
        contacts += f"[[contact.pairs]]\n{dofs}coefficients = {z}tangent = [1, 2, 3, 4]\ntangent_coefficients = {y}"
        contacts += f'[[contact.pairs]]\n{dofs}coefficients = {y}side = "both"\nlaw = "linear"\nstiffness = 1e6\ngap = 2e-4\n'
    return f"""
[structure]
type = "matrices"
mass = "m.mtx"
stiffness = "k.mtx"
damping = "c.mtx"
[contact]
law = "coulomb"
friction = 0.3
normal_stiffness = 1e6
tangential_stiffness = 2e4
normal_gap = 2e-4
wear_coefficient = 2e-14
{contacts}[forcing]
frequency = 20.0
[[forcing.terms]]
harmonic = 0
dofs = [3]
amplitude = 4.9
[[forcing.terms]]
{dofs}coefficients = [3.4, 3.0, 0.68, 0.6]
amplitude = 1.0
[time]
trial = "fourier"
weight = "fourier"
functions = 31
quadrature_points = 256
[analysis]
type = "forced_response"
recorded_periods = {recorded}
"""


def test_a_response_that_does_not_exist_is_the_aperiodic_motion_with_its_statistics(run, matrix):
    record = run(tube(matrix))
    found = record.summary
    assert record.code == 3
    assert (found["status"], found["motion_kind"], found["converged"]) == ("aperiodic", "chaotic", False)
    assert (found["analysis"], found["solved_by"], found["recorded_periods"]) == ("forced_response", "time_stepping", 64)
    assert 0.0 < found["wear_error_m3"] < found["wear_m3"] and found["friction_work_J"] > 0.0
    for name in ("statistics.csv", "section.csv", "spectrum.csv", "response.svg"):
        assert (record.folder / name).exists(), name
    assert "more analysis.recorded_periods" in record.errors


def test_a_response_that_does_not_exist_is_recorded_as_long_as_some_seconds_allow(run, matrix):
    record = run(tube(matrix, recorded=2000))
    assert record.summary["status"] == "aperiodic" and 64 < record.summary["recorded_periods"] < 2000
    assert any('analysis.type = "time_stepping" records all' in warning for warning in record.summary["warnings"])


def test_a_response_without_a_record_ends_as_before(run, matrix):
    found = run(tube(matrix, recorded=0)).summary
    assert found["status"] != "aperiodic" and "statistics" not in found


def test_an_unstable_response_names_the_analysis_of_the_motion_that_occurs(run, hammer):
    found = run(STRUCTURE + '[analysis]\ntype = "forced_response"\n', set=["forcing.terms[1].amplitude=23.0"]).summary
    assert found["unstable_multipliers"] == 1
    assert any("time_stepping" in one and "max_periods = 200" in one for one in found["warnings"])
