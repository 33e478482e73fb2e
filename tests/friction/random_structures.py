"""Random structures whose contacts rub, and chains on supports or between stops."""

import numpy as np
from rubbing_structures import lifting, mixture, slider
from standard_random import StandardRandom


def chain_that_rubs(seed):
    """Unit masses that move along x and y between springs, each pressed against an obstacle along y.

    They rub on it along x. The last one is driven along both, with a phase.
    """
    any = StandardRandom(seed).uniform
    masses = 1 + int(10 * any())
    size = 2 * masses
    stiffness = np.zeros((size, size))
    for i in range(masses):
        for a in (2 * i, 2 * i + 1):
            stiffness[a, a] += 0.5 + 0.5 * any()
            if i + 1 < masses:
                stiffness[a, a] += 2.0
                stiffness[a + 2, a + 2] += 2.0
                stiffness[a, a + 2] = stiffness[a + 2, a] = -2.0
        coupling = 0.3 * (any() - 0.5)
        stiffness[2 * i, 2 * i + 1] += coupling
        stiffness[2 * i + 1, 2 * i] += coupling
    damping = 0.05 * stiffness + 0.02 * np.eye(size)
    friction, normal_load = 0.2 + 0.6 * any(), 0.5 * any()
    normal, tangential = 10.0 ** (0.5 + 1.5 * any()), 10.0 ** (0.3 + 1.7 * any())
    amplitude, omega = 0.5 + 2.0 * any(), 0.4 + 1.6 * any()
    unit = np.eye(size)
    contacts = [lifting(unit[2 * i], unit[2 * i + 1], tangential, friction, normal_load, normal)
                for i in range(masses)]
    return mixture(unit, damping, stiffness, omega, amplitude * unit[-2] + 0.5 * unit[1], contacts,
                   phased=0.8 * amplitude * np.exp(-1.0j) * unit[-1], static=normal_load * unit[1::2].sum(axis=0))


def coupled_masses(seed):
    """Up to three masses that move along x and y and rub along x, against obstacles along y or under a constant load.

    Some dampers are negative, so that without contact the structure is unstable.
    """
    any = StandardRandom(seed).uniform
    masses = 1 + int(3 * any())
    size = 2 * masses
    stiffness = np.diag([4.0 + 8.0 * any() for _ in range(size)])
    for i in range(size):
        for j in range(i):
            stiffness[i, j] = stiffness[j, i] = -2.0 * any() / masses
    damping = 0.02 * stiffness
    damping += 0.1 * any() * np.eye(size)
    if any() < 0.4:
        damping[0, 0] -= 0.5 * any()
    load = np.array([2.0 * any() - 0.5 for _ in range(size)])
    unit, static, contacts = np.eye(size), np.zeros(size), []
    for i in range(masses):
        normal_load, friction = 0.1 + any(), 0.1 + 0.5 * any()
        if any() < 0.5:
            contacts.append(slider(unit[2 * i], 2.0 + 10.0 * any(), friction * normal_load))
        else:
            normal, tangential = 5.0 + 20.0 * any(), 2.0 + 10.0 * any()
            contacts.append(lifting(unit[2 * i], unit[2 * i + 1], tangential, friction, normal_load, normal))
            static[2 * i + 1] = normal_load
    return mixture(unit, damping, stiffness, 1.0 + 3.0 * any(), load, contacts, static=static)


def rubbing_chain(masses, rubbing, driven, tangential, limit, load):
    """Unit masses between springs of 1, clamped at one end, of which one rubs under a constant limit."""
    stiffness = 2.0 * np.eye(masses) - np.eye(masses, k=1) - np.eye(masses, k=-1)
    stiffness[-1, -1] = 1.0
    unit = np.eye(masses)
    contacts = [slider(unit[rubbing], tangential, limit)]
    return mixture(unit, 0.01 * stiffness, stiffness, 1.0, load * unit[driven], contacts)


def random_rubbing_chain(seed):
    random = StandardRandom(seed)
    masses, tangential = random.between(2, 4), (1.0, 5.0, 20.0, 100.0)[random.between(0, 3)]
    rubbing, driven = random.between(0, masses - 1), random.between(0, masses - 1)
    limit = random.uniform(0.2, 2.0)
    return rubbing_chain(masses, rubbing, driven, tangential, limit, limit * (1.2, 2.0, 5.0)[random.between(0, 2)])
