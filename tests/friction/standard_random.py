"""Random numbers of C++'s standard library, so that a seed draws the structure that it always has."""

import os

import numpy as np


def campaign_seeds(usual, full):
    """Number of seeds of a campaign: `full` if the environment requests full campaigns."""
    extent = os.environ.get("WAVEBALANCE_CAMPAIGN")
    assert extent in (None, "full"), extent
    return full if extent else usual


class StandardRandom:
    """std::mt19937 with the distributions of libstdc++."""

    def __init__(self, seed):
        self._words = np.random.RandomState(seed)

    def _word(self):
        return int.from_bytes(self._words.bytes(4), "little")

    def uniform(self, least=0.0, most=1.0):
        low, high = self._word(), self._word()
        return (low + high * 2.0**32) / 2.0**64 * (most - least) + least

    def between(self, least, most):
        """A whole number, both ends included."""
        count = most - least + 1
        product = self._word() * count
        while product % 2**32 < 2**32 % count:
            product = self._word() * count
        return least + product // 2**32
