"""A stiffness that varies in time between two degrees of freedom, against integration by SciPy and Meissner's closed form."""

import numpy as np
import pytest
import scipy.io
import scipy.linalg
from scipy.integrate import solve_ivp

import wavebalance as wb

MEAN, GROUND, DAMPING = 3.0, 0.4, 0.1  # N/m, N/m, N s/m, of masses of 1 and 0.5 kg
MASSES = np.array([1.0, 0.5])
HARMONICS, PHASES = [0.9, 0.35], [20.0, -65.0]
FREQUENCY = 0.21
SCENE = """
[structure]
type = "matrices"
mass = "m.mtx"
stiffness = "k.mtx"
damping = "c.mtx"
[[contact.pairs]]
law = "periodic_stiffness"
stiffness = 3.0
stiffness_harmonics = {harmonics}
{more}
dofs = [1, 2]
[forcing]
frequency = {frequency}
{load}
[time]
{time}
[analysis]
{analysis}
"""
BASES = 'trial = "fourier"\nweight = "fourier"\nfunctions = 127\nquadrature_points = 1024'
EXACT = 'method = "exact"'
LOAD = """[[forcing.terms]]
dofs = [1]
amplitude = 0.8
[[forcing.terms]]
harmonic = 0
dofs = [1, -2]
amplitude = 0.2"""
PHASED = f"stiffness_phases = {PHASES}"


