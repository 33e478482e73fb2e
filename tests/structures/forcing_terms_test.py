"""[[forcing.terms]]: static loads, harmonics with phases, samples and moving bases."""

import tomllib

import numpy as np
import pytest
import scipy.integrate
from structure_scenes import (BAR, CHAIN, CHAIN_MASS, CHAIN_STIFFNESS, MATRICES, ROD, changed, displacements, distance,
                              forces, modal_damping, refused, solved, stepped, terms)

import wavebalance as wb

# The chain with its support as a further row, the first, whose mass couples to the next.
HELD_STIFFNESS = 1e6 * (np.diag([1.0, 2.0, 2.0, 1.0]) - np.eye(4, k=1) - np.eye(4, k=-1))
HELD_MASS = 2.0 * np.eye(4) + 0.3 * (np.eye(4, k=1) * [0, 1, 0, 0] + np.eye(4, k=-1) * [1, 0, 0, 0])
FINE = {"analysis.output_points": 512, "structure.modal_damping": 0.05}
UNLOADED = {"forcing.amplitude": 0.0}


@pytest.fixture(autouse=True)
def files(chain_files, matrix):
    matrix("kb.mtx", HELD_STIFFNESS.tolist())
    matrix("mb.mtx", HELD_MASS.tolist())
    return chain_files


def chain(*each):
    """The chain with these terms."""
    return changed(CHAIN, ("[time]", terms(*each) + "[time]"))


def test_terms_need_no_amplitude_beside_them():
    without = changed(CHAIN, ("amplitude = 100.0 ", ""), ("load_dofs = [3] ", ""))
    refused(without, "forcing.amplitude")
    scene = changed(without, ("[time]", terms("dofs = [3]\namplitude = 40.0") + "[time]"))
    assert tomllib.loads(wb.complete(scene))["forcing"].get("amplitude", 0.0) == 0.0
    assert distance(displacements(solved(scene)), displacements(solved(CHAIN, {"forcing.amplitude": 40.0}))) <= 1e-12


def test_a_static_load_harmonics_and_phases_give_the_motion_of_time_stepping():
    scene = chain("harmonic = 0\namplitude = 150.0", "harmonic = 2\namplitude = 60.0\nphase = 35.0",
                  "dofs = [-2]\namplitude = 40.0\nphase = -90.0")
    balance = solved(scene, {**FINE, "time.functions": 127, "time.quadrature_points": 1024})
    assert forces(balance).max() > 0.0
    assert distance(displacements(balance), displacements(stepped(scene, FINE))) <= 1e-3


@pytest.mark.parametrize("each, overrides, plain", [
    (["amplitude = 60.0", "dofs = [3]\namplitude = 40.0"], UNLOADED, {}),
    (['kind = "base_acceleration"\ndofs = [1, 2, 3]\namplitude = 30.0'], UNLOADED,
     {"forcing.load_dofs": [1, 2, 3], "forcing.amplitude": -60.0}),
], ids=["the first load in other words", "an accelerated base is the masses times it"])
def test_terms_give_the_motion_of_the_first_load(each, overrides, plain):
    assert distance(displacements(solved(chain(*each), overrides)), displacements(solved(CHAIN, plain))) <= 1e-12


def test_a_moving_base_gives_its_forces_on_the_rest():
    # x_b = 1e-4 cos(w t) at the support: forces 1e6 x_b, beta 1e6 x_b' and -0.3 x_b'' on the first mass.
    omega, beta = 2.0 * np.pi * 50.0, 2e-5
    damping = {"structure.stiffness_damping": beta, **UNLOADED}
    undamped = ("modal_damping = 0.01", "# ")
    moving = changed(chain('kind = "base_displacement"\ndofs = [1]\namplitude = 1e-4\nphase = 20.0'), undamped,
                     ("m.mtx", "mb.mtx"), ("k.mtx", "kb.mtx"), ("[2, 3]", "[3, 4]"), ("load_dofs = [3]", ""))
    forced = changed(chain("dofs = [1]\namplitude = 100.0\nphase = 20.0",
                           f"dofs = [1]\namplitude = {beta * 100.0 * omega}\nphase = 110.0",
                           f"dofs = [1]\namplitude = {0.3e-4 * omega**2}\nphase = 20.0"), undamped)
    assert "matrices, 3 degrees of freedom" in wb.check(moving, damping)
    found = displacements(solved(moving, damping))
    assert distance(found, displacements(solved(forced, damping))) <= 1e-7
    assert distance(displacements(solved(moving, {**damping, "forcing.frequency": 25.0})), found) > 0.1


