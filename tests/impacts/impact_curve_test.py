"""Curves of motions with impacts: where they begin to touch, closed forms at their points, and their special points."""

import math

import numpy as np
import pytest
import wavebalance as wb
from event_flow import EventFlow
from impact_structures import (
    Structure,
    between_stops,
    lumped_bar,
    mixture_of,
    oscillator,
    scene_of,
    two_masses,
)
from scipy.linalg import expm

TAU = 2.0 * math.pi


def curve(structure, begin, end, **analysis):
    """Over angular frequencies."""
    ends = {"frequency_from": begin / TAU, "frequency_to": end / TAU}
    return wb.run(scene_of(structure, "frequency_sweep", **ends, **analysis))


def special(record, kind, axis="frequency_Hz"):
    points = record.summary["special_points"]
    return [value for one, value in zip(points["type"], points[axis]) if one == kind]


def test_contact_begins_where_the_motion_without_contact_reaches_the_gap():
    damping, gap = 0.1, 2.0
    record = curve(oscillator(damping, gap, 0.8, 0.5), 0.5, 1.0)
    assert record.status == "reached_end"
    # (1 - w^2)^2 + c^2 w^2 = 1 / gap^2
    half = 1.0 - 0.5 * damping * damping
    expected = math.sqrt(half - math.sqrt(half * half - 1.0 + 1.0 / (gap * gap)))
    assert TAU * special(record, "grazing")[0] == pytest.approx(expected, abs=1e-11, rel=0.0)
    assert record.sweep["impacts"][0] == 0.0 and record.sweep["impacts"][-1] == 1.0


def test_contact_begins_at_the_load_whose_motion_reaches_the_gap():
    structure = oscillator(0.1, 2.0, 0.8, 0.9)
    reach = abs(structure.free_amplitudes()[0])
    record = wb.run(scene_of(structure, "amplitude_sweep", amplitude_from=1.0 / reach, amplitude_to=4.0 / reach))
    assert record.status == "reached_end"
    assert special(record, "grazing", "amplitude_N")[0] == pytest.approx(2.0 / reach, abs=1e-12, rel=0.0)


def closes(structure, omega, impulse, velocity):
    """How far the motion without contact is from what makes one impact in a period of the load at the gap.

    Behind the impact of a linear structure the rest of the motion is the impulse times a constant; what is left of gap
    and velocity is a point of the ellipse of the motion without contact.
    """
    size, row, gap = len(structure.mass), structure.contacts[0], structure.gaps[0]
    inverse = np.linalg.inv(structure.mass)
    rates = np.block([[np.zeros((size, size)), np.eye(size)],
                      [-inverse @ structure.stiffness, -inverse @ structure.damping]])
    blow = np.r_[np.zeros(size), -impulse * inverse @ row]
    own = np.linalg.solve(np.eye(2 * size) - expm(TAU / omega * rates), blow)  # just behind it
    u, v = gap - row @ own[:size], -structure.restitution * velocity - row @ own[size:]
    return math.hypot(u, v / omega) - abs(row @ structure.free_amplitudes(omega))


@pytest.mark.parametrize("structure, begin, end, allowed", [
    (oscillator(0.0, 0.0, 0.8, 2.5), 2.5, 3.0, 1e-11),  # of Shaw and Holmes, 1983
    (oscillator(0.05, 0.0, 0.8, 2.4), 2.4, 3.7, 1e-9),
    (oscillator(0.1, 1.0, 0.8, 1.0), 1.0, 1.4, 1e-9),
    (two_masses(0.3, 0.7, 1.6), 1.6, 1.9, 1e-9),
])
def test_every_point_of_one_impact_has_its_closed_form(structure, begin, end, allowed):
    record = curve(structure, begin, end)
    assert record.status == "reached_end"
    sweep = record.sweep
    assert len(sweep["impacts"]) >= 10 and set(sweep["impacts"]) == {1.0}
    mobility = (structure.contacts @ np.linalg.inv(structure.mass) @ structure.contacts.T)[0, 0]
    impulses, velocities = sweep["max_impulse_Ns"], sweep["max_impact_velocity_m_per_s"]
    np.testing.assert_allclose(impulses * mobility, (1.0 + structure.restitution) * velocities, rtol=1e-12)
    for frequency, impulse, velocity in zip(sweep["frequency_Hz"], impulses, velocities):
        assert abs(closes(structure, TAU * frequency, impulse, velocity)) <= allowed, frequency


def test_a_curve_ends_at_the_unstable_motion_of_one_period_of_the_table():
    # The motion from which the motion of two periods branches; 0.1789102811 N s and 0.0993946006 m/s by matrix
    # exponentials.
    record = curve(oscillator(0.05, 0.0, 0.8, 2.4), 2.4, 3.7)
    last = {key: values[-1] for key, values in record.sweep.items()}
    assert last["unstable"] == 1.0 and last["impacts"] == 1.0
    assert last["max_impulse_Ns"] == pytest.approx(0.1789102811, abs=1e-9, rel=0.0)
    assert last["max_impact_velocity_m_per_s"] == pytest.approx(0.0993946006, abs=1e-9, rel=0.0)


def test_the_multiplier_of_each_special_point_is_on_the_circle():
    found = []
    for gap, begin in (0.1, 3.0), (0.5, 2.2):
        for restitution in 0.7, 0.8:
            points = curve(oscillator(0.1, gap, restitution, begin), begin, 1.2).summary["special_points"]
            for kind, real, imag in zip(points["type"], points["multiplier_real"], points["multiplier_imag"]):
                if kind == "grazing":
                    continue
                found.append(kind)
                assert abs(complex(real, imag)) == pytest.approx(1.0, abs=1e-7, rel=0.0), kind
                assert kind != "fold" or abs(real - 1.0) < 1e-5
                assert kind != "period_doubling" or abs(real + 1.0) < 1e-7
    assert "fold" in found and "period_doubling" in found


