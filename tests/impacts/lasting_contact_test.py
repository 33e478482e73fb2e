"""Contacts that stay closed after impacts without rebound, or after impacts that follow each other ever faster."""

import math

import numpy as np
import pytest
import wavebalance as wb
from event_flow import EventFlow
from impact_structures import columns, lumped_bar, mixture_of, oscillator, scene_of
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline

TAU = 2.0 * math.pi


def solve(structure, **analysis):
    record = wb.run(scene_of(structure, **analysis))
    assert record.converged, record.status
    return record


def flight(damping, gap, omega, begin):
    """Time and velocity at which x'' + c x' + x = cos(omega t) is at the gap again, from rest there."""
    def back(time, y):
        return y[0] - gap if time > begin + 0.1 else -1.0

    back.terminal, back.direction = True, 1.0
    def rates(time, y):
        return [y[1], math.cos(omega * time) - damping * y[1] - y[0]]

    found = solve_ivp(rates, (begin, begin + 50.0), [gap, 0.0], method="DOP853", events=back, rtol=1e-13, atol=1e-13)
    return found.t_events[0][0], found.y_events[0][0][1]


@pytest.mark.parametrize("gap", [0.0, 0.3])
def test_a_contact_opens_where_the_load_no_longer_presses_and_closes_where_it_comes_back(gap):
    omega, damping = 0.5, 0.1
    record = solve(oscillator(damping, gap, 0.0, omega), output_points=997)
    (begin,), (end,) = (record.summary["lasting_contacts"][key] for key in ("begin", "end"))
    opens = math.acos(gap) / TAU  # cos(omega t) = gap
    assert end - 1.0 == pytest.approx(opens, abs=1e-12, rel=0.0)
    time, velocity = flight(damping, gap, omega, opens * TAU / omega)
    impacts = columns(record, "impacts.csv")
    assert impacts["time_fraction"][0] == pytest.approx(time * omega / TAU, abs=1e-9, rel=0.0)
    assert impacts["velocity_before_m_per_s"][0] == pytest.approx(velocity, abs=1e-9, rel=0.0)
    assert record.summary["unstable_multipliers"] == 0
    times, u, force = (record.response[key] for key in ("time_fraction", "displacement_m", "contact_force_N"))
    assert u.max() - gap <= 1e-12 and force.min() >= 0.0
    closed = (times > begin) | (times < end - 1.0)
    assert closed.any()
    np.testing.assert_allclose(u[closed], gap, rtol=0.0, atol=1e-12)
    np.testing.assert_allclose(force[closed], np.cos(TAU * times[closed]) - gap, rtol=0.0, atol=1e-11)


def force_harmonic(n, record, impacts, frequency):
    """Harmonic n of contact force and impulses; between begin and end of a contact the samples have a spline."""
    times, force = record.response["time_fraction"], record.response["contact_force_N"]
    closed = record.summary["lasting_contacts"]
    points, weights = np.polynomial.legendre.leggauss(8)
    total = 0.0j
    for begin, end in zip(closed["begin"], closed["end"]):
        inside = np.arange(math.ceil(begin * len(times) + 1e-3), math.floor(end * len(times) - 1e-3) + 1)
        spline = CubicSpline(inside / len(times), force[inside % len(times)])
        edges = np.linspace(begin, end, 65)
        at = (edges[:-1, None] + np.diff(edges)[:, None] * (0.5 + 0.5 * points)).ravel()
        total += (np.tile(weights, 64) * 0.5 * (end - begin) / 64) @ (spline(at) * np.exp(-1j * TAU * n * at))
    total += frequency * (impacts["impulse_Ns"] @ np.exp(-1j * TAU * n * impacts["time_fraction"]))
    return (1.0 if n == 0 else 2.0) * total


