"""A shaft with a disc between two bearings, in both planes: rows are node, plane (deflection, slope), plane by plane."""
import numpy as np
from beams import bending, write

nodes = np.array([0.0, 0.25, 0.5, 0.65, 0.8])           # m
d = 0.02                                                # m, diameter
M, K = bending(nodes, 210e9 * np.pi * d**4 / 64, 7850 * np.pi * d**2 / 4)
disc = 2 * 2                                            # row of the deflection at 0.5 m
M[disc, disc] += 3.0                                    # kg
M[disc + 1, disc + 1] += 0.006                          # kg m^2 about a diameter
for bearing in (0, 2 * 4):
    K[bearing, bearing] += 5e6                          # N/m
n, zero = len(M), np.zeros_like(M)
G = np.zeros((2 * n, 2 * n))
G[disc + 1, n + disc + 1], G[n + disc + 1, disc + 1] = 0.012, -0.012    # kg m^2 about the axis
write(mass=np.block([[M, zero], [zero, M]]), stiffness=np.block([[K, zero], [zero, K]]), gyroscopic=G,
      damping=8.0 * np.block([[M, zero], [zero, M]]))
