"""A heat exchanger tube of 3 m, clamped at both ends, in both planes: rows are the nodes' deflection and slope, x then y."""
import numpy as np
from beams import bending, write
from scipy.io import mmwrite

nodes = np.linspace(0.0, 3.0, 25)                       # m
d, t = 0.019, 0.0012                                    # m: diameter, wall
area, inertia = np.pi / 4 * (d**2 - (d - 2 * t)**2), np.pi / 64 * (d**4 - (d - 2 * t)**4)
mass = 7850 * area + 0.25                               # kg/m, with the water in it
M, K = (matrix[2:-2, 2:-2] for matrix in bending(nodes, 200e9 * inertia, mass))    # clamped: the ends' rows go
n, zero = len(M), np.zeros_like(M)
write(mass=np.block([[M, zero], [zero, M]]), stiffness=np.block([[K, zero], [zero, K]]),
      damping=2.0 * np.block([[M, zero], [zero, M]]))
along = np.tile([1.0, 0.0], n // 2)                     # all deflections alike
mmwrite("weight.mtx", np.r_[np.zeros(n), -9.81 * M @ along][:, None])              # N: down along y
mmwrite("flow.mtx", np.r_[M @ along, 0.5 * M @ along][:, None] / mass)             # m: lift in x, half of it in y
