"""Motions in time from event to event: friction, rebounds and other laws together, and free structures."""

import csv
import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp


def scene(structure, contacts, forcing, frequency, analysis="", kind="time_stepping"):
    if kind != "time_stepping":  # these have no keys of time stepping
        analysis = "\n".join(line for line in analysis.split("\n") if not line.startswith(("tolerance", "max_periods")))
    return (f'[structure]\ntype = "matrices"\nmass = "m.mtx"\nstiffness = "k.mtx"\n{structure}\n{contacts}\n'
            f'[forcing]\nfrequency = {frequency!r}\n{forcing}\n[analysis]\ntype = "{kind}"\n{analysis}\n')


def table(record, name):
    with open(record.folder / name) as file:
        return list(csv.DictReader(file))


def events(record):
    return [(float(row["time_fraction"]), int(row["contact"]), row["state"]) for row in table(record, "events.csv")]


def impacts(record):
    return [(float(row["time_fraction"]), int(row["contact"]), float(row["velocity_before_m_per_s"]))
            for row in table(record, "impacts.csv")]


both = pytest.mark.parametrize("kind", ["time_stepping", "forced_response"])


def test_a_slider_has_the_instants_and_the_multipliers_of_the_exact_motion(run, matrix):
    # A mass of 1 kg on 1 N/m with a slider of 1 N/m that yields at 1 N; by event-driven integration.
    for name, value in ("m", 1.0), ("k", 1.0), ("c", 0.05):
        matrix(f"{name}.mtx", [[value]])
    slider = '[contact]\nlaw = "coulomb"\nfriction = 1.0\nnormal_load = 1.0\ntangential_stiffness = 1.0\n[[contact.pairs]]\ndofs = [1]'
    found = run(scene('damping = "c.mtx"', slider, "load_dofs = [1]\namplitude = 2.0", 1.2 / (2.0 * math.pi),
                      "tolerance = 1e-9"))
    assert found.code == 0, found.errors
    assert found.summary["residual"] < 1e-11
    assert abs(found.summary["leading_multiplier_real"] + 1j * found.summary["leading_multiplier_imag"]) == pytest.approx(0.64754840, abs=2e-8)
    assert found.summary["max_displacement_m"] == pytest.approx(5.030259141, rel=1e-5)  # of samples
    expected = [(0.029958836, "slip"), (0.385848543, "stick"), (0.529958836, "slip"), (0.885848543, "stick")]
    assert [(pytest.approx(time, abs=2e-9), state) for time, state in expected] == [(row[0], row[2]) for row in events(found)]


@both
def test_a_block_that_friction_alone_holds_slides_as_in_closed_form(run, matrix, kind):
    # 1 kg on a table with 10 cos(2 pi 2 t) m/s^2 and 3 N of rigid friction: half its travel is 0.0558537 m.
    matrix("m.mtx", [[1.0]])
    matrix("k.mtx", [[0.0]])
    block = '[contact]\nlaw = "coulomb"\nfriction = 0.3\nnormal_load = 10.0\n[[contact.pairs]]\ndofs = [1]'
    load = '[[forcing.terms]]\nkind = "base_acceleration"\ndofs = [1]\namplitude = 10.0'
    found = run(scene("free = true", block, load, 2.0, "output_points = 4096", kind))
    assert found.code == 0, found.errors
    travel = found.summary["max_displacement_m"] - found.summary["min_displacement_m"]
    assert travel == pytest.approx(0.111707316, rel=1e-6)


@both
def test_a_free_ball_in_a_cavity_strikes_when_exact_flights_do(run, matrix, kind):
    matrix("m.mtx", [[1.0, 0.0], [0.0, 0.05]])
    matrix("k.mtx", [[1.0, 0.0], [0.0, 0.0]])
    matrix("c.mtx", [[0.02, 0.0], [0.0, 0.0]])
    cavity = '[contact]\nlaw = "rigid"\nrestitution = 0.6\ngap = 1.0\n[[contact.pairs]]\ndofs = [2, 1]\nside = "both"'
    found = run(scene('free = true\ndamping = "c.mtx"', cavity, "load_dofs = [1]\namplitude = 0.06", 1.0 / (2.0 * math.pi),
                      "tolerance = 1e-8\nmax_periods = 3000", kind))
    assert found.code == 0, found.errors
    strikes = impacts(found)
    assert [time for time, _, _ in strikes] == pytest.approx([0.48027891, 0.98027891], abs=2e-8)
    assert [speed for _, _, speed in strikes] == pytest.approx([1.13388806] * 2, abs=2e-8)


