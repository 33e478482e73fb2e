"""Counts of Floquet multipliers of random structures with elastic friction, compared with another integration."""

import numpy as np
import wavebalance as wb
from rubbing_structures import response_of, rubbing_rows
from near_motion import NearMotion
from random_structures import coupled_masses
from standard_random import campaign_seeds

NEAR = 0.01  # the unit circle: not compared
PAIR = wb.Pair("fourier", 127, 1024)


def near_motion(mixture, response):
    whole, rows = response.structure_motion(PAIR.points), rubbing_rows(mixture)
    return NearMotion(mixture, response.displacement[rows], response.contact_force[rows], whole.displacement,
                      whole.velocity)


def sticks_always(contact, displacement, force):
    """Whether a slider never moves, which leaves its position and a multiplier of 1 to it."""
    return np.ptp(displacement - force / contact["tangential"]) < 1e-9 * np.ptp(displacement)


def test_counts_of_random_structures_are_those_of_differences_of_another_integration():
    count = campaign_seeds(15, 500)
    compared, unstable, close, unsolved, lost, wrong = 0, 0, 0, 0, [], []
    for seed in range(1, count + 1):
        mixture = coupled_masses(seed)
        response = response_of(mixture, PAIR)
        if not response.converged:
            unsolved += 1
            continue
        stability = response.stability()
        assert stability.status == "converged", seed
        near = near_motion(mixture, response)
        if any(map(sticks_always, mixture["contacts"], near.displacement, near.force)):
            continue
        if not near.find():
            lost.append(seed)
            continue
        moduli = np.abs(near.multipliers())
        close += abs(moduli[0] - 1.0) < NEAR
        if (np.abs(moduli - 1.0) < NEAR).any():
            continue
        compared += 1
        unstable += moduli[0] > 1.0
        if stability.unstable != (moduli > 1.0).sum():
            wrong.append((seed, stability.unstable, moduli[:3]))
    print(f"{count} drawn, {compared} compared, {unstable} unstable, {close} near, {unsolved} unsolved, lost {lost}")
    assert not wrong
    assert compared >= count // 2
