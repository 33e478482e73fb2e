import numpy as np
import wavebalance as wb

def rubber(u):  # N at a displacement in m
    return 3e8 * max(u - 1e-3, 0.0) ** 2


stop = wb.Function(rubber, gap=1e-3, unilateral=True)
M, K = np.diag([1.0, 0.5]), np.array([[5e5, -2e5], [-2e5, 2e5]])
masses = wb.Structure(M, 1e-5 * K, K, load=[0.0, 200.0], contacts=[1])
response = wb.forced_response(masses, stop, 30.0)
print(response, response.displacement.max(), "m", response.stability())
