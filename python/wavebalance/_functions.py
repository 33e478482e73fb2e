"""Laws of Python functions: slopes, integrals and the arguments of a force."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _core


def takes_velocity(force: Callable[..., float]) -> bool:
    """Whether a force has a second argument without a default."""
    try:
        parameters = inspect.signature(force).parameters.values()
    except (TypeError, ValueError):
        return False  # of compiled functions nothing is known
    kinds = (inspect.Parameter.POSITIONAL_ONLY, inspect.Parameter.POSITIONAL_OR_KEYWORD)
    return sum(one.kind in kinds and one.default is inspect.Parameter.empty for one in parameters) == 2


def velocity_law(
    force: Callable[[float, float], float],
    tangent: Callable[[float, float], float] | None,
    potential: Callable[[float], float] | None,
    damping: Callable[[float, float], float] | None,
    gap: float,
    unilateral: bool,
    kinks: list[float],
    length: float,
    speed: float,
) -> _core.Law:
    def by_displacement(displacement: float, velocity: float) -> float:
        return difference(lambda one: force(one, velocity), length)(displacement)

    def by_velocity(displacement: float, velocity: float) -> float:
        return difference(lambda one: force(displacement, one), speed)(velocity)

    energy = potential if potential is not None else integral(lambda one: force(one, 0.0), gap, kinks)
    return _core.velocity_law(force, tangent or by_displacement, damping or by_velocity, energy, gap, unilateral, kinks)


VectorForce = Callable[..., "npt.ArrayLike"]


def checked_force(force: VectorForce, rows: int) -> Callable[..., npt.NDArray[np.float64]]:
    """A force of several rows that returns an array of the shape of its displacements."""

    def checked(*motion: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        values = np.asarray(force(*motion), float)
        if values.shape != motion[0].shape:
            raise ValueError(f"force returned an array of shape {values.shape}; expected {motion[0].shape}, {rows} rows of as many instants")
        return values

    return checked


def vector_slopes(force: Callable[..., npt.NDArray[np.float64]], sizes: Sequence[float]) -> Callable[..., Any]:
    """Central differences of a force of several rows, by its displacements and by its velocities where it has these."""

    def slopes(*motion: npt.NDArray[np.float64]) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
        both = [np.empty((0, 0, 0)), np.empty((0, 0, 0))]
        for k, size in enumerate(sizes[: len(motion)]):
            step = 6e-6 * np.maximum(np.linalg.norm(motion[k], axis=0), size)
            columns = []
            for row in range(len(motion[k])):
                ahead, back = [list(motion) for _ in range(2)]
                for moved, sign in ((ahead, 1.0), (back, -1.0)):
                    moved[k] = motion[k].copy()
                    moved[k][row] += sign * step
                columns.append((force(*ahead) - force(*back)) / (2.0 * step))
            both[k] = np.stack(columns, axis=1)
        return both[0], both[1]

    return slopes


def difference(force: Callable[[float], float], length: float) -> Callable[[float], float]:
    def tangent(displacement: float) -> float:
        step = 6e-6 * max(abs(displacement), length)
        return (force(displacement + step) - force(displacement - step)) / (2.0 * step)

    return tangent


def integral(force: Callable[[float], float], begin: float, kinks: Sequence[float]) -> Callable[[float], float]:
    nodes, weights = np.polynomial.legendre.leggauss(16)  # type: ignore[no-untyped-call]

    def potential(displacement: float) -> float:
        low, high = min(begin, displacement), max(begin, displacement)
        ends = [low, *(one for one in kinks if low < one < high), high]
        total = 0.0
        for a, b in zip(ends, ends[1:]):
            half = 0.5 * (b - a)
            total += half * sum(w * force(0.5 * (a + b) + half * x) for x, w in zip(nodes, weights))
        return total if displacement >= begin else -total

    return potential
