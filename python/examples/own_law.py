"""A contact law as a Python function, against time stepping; and the same law as a table, which is fast."""

import numpy as np
from scipy.integrate import solve_ivp

import wavebalance as wb

gap = 0.2


def hertz(displacement):  # N at a displacement in m
    return 8.0 * max(displacement - gap, 0.0) ** 1.5


frequency, damping = 0.12, 0.2
structure = wb.Structure([[1.0]], [[damping]], [[1.0]], [0.5], contacts=[0])
pair = wb.Pair("fourier", 63, 512)
own = wb.forced_response(structure, wb.Function(hertz, gap=gap, unilateral=True, kinks=[gap]), frequency, pair)
u = np.concatenate([[-1.0, 0.0], np.linspace(gap, 1.0, 200)])
table = wb.forced_response(structure, wb.Table(u, [hertz(one) for one in u]), frequency, pair)
assert own.converged and table.converged and own.contact_force.max() > 0.1


def rate(time, state):
    force = 0.5 * np.cos(2 * np.pi * frequency * time) - hertz(state[0])
    return [state[1], force - damping * state[1] - state[0]]


# After many periods time stepping has the same motion.
motion, period = own.motion(64), 1.0 / frequency
settled = solve_ivp(rate, (0.0, 30 * period), [0.0, 0.0], rtol=1e-9, atol=1e-11, t_eval=(29 + motion.time) * period).y[0]
error = np.abs(motion.displacement[0] - settled).max() / np.abs(settled).max()
distance = np.abs(own.displacement - table.displacement).max() / np.abs(settled).max()
print(f"{error:.1e} from time stepping, {distance:.1e} from the table; {1e3 * own.wall_seconds:.1f} ms and {1e3 * table.wall_seconds:.2f} ms")
assert error < 1e-4 and distance < 1e-4
