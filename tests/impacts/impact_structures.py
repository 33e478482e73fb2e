"""Structures whose contacts with mass strike rigid stops, and the scenes of the package that solve them."""

import csv
import math
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np


@dataclass
class Structure:
    """M x'' + C x' + K x = load cos(omega t) against stops with a restitution, contacts x <= gap."""

    mass: np.ndarray
    damping: np.ndarray
    stiffness: np.ndarray
    contacts: np.ndarray
    gap: float | np.ndarray
    restitution: float
    omega: float
    loaded: int = 0

    @property
    def gaps(self):
        return np.broadcast_to(np.asarray(self.gap, float), len(self.contacts))

    @property
    def frequency(self):
        return self.omega / (2.0 * math.pi)

    def free_amplitudes(self, omega=None):
        """Amplitudes of all displacements without contact, complex, for exp(i omega t)."""
        w = self.omega if omega is None else omega
        load = np.eye(len(self.mass))[self.loaded]
        return np.linalg.solve(self.stiffness - w * w * self.mass + 1j * w * self.damping, load)


def oscillator(damping, gap, restitution, omega):
    """x'' + c x' + x = cos(omega t), x <= gap."""
    one = np.eye(1)
    return Structure(one, damping * one, one, one, gap, restitution, omega)


def between_stops(damping, gap, restitution, omega):
    one = np.eye(1)
    return Structure(one, damping * one, one, np.array([[1.0], [-1.0]]), gap, restitution, omega)


def two_masses(gap, restitution, omega):
    """Two masses of 1 between three springs of 1, the load on the second, the stop before the first."""
    stiffness = np.array([[2.0, -1.0], [-1.0, 2.0]])
    return Structure(np.eye(2), 0.05 * np.eye(2), stiffness, np.array([[1.0, 0.0]]), gap, restitution, omega, 1)


def lumped_bar(elements, end_mass, damping, gap, restitution, omega):
    """A bar held at one end, EA = rho A = L = 1, C = damping K; at its other end a mass, the load and the stop."""
    length = 1.0 / elements
    mass = np.diag(np.r_[np.full(elements - 1, length), 0.5 * length + end_mass])
    springs = np.diag(np.r_[np.full(elements - 1, 2.0), 1.0]) - np.eye(elements, k=1) - np.eye(elements, k=-1)
    stiffness = springs / length
    end = np.eye(elements)[-1:]
    return Structure(mass, damping * stiffness, stiffness, end, gap, restitution, omega, elements - 1)


def scene_of(structure, kind="forced_response", **analysis):
    """The structure as a scene of the package, under a load of 1 N."""
    pairs = []
    for row, gap in zip(structure.contacts, structure.gaps):
        (dof,) = np.flatnonzero(row)
        pairs.append({"dofs": [int(dof) + 1], "coefficients": [float(row[dof])], "gap": float(gap)})
    forcing = {"load_dofs": [structure.loaded + 1], "amplitude": 1.0}
    if kind != "frequency_sweep":
        forcing["frequency"] = structure.frequency
    return {
        "structure": {"type": "matrices", **{key: getattr(structure, key) for key in ("mass", "damping", "stiffness")}},
        "contact": {"law": "rigid", "restitution": structure.restitution, "pairs": pairs},
        "forcing": forcing,
        "analysis": {"type": kind, **analysis},
    }


def mixture_of(structure):
    """The structure for EventFlow."""
    stops = [{"law": "rigid_stop", "direction": row, "gap": gap, "restitution": structure.restitution}
             for row, gap in zip(structure.contacts, structure.gaps)]
    return {**{key: getattr(structure, key) for key in ("mass", "damping", "stiffness", "omega")},
            "load": np.eye(len(structure.mass))[structure.loaded], "contacts": stops}


def columns(record, name):
    """The numbers of a file that a record writes, by columns."""
    with tempfile.TemporaryDirectory() as folder:
        record.write(folder)
        with open(Path(folder) / name, newline="") as file:
            head, *rows = csv.reader(file)
    return {key: np.array([float(row[i]) for row in rows]) for i, key in enumerate(head)}


def leading(summary):
    return complex(summary["leading_multiplier_real"], summary["leading_multiplier_imag"])


def periods_of(summary):
    """Periods of the load after which the motion repeats."""
    return int(summary.get("period_of_motion") or 1)
