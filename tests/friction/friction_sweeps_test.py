"""Sweeps of structures that rub: their curves have corners where contacts begin to slip, some of which turn back."""

import numpy as np
import pytest
import wavebalance as wb
from rubbing_structures import laws_of, structure_of
from random_structures import random_rubbing_chain, rubbing_chain
from standard_random import campaign_seeds

PAIR = wb.Pair("fourier", 31, 124)


class Sweeps:
    """A chain over its first resonances without friction, from one end or the other."""

    def __init__(self, mixture):
        hertz = np.sqrt(np.linalg.eigvalsh(mixture["stiffness"])) / (2.0 * np.pi)
        self.low, self.high = 0.3 * hertz[0], 1.3 * hertz[min(2, len(hertz) - 1)]
        self.problem, self.laws = wb.Problem(structure_of(mixture), PAIR), laws_of(mixture)

    def sweep(self, upwards):
        ends = (self.low, self.high) if upwards else (self.high, self.low)
        return wb.frequency_sweep(self.problem, self.laws, *ends, stability=False)

    def responses_at(self, curve, frequency):
        """Solved for where the curve passes the frequency, from between its neighbours."""
        ahead = curve.frequency - frequency
        found = []
        for k in np.flatnonzero(ahead[:-1] * ahead[1:] <= 0.0):
            share = ahead[k] / (ahead[k] - ahead[k + 1])
            guess = (1.0 - share) * curve.response(k).displacement + share * curve.response(k + 1).displacement
            found.append(wb.forced_response(self.problem, self.laws, frequency, guess=guess, stay_near_guess=True))
            assert found[-1].converged
        return [one.displacement for one in found]

    def holds_all(self, one, other, frequency):
        """Whether all responses of one curve at a frequency are responses of the other."""
        there = self.responses_at(other, frequency)
        wanted = self.responses_at(one, frequency)
        return all(any(np.linalg.norm(a - b) <= 1e-5 * np.linalg.norm(a) for b in there) for a in wanted)

    def are_the_same(self, one, other):
        inside = self.low + np.array([0.2, 0.4, 0.6, 0.8]) * (self.high - self.low)
        return all(self.holds_all(one, other, at) and self.holds_all(other, one, at) for at in inside)


@pytest.mark.parametrize("upwards", [True, False])
def test_a_sweep_turns_corners_of_more_than_a_right_angle(upwards):
    curve = Sweeps(rubbing_chain(3, 1, 1, 20.0, 0.86, 1.72)).sweep(upwards)
    assert curve.status == "reached_end"
    assert curve.residual.max() <= 1e-9


def test_curves_of_random_chains_are_the_same_from_both_ends():
    count, ended, same = campaign_seeds(2, 60), 0, 0
    for seed in range(count):
        sweeps = Sweeps(random_rubbing_chain(seed))
        one, other = sweeps.sweep(True), sweeps.sweep(False)
        ends = one.status == other.status == "reached_end"
        equal = ends and sweeps.are_the_same(one, other)
        if not equal:
            print(f"seed {seed}: {one.status}, {other.status}")
        ended, same = ended + ends, same + equal
    print(f"{ended} of {count} chains: both sweeps end, {same} the same")
    assert 100 * ended >= 95 * count
    assert 100 * same >= 90 * count
