"""A rod, a bar and what tests of their motions share."""

import json

import numpy as np

ROD = {
    "structure": {"type": "bar", "youngs_modulus": 2.1e11, "density": 7800.0, "area": 9e-4, "length": 1.0,
                  "elements": 20, "lumped_mass_fraction": 0.5},
    "contact": {"law": "rigid", "gap": 1e-3},
    "analysis": {"type": "nonlinear_mode", "points": 200},
}
BAR = {
    "structure": {"type": "bar", "youngs_modulus": 70e9, "density": 2700, "area": 25e-4, "length": 1.0,
                  "elements": 25, "stiffness_damping": 1e-4},
    "contact": {"law": "exponential", "constant": 1e8, "exponent": 50.0, "gap": 1e-3},
    "forcing": {"amplitude": 250e3, "frequency": 150.0},
    "time": {"trial": "fourier", "weight": "fourier", "functions": 64, "quadrature_points": 256},
    "analysis": {"type": "forced_response"},
}


def matrices_of(structure):
    """Mass and stiffness of the free nodes of a clamped bar of linear elements, the last node at the tip."""
    size, share = structure["elements"], structure.get("lumped_mass_fraction", 0.0)
    length = structure["length"] / size
    spring = structure["youngs_modulus"] * structure["area"] / length
    weight = structure["density"] * structure["area"] * length
    mass, stiffness = np.zeros((size + 1, size + 1)), np.zeros((size + 1, size + 1))
    for node in range(size):
        both = np.ix_([node, node + 1], [node, node + 1])
        mass[both] += weight * ((1.0 - share) / 6.0 * np.array([[2.0, 1.0], [1.0, 2.0]]) + share / 2.0 * np.eye(2))
        stiffness[both] += spring * np.array([[1.0, -1.0], [-1.0, 1.0]])
    return mass[1:, 1:], stiffness[1:, 1:]


def figure_of(record, folder, name):
    """The data of a record's picture, as its page has them."""
    record.write(folder)
    text = (folder / f"{name}.figure.js").read_text()
    return json.loads(text[text.index('"] = ') + 5:].rstrip().rstrip(";"))


def labels_of(figure):
    """The labels of the lines in the first panel."""
    return [line["label"] for line in figure["panels"][0]["series"]]


def warns(record, part):
    """Whether a warning contains a text."""
    return any(part in text for text in record.warnings)
