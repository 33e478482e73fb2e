"""Damping and friction dissipate the work of the flow in a period."""
import json

import numpy as np
from scipy.io import mmread

motion = mmread("at_40_Hz/motion.mtx")                  # rows x instants of a period, m
record = json.load(open("at_40_Hz/summary.json"))
period, phases = 1 / 40, np.arange(motion.shape[1]) / motion.shape[1]
harmonics = np.fft.fftfreq(len(phases), 1 / len(phases))
velocity = np.real(np.fft.ifft(2j * np.pi * 40 * harmonics * np.fft.fft(motion)))
load = 4.0 * mmread("flow.mtx") * np.cos(2 * np.pi * phases)
put_in = np.sum(load * velocity) * period / len(phases)
damping = np.sum(velocity * (mmread("damping.mtx") @ velocity)) * period / len(phases)
friction = record["friction_work_J"]
print(f"put in {put_in:.6e} J, damping {damping:.6e} J, friction {friction:.6e} J; left over {(put_in - damping - friction) / put_in:.1e}")
assert abs(put_in - damping - friction) < 1e-3 * put_in