@pytest.fixture(autouse=True)
def matrices(matrix, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    matrix("m.mtx", np.diag(MASSES).tolist())
    matrix("k.mtx", (GROUND * np.eye(2)).tolist())
    matrix("c.mtx", (DAMPING * np.array([[1.0, -0.5], [-0.5, 1.0]])).tolist())


def scene(harmonics=HARMONICS, more=PHASED, frequency=FREQUENCY, load=LOAD, time=EXACT,
          analysis='type = "forced_response"'):
    if "time_stepping" in analysis or "bifurcation" in analysis:
        time = ""
    return SCENE.format(harmonics=list(harmonics), more=more, frequency=frequency, load=load, time=time, analysis=analysis)


def stiffness(t, frequency, harmonics=HARMONICS, phases=PHASES):
    return MEAN + sum(k * np.cos((m + 1) * 2.0 * np.pi * frequency * t + np.radians(p))
                      for m, (k, p) in enumerate(zip(harmonics, phases)))


def rates(t, x, frequency, gap):
    """Time derivatives of the state of the two masses, independent of the program."""
    u = x[0] - x[1]
    force = stiffness(t, frequency) * (u - np.clip(u, -gap, gap))
    load = np.array([0.8 * np.cos(2.0 * np.pi * frequency * t) + 0.2, -0.2])
    damping = DAMPING * np.array([[1.0, -0.5], [-0.5, 1.0]])
    return np.r_[x[2:], (load - GROUND * x[:2] - damping @ x[2:] - force * np.array([1.0, -1.0])) / MASSES]


def integrated(state, frequency, gap, points=None):
    """One period: the state at its end, or states at instants."""
    found = solve_ivp(rates, (0.0, 1.0 / frequency), state, args=(frequency, gap), method="DOP853", rtol=1e-11,
                      atol=1e-13, t_eval=points)
    return found.y[:, -1] if points is None else found.y


def oracle(frequency=FREQUENCY, gap=0.0, points=256):
    """u over the periodic motion, by Newton's method on the map of a period, and its multipliers."""
    state = np.zeros(4)
    for _ in range(40):
        state = integrated(state, frequency, gap)
    for _ in range(4):
        h = 1e-4  # SciPy's steps across the gap differ by some 1e-11, which a shorter one magnifies
        slopes = [(integrated(state + h * e, frequency, gap) - integrated(state - h * e, frequency, gap)) / (2.0 * h)
                  for e in np.eye(4)]
        jacobian = np.column_stack(slopes)
        state = state + np.linalg.solve(np.eye(4) - jacobian, integrated(state, frequency, gap) - state)
    x = integrated(state, frequency, gap, np.arange(points) / points / frequency)
    return x[0] - x[1], np.linalg.eigvals(jacobian)


def displacement(record):
    return record.response["displacement_m"]


def leading(record):
    return complex(record.summary["leading_multiplier_real"], record.summary["leading_multiplier_imag"])


BACKLASH = PHASED + "\ngap = 0.06"  # which the motion leaves on both sides
STEPPING = 'type = "time_stepping"\ntolerance = 1e-9'
RESPONSE = 'type = "forced_response"\nstability = true'
SWEEP = 'type = "frequency_sweep"\nfrequency_from = 0.2\nfrequency_to = 0.215\nstability = true'


@pytest.mark.parametrize("gap", [0.0, 0.06])
def test_responses_and_their_multipliers_are_those_of_scipy(gap):
    expected, multipliers = oracle(gap=gap)
    assert gap == 0.0 or 0.1 < np.mean(np.abs(expected) < gap) < 0.9
    for time, analysis, apart in ((EXACT, RESPONSE, 1e-8), (BASES, RESPONSE, 1e-4), ("", STEPPING, 1e-8)):
        record = wb.run(scene(more=PHASED + f"\ngap = {gap}", time=time, analysis=analysis + "\noutput_points = 256"))
        assert record.converged, record.status
        assert np.abs(displacement(record) - expected).max() < apart * np.ptp(expected)
        assert abs(leading(record)) == pytest.approx(np.abs(multipliers).max(), rel=1e-5)
        assert not record.warnings


def test_a_square_wave_has_the_multipliers_of_meissners_equation(matrix):
    for name, value in (("m", 1.0), ("k", 0.3), ("c", 0.02)):
        matrix(f"{name}.mtx", [[value]])
    mean, step, odd = 0.7, 0.5, np.arange(1, 120, 2)
    harmonics = np.zeros(odd[-1])
    harmonics[odd - 1] = 4.0 * step / np.pi / odd * np.where(odd % 4 == 1, 1.0, -1.0)
    load = "load_dofs = [1]\namplitude = 0.1"

    def half(stiff, period):
        """The map of half a period, from its closed form."""
        rate = np.sqrt(stiff - 0.01**2)
        c, s = np.cos(rate * period / 2.0), np.sin(rate * period / 2.0) / rate
        return np.exp(-0.01 * period / 2.0) * np.array([[c + 0.01 * s, s], [-stiff * s, c - 0.01 * s]])

    found = []
    for frequency in (0.11, 0.25, 0.32, 0.45):
        text = scene(harmonics, "", frequency, load, analysis=RESPONSE).replace("stiffness = 3.0", f"stiffness = {mean}")
        record = wb.run(text.replace("dofs = [1, 2]", "dofs = [1]"))
        multipliers = np.linalg.eigvals(half(0.3 + mean + step, 1.0 / frequency) @ half(0.3 + mean - step, 1.0 / frequency))
        assert record.converged, record.status
        assert abs(leading(record)) == pytest.approx(np.abs(multipliers).max(), rel=1e-3)
        found.append(record.summary["unstable_multipliers"])
    assert found == [0, 0, 1, 0]


@pytest.mark.parametrize("exact", ["false", "true"])
def test_points_of_a_curve_are_responses(exact):
    record = wb.run(scene(more=BACKLASH, time=BASES, analysis=SWEEP + f"\nexact = {exact}\noutputs = [\"row 2\"]"))
    assert record.converged, record.status
    assert not any("signal" in name or "stiffness" in name for name in record.sweep)
    frequency = record.sweep["frequency_Hz"]
    point = len(frequency) // 2
    expected, multipliers = oracle(float(frequency[point]), gap=0.06)
    assert record.sweep["max_displacement_m"][point] == pytest.approx(expected.max(), rel=1e-3)
    assert record.sweep["unstable"][point] == np.sum(np.abs(multipliers) > 1.0)


def test_a_reduced_structure_has_rows_of_its_own_alone(tmp_path, matrix):
    for name in ("m", "k", "c"):
        two = scipy.io.mmread(f"{name}.mtx").toarray()
        matrix(f"{name}.mtx", scipy.linalg.block_diag(two, [[2.0]]).tolist())
    expected = oracle(gap=0.06)[0]
    for kept in ("", "\nkept_modes = 1"):
        text = scene(more=BACKLASH).replace('damping = "c.mtx"', 'damping = "c.mtx"' + kept)
        keys = {"analysis.output_points": 256, "analysis.motion_points": 16, "analysis.outputs": ["row 2", "row 3"]}
        record = wb.run(text, keys, output=tmp_path / f"out{len(kept)}")
        assert np.abs(displacement(record) - expected).max() < 1e-8 * np.ptp(expected)
        assert scipy.io.mmread(tmp_path / f"out{len(kept)}" / "motion.mtx").shape[0] == 3


def test_a_study_and_a_diagram_take_it(tmp_path):
    expected = oracle(gap=0.06)[0]
    record = wb.run(scene(more=BACKLASH))
    table = wb.study(scene(more=BACKLASH), {"contact.pairs[1].stiffness": [3.0, 4.0]}, output=tmp_path / "study").table
    assert table["max_displacement_m"][0] == pytest.approx(displacement(record).max(), rel=1e-2)
    assert table["max_displacement_m"][1] != table["max_displacement_m"][0]
    diagram = 'type = "bifurcation_diagram"\nfrequency_from = 0.21\nfrequency_to = 0.212\nvalues = 2\nexact_curve = false'
    section = wb.run(scene(more=BACKLASH, analysis=diagram)).section
    assert section["displacement_m"][0] == pytest.approx(expected[0], abs=1e-6)


@pytest.mark.parametrize("keys, key, part", [
    ({"analysis.type": "amplitude_sweep", "analysis.amplitude_from": 0.1, "analysis.amplitude_to": 0.2}, "analysis.type", "sweep over the frequency"),
    ({"structure.loss_factor": 0.1}, "structure.loss_factor", "periodic stiffness"),
    ({"contact.pairs[1].side": "both"}, "contact.pairs[1].side", "act twice"),
    ({"contact.pairs[1].stiffness_phases": [1.0]}, "contact.pairs[1].stiffness_phases", "one for each"),
    ({"contact.pairs[1].stiffness_harmonics": []}, "contact.pairs[1].stiffness_harmonics", "a list of numbers in N/m"),
    ({"contact.pairs[1].gap": -1.0}, "contact.pairs[1].gap", "at least 0"),
    ({"time.functions": 3}, "contact.pairs[1].stiffness_harmonics", "up to 1"),
    ({"contact.pairs[1].tangent": [2]}, "contact.pairs[1].tangent", "no friction"),
])
def test_what_does_not_belong_to_it_is_refused_by_key(keys, key, part):
    with pytest.raises(wb.SceneError) as refusal:
        wb.run(scene(more=BACKLASH, time=BASES), keys)
    assert key in str(refusal.value) and part in str(refusal.value)


@pytest.mark.parametrize("analysis", ["nonlinear_mode", "limit_cycle"])
def test_motions_without_a_load_have_no_period_for_it(analysis):
    text = scene(more=BACKLASH, load="amplitude = 0.0", time="", analysis=f'type = "{analysis}"')
    with pytest.raises(wb.SceneError) as refusal:
        wb.run(text.replace('damping = "c.mtx"', "").replace("[forcing]\nfrequency = 0.21\namplitude = 0.0\n", ""))
    assert "period" in str(refusal.value)
