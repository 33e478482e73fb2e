"""Scenes whose bases are compared, and what tests read from comparisons."""

import numpy as np

TWO_PAIRS = "fourier:fourier,bspline:bspline"

# m = k = 1, c = 0.05, a stop of 2 N/m at 1 m, 0.2 N: a bar of one element. The curve has two folds, near 0.1737 Hz and
# 0.1892 Hz, between which there are three motions.
STOP = {
    "structure": {"type": "bar", "youngs_modulus": 1.0, "density": 2.0, "area": 1.0, "length": 1.0, "elements": 1,
                  "lumped_mass_fraction": 1.0, "stiffness_damping": 0.05},
    "contact": {"law": "linear", "stiffness": 2.0, "gap": 1.0},
    "forcing": {"amplitude": 0.2, "frequency": 0.18},
    "time": {"trial": "fourier", "weight": "fourier", "functions": 63, "quadrature_points": 1024},
    "analysis": {"type": "forced_response"},
}

# Two masses with a damping that couples their modes, of which the second presses on a stop with a force of the
# velocity, almost without leaving it.
CLOSED_STOP = {
    "structure": {"type": "matrices", "mass": np.diag([2.39, 2.26]), "contact_dofs": [2],
                  "stiffness": np.array([[8950.0, -4170.0], [-4170.0, 4170.0]]),
                  "damping": np.array([[6.06, -1.87], [-1.87, 3.81]])},
    "contact": {"law": "kelvin_voigt", "stiffness": 7960.0, "damping": 104.7, "gap": -1.73e-3,
                "damping_depth": 3.48e-4},
    "forcing": {"load_dofs": [1], "amplitude": 7.5, "frequency": 7.74},
    "time": {"trial": "fourier", "weight": "fourier", "functions": 63},
}

# Three masses of 2 kg between springs of 1e6 N/m, free at the end, of which the last two touch obstacles.
CHAIN = {
    "structure": {"type": "matrices", "mass": 2.0 * np.eye(3), "contact_dofs": [2, 3], "modal_damping": 0.1,
                  "stiffness": 1e6 * np.array([[2.0, -1.0, 0.0], [-1.0, 2.0, -1.0], [0.0, -1.0, 1.0]])},
    "contact": {"law": "linear", "stiffness": 1e7, "gap": 1e-4},
    "forcing": {"load_dofs": [3], "amplitude": 300.0, "frequency": 30.0},
    "time": {"trial": "fourier", "weight": "fourier", "functions": 32},
    "analysis": {"type": "forced_response"},
}


def rows_of(table, **wanted):
    """The rows with these values, as a list of dictionaries."""
    rows = [dict(zip(table, values)) for values in zip(*table.values())]
    return [row for row in rows if all(row[name] == value for name, value in wanted.items())]


def motion_of(record):
    """Displacements and forces of all contacts, contacts × points."""
    table = record.contacts or record.response
    names = ("displacement_m", "contact_force_N")
    if "contact" not in table:
        return [table[name][None, :] for name in names]
    return [np.array([table[name][table["contact"] == one] for one in np.unique(table["contact"])]) for name in names]


def errors_of(motion, reference):
    """Relative rms errors of the displacements and the forces of all contacts together."""
    return [np.linalg.norm(one - other) / np.linalg.norm(other) for one, other in zip(motion, reference)]
