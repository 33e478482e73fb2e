"""Structures with friction whose exact motions are known: first harmonics and work by event-driven integration.

The residuals of its map of a period are below 1e-11.
"""

import numpy as np
from rubbing_structures import lifting, mixture, plane, slider


def slider_on_oscillator(load, tangential, omega, limit=1.0):
    """x'' + 0.05 x' + x + f = F cos wt."""
    one = np.ones((1, 1))
    return mixture(one, 0.05 * one, one, omega, np.array([load]), [slider([1.0], tangential, limit)])


def rubbing_masses(load, tangential, limit, omega, damper_on_second=0.0):
    """Two unit masses between springs of 1, damping 0.02 K, the load on the second, the slider on the first."""
    stiffness = np.array([[2.0, -1.0], [-1.0, 2.0]])
    damping = 0.02 * stiffness + np.diag([0.0, damper_on_second])
    return mixture(np.eye(2), damping, stiffness, omega, np.array([0.0, load]), [slider([1.0, 0.0], tangential, limit)])


def chain_of_three(load, omega):
    """Three unit masses, a slider between the first and the ground and one between the first two."""
    stiffness = 2.0 * np.eye(3) - np.eye(3, k=1) - np.eye(3, k=-1)
    contacts = [slider([1.0, 0.0, 0.0], 20.0, 1.0), slider([-1.0, 1.0, 0.0], 20.0, 1.0)]
    return mixture(np.eye(3), 0.02 * stiffness, stiffness, omega, np.array([0.0, load, 0.0]), contacts)


def lift_off(load_x, load_y, normal_load, friction, omega):
    """A mass that moves along x and towards an obstacle along y, on which it rubs."""
    contact = lifting([1.0, 0.0], [0.0, 1.0], 5.0, friction, normal_load, 21.0)
    stiffness = np.array([[12.0, -3.0], [-3.0, 10.0]])
    return mixture(np.eye(2), 0.35 * np.eye(2), stiffness, omega, np.array([load_x, 0.0]), [contact],
                   phased=np.array([0.0, load_y * np.exp(-0.7j)]), static=np.array([0.0, normal_load]))


def slip_in_a_plane(limit, omega):
    """A mass that slips in a plane under a constant limit."""
    return mixture(np.eye(2), 0.04 * np.eye(2), np.array([[1.0, 0.2], [0.2, 1.6]]), omega, np.array([1.0, 0.0]),
                   [plane(np.eye(2), 3.0, limit)], phased=np.array([0.0, 0.8 * np.exp(-1.1j)]))


def cantilever(load, tangential, limit, frequency):
    """Four Euler-Bernoulli elements, transverse and rotational, with a slider at the second node."""
    l, modulus, inertia, line_mass = 0.5, 185e9, 0.3 * 0.1**3 / 12.0, 7830.0 * 0.1 * 0.3
    k = modulus * inertia / l**3 * np.array([[12, 6 * l, -12, 6 * l], [6 * l, 4 * l * l, -6 * l, 2 * l * l],
                                             [-12, -6 * l, 12, -6 * l], [6 * l, 2 * l * l, -6 * l, 4 * l * l]])
    m = line_mass * l / 420.0 * np.array([[156, 22 * l, 54, -13 * l], [22 * l, 4 * l * l, 13 * l, -3 * l * l],
                                          [54, 13 * l, 156, -22 * l], [-13 * l, -3 * l * l, -22 * l, 4 * l * l]])
    stiffness, mass = np.zeros((10, 10)), np.zeros((10, 10))
    for e in range(0, 8, 2):
        stiffness[e : e + 4, e : e + 4] += k
        mass[e : e + 4, e : e + 4] += m
    unit, held = np.eye(8), stiffness[2:, 2:]
    omega = 2.0 * np.pi * frequency
    return mixture(mass[2:, 2:], 2e-4 * held, held, omega, load * unit[6], [slider(unit[2], tangential, limit)])