def test_a_bar_has_forces_that_make_its_motion():
    # Harmonics of the displacement follow from load and contact force through the compliance.
    bar, points = lumped_bar(10, 0.0, 0.02, 0.5, 0.0, 0.7), 1 << 16
    record, impacts = solve(bar, output_points=points), columns(solve(bar, output_points=64), "impacts.csv")
    assert len(record.summary["lasting_contacts"]["begin"]) == 2
    u = record.response["displacement_m"]
    assert u.max() <= 0.5 + 1e-11
    harmonics = np.fft.rfft(u)[:6] * np.where(np.arange(6) == 0, 1.0, 2.0) / points
    for n in range(6):
        s = 1j * n * bar.omega
        compliance = np.linalg.inv(s * s * bar.mass + s * bar.damping + bar.stiffness)[-1, -1]
        expected = compliance * ((n == 1) - force_harmonic(n, record, impacts, bar.frequency))
        # The corner at the impact leaves an error of the sum of 1 / points^2.
        assert abs(expected - harmonics[n]) <= 1e-7, n


def test_the_mean_force_of_a_bar_tends_to_a_limit_as_its_elements_are_refined():
    # The compliance of the bar is 1, so that the force's mean is the displacement's, but for its sign.
    records = [solve(lumped_bar(elements, 0.0, 0.02, 0.5, 0.0, 0.7), output_points=4096) for elements in (10, 20, 40)]
    means = [-record.response["displacement_m"].mean() for record in records]
    assert abs(means[2] - means[1]) < 0.6 * abs(means[1] - means[0])


def test_the_map_of_the_flow_has_the_motion_of_the_equations_of_impacts():
    bar = lumped_bar(6, 0.5, 0.02, 0.8, 0.8, 0.9)
    response, stepped = (solve(bar, kind=kind, output_points=97) for kind in ("forced_response", "time_stepping"))
    assert response.summary["solved_by"] == "impacts" and "period_of_motion" not in response.summary
    mine, other = (columns(one, "impacts.csv") for one in (response, stepped))
    for key in "time_fraction", "impulse_Ns":
        assert np.linalg.norm(np.sort(mine[key]) - np.sort(other[key])) < 1e-8
    for key, allowed in ("displacement_m", 1e-8), ("velocity_m_per_s", 1e-7):
        assert np.linalg.norm(response.response[key] - stepped.response[key]) < allowed


def test_impacts_that_follow_each_other_ever_faster_end_in_rest():
    # e = 0.3: infinitely many impacts in a finite time, then rest, until the load passes zero.
    record = solve(oscillator(0.1, 0.0, 0.3, 0.5), output_points=997)
    assert record.summary["impacts"] > 8 and record.summary["unstable_multipliers"] == 0
    assert record.response["displacement_m"].max() <= 1e-9 and record.response["contact_force_N"].min() >= -1e-12
    opens = math.acos(0.0) / TAU
    assert record.summary["lasting_contacts"]["end"][-1] - 1.0 == pytest.approx(opens, abs=1e-10, rel=0.0)


def test_rest_begins_where_the_geometric_series_of_the_impacts_in_time_ends():
    structure = oscillator(0.1, 0.0, 0.5, 0.2)
    closed = solve(structure).summary["lasting_contacts"]
    assert list(closed["contact"]) == [1.0]
    (begin,), (end,) = closed["begin"], closed["end"]
    period = TAU / structure.omega
    opens, rests = (time * period for time in (end - 1.0, begin))
    phase = structure.omega * opens
    flow = EventFlow(mixture_of(structure))
    flow.over(("open",), np.array([0.0, 0.0, 1.0, math.cos(phase), math.sin(phase)]), rests - 1e-4 * period - opens)
    times = [opens + time for time, _, event, _ in flow.events if event == "impact"]
    assert len(times) >= 5
    a, b, c = times[-3:]
    assert (c - (c - b) ** 2 / ((c - b) - (b - a))) / period == pytest.approx(begin, abs=1e-5, rel=0.0)
