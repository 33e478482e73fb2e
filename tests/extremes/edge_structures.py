"""Matrices and contact laws of completed scenes in NumPy, apart from the program."""

from pathlib import Path

import numpy as np
import scipy.io
import scipy.linalg
import scipy.sparse
import scipy.sparse.linalg


class Structure:
    """M u'' + C u' + K u = load cos(2 pi f t) - S^T force."""

    def __init__(self, mass, damping, stiffness, load, directions):
        self.mass, self.damping, self.stiffness = (scipy.sparse.csc_matrix(one) for one in (mass, damping, stiffness))
        self.load, self.directions = load, scipy.sparse.csr_matrix(directions)

    def dynamic(self, pair, frequency, k):
        """The dynamic stiffness of coefficient k."""
        second, first, none = (pair.symbol(d)[k] for d in (2, 1, 0))
        return second * frequency ** 2 * self.mass + first * frequency * self.damping + none * self.stiffness

    def free_span(self, pair, frequency):
        """The largest displacement of a contact without contact forces."""
        load = pair.load()
        motion = np.zeros((len(self.load), len(load)), complex)
        for k in range(len(load)):
            if load[k] != 0.0:
                motion[:, k] = scipy.sparse.linalg.spsolve(self.dynamic(pair, frequency, k), self.load * load[k])
        return np.abs(pair.evaluate(self.directions @ motion)).max()


def bar_matrices(bar, massless):
    """Mass and stiffness of a clamped bar of linear elements; a tip without mass leaves it to its neighbour."""
    count = bar["elements"]
    step = bar["length"] / count
    element, spring = bar["density"] * bar["area"] * step, bar["youngs_modulus"] * bar["area"] / step
    lumped = bar["lumped_mass_fraction"]
    inner, beside = element * (2.0 + lumped) / 3.0, element * (1.0 - lumped) / 6.0
    diagonal, off = np.full(count, inner), np.full(count - 1, beside)
    diagonal[-1] = 0.5 * inner
    if massless:
        diagonal[-2] += diagonal[-1] + 2.0 * off[-1]
        diagonal[-1] = off[-1] = 0.0
    springs = np.full(count, 2.0 * spring)
    springs[-1] = spring
    coupling = np.full(count - 1, -spring)
    return (scipy.sparse.diags([off, diagonal, off], [-1, 0, 1]),
            scipy.sparse.diags([coupling, springs, coupling], [-1, 0, 1]))


def bar_of(scene):
    bar, contact = scene["structure"], scene["contact"]
    massless = bar["massless_tip"] or (contact["law"] == "rigid" and contact.get("mass") != "keep")
    mass, stiffness = bar_matrices(bar, massless)
    tip = np.zeros(bar["elements"])
    tip[-1] = 1.0
    load = scene["forcing"]["amplitude"] * tip
    return Structure(mass, bar["stiffness_damping"] * stiffness, stiffness, load, tip[None, :])


def matrices_of(scene, folder):
    """Matrices with modal or no damping; before rigid obstacles the contacts leave their mass to the lowest modes."""
    keys = scene["structure"]
    mass, stiffness = (scipy.io.mmread(Path(folder) / keys[name]).toarray() for name in ("mass", "stiffness"))
    squares, shapes = scipy.linalg.eigh(stiffness, mass)
    momenta = mass @ shapes
    damping = momenta @ np.diag(2.0 * keys["modal_damping"] * np.sqrt(squares)) @ momenta.T
    rows = np.array(keys["contact_dofs"]) - 1
    if scene["contact"]["law"] == "rigid":
        low = momenta[:, : len(mass) - len(rows)]
        mass = low @ low.T
    load = np.zeros(len(mass))
    load[np.array(scene["forcing"]["load_dofs"]) - 1] = scene["forcing"]["amplitude"]
    return Structure(mass, damping, stiffness, load, np.eye(len(mass))[rows])


class Law:
    """The unilateral law of a scene's contact at one gap, and its inverse."""

    def __init__(self, keys, gap):
        self.keys, self.gap, self.kind = keys, gap, keys["law"]
        assert self.kind in ("linear", "exponential", "rigid")

    def force(self, displacement):
        depth = np.maximum(displacement - self.gap, 0.0)
        if self.kind == "linear":
            return self.keys["stiffness"] * depth
        constant, power = self.keys["constant"], self.keys["exponent"] * depth
        grown = np.exp(np.minimum(power, 300.0))  # continued by its tangent
        force = constant * (np.expm1(np.minimum(power, 300.0)) + grown * np.maximum(power - 300.0, 0.0))
        return np.minimum(force, np.finfo(float).max)

    def displacement(self, force):
        """Where the law has a force above zero."""
        if self.kind == "linear":
            return self.gap + force / self.keys["stiffness"]
        if self.kind == "exponential":
            return self.gap + np.log1p(force / self.keys["constant"]) / self.keys["exponent"]
        return np.full_like(force, self.gap)


def laws_of(scene, contacts):
    """A law for each contact; none where there is no contact."""
    keys = scene["contact"]
    if keys["law"] == "none":
        return None
    gaps = np.broadcast_to(keys["gap"], contacts)
    return [Law(keys, gap) for gap in gaps]
