"""Structures with friction whose exact motions are known from event-driven integrations, as scenes of the package."""

import math

import numpy as np


def slider(stiffness, limit, dofs, **more):
    """A slider of a constant limit along a direction."""
    return {"friction": 1.0, "tangential_stiffness": stiffness, "normal_load": limit, "dofs": dofs, **more}


def scene(matrices, pairs, load, omega, terms=()):
    """M, C and K; contacts; the load (amplitude, degree of freedom) as a cosine; rad/s."""
    mass, damping, stiffness = (np.atleast_2d(np.array(one, float)) for one in matrices)
    return {
        "structure": {"type": "matrices", "mass": mass, "damping": damping, "stiffness": stiffness},
        "contact": {"law": "coulomb", "pairs": pairs},
        "forcing": {"amplitude": load[0], "load_dofs": [load[1]], "frequency": omega / (2.0 * math.pi),
                    **({"terms": list(terms)} if terms else {})},
        "time": {"method": "exact", "tolerance": 1e-10},
        "analysis": {"type": "forced_response"},
    }


def jenkins(load, stiffness, omega, limit=1.0):
    """x'' + 0.05 x' + x + f = F cos(omega t)."""
    return scene((1.0, 0.05, 1.0), [slider(stiffness, limit, [1])], (load, 1), omega)


def masses(load, kt, limit, omega):
    """Two unit masses between springs of 1, damping 0.02 K, the load on the second, the slider on the first."""
    stiffness = np.array([[2.0, -1.0], [-1.0, 2.0]])
    return scene((np.eye(2), 0.02 * stiffness, stiffness), [slider(kt, limit, [1])], (load, 2), omega)


def chain(load, omega):
    """Three unit masses, a slider between the first and the ground and one between the first two."""
    stiffness = 2.0 * np.eye(3) - np.eye(3, k=1) - np.eye(3, k=-1)
    pairs = [slider(20.0, 1.0, [1]), slider(20.0, 1.0, [1, 2], coefficients=[-1.0, 1.0])]
    return scene((np.eye(3), 0.02 * stiffness, stiffness), pairs, (load, 2), omega)


def lift_off(load_x, load_y, normal_load, friction, omega):
    """A mass that moves along x and towards an obstacle along y, on which it rubs."""
    pair = {"friction": friction, "tangential_stiffness": 5.0, "normal_load": normal_load, "normal_stiffness": 21.0,
            "dofs": [2], "tangent": [1]}
    terms = [{"harmonic": 0, "amplitude": normal_load, "dofs": [2]},
             {"amplitude": load_y, "phase": math.degrees(-0.7), "dofs": [2]}]
    return scene((np.eye(2), 0.35 * np.eye(2), [[12.0, -3.0], [-3.0, 10.0]]), [pair], (load_x, 1), omega, terms)


def slip_in_a_plane(limit, omega):
    """A mass that slips in a plane under a constant limit."""
    terms = [{"amplitude": 0.8, "phase": math.degrees(-1.1), "dofs": [2]}]
    return scene((np.eye(2), 0.04 * np.eye(2), [[1.0, 0.2], [0.2, 1.6]]), [slider(3.0, limit, [1], second_tangent=[2])],
                 (1.0, 1), omega, terms)


def beam(load, kt, limit, frequency):
    """Four Euler-Bernoulli elements, transverse and rotational, with a slider at the second node."""
    elements, l = 4, 0.5
    ei, m = 185e9 * 0.3 * 0.1**3 / 12.0 / l**3, 7830.0 * 0.1 * 0.3 * l / 420.0
    k = ei * np.array([[12, 6 * l, -12, 6 * l], [6 * l, 4 * l * l, -6 * l, 2 * l * l],
                       [-12, -6 * l, 12, -6 * l], [6 * l, 2 * l * l, -6 * l, 4 * l * l]])
    mm = m * np.array([[156, 22 * l, 54, -13 * l], [22 * l, 4 * l * l, 13 * l, -3 * l * l],
                       [54, 13 * l, 156, -22 * l], [-13 * l, -3 * l * l, -22 * l, 4 * l * l]])
    stiffness, mass = np.zeros((2, 10, 10))
    for e in range(0, 2 * elements, 2):
        stiffness[e : e + 4, e : e + 4] += k
        mass[e : e + 4, e : e + 4] += mm
    held = stiffness[2:, 2:]
    return scene((mass[2:, 2:], 2e-4 * held, held), [slider(kt, limit, [3])], (load, 7), 2.0 * math.pi * frequency)


