"""Periodic motions with impacts: a table, closed forms, and displacements and energy from impacts."""

import math

import numpy as np
import pytest
import wavebalance as wb
from impact_oracle import ImpactOracle, strikes_of
from impact_structures import columns, leading, oscillator, periods_of, scene_of
from impact_table import KNOWN

STABLE = [one for one in KNOWN if abs(one.multiplier) < 1.0]


class Found:
    """A motion that a scene has: its multiplier and its impacts, over `periods` of the load."""

    def __init__(self, record, number=None):
        summary = record.summary
        self.record = record
        if number is None:
            self.periods, self.multiplier = periods_of(summary), leading(summary)
            self.impacts = columns(record, "impacts.csv")
        else:
            motions = summary["motions"]
            self.periods = int(motions["period"][number])
            self.multiplier = leading({key: values[number] for key, values in motions.items() if "multiplier_" in key})
            self.impacts = columns(record, f"motion_{number + 1}_impacts.csv")

    def matches(self, known):
        """Whether its instants agree with the table up to whole forcing periods."""
        if self.periods != known.periods or len(self.impacts["contact"]) != len(known.contacts):
            return False
        return any(np.abs((self.instants(k) - known.instants)).max() < 1e-3 for k in range(known.periods))

    def instants(self, turned):
        """In periods of the load, `turned` later, in their order."""
        return np.sort((self.impacts["time_fraction"] * self.periods + turned) % self.periods)


def motions_of(known):
    """The response, or all motions where the known one is unstable and the response another."""
    record = wb.run(scene_of(known.structure, output_points=256))
    found = [Found(record)]
    if not found[0].matches(known):
        record = wb.run(scene_of(known.structure, "motions", random_starts=60))
        found = [Found(record, k) for k in range(len(record.summary["motions"]["period"]))]
    return [one for one in found if one.matches(known)]


@pytest.fixture(scope="module")
def motions():
    return {known.name: motions_of(known) for known in KNOWN}


table = pytest.mark.parametrize("known", KNOWN, ids=lambda known: known.name)
settled = pytest.mark.parametrize("known", STABLE, ids=lambda known: known.name)


@table
def test_a_motion_has_the_impacts_and_the_leading_multiplier_of_the_table(motions, known):
    (found,) = motions[known.name]
    turned = min(range(known.periods), key=lambda k: np.abs(found.instants(k) - known.instants).max())
    order = np.argsort((found.impacts["time_fraction"] * found.periods + turned) % found.periods)
    assert found.instants(turned) == pytest.approx(known.instants, abs=1e-9, rel=0.0)
    for key, expected in ("velocity_before_m_per_s", known.velocities), ("impulse_Ns", known.impulses):
        assert found.impacts[key][order] == pytest.approx(expected, abs=1e-9, rel=0.0)
    assert list(found.impacts["contact"][order]) == known.contacts
    multiplier = complex(found.multiplier.real, abs(found.multiplier.imag))
    assert abs(multiplier - known.multiplier) <= 1e-8 * max(1.0, abs(known.multiplier))


@settled
def test_a_response_is_the_stable_motion_of_the_table(motions, known):
    (found,) = motions[known.name]
    assert found.record.summary["analysis"] == "forced_response"
    assert found.record.converged and found.record.summary["stability"] == "stable"
    assert found.record.summary["unstable_multipliers"] == 0


@settled
def test_a_motion_moves_as_its_impacts_say(motions, known):
    (found,) = motions[known.name]
    response, contacts, impacts = found.record.response, found.record.contacts, found.impacts
    oracle = ImpactOracle(known.structure)
    strikes = strikes_of(impacts, found.periods * oracle.load_period)
    times = np.arange(256) / 256.0 * found.periods * oracle.load_period
    states = oracle.periodic(strikes, found.periods, times)
    if response:
        np.testing.assert_allclose(response["displacement_m"], oracle.rows[0] @ states, rtol=0.0, atol=1e-12)
        speed = max(1.0, impacts["velocity_before_m_per_s"].max())
        expected = oracle.speeds[0] @ states
        np.testing.assert_allclose(response["velocity_m_per_s"], expected, rtol=0.0, atol=1e-12 * speed)
    else:  # of several contacts
        for c, row in enumerate(oracle.rows):
            mine = np.array(contacts["contact"]) == c + 1
            np.testing.assert_allclose(contacts["displacement_m"][mine], row @ states, rtol=0.0, atol=1e-12)
    for strike in strikes:
        (place,) = oracle.rows[strike.contact] @ oracle.periodic(strikes, found.periods, strike.time)
        (after,) = oracle.speeds[strike.contact] @ oracle.periodic(strikes, found.periods, strike.time)
        assert place == pytest.approx(known.structure.gaps[strike.contact], abs=1e-13, rel=0.0)
        assert after == pytest.approx(-known.structure.restitution * strike.velocity, abs=1e-12, rel=0.0)
    before, after = impacts["velocity_before_m_per_s"], impacts["velocity_after_m_per_s"]
    np.testing.assert_allclose(after, -known.structure.restitution * before, rtol=0.0, atol=1e-15)
    fine = oracle.periodic(strikes, found.periods, np.linspace(0.0, found.periods * oracle.load_period, 2001))
    assert ((oracle.rows @ fine).T - known.structure.gaps).max() <= 1e-12