# Name: structure, row of S, amplitude and angle (degrees) of 2/T times the integral of u exp(i w t), work of a period.
KNOWN = {
    "Jenkins 1": (slider_on_oscillator(2.0, 1.0, 1.0), 0, 15.24880669, 78.03919810, 57.20200604),
    "Jenkins 2": (slider_on_oscillator(2.0, 1.0, 1.2), 0, 5.002826509, 138.47166233, 16.12103657),
    "Jenkins 3": (slider_on_oscillator(1.5, 1.0, 1.3), 0, 2.877360723, 137.01667201, 7.553103559),
    "Jenkins 4": (slider_on_oscillator(0.5, 1.0, 1.41), 0, 1.356058056, 121.76679083, 1.403619588),
    "Jenkins 5": (slider_on_oscillator(2.0, 1.0, 0.45), 0, 1.097855263, 4.95798686, 0.4751676217),
    "Jenkins 6": (slider_on_oscillator(1.5, 10.0, 1.1), 0, 3.283576885, 107.75333803, 12.87055849),
    "Jenkins 7": (slider_on_oscillator(2.0, 10.0, 0.35), 0, 1.922715379, 34.20697379, 6.517261824),
    "masses 1": (rubbing_masses(1.0, 20.0, 1.0, 1.1), 0, 0.3190945734, 88.87064027, 1.243657049),
    "masses 2": (rubbing_masses(1.0, 2.0, 0.3, 1.0), 0, 15.49106365, 88.03905311, 18.42165955),
    "masses 3": (rubbing_masses(1.0, 2.0, 0.3, 1.7), 0, 2.410075263, -131.91800580, 2.71834876),
    "masses 4": (rubbing_masses(1.0, 2.0, 0.3, 0.6), 0, 0.3837520286, 30.77841669, 0.3501968699),
    "masses 5": (rubbing_masses(0.3, 20.0, 1.0, 1.4), 0, 0.2490895418, 166.60129865, 0.9009964397),
    "lift-off 1": (lift_off(2.0, 2.0, 0.6, 0.5, 3.0), 1, 0.8394928991, 36.26958233, 0.08956782539),
    "lift-off 2": (lift_off(2.0, 0.3, 0.8, 0.5, 3.6), 1, 0.8480504295, 137.81003911, 0.0867303503),
    "lift-off 3": (lift_off(1.0, 1.0, 0.6, 0.5, 2.4), 1, 0.16760139, 16.55471259, 0.009501358651),
    "lift-off 4": (lift_off(3.0, 3.0, 0.6, 0.3, 4.5), 1, 0.1494001728, 87.36462453, 0.16813445),
    "lift-off 5": (lift_off(2.0, 2.0, 0.6, 0.5, 5.2), 1, 0.09885903968, 148.48560834, 0.07204846169),
    "beam 1": (cantilever(200.0, 1e7, 500.0, 21.0), 0, 0.0002213141966, 103.11964394, 0.3432899534),
    "beam 2": (cantilever(200.0, 1e7, 500.0, 23.0), 0, 0.0001398661067, 130.18112343, 0.1810996299),
    "beam 3": (cantilever(1000.0, 1e7, 500.0, 30.0), 0, 0.0001678063563, 171.65973218, 0.23311738),
    "beam 4": (cantilever(200.0, 1e8, 300.0, 25.0), 0, 5.617511121e-05, 142.61810670, 0.06321740761),
    "chain 1": (chain_of_three(6.0, 1.0), 0, 5.457548875, 169.30886378, 23.90822297),
    "chain 2": (chain_of_three(3.0, 0.85), 0, 6.92202665, 151.41079665, 36.60300851),
    "plane 1": (slip_in_a_plane(0.4, 1.1), 0, 3.062298476, 119.045638, 5.86809935),
    "plane 2": (slip_in_a_plane(0.5, 1.6), 0, 0.702498735, 158.844637, 2.31546099),
    "plane 3": (slip_in_a_plane(0.6, 0.6), 0, 0.823732656, 41.523253, 1.98552060),
}