def test_a_constant_acceleration_stretches_a_bar_by_the_closed_form():
    # u(L) = -rho a L^2 / (2 E) of a bar under the constant acceleration a.
    scene = changed(BAR, ("[time]", terms('kind = "base_acceleration"\nharmonic = 0\namplitude = 5e4') + "[time]"))
    np.testing.assert_allclose(displacements(solved(scene, UNLOADED)), -2700.0 * 5e4 / (2.0 * 70e9), rtol=1e-10)


def test_samples_are_the_series_through_them(files):
    t = np.arange(24) / 24.0
    force = 0.5 + np.cos(2.0 * np.pi * t) - 0.25 * np.sin(6.0 * np.pi * t)
    np.savetxt(files / "load.csv", np.column_stack([t, force]), "%.17g", ",", header="time_fraction,force", comments="")
    sampled = solved(chain('samples = "load.csv"\namplitude = 80.0'))
    series = solved(chain("harmonic = 0\namplitude = 40.0", "amplitude = 80.0",
                          "harmonic = 3\namplitude = 20.0\nphase = 90.0"))
    assert distance(displacements(sampled), displacements(series)) <= 1e-11


TERM = "forcing.terms[1]."


@pytest.mark.parametrize("each, key, part", [
    (["harmonic = 2"], TERM + "amplitude", "missing; expected a number in N"),
    (["amplitude = 1.0\nphases = 3"], TERM + "phases", "did you mean forcing.terms[1].phase?"),
    (["amplitude = 1.0", "amplitude = 1.0\nharmonic = 0\nphase = 3.0"], "forcing.terms[2].phase",
     "does not belong to a static load"),
    (["amplitude = 1.0\nharmonic = 16"], TERM + "harmonic", "up to 15"),
    (["amplitude = 1.0\ndofs = [4]"], TERM + "dofs", "expected 1..3"),
    (['amplitude = 1.0\nkind = "base_acceleration"'], TERM + "dofs", "missing"),
    (['amplitude = 1e-4\nkind = "base_displacement"\ndofs = [3]'], "structure.contact_dofs",
     "degree of freedom 3 moves with a base displacement"),
    (['amplitude = 1e-4\nkind = "base_displacement"\ndofs = [9]'], "forcing.terms",
     "moves degree of freedom 9; expected 1..3"),
    (['samples = "none.csv"'], TERM + "samples", "none.csv"),
    (['samples = "commas.csv"'], TERM + "samples", "decimals take a point"),
    (['samples = "nameless.csv"'], TERM + "samples", "expected the names of the columns"),
    (['samples = "large.csv"'], TERM + "samples", "it has more than 268435456 bytes"),
    (['samples = "none.csv"\nharmonic = 2'], TERM + "harmonic", "a term with samples"),
])
def test_a_wrong_term_is_refused_at_its_line(files, each, key, part):
    (files / "commas.csv").write_text("force\n0,5\n1,5\n")
    (files / "nameless.csv").write_text("0.5\n1.5\n2.5\n")
    with open(files / "large.csv", "w", encoding="ascii") as large:
        large.write("force\n1\n2\n")
        large.truncate(2**28 + 1)  # a hole
    assert refused(chain(*each), key, part).line > 0


