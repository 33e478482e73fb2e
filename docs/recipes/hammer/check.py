"""The hammer flies freely between blows: an integration from blow to blow has the same instants and speeds."""
import numpy as np
from scipy.integrate import solve_ivp

m, k, c, gap, base, w = 0.05, 0.05 * (40 * np.pi)**2, 2 * 0.02 * 0.05 * 40 * np.pi, 2e-3, 100.0, 70 * np.pi
blows = np.atleast_1d(np.genfromtxt("at_100/impacts.csv", delimiter=",", names=True))
t, speed = blows["time_fraction"] / 35, blows["velocity_before_m_per_s"]


def strikes(t, y):
    return y[0] - gap


strikes.terminal, strikes.direction = True, 1.0
found = solve_ivp(lambda t, y: [y[1], -(k * y[0] + c * y[1]) / m - base * np.cos(w * t)], (t[0], t[0] + 0.1),
                  [gap - 1e-15, -0.7 * speed[0]], events=strikes, rtol=1e-11, atol=1e-14)
following = (t[1] if len(t) > 1 else t[0] + 1 / 35), speed[1 % len(speed)]
print(f"next blow at {found.t[-1]:.9f} s with {found.y[1, -1]:.9f} m/s; the record says {following[0]:.9f} s and {following[1]:.9f} m/s")
assert abs(found.t[-1] - following[0]) < 1e-9 and abs(found.y[1, -1] - following[1]) < 1e-7