@both
def test_a_valve_between_two_rigid_stops_with_dry_friction_strikes_when_simulations_do(run, matrix, kind):
    # Between two rigid stops, with dry friction; instants and speeds by an event-driven simulation.
    matrix("m.mtx", [[3.3612e-4]])
    matrix("k.mtx", [[1488.58]])
    valve = """[contact]
law = "rigid"
restitution = 0.3
[[contact.pairs]]
dofs = [1]
gap = 1.016e-3
[[contact.pairs]]
dofs = [1]
coefficients = [-1.0]
gap = 0.0
[[contact.pairs]]
dofs = [1]
law = "coulomb"
friction = 1.0
normal_load = 1.0"""
    load = "load_dofs = [1]\namplitude = 2.03365485\n[[forcing.terms]]\nharmonic = 0\namplitude = 0.60641"
    found = run(scene("", valve, load, 250.0, "max_periods = 300", kind))
    assert found.code == 0, found.errors
    first = sorted(impacts(found), key=lambda one: -one[2])[:4]
    assert [time for time, _, _ in first] == pytest.approx([0.5022997, 0.0345464, 0.5865897, 0.6032446], abs=2e-6)
    assert [speed for _, _, speed in first] == pytest.approx([2.3006885, 2.0876812, 0.2318148, 0.0109335], rel=1e-4)


CAVITY = '[contact]\nlaw = "rigid"\nrestitution = 0.6\ngap = 1.0\n[[contact.pairs]]\ndofs = [2, 1]\nside = "both"'


def test_the_curve_of_a_free_ball_ends_at_the_response_there(run, matrix):
    matrix("m.mtx", [[1.0, 0.0], [0.0, 0.05]])
    matrix("k.mtx", [[1.0, 0.0], [0.0, 0.0]])
    matrix("c.mtx", [[0.02, 0.0], [0.0, 0.0]])
    structure, load = 'free = true\ndamping = "c.mtx"', "load_dofs = [1]\namplitude = 0.06"
    curve = run(scene(structure, CAVITY, load, 0.1, "frequency_from = 0.16\nfrequency_to = 0.165", "frequency_sweep")
                .replace("frequency = 0.1\n", ""))
    assert curve.code == 0, curve.errors
    last = table(curve, "sweep.csv")[-1]
    assert last["phases_status"] == "converged" and float(last["frequency_Hz"]) == pytest.approx(0.165, rel=1e-12)
    there = run(scene(structure, CAVITY, load, 0.165, "", "forced_response")).summary
    assert there["status"] == "converged" and there["stability"] == "stable"
    assert float(last["max_displacement_m"]) == pytest.approx(there["max_displacement_m"], rel=1e-5)  # of samples
    assert float(last["rms_displacement_m"]) == pytest.approx(there["rms_displacement_m"], rel=1e-7)


def test_a_ball_on_a_table_that_shakes_hard_is_told_as_unstable_with_what_it_settles_to(run, matrix):
    # One impact a period with -1/2 of the speed: 0.2616 m/s, phase and multiplier in closed form. From rest it bounces to rest.
    matrix("m.mtx", [[1.0]])
    matrix("k.mtx", [[0.0]])
    table_below = '[contact]\nlaw = "rigid"\nrestitution = 0.5\ngap = 0.0\n[[contact.pairs]]\ndofs = [1]\ncoefficients = [-1.0]'
    loads = ('[[forcing.terms]]\nharmonic = 0\ndofs = [1]\namplitude = -9.81\n'
             '[[forcing.terms]]\nkind = "base_acceleration"\ndofs = [1]\namplitude = 20.0')
    found = run(scene("free = true", table_below, loads, 25.0, "", "forced_response"))
    summary = found.summary
    assert found.code == 0 and summary["stability"] == "unstable", found.errors
    assert summary["max_impact_velocity_m_per_s"] == pytest.approx(0.2616, rel=1e-9)
    assert summary["leading_multiplier_real"] == pytest.approx(-2.58922383, abs=1e-7)
    assert summary["settled_periods"] > 1


