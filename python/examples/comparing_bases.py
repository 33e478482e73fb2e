"""Which basis, and how many functions? Measured on a scene, and on a structure in memory."""

import numpy as np

import wavebalance as wb

structure = wb.Structure(np.diag([1.0, 0.5]), np.array([[7.0, -2.0], [-2.0, 2.0]]), 1e5 * np.array([[5.0, -2.0], [-2.0, 2.0]]),
                         load=[0.0, 200.0], contacts=[1])
stop = wb.Penalty(stiffness=1e6, gap=1e-3)

found = wb.compare(structure.scene(stop, frequency=30.0), pairs=["fourier:fourier", "daubechies6:fourier", "bspline:bspline"], budget=2.0)
print(found.text)
assert found.converged
table = {name: np.asarray(values) for name, values in found.table.items()}
assert set(np.unique(table["trial"])) == {"fourier", "daubechies6", "bspline", "phases"}  # with exact solutions

# Errors of the displacement fall with the functions in each of them.
reference = wb.forced_response(structure, stop, 30.0, wb.Pair("fourier", 2047, 8192)).motion(1024).displacement
for name in ("fourier:fourier", "daubechies6:fourier", "bspline:bspline"):
    errors = []
    for functions in (16, 64, 256):
        motion = wb.forced_response(structure, stop, 30.0, wb.Pair(name, functions, 8 * functions)).motion(1024)
        errors.append(np.linalg.norm(motion.displacement - reference) / np.linalg.norm(reference))
    print(name, ["%.1e" % error for error in errors])
    assert errors[2] < 0.1 * errors[0] and errors[2] < 2e-3
