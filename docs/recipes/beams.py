"""Matrices of straight beams in bending, instead of a finite element program."""
import numpy as np
from scipy.io import mmwrite
from scipy.sparse import csc_matrix


def bending(nodes, stiffness, mass):
    """Mass and stiffness of a beam with these nodes (m), E I (N m^2) and mass per length (kg/m).

    Two rows a node: deflection and slope. Both are (2 n) x (2 n).
    """
    M, K = np.zeros((2 * len(nodes),) * 2), np.zeros((2 * len(nodes),) * 2)
    for e, h in enumerate(np.diff(nodes)):
        rows = np.ix_(*[range(2 * e, 2 * e + 4)] * 2)
        K[rows] += stiffness / h**3 * np.array([[12, 6 * h, -12, 6 * h], [6 * h, 4 * h * h, -6 * h, 2 * h * h],
                                                [-12, -6 * h, 12, -6 * h], [6 * h, 2 * h * h, -6 * h, 4 * h * h]])
        M[rows] += mass * h / 420 * np.array([[156, 22 * h, 54, -13 * h], [22 * h, 4 * h * h, 13 * h, -3 * h * h],
                                              [54, 13 * h, 156, -22 * h], [-13 * h, -3 * h * h, -22 * h, 4 * h * h]])
    return M, K


def write(**matrices):
    """Each matrix to a file of its name."""
    for name, matrix in matrices.items():
        mmwrite(f"{name}.mtx", csc_matrix(matrix))
