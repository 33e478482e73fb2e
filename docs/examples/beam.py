"""A steel cantilever of 0.5 m x 20 mm x 5 mm in 20 beam elements: writes mass.mtx and stiffness.mtx."""
import numpy as np
from scipy.io import mmwrite
from scipy.sparse import lil_matrix

n, length, width, height = 20, 0.5, 0.02, 0.005  # elements, m
E, rho = 210e9, 7850.0                           # Pa, kg/m^3
h, EI, m = length / n, E * width * height**3 / 12, rho * width * height
Ke = EI / h**3 * np.array([[12, 6*h, -12, 6*h], [6*h, 4*h*h, -6*h, 2*h*h],
                           [-12, -6*h, 12, -6*h], [6*h, 2*h*h, -6*h, 4*h*h]])
Me = m * h / 420 * np.array([[156, 22*h, 54, -13*h], [22*h, 4*h*h, 13*h, -3*h*h],
                             [54, 13*h, 156, -22*h], [-13*h, -3*h*h, -22*h, 4*h*h]])
K, M = lil_matrix((2*n + 2, 2*n + 2)), lil_matrix((2*n + 2, 2*n + 2))
for e in range(n):
    dofs = range(2*e, 2*e + 4)                   # deflection and rotation of two nodes
    K[np.ix_(dofs, dofs)] += Ke
    M[np.ix_(dofs, dofs)] += Me
mmwrite("stiffness.mtx", K.tocsc()[2:, 2:])      # the first node is clamped: its rows and columns go
mmwrite("mass.mtx", M.tocsc()[2:, 2:])
