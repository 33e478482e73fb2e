"""Curves of periodic responses with their stability."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from . import _core, _plots
from ._matrices import as_number
from .laws import LawLike, as_laws
from .responses import ProblemLike, Response, as_problem
from .structure import Pair

__all__ = ["Sweep", "amplitude_sweep", "frequency_sweep"]

Numbers = npt.NDArray[np.float64]


class Sweep:
    """A curve of P periodic responses, in its order through folds. All arrays have P values and are read-only views.

    Attributes
    ----------
    converged: bool
        Whether the curve reached its end and rounding leaves its motions accurate to 1e-3.
    status: str
        "reached_end", or why it ended: "returned", "no_start", "closed", "lost", "unbounded" or "point_limit".
    frequency: numpy.ndarray
        Hz.
    amplitude: numpy.ndarray
        The factor on the load; 1 in a frequency sweep.
    max_displacement, min_displacement, max_abs_displacement, rms_displacement: numpy.ndarray
        Over the period and the contacts, m.
    max_force, contact_fraction, residual: numpy.ndarray
        Largest contact force, N; share of the points in contact; relative residual.
    unstable: numpy.ndarray
        Floquet multipliers outside the unit circle, -1 where not known.
    stable: numpy.ndarray
        Truth values, masked where the stability is not known (numpy.ma): such a motion is neither stable nor unstable.
    contacts: numpy.ndarray
        Intervals of contact within the period.
    stability_status: list[str]
        "converged", or why the stability is not known.
    special_points: list[dict]
        Where the stability or the contact changes: type ("fold", "period_doubling", "neimark_sacker", "grazing",
        "branch"), frequency, amplitude, bracket, multiplier, max_displacement, located.
    wall_seconds: float
        Of the curve and its stability, s.
    """

    def __init__(self, core: _core.Curve) -> None:
        self._core = core
        self.status: str = core.status
        self.wall_seconds: float = core.wall_seconds
        self.converged: bool = core.status == "reached_end" and core.rounding_error <= 1e-3
        self.frequency: Numbers = core.frequency
        self.amplitude: Numbers = core.amplitude
        self.max_displacement: Numbers = core.max_displacement
        self.min_displacement: Numbers = core.min_displacement
        self.max_abs_displacement: Numbers = core.max_abs_displacement
        self.rms_displacement: Numbers = core.rms_displacement
        self.max_force: Numbers = core.max_force
        self.contact_fraction: Numbers = core.contact_fraction
        self.residual: Numbers = core.residual
        known = len(core.unstable) == len(core)
        self.unstable: npt.NDArray[np.int32] = core.unstable if known else np.full(len(core), -1, np.int32)
        self.contacts: npt.NDArray[np.int32] = core.contacts if known else np.full(len(core), -1, np.int32)
        self.stable = np.ma.masked_array(self.unstable == 0, mask=self.unstable < 0)
        self.stability_status: list[str] = core.stability_status
        self.special_points: list[dict[str, Any]] = core.special_points

    def __len__(self) -> int:
        return len(self.frequency)

    def response(self, index: int) -> Response:
        """The response at a point, from 0; negative numbers count from the end. Raises IndexError."""
        return Response(self._core._response(index))

    def special(self, kind: str) -> list[dict[str, Any]]:
        """The special points of one type."""
        return [point for point in self.special_points if point["type"] == kind]

    def plot(self, ax: Any = None) -> Any:
        """Draws the largest displacement with Matplotlib, dashed where unstable, and returns the axes."""
        ax = _plots.axes(ax)
        over_amplitude = self._core.over_amplitude
        _plots.curve(ax, self.amplitude if over_amplitude else self.frequency, self.max_displacement, self.unstable)
        ax.set_xlabel("Factor on the load" if over_amplitude else "Frequency (Hz)")
        ax.set_ylabel("Largest displacement (m)")
        return ax

    def __repr__(self) -> str:
        return f"<wavebalance.Sweep of {len(self)} points: {self.status}>"


def frequency_sweep(
    structure: ProblemLike,
    laws: LawLike,
    frequency_from: float,
    frequency_to: float,
    pair: Pair | None = None,
    *,
    first_step: float | None = None,
    largest_step: float | None = None,
    stability: bool = True,
    max_points: int = 20000,
    output_points: int = 1024,
    form: str = "automatic",
) -> Sweep:
    """The curve of periodic responses over the frequency, by arc length through folds, with its stability.

    Parameters
    ----------
    structure, laws, pair, form:
        As for :func:`forced_response`.
    frequency_from, frequency_to:
        Where it starts and ends, Hz; either may be the larger.
    first_step, largest_step:
        Steps along the curve, Hz.
    stability:
        Whether the Floquet multipliers of each point are counted.
    max_points:
        After which the curve is given up.
    output_points:
        Times per period at which the extremes are taken.

    Raises
    ------
    ValueError
        For frequencies that are not positive, finite and different, and laws that do not fit.
    """
    steps = _core.Steps(first_step or 0.0, largest_step or 0.0, max_points, output_points, stability, form)
    begin = as_number(frequency_from, "frequency_from", "one number in Hz")
    end = as_number(frequency_to, "frequency_to", "one number in Hz")
    problem = as_problem(structure, pair)
    return Sweep(_core.sweep(problem, as_laws(laws), float("nan"), begin, end, steps))


def amplitude_sweep(
    structure: ProblemLike,
    laws: LawLike,
    frequency: float,
    amplitude_from: float,
    amplitude_to: float,
    pair: Pair | None = None,
    *,
    first_step: float | None = None,
    largest_step: float | None = None,
    stability: bool = True,
    max_points: int = 20000,
    output_points: int = 1024,
    form: str = "automatic",
) -> Sweep:
    """The curve of periodic responses over a factor on the load (but its static part) at one frequency.

    Parameters and errors are those of :func:`frequency_sweep`; the amplitudes and steps are factors on the load.
    """
    steps = _core.Steps(first_step or 0.0, largest_step or 0.0, max_points, output_points, stability, form)
    problem = as_problem(structure, pair)
    return Sweep(_core.sweep(problem, as_laws(laws), frequency, amplitude_from, amplitude_to, steps))
