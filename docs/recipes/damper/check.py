"""A damper that always sticks is a spring, and friction dissipates the work of the load."""
import json

import numpy as np
from scipy.io import mmread

M, C, K = (mmread(f"{name}.mtx").toarray() for name in ("mass", "damping", "stiffness"))
load = np.eye(21)[18]
stuck = np.genfromtxt("stuck/sweep.csv", delimiter=",", names=True)
platform, neighbour = np.eye(21)[2] - np.eye(21)[20], np.eye(21)[20]
held = K + 1e6 * (np.outer(platform, platform) + np.outer(neighbour, neighbour))
worst = 0.0
for frequency, amplitude in zip(stuck["frequency_Hz"], stuck["row_19_amplitude_1_m"]):
    w = 2 * np.pi * frequency
    worst = max(worst, abs(amplitude / abs(np.linalg.solve(held + 1j * w * C - w**2 * M, load)[18]) - 1))
print(f"always sticking: the tip within {worst:.1e} of the linear blade with both springs")
assert worst < 1e-8

record = json.load(open("peak/summary.json"))
motion, w = mmread("peak/motion.mtx"), 2 * np.pi * record["frequency_Hz"]
x = np.fft.fft(motion) / motion.shape[1]                # harmonics of all rows
velocity = np.real(np.fft.ifft(1j * w * np.fft.fftfreq(motion.shape[1], 1 / motion.shape[1]) * x) * motion.shape[1])
put_in = np.pi * np.imag(-2 * x[18, 1])                 # of 1 N cos(w t) at the tip, J a period
damping = np.mean(np.sum(velocity * (C @ velocity), axis=0)) * 2 * np.pi / w
left = (put_in - damping - record["friction_work_J"]) / put_in
print(f"put in {put_in:.4e} J, damping {damping:.4e} J, friction {record['friction_work_J']:.4e} J; left over {left:.1e}")
assert abs(left) < 1e-3
