"""Periodic responses of custom structures, and their stability."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Union

import numpy as np
import numpy.typing as npt

from . import _core, _plots
from ._matrices import as_number
from .laws import LawLike, as_laws
from .structure import Pair, Structure, default_pair

__all__ = ["Motion", "Problem", "Response", "Stability", "forced_response", "harmonics_of", "stability"]


class Problem(_core.Problem):
    """A structure condensed on its contacts in a pair of bases: what responses of many frequencies and laws share.

    Functions of a structure make one and keep it with the structure for its last pair. Threads may share it, one at a
    time.

    Parameters
    ----------
    structure, pair:
        Pair of the problem; 63 Fourier functions with 256 points by default.
    harmonics:
        Complex amplitudes h_m of the load's time function Re sum_m h_m exp(2 pi i m f t); (0, 1) is a cosine.
    threads:
        Threads of each condensation of a large structure; 0 for one per core.

    Attributes
    ----------
    contacts, points, functions: int
        C, N and M.
    """

    def __init__(
        self, structure: Structure, pair: Pair | None = None, *, harmonics: Sequence[complex] = (0.0, 1.0), threads: int = 1
    ) -> None:
        self.structure = structure
        self.pair = default_pair() if pair is None else pair
        self._arguments = np.ravel(np.asarray(harmonics, complex)), threads
        super().__init__(structure, self.pair, *self._arguments)

    def __reduce__(self) -> Any:
        return _restored_problem, (self.structure, self.pair, *self._arguments)


def _restored_problem(structure: Structure, pair: Pair, harmonics: Any, threads: int) -> Problem:
    return Problem(structure, pair, harmonics=harmonics, threads=threads)


ProblemLike = Union[Structure, Problem]


def as_problem(of: ProblemLike, pair: Pair | None) -> Problem:
    """The problem, or the one of a structure, which keeps the problem of its last pair."""
    if isinstance(of, Problem):
        if pair is not None and pair is not of.pair:
            raise ValueError("pair is given, but the problem has one of its own; expected a structure, or no pair")
        return of
    if not isinstance(of, Structure):
        raise TypeError(f"structure is of type {type(of).__name__}; expected a Structure or a Problem")
    wanted = default_pair() if pair is None else pair
    kept = of._problem
    if kept is None or kept[0] is not wanted:
        kept = of._problem = (wanted, Problem(of, wanted))
    problem: Problem = kept[1]
    return problem


class Motion:
    """One period of a motion at uniform times.

    Attributes
    ----------
    time: numpy.ndarray
        Fractions of the period, P values from 0; a cosine load is largest at 0.
    displacement, velocity: numpy.ndarray
        Rows × P, m and m/s: a row per contact, towards its obstacle, or per degree of freedom.
    force: numpy.ndarray
        Contacts × P, N; 0 × 0 of a structure's motion.
    """

    def __init__(self, motion: _core.Motion) -> None:
        self.displacement: npt.NDArray[np.float64] = motion.displacement
        self.velocity: npt.NDArray[np.float64] = motion.velocity
        self.force: npt.NDArray[np.float64] = motion.force
        points = self.displacement.shape[1]
        self.time: npt.NDArray[np.float64] = np.arange(points) / points


class Response(_core.Response):
    """A periodic response at one frequency. It can be pickled, with its structure and laws, and copied.

    Attributes
    ----------
    converged: bool
        Whether the residual meets the tolerance and rounding leaves the motion accurate to 1e-3.
    status: str
        "converged", "stalled", "iteration_limit", "effort_limit", "singular", "unbalanced" or "inaccurate".
    frequency: float
        Hz.
    residual, iterations, residual_history:
        Relative residual, Newton iterations of all attempts, residuals of the last run.
    strategy: str
        Strategy that found it: "newton", "gap_continuation", ...
    displacement: numpy.ndarray
        Displacements of the contacts at the N points, C × N, m; a view that cannot be written to.
    contact_force: numpy.ndarray
        Contact forces there, C × N, N.
    coefficients: numpy.ndarray
        Spectra over translates of the trial coefficients, (M // 2 + 1) × C.
    time: numpy.ndarray
        The N points, fractions of the period.
    wall_seconds: float
        Time of the condensation and the solution, s.
    """

    def __init__(self, core: _core.Response, problem: Problem, laws: Any) -> None:
        super().__init__(core)
        self._problem = problem
        self._laws = laws

    def __reduce__(self) -> Any:
        return _restored_response, (self._problem, self._laws, _core.response_state(self))

    @property
    def time(self) -> npt.NDArray[np.float64]:
        points = self.displacement.shape[1]
        return np.arange(points) / points + self.first_sample

    def motion(self, points: int = 1024) -> Motion:
        """The motion of all contacts at `points` uniform times. O(C points log points)."""
        return Motion(self._motion(points))

    def structure_motion(self, points: int = 1024) -> Motion:
        """The motion of all n degrees of freedom at `points` uniform times. O(n (M + points log points))."""
        return Motion(self._structure_motion(points))

    def harmonics(self, count: int = 5, points: int = 1024) -> npt.NDArray[np.complex128]:
        """Complex amplitudes of the contacts' displacements, C × (count + 1): u = Re sum_m h_m exp(2 pi i m f t).

        The modulus of h_m is an amplitude (m), its argument a phase ahead of a cosine; h_0 is the mean. `points` must exceed
        twice `count`. For degrees of freedom use ``harmonics_of(response.structure_motion().displacement, count)``.
        """
        return harmonics_of(self.motion(points).displacement, count)

    def to_frame(self, points: int = 1024) -> Any:
        """The motion of the contacts as a pandas.DataFrame with a column for each; needs pandas."""
        motion = self.motion(points)
        columns = {"time_fraction": motion.time}
        for contact, (u, f) in enumerate(zip(motion.displacement, motion.force), start=1):
            columns[f"displacement_{contact}_m"] = u
            columns[f"contact_force_{contact}_N"] = f
        return _plots.frame(columns)

    def stability(self, multipliers: int = 4) -> Stability:
        """:func:`stability` of this response."""
        return stability(self, multipliers)

    def plot(self, ax: Any = None, points: int = 1024) -> Any:
        """Draws the displacements of the contacts over a period with Matplotlib, and returns the axes."""
        ax = _plots.axes(ax)
        motion = self.motion(points)
        ax.plot(motion.time, motion.displacement.T)
        ax.set_xlabel("Time (fraction of a period)")
        _plots.name_axis(ax.yaxis, "Displacement", "m")
        return ax

    def __repr__(self) -> str:
        return f"<wavebalance.Response at {self.frequency:g} Hz: {self.status}>"

    def _repr_html_(self) -> str:
        motion = self.motion(256)
        time = np.append(motion.time, 1.0)
        lines = [_plots.Line(time, np.append(u, u[0])) for u in motion.displacement]
        return _plots.svg(lines, ("Time (fraction of a period)", ""), ("Displacement", "m"), repr(self)[1:-1])


def _restored_response(problem: Problem, laws: Any, state: tuple[Any, ...]) -> Response:
    return Response(_core.restored_response(problem, laws, state), problem, laws)


def harmonics_of(displacement: npt.ArrayLike, count: int = 5) -> npt.NDArray[np.complex128]:
    """Complex amplitudes h_0 .. h_count of motions at uniform times of a period, rows × points: Re sum_m h_m exp(2 pi i m t).

    Raises ValueError where there are not more than 2 `count` points.
    """
    rows = np.atleast_2d(np.asarray(displacement, dtype=float))
    if rows.shape[1] <= 2 * count:
        raise ValueError(f"there are {rows.shape[1]} points; expected more than {2 * count} for {count} harmonics")
    series = np.fft.rfft(rows)[:, : count + 1] * (2.0 / rows.shape[1])
    series[:, 0] *= 0.5
    return series


class Stability:
    """Growth of small disturbances of a periodic response.

    Attributes
    ----------
    status: str
        "converged" where the stability is known, or why not, such as "too_few_harmonics", "undamped" or "no_response".
    stable: bool | None
        Whether all Floquet multipliers lie within the unit circle; None where it is not known.
    unstable: int
        Multipliers outside the unit circle; -1 where not known.
    multipliers: numpy.ndarray
        The largest ones in modulus, complex, of each conjugate pair that with Im >= 0; those below 1e-2 are left out,
        and with friction all.
    exponents: numpy.ndarray
        Their Floquet exponents, 1/s.
    """

    def __init__(self, core: _core.Stability) -> None:
        self.status: str = core.status
        self.unstable: int = core.unstable
        self.stable: bool | None = None if core.unstable < 0 else core.unstable == 0
        self.multipliers: npt.NDArray[np.complex128] = np.array(core._multipliers, dtype=complex)
        self.exponents: npt.NDArray[np.complex128] = np.array(core._exponents, dtype=complex)

    def __repr__(self) -> str:
        word = {None: self.status, True: "stable", False: f"unstable, {self.unstable} multipliers outside the unit circle"}
        return f"<wavebalance.Stability: {word[self.stable]}>"


def forced_response(
    structure: ProblemLike,
    laws: LawLike,
    frequency: float,
    pair: Pair | None = None,
    *,
    guess: Response | npt.ArrayLike | None = None,
    stay_near_guess: bool = False,
    form: str = "automatic",
    tolerance: float = 1e-11,
    max_iterations: int = 60,
) -> Response:
    """The periodic response at one frequency.

    Parameters
    ----------
    structure:
        A :class:`Structure`, or a :class:`Problem` with its pair.
    laws:
        One law for all contacts, a list with one each, or functions of Python in their places (slow).
    frequency:
        Forcing frequency, Hz, above 0.
    pair:
        Trial and weight functions; 63 Fourier functions with 256 points by default.
    guess:
        Another response of the same size, or displacements of the contacts at the points, C × N, m, from which Newton's
        method starts; the motion without contact by default.
    stay_near_guess:
        Whether only a response near the guess is accepted.
    form:
        "automatic", "displacement" or "force": the unknown that is solved for.
    tolerance, max_iterations:
        Tolerance of Newton's method, relative to the linear response.

    Returns
    -------
    Response
        Its status shows whether it converged.

    Raises
    ------
    ValueError
        For a frequency, laws or a guess that do not fit; and for a law that returns nan, with the displacement, where no
        response was found.
    """
    hertz = as_number(frequency, "frequency", "one number in Hz; frequency_sweep takes an interval")
    problem = as_problem(structure, pair)
    all_laws = as_laws(laws)
    found = _core.forced_response(problem, all_laws, hertz, guess, stay_near_guess, form, tolerance, max_iterations)
    return Response(found, problem, all_laws)


def stability(response: Response, multipliers: int = 4) -> Stability:
    """Counts the Floquet multipliers of a response outside the unit circle, and computes the largest ones.

    Parameters
    ----------
    response:
        A response that has converged; for others the status is "no_response".
    multipliers:
        Number of multipliers computed in addition to the count, a conjugate pair counted once; 0 for none.

    Raises
    ------
    ValueError
        Where the structure has no modes to compute.
    """
    return Stability(_core.stability(response, multipliers))
