"""Random chains with impacts: each motion that is found, against a motion in time by matrix exponentials."""

import math
import os

import numpy as np
import wavebalance as wb
from event_flow import EventFlow
from impact_oracle import ImpactOracle, strikes_of
from impact_structures import Structure, columns, leading, mixture_of, periods_of, scene_of

SHARE = 0.7  # of chains that must have a motion with impacts only


def seeds():
    """The first 40 seeds, or 200 of them if the environment requests full campaigns."""
    extent = os.environ.get("WAVEBALANCE_CAMPAIGN")
    assert extent in (None, "full"), extent
    return range(1, 1 + (200 if extent else 40))


def random_structure(seed):
    """A chain of 1 to 5 masses whose load reaches its stops."""
    random = np.random.default_rng(seed)
    size = int(random.integers(1, 6))
    springs = random.uniform(0.5, 2.0, size)
    stiffness = np.diag(springs + np.r_[springs[1:], 0.0]) - np.diag(springs[1:], 1) - np.diag(springs[1:], -1)
    mass = np.diag(random.uniform(0.5, 1.5, size))
    damping = random.uniform(0.01, 0.11) * stiffness + 0.02 * mass
    omega, restitution = random.uniform(0.3, 2.8), random.uniform(0.1, 0.95)
    contacts = np.zeros((2 if random.random() < 0.3 else 1, size))
    contacts[0, -1] = 1.0
    if len(contacts) > 1:
        contacts[1, 0 if random.random() < 0.5 else size - 1] = -1.0
    one = Structure(mass, damping, stiffness, contacts, 0.0, restitution, omega, size - 1)
    one.gap = random.uniform(0.05, 0.95) * np.abs(contacts @ one.free_amplitudes())
    return one


class InTime:
    """The integration of a structure from event to event, which begins with every contact open."""

    def __init__(self, structure, periods):
        self.flow, self.open = EventFlow(mixture_of(structure), periods), ("open",) * len(structure.contacts)

    def after(self, state, time):
        return self.flow.over(self.open, np.r_[state, 1.0, 1.0, 0.0], time)[1][: len(state)]

    def impacts(self, state):
        """Time, contact and velocity before it of each impact of a period."""
        period, n, found = self.flow.period, len(state) // 2, []
        self.after(state, period)
        for time, c, event, _ in self.flow.events:
            assert event == "impact"
            found.append((time, c, self.flow.contacts[c]["direction"] @ self.after(state, time - 1e-10 * period)[n:]))
        return found

    def growth(self, state, change):
        """The largest modulus of the multipliers, by differences."""
        columns = [self.after(state + step, self.flow.period) - self.after(state - step, self.flow.period)
                   for step in change * np.eye(len(state))]
        return np.abs(np.linalg.eigvals(np.array(columns).T / (2.0 * change))).max()


def compare(structure, record):
    """The error of a motion with impacts only, or None."""
    periods, oracle = periods_of(record.summary), ImpactOracle(structure)
    in_time, period = InTime(structure, periods), periods * oracle.load_period
    expected = strikes_of(columns(record, "impacts.csv"), period) if record.summary["impacts"] else []
    begin = oracle.periodic(expected, periods, 0.0)[:, 0]
    end, found = in_time.after(begin, period), in_time.impacts(begin)
    size = abs(leading(record.summary))
    growth = max(1.0, size)
    if not np.linalg.norm(end - begin) <= 1e-8 * growth * np.linalg.norm(begin):
        return f"the state is {np.linalg.norm(end - begin):.1e} apart after a period"
    if [c for _, c, _ in found] != [one.contact for one in expected]:
        return f"contacts strike in another order: {found}, {expected}"
    for (time, _, velocity), other in zip(found, expected):
        if not (abs(time - other.time) <= 1e-8 * growth * period and abs(velocity - other.velocity) <= 1e-7 * growth):
            return f"an impact is another: {time, velocity}, {other}"
    if not abs(in_time.growth(begin, 1e-6 / math.sqrt(growth)) - size) <= 1e-3 * growth:
        return f"the leading multiplier is not {size:.6f}"
    return None


def test_motions_of_random_chains_are_those_in_time():
    wrong, answered = {}, 0
    for seed in seeds():
        structure = random_structure(seed)
        record = wb.run(scene_of(structure))
        if not record.converged or record.summary["solved_by"] != "impacts":
            continue
        answered += 1
        found = compare(structure, record)
        if found:
            wrong[seed] = found
    print(f"{answered} of {len(seeds())} chains have a motion with impacts alone")
    assert not wrong
    assert answered >= SHARE * len(seeds())
