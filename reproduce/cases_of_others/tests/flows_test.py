"""Holds what the cases with events are compared with to integrations of the tests' own."""

from math import pi

import numpy as np
import pytest

import flows
import smooth
from references_test import text


def known(name, *words):
    """The values of the rows of a case whose names begin with some words, in the order of the file, by frequency where they have some."""
    rows = [row for group in text(name)["values"] for row in group["rows"]]
    found = [next(row[2:] for row in rows if row[0].startswith(word)) for word in words]
    return [values[0] if len(values) == 1 else values for values in found]  # one number where there is one


def places(name):
    """The frequencies of the first values that have some."""
    return next(group["at"] for group in text(name)["values"] if "at" in group)


def test_impacts_of_the_spool():
    flow = flows.spool()
    events = [event for event in flow.settled([0, 0], "stick", 6)[1][3] if abs(event[3][1]) > 1e-3]
    assert [event[0] for event in events] == pytest.approx(known("spool_valve", "instant of the impact", "instant of the first", "instant of the second", "instant of the third"), abs=1e-9)
    assert [abs(event[3][1]) for event in events] == pytest.approx(known("spool_valve", "speed on the right", "speed on the left", "speed of the second", "speed of the third"), rel=1e-7)


@pytest.mark.parametrize("index", [0, 1])
def test_motions_of_the_impact_damper(index):
    flow = flows.impact_damper(places("impact_damper")[index])
    state, (_, _, transition, events, path) = flow.periodic(flow.run([0, 0, 0.2, 0.5], "fly", 30)[0], "fly")
    first, second, speed, largest, multiplier = (values[index] for values in known("impact_damper", "instant of the first", "instant of the second", "speed", "largest", "modulus"))
    assert [event[0] for event in events] == pytest.approx([first, second], abs=1e-9)
    assert [abs(event[3][3] - event[3][2]) for event in events] == pytest.approx([speed, speed], abs=1e-9)
    assert flow.largest(path) == pytest.approx(largest, rel=1e-8)
    assert max(abs(np.linalg.eigvals(transition))) == pytest.approx(multiplier, abs=1e-8)


def test_work_of_the_shaken_mass():
    for amplitude, row in ((1.5, "power of wear (W) at 1.5"), (1.01, "power of wear (W) at 1.01"), (0.99, "power of wear (W) at 0.99")):
        events = flows.shaken(1.0, amplitude, 2 * pi).run([0, 0], "stick", 2)[3]
        places = [event[3][0] for event in events if event[0] > 0.9]
        power = 10 * abs(places[2] - places[0]) * 2 if len(places) > 2 else 0.0
        assert power == pytest.approx(known("shaken_mass", row)[0], rel=5e-6)


@pytest.mark.parametrize("index", range(4))
def test_motions_of_the_friction_oscillator(index):
    flow = flows.dry(places("pwsdde_friction")[index], 1.0, 1.5, damping=0.1)
    state, name, *_ = flow.run([0, 0], "stick", 25)
    _, (_, _, _, _, path) = flow.periodic(state, name)
    largest, stick = (values[index] for values in known("pwsdde_friction", "largest", "share"))
    assert flow.largest(path) == pytest.approx(largest, rel=1e-9)
    assert flows.shares(path).get("stick", 0.0) == pytest.approx(stick, abs=1e-9)


def test_motion_of_the_two_masses():
    flow = flows.two_masses()
    state, name, *_ = flow.run([0, 1, 0, 0], "stick", 50)
    _, (_, _, transition, _, path) = flow.periodic(state, name)
    largest, stick, multiplier = known("siconos_two_masses", "largest", "share", "modulus")
    assert flow.largest(path) == pytest.approx(largest, rel=1e-10)
    assert flows.shares(path)["stick"] == pytest.approx(stick, abs=1e-8)
    assert max(abs(np.linalg.eigvals(transition))) == pytest.approx(multiplier, abs=1e-8)


