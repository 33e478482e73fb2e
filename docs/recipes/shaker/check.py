"""Below the clearance the oscillator is linear; the curve jumps where time integration jumps."""
import json

import numpy as np
from scipy.integrate import solve_ivp

m, k, c, stop, gap, base = 5.0, 5.0 * (24 * np.pi)**2, 12 * np.pi, 2.5e5, 6e-3, 9.80665
curve = np.genfromtxt("out/sweep.csv", delimiter=",", names=True)
f, stroke = curve["frequency_Hz"], curve["row_1_amplitude_1_m"]
free = curve["row_1_max_m"] < 0.99 * gap
w = 2 * np.pi * f[free]
linear = m * base / abs(k - m * w**2 + 1j * w * c)
print(f"{sum(free)} points below the clearance: amplitude within {np.max(abs(stroke[free] / linear - 1)):.1e} of the closed form")
assert np.allclose(stroke[free], linear, rtol=1e-8)
ratio = abs((k + 1j * w * c) / (k - m * w**2 + 1j * w * c))
error = np.max(abs(curve["transmissibility_of_row_1_amplitude_1"][free] / ratio - 1))
print(f"transmissibility within {error:.1e} of the closed form")
assert error < 1e-8


def settled(frequency, start, periods=40):
    """The state after some periods, and the largest stroke of the last five."""
    w = 2 * np.pi * frequency

    def slope(t, y):
        force = k * y[0] + c * y[1] + stop * (max(y[0] - gap, 0.0) + min(y[0] + gap, 0.0))
        return [y[1], -force / m - base * np.cos(w * t)]

    found = solve_ivp(slope, (0, periods / frequency), start, method="LSODA", rtol=1e-6, atol=1e-9, max_step=0.1 / frequency)
    return found.y[:, -1], np.max(abs(found.y[0][found.t > (periods - 5) / frequency]))


folds = [point["frequency_Hz"] for point in json.load(open("out/summary.json"))["special_points"] if point["type"] == "fold"]
upper, lower = max(folds), min(folds)
state = np.zeros(2)
for frequency in (*np.arange(11.0, 21.5), 21.5, 21.6, 0.9995 * upper):
    state, before = settled(frequency, state)
after = settled(1.0005 * upper, state, 200)[1]
print(f"folds at {upper:.4f} and {lower:.4f} Hz; a sine sweep has {1e3 * before:.2f} mm just below the upper one, {1e3 * after:.2f} mm just above")
assert before > 9e-3 and after < 6e-3
