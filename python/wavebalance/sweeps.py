"""Curves of periodic responses with their stability."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _core, _plots
from ._matrices import as_count, as_number
from .laws import Function, LawLike, as_laws
from .responses import Problem, ProblemLike, Response, as_problem, harmonics_of
from .structure import Pair

__all__ = ["Sweep", "amplitude_sweep", "frequency_sweep", "overlay"]

Numbers = npt.NDArray[np.float64]


def _may_have_unnamed_kinks(laws: Any) -> bool:
    """Whether one of these laws is a Function without kinks."""
    return any(isinstance(one, Function) and not one._arguments[3]["kinks"] for one in (laws if isinstance(laws, list) else [laws]))


class Sweep(_core.Curve):
    """A curve of P periodic responses, in its order through folds. All arrays have P values and are read-only views.
    It can be pickled, with its structure and laws, and copied.

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
    turning_points: list[dict]
        Every point at which the curve turns: frequency, amplitude, max_displacement, and whether a sample of a contact
        grazes there. The structure jumps at one of them. Some may belong only to the samples and be no folds.
    warnings: list[str]
        Facts that the numbers do not show: a curve that ended early, turns that are no folds in `special_points` or
        the other way round, stability that is not known, motions that are all unstable.
    wall_seconds: float
        Time of the curve and its stability, s.
    """

    def __init__(self, core: _core.Curve, problem: Problem, laws: Any) -> None:
        super().__init__(core)
        self._problem = problem
        self._laws = laws

    @property
    def converged(self) -> bool:
        return self.status == "reached_end" and self.rounding_error <= 1e-3

    @property
    def stable(self) -> Any:
        return np.ma.masked_array(self.unstable == 0, mask=self.unstable < 0)

    @property
    def warnings(self) -> list[str]:
        texts = []
        if self.status != "reached_end":
            texts.append(f'The curve did not reach its end: "{self.status}".')
        elif not self.converged:
            texts.append("Rounding leaves the motions less accurate than 1e-3.")
        if self.status not in ("reached_end", "cancelled") and _may_have_unnamed_kinks(self._laws):
            texts.append("A law of functions has no kinks. If its slope jumps, as at a gap, Function(force, kinks=[gap]) names the place.")
        if len(self) == 0 or len(self.stability_status) != len(self):
            return texts
        turns, folds = len(self.turning_points), len(self.special("fold"))
        if turns != folds:
            texts.append(
                f"The curve turns {turns} times; special_points has {folds} of type fold. turning_points has all turns."
            )
        if np.any(self.unstable < 0):
            count = np.count_nonzero(self.unstable < 0)
            texts.append(f"The stability of {count} of {len(self)} points is not known; stability_status has the reasons.")
        elif np.all(self.unstable > 0):
            texts.append("All motions of the curve are unstable: a structure that is disturbed leaves them.")
        return texts

    def __reduce__(self) -> Any:
        return _restored_sweep, (self._problem, self._laws, _core.curve_state(self))

    def response(self, index: int) -> Response:
        """The response at a point, from 0; negative numbers count from the end. Raises IndexError."""
        return Response(self._response(index), self._problem, self._laws)

    def special(self, kind: str) -> list[dict[str, Any]]:
        """The bifurcation or grazing points of one type. Raises ValueError for a name of none."""
        if kind not in _plots.MARKERS:
            raise ValueError(f"kind is {kind!r}; expected one of {', '.join(_plots.MARKERS)}")
        return [point for point in self.special_points if point["type"] == kind]

    def harmonics(self, dofs: Sequence[int] | None = None, count: int = 3, points: int = 256) -> npt.NDArray[np.complex128]:
        """Complex amplitudes along the curve, P × rows × (count + 1), as :meth:`Response.harmonics` of each point.

        Parameters
        ----------
        dofs:
            Degrees of freedom of the structure, from 0; the contacts by default.
        """
        result = []
        for index in range(len(self)):
            response = self.response(index)
            if dofs is None:
                result.append(response.harmonics(count, points))
            else:
                result.append(harmonics_of(response.structure_motion(points).displacement[list(dofs)], count))
        return np.array(result)

    def to_frame(self) -> Any:
        """The points as a pandas.DataFrame with the columns of sweep.csv; needs pandas."""
        columns: dict[str, Any] = {"amplitude" if self.over_amplitude else "frequency_Hz": self._place()}
        columns |= {
            "max_displacement_m": self.max_displacement,
            "rms_displacement_m": self.rms_displacement,
            "min_displacement_m": self.min_displacement,
            "max_abs_displacement_m": self.max_abs_displacement,
            "max_contact_force_N": self.max_force,
            "contact_fraction": self.contact_fraction,
            "unstable": self.unstable,
            "contacts": self.contacts,
        }
        return _plots.frame(columns)

    def _place(self) -> Numbers:
        return self.amplitude if self.over_amplitude else self.frequency

    def _place_name(self) -> _plots.Name:
        return ("Factor on the load", "") if self.over_amplitude else ("Frequency", "Hz")

    def plot(self, ax: Any = None, label: str | None = None) -> Any:
        """Draws the largest displacement with Matplotlib, dashed where unstable, with its special points, and returns the axes."""
        ax = _plots.axes(ax)
        _plots.curve(ax, self._place(), self.max_displacement, self.unstable, label)
        _plots.special_points(ax, self.special_points, "amplitude" if self.over_amplitude else "frequency")
        _plots.name_axis(ax.xaxis, *self._place_name())
        _plots.name_axis(ax.yaxis, "Largest displacement", "m")
        return ax

    def __repr__(self) -> str:
        return f"<wavebalance.Sweep of {len(self)} points: {self.status}>"

    def _repr_html_(self) -> str:
        line = _plots.Line(self._place(), self.max_displacement, self.unstable > 0)
        return _plots.svg([line], self._place_name(), ("Largest displacement", "m"), repr(self)[1:-1])


def _restored_sweep(problem: Problem, laws: Any, state: tuple[Any, ...]) -> Sweep:
    return Sweep(_core.restored_curve(problem, laws, state), problem, laws)


def overlay(curves: Sequence[Any], labels: Sequence[str] | None = None, ax: Any = None) -> Any:
    """Draws curves, responses or records over each other with Matplotlib, and returns the axes.

    Parameters
    ----------
    curves:
        Objects with a method ``plot``: :class:`Sweep`, :class:`Response`, records of :func:`wavebalance.run`, modes.
    labels:
        One for each; by default their numbers from 1.
    """
    names = [str(i + 1) for i in range(len(curves))] if labels is None else list(labels)
    if len(names) != len(curves):
        raise ValueError(f"there are {len(names)} labels; expected one for each of {len(curves)} curves")
    ax = _plots.axes(ax)
    for one, name in zip(curves, names):
        before = len(ax.lines)
        one.plot(ax)
        if len(ax.lines) > before:
            ax.lines[before].set_label(name)
    ax.legend()
    return ax


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
    steps = _steps(first_step, largest_step, max_points, output_points, stability, form)
    begin = as_number(frequency_from, "frequency_from", "one number in Hz")
    end = as_number(frequency_to, "frequency_to", "one number in Hz")
    problem, all_laws = as_problem(structure, pair), as_laws(laws)
    return Sweep(_core.sweep(problem, all_laws, float("nan"), begin, end, steps), problem, all_laws)


def _steps(
    first: float | None, largest: float | None, max_points: int, output_points: int, stability: bool, form: str
) -> _core.Steps:
    """Steps along a curve. Raises TypeError for what is no number or text."""
    sizes = [
        0.0 if one is None else as_number(one, name, "one number, or None")
        for one, name in ((first, "first_step"), (largest, "largest_step"))
    ]
    counts = [
        as_count(one, name, "a whole number")
        for one, name in ((max_points, "max_points"), (output_points, "output_points"))
    ]
    if not isinstance(form, str):
        raise TypeError(f'form is {form!r}; expected "automatic", "displacement" or "force"')
    return _core.Steps(sizes[0], sizes[1], counts[0], counts[1], bool(stability), form)


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

    Parameters and errors as for :func:`frequency_sweep`; the amplitudes and steps are factors on the load.
    """
    steps = _steps(first_step, largest_step, max_points, output_points, stability, form)
    hertz = as_number(frequency, "frequency", "one number in Hz")
    begin = as_number(amplitude_from, "amplitude_from", "one number, a factor on the load")
    end = as_number(amplitude_to, "amplitude_to", "one number, a factor on the load")
    problem, all_laws = as_problem(structure, pair), as_laws(laws)
    return Sweep(_core.sweep(problem, all_laws, hertz, begin, end, steps), problem, all_laws)