@pytest.mark.parametrize("index", range(4))
def test_motions_between_two_stops(index):
    flow = flows.stops(places("two_stops")[index])
    _, (_, _, transition, events, _) = flow.periodic(flow.run([0.3, 0], "fly", 20)[0], "fly")
    speed, multiplier = (values[index] for values in known("two_stops", "speed", "modulus"))
    assert [abs(event[3][1]) for event in events] == pytest.approx([speed, speed], abs=1e-9)
    assert max(abs(np.linalg.eigvals(transition))) == pytest.approx(multiplier, abs=1e-9)


def test_motion_and_fold_of_the_harvester(solve):
    run = solve("harvester.toml", "analysis.exact=false", "analysis.stability=false", "analysis.frequency_to=500", "analysis.motion_at=[400.0]")
    flow, first = flows.harvester(400.0), run.rows(run.summary["motions"][0]["file"])[0]
    start = np.array([first["displacement_m"], first["velocity_m_per_s"]]) / flows.TENTH
    events, path = flow.periodic(start, "open")[1][3:]
    assert flow.largest(path) * flows.TENTH == pytest.approx(known("harvester", "largest displacement (m)")[0], rel=1e-9)
    touch, leave = (next(event for event in events if event[1:3] == pair) for pair in (("open", "right"), ("right", "open")))
    fold = flows.harvester_fold(touch[3][1], 2 * pi * touch[0], (leave[0] - touch[0]) % 1.0)
    assert fold == pytest.approx(text("harvester")["points"][1]["fold"][0], abs=1e-3)


def test_motion_of_the_harvester_with_dashpots(solve):
    flow = flows.harvester(300.0, dashpot=0.02)
    run = solve("harvester_dashpots.toml")
    first = run.rows("response.csv")[0]
    side = run.rows("contacts.csv")[0]["displacement_m"] / first["displacement_m"]  # of the contact whose motion the response is
    _, (_, _, _, _, path) = flow.periodic(side * np.array([first["displacement_m"], first["velocity_m_per_s"]]) / flows.TENTH, "open")
    assert flow.largest(path) * flows.TENTH == pytest.approx(known("harvester", "largest displacement with dashpots")[0], rel=1e-9)


def test_motions_of_the_tip():
    attracted, tapping, force = known("tapping_tip", "amplitude by", "amplitude that", "its largest")
    assert smooth.tip([-9.8785, 69.0906])[0] == pytest.approx(attracted, rel=1e-6)
    amplitude, _, largest = smooth.tip([9.3036, 82.5740])
    assert [amplitude, largest] == pytest.approx([tapping, force], rel=1e-6)


@pytest.mark.parametrize("index", [0, 1])
def test_motions_of_nlvibs_chain(index):
    found = smooth.chain(places("nlvib_example07")[index], periods=30)
    assert list(found) == pytest.approx([values[index] for values in known("nlvib_example07", *(f"largest displacement of mass {n}" for n in (1, 2, 3)))], rel=2e-3)  # of 30 periods


def test_flight_of_the_follower():
    landing, height, speed = known("cam_follower", "share", "height", "speed")
    found = smooth.follower()
    assert found == pytest.approx((landing, height, speed), rel=1e-5)


def test_bounces_of_the_follower():
    impacts = smooth.bouncing_follower(0.8, 60)
    period, count, largest, least = known("cam_follower", "period", "impacts", "largest", "least")
    assert len([speed for turn, speed in impacts if turn >= 60 - period]) == count
    speeds = [speed for _, speed in impacts[-int(count):]]
    assert [max(speeds), min(speeds)] == pytest.approx([largest, least], rel=1e-6)


def test_load_of_the_cam_is_that_of_its_arcs():
    lines = (smooth.SCENES / "cam_load.csv").read_text().split()[1:]
    assert [float(line) for line in lines] == pytest.approx([smooth.cam_force(k / len(lines)) for k in range(len(lines))], rel=1e-6, abs=1e-3)


def test_table_of_the_sample_is_its_formula():
    lines = [line.split(",") for line in (smooth.SCENES / "sample.csv").read_text().split()[1:]]
    assert [float(force) for _, force in lines] == pytest.approx([smooth.tip_force(float(place)) for place, _ in lines], rel=1e-5)


