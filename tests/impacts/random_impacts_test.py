"""Random chains with impacts: each motion that is found, against a motion in time by matrix exponentials."""

import os

import numpy as np
import wavebalance as wb
from impact_oracle import ImpactOracle, strikes_of
from impact_structures import Structure, columns, leading, periods_of, scene_of

SHARE = 0.7  # of chains that must have a motion with impacts alone


def seeds():
    """The first 40 seeds, or 200 of them where the environment asks for full campaigns."""
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


def compare(seed, structure, record):
    """What is wrong with a motion of impacts alone, or None."""
    periods, oracle = periods_of(record.summary), ImpactOracle(structure)
    period = periods * oracle.load_period
    expected = strikes_of(columns(record, "impacts.csv"), period) if record.summary["impacts"] else []
    begin = oracle.periodic(expected, periods, 0.0)[:, 0]
    end, found = oracle.advance(begin, 0.0, period)
    size = abs(leading(record.summary))
    growth = max(1.0, size)
    if not np.linalg.norm(end - begin) <= 1e-8 * growth * np.linalg.norm(begin):
        return f"the state is {np.linalg.norm(end - begin):.1e} apart after a period"
    if [one.contact for one in found] != [one.contact for one in expected]:
        return f"contacts strike in another order: {found}, {expected}"
    for one, other in zip(found, expected):
        apart, faster = abs(one.time - other.time), abs(one.velocity - other.velocity)
        if not (apart <= 1e-8 * growth * period and faster <= 1e-7 * growth):
            return f"an impact is another: {one}, {other}"
    if seed % 8 == 0 and expected and not abs(oracle.growth_by_differences(begin, period) - size) <= 1e-3 * growth:
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
        found = compare(seed, structure, record)
        if found:
            wrong[seed] = found
    print(f"{answered} of {len(seeds())} chains have a motion with impacts alone")
    assert not wrong
    assert answered >= SHARE * len(seeds())