def test_motions_of_twice_the_period_are_followed_from_a_doubling():
    record = curve(oscillator(0.1, 0.1, 0.8, 3.0), 3.0, 1.2, branches=True)
    sweep, branches = record.sweep, record.summary["branches"]
    assert len(branches["branch"]) >= 1
    for branch, parent, at in zip(branches["branch"], branches["parent"], branches["frequency_Hz"]):
        mine = sweep["branch"] == branch
        assert mine.sum() >= 3
        assert sweep["frequency_Hz"][mine][0] == pytest.approx(at, rel=1e-2)
        near = np.abs(special(record, "period_doubling") - at).min()
        assert near <= 1e-9 * at
        assert set(sweep["period"][mine]) == {2.0 * sweep["period"][sweep["branch"] == parent][0]}


def test_over_the_amplitude_motions_of_twice_the_period_begin_where_they_do_over_the_frequency():
    omega = 0.6
    ends = {"amplitude_from": 1.3, "amplitude_to": 0.7}
    record = wb.run(scene_of(oscillator(0.04, 1.0, 0.7, omega), "amplitude_sweep", **ends, branches=True))
    (load,) = special(record, "period_doubling", "amplitude_N")
    # With a gap of 1 / load, a load of 1 N has the same motion, smaller.
    same = curve(oscillator(0.04, 1.0 / load, 0.7, 0.65), 0.65, 0.5)
    assert min(abs(TAU * one - omega) for one in special(same, "period_doubling")) <= 1e-9
    sweep, branches = record.sweep, record.summary["branches"]
    mine = sweep["branch"] == 1.0
    assert mine.sum() >= 10 and set(sweep["period"][mine]) == {2.0}
    assert branches["amplitude_N"][0] == load
    assert branches["lowest_amplitude_N"][0] == sweep["amplitude_N"][mine].min()
    assert branches["end_amplitude_N"][0] == pytest.approx(0.7, rel=1e-12) and branches["end"][0] == "amplitude_to"
    assert "amplitude_N" in record.summary["special_points_of_branches"]


def test_a_curve_passes_the_motions_that_the_structure_settles_to():
    structure = between_stops(0.2, 0.4, 0.7, 0.5)
    sweep = curve(structure, 0.7, 2.5).sweep
    compared = 0
    for i in range(0, len(sweep["frequency_Hz"]), 7):
        if sweep["unstable"][i] != 0.0:
            continue
        structure.omega = TAU * sweep["frequency_Hz"][i]
        settled = wb.run(scene_of(structure)).summary
        if "period_of_motion" in settled or settled["impacts"] != sweep["impacts"][i]:
            continue
        compared += 1
        assert settled["impact_energy_J"] == pytest.approx(sweep["impact_energy_J"][i], abs=1e-8, rel=0.0)
    assert compared >= 3


def test_a_bar_of_many_modes_is_followed():
    record = curve(lumped_bar(30, 0.5, 0.02, 0.8, 0.6, 0.6), 0.6, 1.0, largest_step=0.004 / TAU)
    assert record.status == "reached_end"
    points = record.summary["special_points"]
    sizes = np.hypot(points["multiplier_real"], points["multiplier_imag"])
    others = np.array(points["type"]) != "grazing"
    np.testing.assert_allclose(sizes[others], 1.0, rtol=0.0, atol=1e-6)


def strikes_in_time(structure, periods=40):
    """Instants and speeds by contact of the impacts in the last of so many periods from rest, from event to event."""
    flow = EventFlow(mixture_of(structure))
    states, z = ("open",) * len(structure.contacts), np.zeros(flow.length)
    z[flow.one :] = 1.0, 1.0, 0.0  # the constant, and cos and sin at the beginning of a period
    for _ in range(periods):
        flow.fastest[:] = 0.0
        states, z = flow.over(states, z, flow.period)
    strikes = sorted((c, time / flow.period) for time, c, event, _ in flow.events if event == "impact")
    assert [c for c, _ in strikes] == list(range(len(structure.contacts)))
    return [time for _, time in strikes], flow.fastest


def test_a_curve_goes_on_where_the_impacts_of_two_contacts_pass_each_other():
    structure = Structure(np.eye(2), 0.3 * np.eye(2), np.array([[4.0, -3.0], [-3.0, 3.5]]), np.eye(2), np.array([0.4, 0.35]), 0.3, 1.2)
    record = curve(structure, 1.15, 1.33)
    assert record.status == "reached_end" and record.warnings == []
    sweep, later = record.sweep, []
    assert set(sweep["impacts"]) == {2.0} and set(sweep["unstable"]) == {0.0} and not record.summary["special_points"]
    for i in np.linspace(0, len(sweep["impacts"]) - 1, 6).astype(int):
        structure.omega = TAU * sweep["frequency_Hz"][i]
        (one, other), speeds = strikes_in_time(structure)
        later.append(math.remainder(other - one, 1.0))
        found = [sweep[f"contact_{c}_max_impact_velocity_m_per_s"][i] for c in (1, 2)]
        np.testing.assert_allclose(found, speeds, rtol=1e-8)
    assert later[0] > 1e-3 and later[-1] < -1e-3
