"""The exact first mode of a rod against a rigid obstacle, by the closed form of d'Alembert."""

import math

import scipy.optimize


def energy_ratio(period):
    """The energy measure of LL10 over its value at grazing, of a period 3 < T < 4 in units of length and wave speed."""
    speed = 1.0 / (2.0 * period - 6.0)
    return 8.0 * speed**2 * period * (period - 2.0) * (6.0 - period) / (4.0 * math.pi**2)


def frequency_ratio(energy):
    """The frequency at an energy ratio, over the linear one, whose period is 4."""
    return 4.0 / scipy.optimize.brentq(lambda period: energy_ratio(period) - energy, 3.0 + 1e-9, 4.0, xtol=1e-14)
