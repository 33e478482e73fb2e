"""A pinion and a wheel that turn freely, along their line of action: rows are r1 theta1, r2 theta2, and the transmission error."""
import numpy as np
from beams import write

m1, m2, k, ratio = 0.3, 0.6, 2e8, 0.04                  # kg: inertia over squared radius; N/m, damping ratio of the mesh
mesh = np.array([1.0, -1.0, -1.0])                      # deflection of the teeth: r1 theta1 - r2 theta2 - error
c = 2 * ratio * np.sqrt(k * m1 * m2 / (m1 + m2))
write(mass=np.diag([m1, m2, 1e-3]), stiffness=np.zeros((3, 3)), damping=c * np.outer(mesh, mesh))
