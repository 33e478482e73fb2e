"""Structures of 2 to 20 degrees of freedom with one to six contacts and stops of 1 to 1e4 times the static stiffness.

Chains, chains with masses over six decades, two equal chains coupled by 1e-3 of a spring, and full matrices with given
natural frequencies. Gaps are -0.3 to 1 times the contact-free amplitude of their contact.
"""

import dataclasses
import math

import numpy as np
import scipy.linalg
from edge_draw import PAIRS, Draw
from edge_structures import Structure

import wavebalance as wb


@dataclasses.dataclass
class Drawn:
    structure: Structure
    contacts: list  # degrees of freedom from 0
    laws: list  # of the package, one for each contact
    frequency: float  # Hz
    trial: str
    weight: str
    functions: int
    points: int

    def package(self):
        """The structure for the package."""
        one = self.structure
        return wb.Structure(one.mass, one.damping, one.stiffness, one.load, self.contacts)


def add_spring(stiffness, a, b, spring):
    stiffness[[a, b], [a, b]] += spring
    stiffness[[a, b], [b, a]] -= spring


def chain(draw, size, spread):
    """Masses between springs, fixed at the first; `spread` decades of masses."""
    stiffness = np.zeros((size, size))
    stiffness[0, 0] = 1e5 * draw.magnitude(-0.5, 0.5)
    mass = np.diag([draw.magnitude(-0.5 * spread, 0.5 * spread) for _ in range(size)])
    for i in range(size - 1):
        add_spring(stiffness, i, i + 1, 1e5 * draw.magnitude(-0.5, 0.5))
    return mass, stiffness


def twins(draw, size):
    """Two equal chains whose ends are coupled weakly."""
    half = max(size // 2, 1)
    mass, stiffness = (scipy.linalg.block_diag(one, one) for one in chain(draw, half, 0.5))
    add_spring(stiffness, half - 1, 2 * half - 1, 1e2)
    return mass, stiffness


def full(draw, size):
    """Natural frequencies of 5 to 200 Hz and random modes."""
    modes, _ = np.linalg.qr(draw.generator.uniform(-1.0, 1.0, (size, size)))
    squares = [(2.0 * math.pi * 5.0 * draw.magnitude(0.0, 1.6)) ** 2 for _ in range(size)]
    stiffness = modes @ np.diag(squares) @ modes.T
    return np.eye(size), 0.5 * (stiffness + stiffness.T)


def draw_matrices(draw):
    size = draw.between(2, 20)
    return draw.one_of((lambda: chain(draw, size, 0.5), lambda: chain(draw, size, 6.0), lambda: twins(draw, size),
                        lambda: full(draw, size)))()


def draw_laws(draw, contacts, free, flexibility):
    linear, laws = draw.chance(0.5), []
    for dof in contacts:
        gap, stop = free[dof] * draw.uniform(-0.3, 1.0), draw.magnitude(0.0, 4.0) / flexibility[dof]
        exponent = 0.0 if linear else draw.magnitude(-0.5, 1.0) / free[dof]
        laws.append(wb.Penalty(stop, gap) if linear else wb.Exponential(stop / exponent, exponent, gap))
    return laws


def random_structure(seed):
    draw = Draw(seed)
    mass, stiffness = draw_matrices(draw)
    size = len(mass)
    first = math.sqrt(scipy.linalg.eigh(stiffness, mass, eigvals_only=True, subset_by_index=[0, 0])[0])
    damping = 2.0 * draw.magnitude(-2.7, -1.0) / first * stiffness
    load = draw.generator.uniform(-1.0, 1.0, size)
    contacts = [int(dof) for dof in draw.generator.permutation(size)[: min(draw.between(1, 6), size)]]
    frequency = first / (2.0 * math.pi) * draw.magnitude(-0.7, 0.5)
    rate = 2j * math.pi * frequency
    free = np.abs(np.linalg.solve(mass * rate ** 2 + damping * rate + stiffness, load))
    laws = draw_laws(draw, contacts, free, np.diag(np.linalg.inv(stiffness)))
    trial, weight = draw.one_of(PAIRS)
    functions = 1 << draw.between(5, 7)
    structure = Structure(mass, damping, stiffness, load, np.eye(size)[contacts])
    return Drawn(structure, contacts, laws, frequency, trial, weight, functions, functions << draw.between(1, 3))
