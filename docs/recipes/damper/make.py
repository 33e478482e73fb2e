"""A blade of 0.12 m as a beam with a platform at 24 mm, and a damper of 10 g below it, which lies on its neighbour, too."""
import numpy as np
from beams import bending, write

nodes = np.linspace(0.0, 0.12, 11)                      # m
M, K = (matrix[2:, 2:] for matrix in bending(nodes, 110e9 * 0.02 * 0.003**3 / 12, 4400 * 0.02 * 0.003))
n = len(M)                                              # 20 rows: deflection and slope of nodes 1 to 10
M, K = np.pad(M, (0, 1)), np.pad(K, (0, 1))             # row 21: the damper
M[n, n], K[n, n] = 0.010, 1e3                           # kg, N/m
write(mass=M, stiffness=K, damping=1e-6 * K + 2.0 * M)
