import numpy as np
import wavebalance as wb
from scipy.io import mmread

M, K = mmread("mass.mtx").tocsc(), mmread("stiffness.mtx").tocsc()
tip = M.shape[0] - 2  # rows from 0: the deflection of the last node
load = np.zeros(M.shape[0])
load[tip] = 0.04  # N
beam = wb.Structure(M, 2e-4 * K, K, load, contacts=[tip])
pair = wb.Pair(functions=63, points=512)
curve = wb.frequency_sweep(beam, wb.Penalty(5e3, gap=1e-3), 14.0, 26.0, pair)
print(curve, "stable points:", np.count_nonzero(curve.stable))
for point in curve.special_points:
    print(f"{point['type']:16} {point['frequency']:.4f} Hz")
peak = curve.response(int(np.argmax(curve.max_displacement)))
print(peak, peak.stability())
