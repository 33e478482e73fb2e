"""Your own structure: from SciPy's matrices to a curve with its stability, and the balance of its power."""

import numpy as np
import scipy.sparse as sp

import wavebalance as wb

n = 20  # masses in a row between springs
M = 0.5 * sp.identity(n)  # kg
K = 1e6 * sp.diags([-1, 2, -1], [-1, 0, 1], shape=(n, n))  # N/m
C = 1e-4 * K  # N s/m
load = np.zeros(n)
load[-1] = 50.0  # N at the last one, cos(2 pi f t)
structure = wb.Structure(M, C, K, load, contacts=[n // 2])
stop = wb.Penalty(stiffness=3e5, gap=3e-4)  # N/m, m: met by the mass in the middle

curve = wb.frequency_sweep(structure, stop, 25.0, 50.0)
folds = [point["frequency"] for point in curve.special("fold")]
print(f"{curve.status}: {len(curve)} points, {np.sum(~curve.stable)} of them not stable, folds at {np.round(folds, 3)} Hz")
assert curve.converged and len(folds) == 2
unstable = curve.frequency[curve.unstable > 0]
assert min(folds) - 1e-3 < unstable.min() and unstable.max() < max(folds) + 1e-3

# The damping dissipates the work of the load: the stop is elastic.
for point in (0, int(np.argmax(curve.max_displacement)), len(curve) // 2, len(curve) - 1):
    motion = curve.response(point).structure_motion(1024)
    velocity = motion.velocity
    supplied = np.mean(np.cos(2 * np.pi * motion.time) * (load @ velocity))
    dissipated = np.mean(np.sum(velocity * (C @ velocity), axis=0))
    print(f"{curve.frequency[point]:.3f} Hz: {supplied:.5g} W supplied, {dissipated:.5g} W dissipated")
    assert abs(supplied - dissipated) < 2e-3 * dissipated