def strike_of_a_dashpot(touch, gravity=9.81, amplitude=20.0, omega=50.0 * math.pi, stiffness=1e6, damping=430.0):
    """From a touch, an instant and a speed, over contact that ends where its force vanishes and the flight to the next."""

    def depth(force):
        return lambda t, z: [z[1], gravity + amplitude * math.cos(omega * t) - force(z)]

    def until(slope, t, z, event):
        event.terminal, event.direction = True, 1
        ended = solve_ivp(slope, (t, t + 1.0), z, method="DOP853", rtol=1e-12, atol=1e-16, events=event)
        return ended.t[-1], ended.y[:, -1]

    def force(z):
        return stiffness * z[0] + damping * z[1]

    time, state = until(depth(force), touch[0], [0.0, touch[1]], lambda t, z: -force(z))
    time, state = until(depth(lambda z: 0.0), time, state, lambda t, z: z[0])
    return np.array([time - 2.0 * math.pi / omega, state[1]])


def test_the_multiplier_of_a_ball_that_strikes_a_dashpot_is_that_of_its_strikes(run, matrix):
    # The touches of one period by Newton's method; a dashpot that rises within 1e-6 m is nearly one that acts at once.
    touch = np.array([0.3928 * 0.04, 0.2616])
    for _ in range(6):
        steps = np.diag([1e-7, 1e-5])
        map_of = np.column_stack([(strike_of_a_dashpot(touch + s) - strike_of_a_dashpot(touch - s)) / (2.0 * s.sum()) for s in steps])
        touch = touch + np.linalg.solve(np.eye(2) - map_of, strike_of_a_dashpot(touch) - touch)
    leading = min(np.linalg.eigvals(map_of).real)
    matrix("m.mtx", [[1.0]])
    matrix("k.mtx", [[0.0]])
    loads = ('[[forcing.terms]]\nharmonic = 0\ndofs = [1]\namplitude = -9.81\n'
             '[[forcing.terms]]\nkind = "base_acceleration"\ndofs = [1]\namplitude = 20.0')
    pair = '[time]\ntrial = "fourier"\nweight = "fourier"\nfunctions = 255\nquadrature_points = 8192\n'
    for at_once in "0.0", "1e-6":
        stop = (f'[contact]\nlaw = "kelvin_voigt"\nstiffness = 1e6\ndamping = 430.0\ndamping_depth = {at_once}\n'
                'gap = 0.0\n[[contact.pairs]]\ndofs = [1]\ncoefficients = [-1.0]')
        found = run(scene("free = true", stop, loads, 25.0, "", "forced_response").replace("[analysis]", pair + "[analysis]"))
        assert found.code == 0 and found.summary["phases_status"] == "converged", found.errors
        assert found.summary["stability"] == "unstable"
        assert found.summary["leading_multiplier_real"] == pytest.approx(leading, abs=1e-5)


def test_a_curve_of_a_block_that_nothing_holds_is_told_as_undetermined(run, matrix):
    matrix("m.mtx", [[1.0]])
    matrix("k.mtx", [[0.0]])
    block = '[contact]\nlaw = "coulomb"\nfriction = 0.3\nnormal_load = 10.0\n[[contact.pairs]]\ndofs = [1]'
    load = '[[forcing.terms]]\nkind = "base_acceleration"\ndofs = [1]\namplitude = 10.0'
    found = run(scene("free = true", block, load, 2.0, "frequency_from = 2.0\nfrequency_to = 2.5", "frequency_sweep")
                .replace("frequency = 2.0\n", ""))
    assert found.code == 3 and found.summary["status"] == "undetermined"
    assert "soft spring" in found.text and "what may help" not in found.errors


