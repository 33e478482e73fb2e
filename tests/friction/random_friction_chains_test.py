"""Random chains of one to ten contacts that open and rub: nine in ten have a response, and each one is periodic."""

import collections

import numpy as np
import pytest
import wavebalance as wb
from rubbing_structures import response_of, rubbing_rows, scene_of
from near_motion import NearMotion
from random_structures import chain_that_rubs
from standard_random import campaign_seeds

SAME = 0.05  # of the state: the error of 31 functions, which an unstable motion multiplies
FEW, MANY = wb.Pair("fourier", 31, 256), wb.Pair("fourier", 127, 1024)


def distance_after_a_period(mixture, response):
    """Between the state at the beginning of a response and that a period later, over the size of the former."""
    whole, rows = response.structure_motion(response.displacement.shape[1]), rubbing_rows(mixture)
    near = NearMotion(mixture, response.displacement[rows], response.contact_force[rows], whole.displacement,
                      whole.velocity)
    states, begin = near.start(0)
    _, end = near.flow.over(states, begin, near.flow.period)
    moving = slice(0, 2 * near.flow.size)
    return np.linalg.norm(end[moving] - begin[moving]) / np.linalg.norm(begin[moving])


def finer_distance(mixture, coarse):
    """The same of 127 functions and 1024 points, from the motion of fewer on; infinite where none is found."""
    finer = response_of(mixture, MANY, guess=coarse.motion(MANY.points).displacement)
    return distance_after_a_period(mixture, finer) if finer.converged else np.inf


def test_responses_of_random_chains_repeat_after_a_period_of_another_integration():
    count, found, distances = campaign_seeds(6, 200), collections.Counter(), {}
    for seed in range(1, count + 1):
        mixture = chain_that_rubs(seed)
        response = response_of(mixture, FEW)
        found[response.strategy if response.converged else response.status] += 1
        if not response.converged:
            contacts = len(mixture["contacts"])
            print(f"seed {seed}, {contacts} contacts: {response.status} after {response.wall_seconds:.1f} s")
            continue
        distances[seed] = distance_after_a_period(mixture, response)
        if distances[seed] >= SAME:
            print(f"seed {seed}: distance {distances[seed]:.1e} with 31 functions")
            distances[seed] = finer_distance(mixture, response)
    print(f"{len(distances)} of {count} solved, worst distance {max(distances.values()):.1e}; {dict(found)}")
    assert not {seed: one for seed, one in distances.items() if not one < SAME}
    assert 10 * len(distances) >= 9 * count


@pytest.mark.parametrize("seed", [84, 155])
def test_chains_whose_motions_never_repeat_have_unstable_responses_near_pieces_that_nearly_return(seed):
    record = wb.run(scene_of(chain_that_rubs(seed), FEW))
    assert record.converged
    assert record.summary["strategy"] == "recurrence"
    assert record.summary["attractor_periods"] == 0
