"""Which of three motions at one frequency does a disturbed structure keep? Floquet multipliers, and a simulation."""

import numpy as np
from scipy.integrate import solve_ivp

import wavebalance as wb

damping, amplitude, stop = 0.05, 0.05, wb.Penalty(stiffness=2.0, gap=0.3)
structure = wb.Structure([[1.0]], [[damping]], [[1.0]], [amplitude], contacts=[0])
pair = wb.Pair("fourier", 127, 1024)
curve = wb.frequency_sweep(structure, stop, 0.13, 0.25, pair)
folds = [point["frequency"] for point in curve.special("fold")]
assert curve.converged and len(folds) == 2

frequency = np.mean(folds)
crossings = [i for i in range(len(curve) - 1) if (curve.frequency[i] - frequency) * (curve.frequency[i + 1] - frequency) < 0.0]
motions = [wb.forced_response(structure, stop, frequency, pair, guess=curve.response(i), stay_near_guess=True) for i in crossings]
assert len(motions) == 3 and all(motion.converged for motion in motions)
stabilities = [wb.stability(motion) for motion in motions]
for motion, stability in zip(motions, stabilities):
    print(f"{frequency:.4f} Hz, {motion.displacement.max():.4f} m: {stability}, multipliers {np.round(stability.multipliers, 4)}")
assert [stability.stable for stability in stabilities] == [True, False, True]


def rate(time, state):
    force = amplitude * np.cos(2 * np.pi * frequency * time) - stop.force(state[0])
    return [state[1], force - damping * state[1] - state[0]]


# Started near each motion, the structure stays at the first and the third, and leaves the second.
for motion, stability in zip(motions, stabilities):
    at = motion.motion(1024)
    start = np.array([at.displacement[0, 0], at.velocity[0, 0]])
    later = solve_ivp(rate, (0.0, 60.0 / frequency), 1.01 * start, rtol=1e-7, atol=1e-9).y[:, -1]
    distance = np.linalg.norm(later - start) / np.linalg.norm(start)
    print(f"{distance:.1e} away after 60 periods")
    assert (distance < 1e-2) == stability.stable
