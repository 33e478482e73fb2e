"""Laws of Python functions: slopes, integrals and the arguments of a force."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Sequence

import numpy as np

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