def test_the_curve_of_a_free_ball_on_a_table_has_its_impacts(run, matrix):
    # It strikes with g T / (1 + e) at a period T, whatever the table does.
    matrix("m.mtx", [[1.0]])
    matrix("k.mtx", [[0.0]])
    table_below = '[contact]\nlaw = "rigid"\nrestitution = 0.5\ngap = 0.0\n[[contact.pairs]]\ndofs = [1]\ncoefficients = [-1.0]'
    loads = ('[[forcing.terms]]\nharmonic = 0\ndofs = [1]\namplitude = -9.81\n'
             '[[forcing.terms]]\nkind = "base_acceleration"\ndofs = [1]\namplitude = 20.0')
    found = run(scene("free = true", table_below, loads, 25.0, "frequency_from = 24.0\nfrequency_to = 25.0", "frequency_sweep")
                .replace("frequency = 25.0\n", ""))
    assert found.code == 0, found.errors
    assert found.summary["max_impact_velocity_m_per_s"] == pytest.approx(9.81 / 24.0 / 1.5, rel=1e-9)
    assert "There is no contact" not in found.text and "No contact" not in found.errors
    for row in table(found, "sweep.csv"):
        assert int(row["impacts"]) == 1
        assert float(row["max_impact_velocity_m_per_s"]) == pytest.approx(9.81 / float(row["frequency_Hz"]) / 1.5, rel=1e-9)


def test_the_mass_of_a_contact_with_rigid_friction_is_kept_where_the_scene_says_so(run, matrix):
    # Den Hartog, Trans. ASME 53, 1931: x^2 = V^2 - (0.3 U)^2 with V = 1 / (1 - r^2) and U = tan(pi / (2 r)) / r.
    for name in ("m", "k"):
        matrix(f"{name}.mtx", [[1.0]])
    slider = '[contact]\nlaw = "coulomb"\nmass = "keep"\nfriction = 0.3\nnormal_load = 1.0\n[[contact.pairs]]\ndofs = [1]'
    found = run(scene("", slider, "load_dofs = [1]\namplitude = 1.0", 0.75 / (2.0 * math.pi), "output_points = 4096", "forced_response"))
    assert found.code == 0, found.errors
    exact = math.sqrt((1.0 / (1.0 - 0.75**2)) ** 2 - (0.3 * math.tan(math.pi / 1.5) / 0.75) ** 2)
    assert found.summary["max_displacement_m"] == pytest.approx(exact, rel=1e-6)  # of samples


def test_impacts_that_follow_each_other_ever_faster_come_to_rest_in_a_response(run, matrix):
    # The same motion in time from event to event.
    matrix("m.mtx", [[1.0]])
    matrix("k.mtx", [[1.0]])
    matrix("c.mtx", [[0.1]])
    stop = '[contact]\nlaw = "rigid"\nrestitution = 0.3\ngap = 0.0\n[[contact.pairs]]\ndofs = [1]'
    def solve(kind):
        found = run(scene('damping = "c.mtx"', stop, "load_dofs = [1]\namplitude = 1.0", 0.5 / (2.0 * math.pi),
                          "tolerance = 1e-9\noutput_points = 512", kind))
        assert found.code == 0, found.errors
        return found.summary

    response, stepped = solve("forced_response"), solve("time_stepping")
    assert response["status"] == "converged" and response["stability"] == "stable"
    assert response["impacts"] > 8 and len(response["lasting_contacts"]) == 1
    assert response["max_impact_velocity_m_per_s"] == pytest.approx(stepped["max_impact_velocity_m_per_s"], rel=1e-8)
    assert response["rms_displacement_m"] == pytest.approx(stepped["rms_displacement_m"], rel=1e-7)


def stuck(stiffness, load=0.5):
    return (f'[contact]\nlaw = "coulomb"\nfriction = 0.5\nnormal_load = 2.0\n{stiffness}\n[[contact.pairs]]\ndofs = [1]',
            f"load_dofs = [1]\namplitude = {load}")