def test_terms_are_tables_and_belong_to_structures_and_analyses_that_take_them():
    number = changed(CHAIN, ("amplitude = 100.0", "terms = 3\namplitude = 100.0"))
    assert refused(number, "forcing.terms", "expected tables [[forcing.terms]]").line > 0
    bar = changed(BAR, ("[time]", terms('kind = "base_displacement"\namplitude = 1.0') + "[time]"))
    error = refused(bar, TERM + "kind", "only with structure.type", line=18)
    assert (error.file, error.found) == ("scene", '"base_displacement"')
    refused(changed(ROD, ("[analysis]", terms("amplitude = 1.0") + "[analysis]")), "forcing.terms")


def test_terms_are_written_and_read_back():
    written = wb.complete(chain("harmonic = 0\namplitude = 150.0", "harmonic = 2\namplitude = 60.0\nphase = 35.0",
                                'kind = "base_acceleration"\ndofs = [1, -2]\namplitude = 40.0'))
    assert wb.complete(written) == written
    first, second, third = tomllib.loads(written)["forcing"]["terms"]
    assert (first["harmonic"], first["amplitude"]) == (0, 150.0)
    assert (second["harmonic"], second["amplitude"], second["phase"]) == (2, 60.0, 35.0)
    assert (third["kind"], third["dofs"], third["amplitude"]) == ("base_acceleration", [1, -2], 40.0)
    changed_phase = tomllib.loads(wb.complete(written, {"forcing.terms[2].phase": 10}))
    assert changed_phase["forcing"]["terms"][1]["phase"] == 10.0


def test_terms_are_described(command):
    said = wb.check(chain("harmonic = 0\namplitude = 150.0",
                          'kind = "base_acceleration"\ndofs = [1, 2]\namplitude = 40.0\nphase = 5.0'))
    assert "           force: static, 150 N on 1 degree of freedom\n" in said
    assert "           base acceleration: harmonic 1, 40 m/s^2, 5 degrees ahead on 2 degrees of freedom\n" in said
    assert "[[forcing.terms]]" in command("keys").text


def period_map(load, start):
    """The state of the chain after a period of 50 Hz from a state, and the matrix of its derivatives."""
    damping = modal_damping(CHAIN_STIFFNESS, CHAIN_MASS, 0.05)

    def rates(time, values):
        u, v = values[:3], values[3:6]
        touching = u[2] > 1e-4
        stop = np.diag([0.0, 0.0, 2e6 if touching else 0.0])
        outside = np.array([0.0, 0.0, load(time) - (2e6 * (u[2] - 1e-4) if touching else 0.0)])
        rate = np.concatenate([v, (outside - damping @ v - CHAIN_STIFFNESS @ u) / 2.0])
        linear = np.block([[np.zeros((3, 3)), np.eye(3)], [-(CHAIN_STIFFNESS + stop) / 2.0, -damping / 2.0]])
        return np.concatenate([rate, (linear @ values[6:].reshape(6, 6)).ravel()])

    first = np.concatenate([start, np.eye(6).ravel()])
    accurate = {"method": "DOP853", "rtol": 1e-9, "atol": 1e-12, "max_step": 2e-4}
    end = scipy.integrate.solve_ivp(rates, (0.0, 0.02), first, **accurate).y[:, -1]
    return end[:6], end[6:].reshape(6, 6)


