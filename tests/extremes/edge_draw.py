"""Random numbers of one seed, and the number of seeds of a campaign."""

import os

import numpy as np

PAIRS = (("fourier", "fourier"), ("fourier", "fourier"), ("bspline", "bspline"), ("daubechies6", "daubechies6"),
         ("daubechies12", "fourier"), ("haar", "fourier"), ("haar", "bspline"))


def campaign_seeds(usual, full):
    """The first seeds, or all of them if the environment requests full campaigns."""
    extent = os.environ.get("WAVEBALANCE_CAMPAIGN")
    assert extent in (None, "full"), extent
    return range(1, (full if extent else usual) + 1)


class Draw:
    def __init__(self, seed):
        self.generator = np.random.default_rng(seed)

    def between(self, least, most):
        return int(self.generator.integers(least, most, endpoint=True))

    def uniform(self, least, most):
        return float(self.generator.uniform(least, most))

    def chance(self, probability):
        return probability > 0.0 and self.uniform(0.0, 1.0) < probability

    def magnitude(self, least_power, most_power):
        return 10.0 ** self.uniform(least_power, most_power)

    def one_of(self, values):
        return values[self.between(0, len(values) - 1)]
