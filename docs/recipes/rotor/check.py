"""In an isotropic rotor the rub turns with the speed: one complex equation a radius. How far is the curve from it?"""
import numpy as np
from scipy.io import mmread

curve = np.genfromtxt("out/sweep.csv", delimiter=",", names=True)
M, C, K, G = (mmread(f"{name}.mtx").toarray() for name in ("mass", "damping", "stiffness", "gyroscopic"))
n, x = len(M) // 2, 4
coupling = G[:n, n:]                                    # of y on x; x + i y turns with exp(i w t)
worst = 0.0
for f, r in zip(curve["frequency_Hz"], curve["row_5_amplitude_1_m"]):
    w = 2 * np.pi * f
    D = K[:n, :n] + 1j * w * (C[:n, :n] - 1j * w * coupling) - w**2 * M[:n, :n]
    H = np.linalg.inv(D)[x, x]
    deep = max(r - 0.3e-3, 0.0)
    load = abs(r / H + 1e6 * deep * (1 + 0.1j))         # N that this radius needs
    worst = max(worst, abs(load / (1.5e-4 * w**2) - 1))
print(f"{len(curve)} points of the curve: the load that each radius needs is that of the unbalance within {worst:.1e}")
assert worst < 1e-6