def whirl(radius, speed, load, stiffness, friction):
    """How much the load of a whirl around a ring of clearance 1 is from `load`."""
    ring = stiffness * (1 - 1 / radius) * (1 + 1j * friction)
    return abs(1 - speed**2 + 0.1j * speed + ring) * radius - load


def test_whirls_in_rings_have_their_closed_forms():
    at_11, force, at_10, at_09 = known("rotor_in_ring", "radius at 1.1", "force", "radius at 1 ", "radius at 0.9")
    for radius, speed in ((at_11, 1.1), (at_10, 1.0), (at_09, 0.9)):
        assert whirl(radius, speed, 0.3 * speed**2, 5.0, 0.0) == pytest.approx(0.0, abs=1e-9)
    assert eval(force) == pytest.approx(5 * (at_11 - 1), rel=1e-9)
    for radius, speed in zip(known("rotor_rub", "radius")[0], places("rotor_rub")):
        assert whirl(radius, speed, 0.25, 10.0, 0.1) == pytest.approx(0.0, abs=1e-9)


def multiplier(radius, speed, stiffness, friction):
    """The modulus of the leading multiplier of a whirl, which is at rest in the frame that turns with it."""
    law = stiffness * (1 + 1j * friction)
    both, radial, turning = 1 - speed**2 + 0.1j * speed + law * (1 - 1 / radius), law / radius, 0.1 + 2j * speed
    columns = [both + radial, 1j * both, turning, 1j * turning]
    rates = np.vstack([np.eye(4)[2:], [[-one.real for one in columns], [-one.imag for one in columns]]])
    return np.exp(max(np.linalg.eigvals(rates).real) * 2 * pi / speed)


def test_multipliers_of_whirls_are_those_of_their_frame():
    assert multiplier(known("rotor_in_ring", "radius at 1.1")[0], 1.1, 5.0, 0.0) == pytest.approx(known("rotor_in_ring", "modulus")[0], abs=1e-8)
    for radius, speed, given in zip(known("rotor_rub", "radius")[0], places("rotor_rub"), known("rotor_rub", "modulus")[0]):
        assert multiplier(radius, speed, 10.0, 0.1) == pytest.approx(given, abs=1e-8)


def test_fold_of_the_rub_is_where_its_whirls_end():
    radii = np.linspace(1.06, 1.11, 501)
    speeds = [max((root.real for root in np.roots(quartic(radius)) if abs(root.imag) < 1e-9), default=0.0) for radius in radii]
    best = int(np.argmax(speeds))
    fit = np.polyfit(radii[best - 2:best + 3] - radii[best], speeds[best - 2:best + 3], 4)
    turn = [root.real for root in np.roots(np.polyder(fit)) if abs(root.imag) < 1e-9 and abs(root) < 2e-4]
    assert np.polyval(fit, turn[0]) == pytest.approx(text("rotor_rub")["points"][0]["fold"][0], abs=1e-8)


def quartic(radius):
    """The polynomial in the speed with the roots of whirl() of the rub at a radius, squared."""
    pressure = 10 * (1 - 1 / radius)
    stiffness = np.poly1d([-1, 0, 1 + pressure])
    turning = np.poly1d([0.1, 0.1 * pressure])
    return stiffness**2 + turning**2 - (0.25 / radius)**2


def test_motion_of_the_ball_has_its_closed_form():
    gravity, period, kept, table = 9.81, 0.04, 0.5, 20.0
    omega = 2 * pi / period
    speed = gravity * period * (1 - kept) / (1 + kept) / 2  # of the table at the impact
    phase = pi - np.arcsin(speed * omega / table)
    # The map from impact to impact has the determinant kept^2, and its trace has the table's acceleration at the
    # impact.
    trace = 1 + kept**2 + (1 + kept)**2 * table * np.cos(phase) / gravity
    instant, _, multiplier = known("bouncing_ball", "instant", "relative", "leading")
    assert phase / (2 * pi) == pytest.approx(instant, abs=1e-11)
    assert min(np.roots([1, -trace, kept**2])) == pytest.approx(multiplier, abs=1e-8)
