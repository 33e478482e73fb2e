"""A hammer of 50 g on a spring of 20 Hz with 2 % of critical damping."""
import numpy as np
from beams import write

m, f = 0.05, 20.0                                       # kg, Hz
write(mass=[[m]], stiffness=[[m * (2 * np.pi * f)**2]], damping=[[2 * 0.02 * m * 2 * np.pi * f]])