@pytest.mark.parametrize("known", [one for one in KNOWN if len(one.structure.mass) == 1], ids=lambda known: known.name)
def test_the_load_brings_what_damping_and_impacts_take(motions, known):
    # Oscillator: int cos(w t) v dt = int c v^2 dt + energy dissipated by impacts, by Gauss' rule between impacts.
    (found,) = motions[known.name]
    oracle = ImpactOracle(known.structure)
    period, panels = found.periods * oracle.load_period, 200
    strikes = strikes_of(found.impacts, period)
    lost = found.impacts["energy_lost_J"].sum()
    points, weights = np.polynomial.legendre.leggauss(3)
    work = damped = 0.0
    for strike, end in zip(strikes, [one.time for one in strikes[1:]] + [strikes[0].time + period]):
        length = (end - strike.time) / panels
        times = (strike.time + length * (np.arange(panels)[:, None] + 0.5 + 0.5 * points)).ravel()
        velocity, weight = oracle.periodic(strikes, found.periods, times)[1], np.tile(0.5 * length * weights, panels)
        work += weight @ (np.cos(known.structure.omega * times) * velocity)
        damped += known.structure.damping[0, 0] * (weight @ velocity**2)
    assert work == pytest.approx(damped + lost, abs=1e-10 * max(1.0, lost), rel=0.0)


class ShawHolmes:
    """One impact in n periods of an undamped oscillator [Shaw and Holmes 1983]."""

    def __init__(self, omega, restitution, periods, gap):
        self.structure, self.periods = oscillator(0.0, gap, restitution, omega), periods
        factor, period = 1.0 / (1.0 - omega * omega), 2.0 * math.pi * periods / omega
        c = math.sin(period) * (1.0 + restitution) / (1.0 - math.cos(period))
        s = (1.0 - restitution) / omega
        root = math.sqrt(factor**2 * c * c - (gap * gap - factor**2) * s * s)
        self.velocities = [(-2.0 * c * gap + sign * 2.0 * root) / (c * c + s * s) for sign in (1.0, -1.0)]


@pytest.mark.parametrize("omega, restitution, periods, gap", [
    (3.7, 0.8, 2, 0.0), (2.8, 0.8, 1, 0.0), (2.0, 0.8, 1, 0.1), (2.6, 0.6, 1, 0.05), (1.5, 0.7, 1, 0.2),
    (4.2, 0.9, 2, 0.02)])
def test_an_oscillator_without_damping_has_the_closed_form_of_shaw_and_holmes(omega, restitution, periods, gap):
    known = ShawHolmes(omega, restitution, periods, gap)
    record = wb.run(scene_of(known.structure, "motions"))
    motions = [Found(record, k) for k in range(len(record.summary["motions"]["period"]))]
    motions = [one for one in motions if one.periods == periods and len(one.impacts["contact"]) == 1]
    assert motions
    for found in motions:
        (v,) = found.impacts["velocity_before_m_per_s"]
        assert min(abs(v - one) for one in known.velocities) <= 1e-12 * max(1.0, v)
        oracle = ImpactOracle(known.structure)
        multipliers = oracle.multipliers(strikes_of(found.impacts, periods * oracle.load_period), periods)
        assert abs(multipliers.prod()) == pytest.approx(restitution**2, abs=1e-11, rel=0.0)
        assert abs(multipliers - found.multiplier).min() <= 1e-11 * max(1.0, abs(found.multiplier))


def test_a_motion_that_stays_below_the_gap_has_no_impacts():
    record = wb.run(scene_of(oscillator(0.1, 10.5, 0.8, 1.0)))
    assert record.converged and record.summary["impacts"] == 0.0 and record.summary["unstable_multipliers"] == 0
    assert abs(leading(record.summary)) ** 2 == pytest.approx(math.exp(-0.2 * math.pi), abs=1e-14, rel=0.0)


def test_a_motion_without_impacts_has_no_panel_of_them():
    drawn = wb.run(scene_of(oscillator(0.1, 50.0, 0.7, 0.9))).svg()
    assert "Velocity" in drawn and "Impulses of impacts" not in drawn