@pytest.mark.parametrize("preload, closed", [(300.0, True), (60.0, False)])
def test_a_preloaded_contact_has_the_multipliers_of_shooting(preload, closed):
    scene = chain(f"harmonic = 0\namplitude = {preload}")
    found = solved(scene, {"structure.contact_dofs": [3], "contact.stiffness": 2e6, "time.functions": 127,
                           "structure.modal_damping": 0.05, "analysis.stability": True}).summary
    state = np.zeros(6)
    for _ in range(20):
        end, monodromy = period_map(lambda time: preload + 100.0 * np.cos(100.0 * np.pi * time), state)
        if np.abs(end - state).max() < 1e-10:
            break
        state = state + np.linalg.solve(np.eye(6) - monodromy, end - state)
    assert np.abs(end - state).max() < 1e-10
    assert (found["contact_fraction"] == 1.0) is closed and found["contact_fraction"] > 0.0
    multipliers = np.linalg.eigvals(monodromy)
    moduli = np.abs(multipliers)
    leading = complex(found["leading_multiplier_real"], found["leading_multiplier_imag"])
    assert abs(leading) == pytest.approx(moduli.max(), abs=1e-3)
    assert np.abs(multipliers - leading).min() < 1e-3
    assert found["unstable_multipliers"] == np.count_nonzero(moduli > 1.0)


AMPLITUDES = {"analysis.type": "amplitude_sweep", "analysis.amplitude_from": 20.0, "analysis.amplitude_to": 400.0,
              "time.functions": 31, "analysis.phases": False}


def test_an_amplitude_sweep_varies_all_loads_but_the_static_ones(tmp_path):
    static, second = "harmonic = 0\namplitude = 30.0", "harmonic = 2\namplitude = {}\nphase = 35.0"
    record = wb.run(chain(static, second.format(60.0)), AMPLITUDES, output=tmp_path / "out")
    assert record.converged, record.status
    assert next(iter(record.sweep)) == "amplitude_N" and "unstable" in record.sweep
    amplitudes, largest = record.sweep["amplitude_N"], record.sweep["max_displacement_m"]
    assert amplitudes[0] == pytest.approx(20.0, abs=1e-9)
    assert amplitudes[-1] == pytest.approx(400.0, abs=1e-6)
    for i in (0, len(amplitudes) // 2, len(amplitudes) - 1):
        one = solved(chain(static, second.format(0.6 * amplitudes[i])),
                     {"time.functions": 31, "forcing.amplitude": amplitudes[i]})
        assert displacements(one).max() == pytest.approx(largest[i], rel=1e-6)
    assert "Amplitude of the load (N)" in (tmp_path / "out" / "sweep.figure.js").read_text()
    assert record.summary["analysis"] == "amplitude_sweep"


def test_an_amplitude_sweep_varies_a_base_alone():
    overrides = {**AMPLITUDES, **UNLOADED, "analysis.stability": False}
    record = wb.run(chain('kind = "base_acceleration"\ndofs = [1, 2, 3]\namplitude = 30.0'), overrides)
    assert record.converged, record.status
    assert next(iter(record.sweep)) == "amplitude_m_per_s2"
    assert record.sweep["amplitude_m_per_s2"][-1] == pytest.approx(400.0, abs=1e-6)
    refused(CHAIN, "forcing.amplitude", overrides=overrides)


SHAKEN = MATRICES / "shaken.toml"


def test_the_shaken_masses_move_as_time_stepping_says():
    balance = solved(SHAKEN, {"analysis.output_points": 512})
    assert 0.01 < balance.summary["contact_fraction"] < 0.5
    assert distance(displacements(balance), displacements(stepped(SHAKEN, {"analysis.output_points": 512}))) <= 1e-3


def test_the_force_of_a_moving_base_is_that_of_each_frequency_along_a_sweep():
    # It grows with the square of the frequency.
    sweep = solved(SHAKEN, {"time.functions": 31, "analysis.type": "frequency_sweep", "analysis.frequency_from": 40.0,
                            "analysis.frequency_to": 55.0}).sweep
    frequencies, largest = sweep["frequency_Hz"], sweep["max_displacement_m"]
    assert frequencies[-1] == pytest.approx(55.0)
    for i in (0, len(frequencies) // 2, len(frequencies) - 1):
        one = solved(SHAKEN, {"time.functions": 31, "forcing.frequency": frequencies[i]})
        assert displacements(one).max() == pytest.approx(largest[i], rel=1e-7)