# By event-driven integrations with residuals of their period map below 1e-11: the first harmonic of the slider
# (amplitude, degrees behind the load), the work of friction, and the moduli of the two largest multipliers.
ROWS = {
    "Jenkins 1": (jenkins(2.0, 1.0, 1.0), 15.24880669, 78.03919810, 57.20200604, 0.85325385, 0.65482821),
    "Jenkins 2": (jenkins(2.0, 1.0, 1.2), 5.002826509, 138.47166233, 16.12103657, 0.64754840, 0.64754840),
    "Jenkins 3": (jenkins(1.5, 1.0, 1.3), 2.877360723, 137.01667201, 7.553103559, 0.53886293, 0.53886293),
    "Jenkins 4": (jenkins(0.5, 1.0, 1.41), 1.356058056, 121.76679083, 1.403619588, 0.22235916, 0.22235916),
    "Jenkins 5": (jenkins(2.0, 1.0, 0.45), 1.097855263, 4.95798686, 0.4751676217, 0.34209596, 0.34209596),
    "Jenkins 6": (jenkins(1.5, 10.0, 1.1), 3.283576885, 107.75333803, 12.87055849, 0.50867709, 0.50867709),
    "Jenkins 7": (jenkins(2.0, 10.0, 0.35), 1.922715379, 34.20697379, 6.517261824, 0.20389380, 0.20389380),
    "masses 1": (masses(1.0, 20.0, 1.0, 1.1), 0.3190945734, 88.87064027, 1.243657049, 0.92711204, 0.58686155),
    "masses 2": (masses(1.0, 2.0, 0.3, 1.0), 15.49106365, 88.03905311, 18.42165955, 0.93907670, 0.90339657),
    "masses 3": (masses(1.0, 2.0, 0.3, 1.7), 2.410075263, -131.91800580, 2.71834876, 0.92230190, 0.92230190),
    "masses 4": (masses(1.0, 2.0, 0.3, 0.6), 0.3837520286, 30.77841669, 0.3501968699, 0.77228987, 0.73216139),
    "masses 5": (masses(0.3, 20.0, 1.0, 1.4), 0.2490895418, 166.60129865, 0.9009964397, 0.90334314, 0.90334314),
    "lift-off 1": (lift_off(2.0, 2.0, 0.6, 0.5, 3.0), 0.8394928991, 36.26958233, 0.08956782539, 0.63913085, 0.63913085),
    "lift-off 2": (lift_off(2.0, 0.3, 0.8, 0.5, 3.6), 0.8480504295, 137.81003911, 0.0867303503, 0.68426516, 0.68426516),
    "lift-off 3": (lift_off(1.0, 1.0, 0.6, 0.5, 2.4), 0.16760139, 16.55471259, 0.009501358651, 0.60672739, 0.60672739),
    "lift-off 4": (lift_off(3.0, 3.0, 0.6, 0.3, 4.5), 0.1494001728, 87.36462453, 0.16813445, 0.73159211, 0.73159211),
    "lift-off 5": (lift_off(2.0, 2.0, 0.6, 0.5, 5.2), 0.09885903968, 148.48560834, 0.07204846169, 0.7379193, 0.7379193),
    "beam 1": (beam(200.0, 1e7, 500.0, 21.0), 0.0002213141966, 103.11964394, 0.3432899534, 0.71382433, 0.71382433),
    "beam 2": (beam(200.0, 1e7, 500.0, 23.0), 0.0001398661067, 130.18112343, 0.1810996299, 0.63596525, 0.63596525),
    "beam 3": (beam(1000.0, 1e7, 500.0, 30.0), 0.0001678063563, 171.65973218, 0.23311738, 0.79077385, 0.79077385),
    "beam 4": (beam(200.0, 1e8, 300.0, 25.0), 5.617511121e-05, 142.61810670, 0.06321740761, 0.64718010, 0.64718010),
    "chain 1": (chain(6.0, 1.0), 5.457548875, 169.30886378, 23.90822297, 0.83426451, 0.83426451),
    "chain 2": (chain(3.0, 0.85), 6.92202665, 151.41079665, 36.60300851, 0.78746749, 0.78746749),
    "plane 1": (slip_in_a_plane(0.4, 1.1), 3.062298476, 119.045638, 5.86809935, None, None),
    "plane 2": (slip_in_a_plane(0.5, 1.6), 0.702498735, 158.844637, 2.31546099, None, None),
    "plane 3": (slip_in_a_plane(0.6, 0.6), 0.823732656, 41.523253, 1.98552060, None, None),
}
