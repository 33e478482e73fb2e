"""The mean tooth force carries the torque, and a run-down in time jumps where the curve folds."""
import json

import numpy as np
from scipy.integrate import solve_ivp

m1, m2, k, gap, mean, error = 0.3, 0.6, 2e8, 40e-6, 400.0, 0.8e-6
c = 2 * 0.04 * np.sqrt(k * m1 * m2 / (m1 + m2))
response = np.genfromtxt("peak/response.csv", delimiter=",", names=True)
print(f"mean tooth force at the peak: {np.mean(response['contact_force_N']):.4f} N of {mean} N")
assert abs(np.mean(response["contact_force_N"]) / mean - 1) < 1e-3


def tooth_force(frequency, state, periods):
    """The state after so many periods, and the largest force of the last 20."""
    w = 2 * np.pi * frequency

    def force(t, y):
        u, v = y[0] - y[1] - error * np.cos(w * t), y[2] - y[3] + error * w * np.sin(w * t)
        return k * (np.maximum(u - gap, 0.0) + np.minimum(u + gap, 0.0)), c * v

    def slope(t, y):
        spring, damper = force(t, y)
        return [y[2], y[3], (mean - spring - damper) / m1, (spring + damper - mean) / m2]

    found = solve_ivp(slope, (0, periods / frequency), state, rtol=1e-7, atol=1e-12, max_step=0.05 / frequency)
    late = found.t > (periods - 20) / frequency
    return found.y[:, -1], np.max(force(found.t[late], found.y[:, late])[0])


points = json.load(open("out/summary.json"))["structure_special_points"]
lower = min(point["frequency_Hz"] for point in points if point["type"] == "fold")
state = np.array([gap + mean / k, 0.0, 0.0, 0.0])
for frequency in (4200.0, 4000.0, 3800.0, 3650.0, 1.001 * lower):
    state, before = tooth_force(frequency, state, 100)
after = tooth_force(0.999 * lower, state, 200)[1]
print(f"fold at {lower:.2f} Hz; running down, the teeth press with up to {before:.0f} N 0.1 % above it and {after:.0f} N 0.1 % below it")
assert after < 1000.0 < before
