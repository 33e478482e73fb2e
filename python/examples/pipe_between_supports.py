"""A pipe of a heat exchanger between supports with clearance on both sides, over the frequency."""

import numpy as np

import wavebalance as wb

length, outer, inner, elements = 1.0, 0.019, 0.0165, 24  # m
modulus, density = 200e9, 7850.0  # Pa, kg/m^3
area = np.pi / 4 * (outer**2 - inner**2)
bending = modulus * np.pi / 64 * (outer**4 - inner**4)
h = length / elements

# Euler and Bernoulli's beam, both ends clamped: deflection and slope at each node.
size = 2 * (elements + 1)
M, K = np.zeros((size, size)), np.zeros((size, size))
m = density * area * h / 420 * np.array([[156, 22 * h, 54, -13 * h], [22 * h, 4 * h**2, 13 * h, -3 * h**2],
                                         [54, 13 * h, 156, -22 * h], [-13 * h, -3 * h**2, -22 * h, 4 * h**2]])
k = bending / h**3 * np.array([[12, 6 * h, -12, 6 * h], [6 * h, 4 * h**2, -6 * h, 2 * h**2],
                               [-12, -6 * h, 12, -6 * h], [6 * h, 2 * h**2, -6 * h, 4 * h**2]])
for e in range(elements):
    M[2 * e : 2 * e + 4, 2 * e : 2 * e + 4] += m
    K[2 * e : 2 * e + 4, 2 * e : 2 * e + 4] += k
M, K = M[2:-2, 2:-2], K[2:-2, 2:-2]
C = 20.0 * M + 2e-5 * K


def deflection(fraction):  # the row of a node
    return 2 * (round(fraction * elements) - 1)


load = np.zeros(len(M))
load[0::2] = 25.0 * h  # N/m of the flow
gap = 0.25e-3  # m
pipe = wb.Structure(M, C, K, load, contacts=[deflection(1 / 3), deflection(2 / 3)])
supports = wb.Clearance(stiffness=1e6, gap=gap)

first = np.sqrt(bending / (density * area)) * (4.730041 / length) ** 2 / (2 * np.pi)
curve = wb.frequency_sweep(pipe, supports, 0.8 * first, 1.3 * first, wb.Pair("fourier", 31, 256), stability=False)
peak = int(np.argmax(curve.max_displacement))
print(f"{curve.status}: first frequency {first:.2f} Hz, peak at {curve.frequency[peak]:.2f} Hz with {1e3 * curve.max_displacement[peak]:.3f} mm")
assert curve.converged
# Supports stiffen: the peak is above the natural frequency, and the pipe hardly passes them.
assert curve.frequency[peak] > first and gap < curve.max_displacement[peak] < 1.5 * gap

response = curve.response(peak)
motion = response.motion(2048)
# Pipe and load are symmetric, and so are both supports' forces and both sides of each.
np.testing.assert_allclose(motion.force[0], motion.force[1], atol=1e-6 * np.abs(motion.force).max())
half = np.roll(motion.displacement[0], 1024)
np.testing.assert_allclose(motion.displacement[0], -half, atol=1e-6 * np.abs(half).max())
# The damping dissipates the work of the flow in a period.
whole = response.structure_motion(2048)
supplied = np.mean(np.cos(2 * np.pi * whole.time) * (load @ whole.velocity))
dissipated = np.mean(np.sum(whole.velocity * (C @ whole.velocity), axis=0))
assert abs(supplied - dissipated) < 1e-2 * dissipated