@pytest.mark.parametrize("stiffness", [1e2, 1e4])
def test_a_contact_that_sticks_all_the_time_leaves_the_multipliers_of_the_linear_structure(run, matrix, stiffness):
    for name, value in ("m", 1.0), ("k", 1.0), ("c", 0.05):
        matrix(f"{name}.mtx", [[value]])
    contact, load = stuck(f"tangential_stiffness = {stiffness}")
    found = run(scene('damping = "c.mtx"', contact, load, 0.2, "max_periods = 3000"))
    assert found.code == 0, found.errors
    assert found.summary["stability"] == "stable"
    size = abs(found.summary["leading_multiplier_real"] + 1j * found.summary["leading_multiplier_imag"])
    assert size == pytest.approx(math.exp(-0.025 * 5.0), rel=1e-6)
    assert any("sticks all the time" in warning for warning in found.summary["warnings"])


def test_rigid_friction_that_never_slips_holds_its_contact(run, matrix):
    for name, value in ("m", 1.0), ("k", 1.0), ("c", 0.05):
        matrix(f"{name}.mtx", [[value]])
    contact, load = stuck("")
    found = run(scene('damping = "c.mtx"', contact, load, 0.2))
    assert found.code == 0, found.errors
    assert abs(found.summary["max_displacement_m"]) < 1e-9
    assert found.summary["stability"] != "unstable"


@pytest.mark.parametrize("stiffness", [1e7, 1e9])
def test_a_slider_far_stiffer_than_the_structure_moves_as_in_closed_form(run, matrix, stiffness):
    # A mass with rigid dry friction after Den Hartog; the displacements that hold a stuck contact are rounding of others.
    for name in ("m", "k"):
        matrix(f"{name}.mtx", [[1.0]])
    slider = f'[contact]\nlaw = "coulomb"\nfriction = 0.3\nnormal_load = 1.0\ntangential_stiffness = {stiffness}\n[[contact.pairs]]\ndofs = [1]'
    found = run(scene("", slider, "load_dofs = [1]\namplitude = 1.0", 0.75 / (2.0 * math.pi), "output_points = 4096"))
    assert found.code == 0, found.errors
    assert found.summary["max_displacement_m"] == pytest.approx(2.1781440, rel=1e-4)


ESCAPE = """[structure]
type = "matrices"
mass = "m.mtx"
stiffness = "m.mtx"
stiffness_damping = 0.05
contact_dofs = [1]
[contact]
law = "cubic"
cubic_stiffness = -1.0
[forcing]
load_dofs = [1]
amplitude = {load}
frequency = 0.13
[analysis]
type = "{kind}"
{more}
"""


def test_a_mass_that_escapes_from_its_softening_spring_is_told_to_grow(run, matrix):
    # Its potential u^2/2 - u^4/4 holds it between -1 and 1 only.
    matrix("m.mtx", [[1.0]])
    found = run(ESCAPE.format(load=1.0, kind="time_stepping", more=""))
    assert found.code == 3 and found.summary["status"] == "grows", found.errors
    assert "grows without bound" in found.text and "softer contact" not in found.errors
    found = run(ESCAPE.format(load=1.0, kind="motions", more="random_starts = 4"))
    assert found.code == 3 and found.summary["status"] == "grows", found.errors
    assert "(4 grows)" in found.errors and "longest_period" not in found.errors
    interval = "frequency_from = 0.12\nfrequency_to = 0.13\nvalues = 2\nexact_curve = false"
    diagram = ESCAPE.format(load=1.0, kind="bifurcation_diagram", more=interval).replace("frequency = 0.13\n[analysis]", "[analysis]")
    found = run(diagram)
    assert found.code == 3 and found.summary["status"] == "grows", found.errors
    assert "same motions" not in found.text


def test_starts_that_escape_are_told_beside_the_motion_of_those_that_do_not(run, matrix):
    matrix("m.mtx", [[1.0]])
    found = run(ESCAPE.format(load=0.1, kind="motions", more=""))
    assert found.code == 0, found.errors
    none = int(found.summary["starts_without_motion"])
    stable = [one for one in found.summary["motions"] if one["stability"] == "stable"]
    assert none > 0 and f"({none} grows)" in found.errors
    assert len(stable) == 1 and stable[0]["share"] == pytest.approx((24 - none) / 24)
