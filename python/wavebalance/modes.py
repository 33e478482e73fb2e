"""Nonlinear modes of custom structures."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _core, _plots
from .laws import LawLike, as_laws
from .responses import Motion
from .structure import Pair, Structure

__all__ = ["Backbone", "DampedMode", "backbone", "damped_mode"]

Numbers = npt.NDArray[np.float64]


class Backbone(_core.Backbone):
    """A nonlinear mode: P free periodic motions of the undamped structure over their energy.

    Attributes
    ----------
    status: str
        "reached_energy" or "reached_frequency", or why it ended before: "internal_resonance", "lost", "no_start",
        "no_contact" or "point_limit".
    linear_frequency: float
        Frequency of the continued linear mode, Hz.
    frequency, frequency_ratio: numpy.ndarray
        P values, Hz, and over the linear mode's.
    energy_ratio: numpy.ndarray
        Energy over the energy of the linear mode that just touches.
    contact_fraction, virial_residual: numpy.ndarray
        Share of the samples in contact; residual of the virial theorem, zero for exact motions.
    accepted: numpy.ndarray
        Truth values: whether the point is a motion of the mode and lies on no internal resonance.
    point_status: list[str]
        "converged", "linear", "tongue" (an internal resonance), ...
    unstable: numpy.ndarray
        Floquet multipliers that leave the unit circle, -1 where not known; of elastic laws with `stability`.
    """

    @property
    def frequency_ratio(self) -> Numbers:
        return self.frequency / self.linear_frequency

    @property
    def accepted(self) -> npt.NDArray[np.bool_]:
        return np.array([one in ("converged", "linear") for one in self.point_status], bool)

    def amplitudes(self, index: int) -> npt.NDArray[np.complex128]:
        """Complex amplitudes of the motion at a point in the linear modes, r × (N + 1), m sqrt(kg)."""
        return super().amplitudes(index)

    def structure_motion(self, index: int, points: int = 1024) -> Motion:
        """Displacements and velocities of all degrees of freedom at a point, over one period at `points` instants.

        Raises ValueError where no motion was found.
        """
        return Motion(self._structure_motion(index, points))

    def plot(self, ax: Any = None) -> Any:
        """Draws the frequency over the energy with Matplotlib, and returns the axes."""
        ax = _plots.axes(ax)
        ax.semilogx(self.energy_ratio, np.where(self.accepted, self.frequency, np.nan))
        ax.set_xlabel("Energy / grazing energy")
        ax.set_ylabel("Frequency (Hz)")
        return ax

    def __repr__(self) -> str:
        return f"<wavebalance.Backbone of {len(self)} points: {self.status}>"


def backbone(
    structure: Structure,
    laws: LawLike,
    pair: Pair | None = None,
    *,
    mode: int = 1,
    largest_energy: float = 10.0,
    largest_frequency_ratio: float | None = None,
    points: int = 200,
    harmonics: int = 10,
    samples: int | None = None,
    gaps: Sequence[float] = (),
    cosine_only: bool = False,
    stability: bool = False,
) -> Backbone:
    """The nonlinear mode that continues a linear one, from where it first touches on.

    Damping, load and forces of the structure have no effect.

    Parameters
    ----------
    structure, laws:
        As for :func:`forced_response`. A rigid obstacle is a complementarity at the samples; other laws are solved by
        arc length.
    pair:
        Trial and weight functions of elastic laws; by default Fourier functions of the `harmonics`, at the `samples`.
    mode:
        The linear mode, from 1.
    largest_energy, largest_frequency_ratio:
        Where the curve ends: energy over the energy of grazing and, if given, frequency over the linear mode's.
    points:
        About so many.
    harmonics, samples:
        N of the motion, and times at which contact is enforced, by default 2 N for rigid obstacles and 8 N otherwise.
    gaps:
        Lengths that energies refer to, m, one per contact, for laws without a gap.
    cosine_only:
        Whether only motions that are even in time are computed.
    stability:
        Whether the Floquet multipliers of the points are counted; only for elastic laws.

    Raises
    ------
    ValueError
        For options or laws out of range.
    """
    _require_no_turning(structure)
    given = as_laws(laws)
    rigid = given.is_rigid if isinstance(given, _core.Law) else any(one.is_rigid for one in given)
    count = samples if samples is not None else (2 if rigid else 8) * harmonics
    functions = pair if pair is not None else Pair("fourier", 2 * harmonics + 1, max(count, 2 * harmonics + 1))
    arguments = _core.BackboneArguments(
        mode, largest_energy, largest_frequency_ratio or 0.0, points, harmonics, count, cosine_only, stability
    )
    return Backbone(_core.backbone(structure, given, functions, [float(one) for one in gaps], arguments))


def _require_no_turning(structure: Structure) -> None:
    if structure.turns:
        raise ValueError("structure has a gyroscopic matrix or a spin stiffness; expected none with a nonlinear mode")


class DampedMode(_core.DampedCurve):
    """A nonlinear mode of a structure that loses energy: P motions over their amplitude.

    Attributes
    ----------
    status: str
        "reached_amplitude", or why it ended before: "lost", "no_start" or "point_limit".
    linear_frequency, linear_damping_ratio: float
        Frequency (Hz) and damping ratio of the linear mode with the contacts as at rest.
    slip_amplitude: float
        m, up to which contacts do what they do at rest; infinite where they always do, 0 where at no amplitude.
    amplitude: numpy.ndarray
        P values, m: of the first harmonic of the linear mode's coordinate, where the mode moves a contact most.
    frequency, damping_ratio: numpy.ndarray
        Hz, and xi / (2 omega) of the damping -xi M that makes the motion periodic.
    """

    def displacement(self, index: int) -> Numbers:
        """Displacements of the contacts over a period at a point, contacts × samples, m."""
        return super().displacement(index)

    def force(self, index: int) -> Numbers:
        """Forces of the contacts over a period at a point, contacts × samples, N."""
        return super().force(index)

    def structure_motion(self, index: int, points: int = 1024) -> Motion:
        """Displacements and velocities of all degrees of freedom at a point, over one period at `points` instants."""
        return Motion(self._structure_motion(index, points))

    def plot(self, ax: Any = None) -> Any:
        """Draws the damping ratio over the amplitude with Matplotlib, and returns the axes."""
        ax = _plots.axes(ax)
        ax.semilogx(self.amplitude, self.damping_ratio)
        _plots.name_axis(ax.xaxis, "Amplitude", "m")
        ax.set_ylabel("Damping ratio")
        return ax

    def __repr__(self) -> str:
        return f"<wavebalance.DampedMode of {len(self)} points: {self.status}>"


def damped_mode(
    structure: Structure,
    laws: LawLike,
    pair: Pair | None = None,
    *,
    mode: int = 1,
    amplitudes: tuple[float, float] | None = None,
    points: int = 100,
    harmonics: int = 10,
    samples: int | None = None,
) -> DampedMode:
    """Frequency and damping of a mode over its amplitude, with friction or dampers at the contacts.

    The free motion is made periodic by a damping -xi M (the extended periodic motion concept). It continues the linear
    mode of the structure at rest under its static forces, with the contacts stuck.

    Parameters
    ----------
    structure, laws:
        As for :func:`forced_response`; laws with a finite force. The vibrating load has no effect.
    pair:
        Trial and weight functions; by default Fourier functions of the `harmonics`, at the `samples`.
    mode:
        The linear mode, from 1.
    amplitudes:
        First and last amplitude of the curve, m; by default half of that at which a contact first slips, and ten times it.
    points:
        About so many, uniform in the logarithm of the amplitude.
    harmonics, samples:
        N of the motion, and points at which forces are evaluated, by default 32 N.

    Raises
    ------
    ValueError
        For arguments out of range, a rigid law, a mode that moves no contact, and where no amplitude of first slip is known.
    """
    count = samples if samples is not None else 32 * harmonics
    functions = pair if pair is not None else Pair("fourier", 2 * harmonics + 1, max(count, 2 * harmonics + 1))
    first, last = amplitudes if amplitudes is not None else (0.0, 0.0)
    _require_no_turning(structure)
    if amplitudes is not None and not 0.0 < first < last < np.inf:
        raise ValueError(f"amplitudes is {amplitudes}; expected two numbers in m, 0 < first < last")
    if points < 1:
        raise ValueError(f"points is {points}; expected at least 1")
    return DampedMode(_core.damped_curve(structure, as_laws(laws), functions, mode, first, last, points))
