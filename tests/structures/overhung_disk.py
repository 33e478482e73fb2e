"""An overhung disk on an isotropic shaft, of matrices that turn, with closed forms of its motions."""

import numpy as np

# Displacement x and y, rotation about y and x, whose moments couple with the speed.
MASS = np.diag([10.0, 10.0, 0.3, 0.3])
STIFFNESS = np.array([[1e6, 0.0, -3e5, 0.0], [0.0, 1e6, 0.0, -3e5], [-3e5, 0.0, 2.5e5, 0.0], [0.0, -3e5, 0.0, 2.5e5]])
DAMPING = 2e-5 * STIFFNESS
POLAR = 0.5  # kg m^2
GYROSCOPIC = np.zeros((4, 4))
GYROSCOPIC[2, 3], GYROSCOPIC[3, 2] = POLAR, -POLAR
SPIN_STIFFNESS = np.diag([0.0, 0.0, 0.2, 0.2])
UNBALANCE = 5e-3  # kg m
ROTOR = f"""
[structure]
type = "matrices"
mass = "m.mtx"
stiffness = "k.mtx"
damping = "c.mtx"
gyroscopic = "g.mtx"
contact_dofs = [1]
[contact]
law = "none"
[forcing]
frequency = 40.0
[[forcing.terms]]
kind = "unbalance"
dofs = [1, 2]
amplitude = {UNBALANCE}
[time]
trial = "fourier"
weight = "fourier"
functions = 31
[analysis]
type = "forced_response"
"""
STOP = {"contact.law": "linear", "contact.stiffness": 1e6, "contact.gap": 2e-4}
FILES = (("m", MASS), ("k", STIFFNESS), ("c", DAMPING), ("g", GYROSCOPIC), ("s", SPIN_STIFFNESS))


def plane(speed, spin_stiffness=0.0):
    """K, C and M of x + iy and its rotation, 2 x 2, in which x = X exp(iwt) turns forwards for w > 0."""
    stiffness = STIFFNESS[::2, ::2] + speed**2 * spin_stiffness * SPIN_STIFFNESS[::2, ::2]
    return stiffness, DAMPING[::2, ::2] - 1j * speed * np.diag([0.0, POLAR]), MASS[::2, ::2]


def whirl(frequency, speed, spin_stiffness=0.0):
    """The complex displacement x + iy of the forward whirl."""
    omega = 2.0 * np.pi * frequency
    stiffness, damping, mass = plane(speed, spin_stiffness)
    return np.linalg.solve(stiffness + 1j * omega * damping - omega**2 * mass, [UNBALANCE * omega**2, 0.0])[0]
