"""Parts and loads of structures that turn."""

from __future__ import annotations

import operator
from collections.abc import Sequence
from typing import Any, Union

import numpy as np
import scipy.sparse
import scipy.sparse.linalg

from ._matrices import as_csc

Unbalance = Union[
    tuple[float, Sequence[int]], tuple[float, Sequence[int], float], tuple[float, Sequence[int], float, int]
]


def unbalance_load(given: Any, size: int) -> tuple[float, list[int], float, int]:
    """Amount, degrees of freedom, phase and harmonic. Raises ValueError."""
    try:
        amount, dofs, *more = given
        phase, harmonic = (*more, *(0.0, 1)[len(more) :])
        rows = [operator.index(dof) for dof in np.atleast_1d(np.asarray(dofs)).tolist()]
        result = float(amount), rows, float(phase), operator.index(harmonic)
    except (TypeError, ValueError):
        raise ValueError(
            f"unbalance has {given!r}; expected (kg m, degrees of freedom), (..., phase in degrees) or (..., phase, harmonic)"
        ) from None
    if result[3] < 1:
        raise ValueError(f"unbalance: harmonic {result[3]}; expected 1 or more")
    if not 1 <= len(rows) <= 2 or len(set(rows)) < len(rows) or not all(0 <= row < size for row in rows):
        raise ValueError(f"unbalance: degrees of freedom {rows}; expected one or two different ones in 0 to {size - 1}")
    return result


def turning_forces(amount: float, dofs: list[int], phase: float, harmonic: int, size: int) -> list[tuple[Any, Any, int]]:
    """The second derivative of -amount cos(Omega t + phase) along the first, a quarter of a turn later along the second."""
    turned = np.exp(1j * np.radians([phase, phase - 90.0]))
    return [(-amount * np.eye(1, size, dof)[0], np.r_[np.zeros(harmonic), one], 2) for dof, one in zip(dofs, turned)]


def turning_part(matrix: Any, name: str, sign: float) -> scipy.sparse.csc_matrix | None:
    """The matrix of that symmetry (1) or skew symmetry (-1). Raises ValueError."""
    if matrix is None:
        return None
    part = as_csc(matrix, name)
    same = part.shape[0] == part.shape[1]
    if not same or scipy.sparse.linalg.norm(part - sign * part.T) > 1e-10 * scipy.sparse.linalg.norm(part):
        raise ValueError(f"{name} is not {'skew-' if sign < 0.0 else ''}symmetric; expected all of it, both triangles")
    return part


def speed(spin_speed: float, turns: bool) -> float:
    """Raises ValueError for one out of range, or of a structure that does not turn."""
    if not 0.0 <= spin_speed < np.inf:
        raise ValueError(f"spin_speed is {spin_speed}; expected rad/s, or 0 to turn with the load")
    if spin_speed and not turns:
        raise ValueError(f"spin_speed is {spin_speed}; expected gyroscopic or spin_stiffness beside it")
    return float(spin_speed)
