"""A box of 5 kg on an isolator of 12 Hz with 5 % of critical damping."""
import numpy as np
from beams import write

m, f = 5.0, 12.0                                        # kg, Hz
write(mass=[[m]], stiffness=[[m * (2 * np.pi * f)**2]], damping=[[2 * 0.05 * m * 2 * np.pi * f]])
