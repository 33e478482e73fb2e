"""A law of a Python function along several contact directions."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _core
from ._functions import checked_force, takes_velocity, vector_slopes
from .laws import Law

__all__ = ["VectorFunction"]


class VectorFunction(Law):
    """A law of a Python function of the displacements along several contact directions, and of their velocities.

    A squeeze-film damper, for one, whose force along x depends on x, y and both velocities. The function is called with N
    instants at once and must treat them alike, so that it is as fast as its NumPy is. Stability counts it as smooth.

    Parameters
    ----------
    force:
        The forces (N), rows × N, at displacements (m), rows × N; with two arguments at displacements and velocities (m/s).
        They oppose positive displacements.
    rows:
        The number of contact directions, consecutive rows of ``Structure.S``.
    length, speed:
        A displacement (m) and a velocity (m/s) that the motion has. Slopes are central differences over 6e-6 times the size
        of displacements and velocities, or of these where that is more.
    """

    def __init__(self, force: Callable[..., npt.ArrayLike], rows: int = 2, *, length: float = 1e-3, speed: float = 1e-1) -> None:
        if rows < 1:
            raise ValueError(f"rows is {rows}; expected at least 1")
        self._arguments = (force, rows, length, speed)
        self._force = checked_force(force, rows)
        law = _core.vector_law(self._force, vector_slopes(self._force, (length, speed)), rows, takes_velocity(force))
        super().__init__(law, {"force": force, "rows": rows})

    def force(self, displacement: npt.ArrayLike, velocity: npt.ArrayLike = 0.0) -> Any:
        """The forces (N) at displacements (m, rows × N) and velocities (m/s, likewise)."""
        motion = np.asarray(displacement, float)
        return self._force(motion, np.broadcast_to(velocity, motion.shape)) if self.depends_on_velocity else self._force(motion)

    def __reduce__(self) -> Any:
        return _restored_vector_function, self._arguments

    def scene_keys(self) -> dict[str, Any]:
        raise ValueError("a law of Python functions has no keys; forced_response() and the sweeps take structure and law as they are")


def _restored_vector_function(force: Any, rows: int, length: float, speed: float) -> VectorFunction:
    return VectorFunction(force, rows, length=length, speed=speed)
