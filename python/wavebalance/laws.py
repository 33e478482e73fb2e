"""Contact laws: the force at a contact as a function of its displacement, positive towards the obstacle."""

from __future__ import annotations

import inspect
import os
from collections.abc import Callable, Sequence
from typing import Any, Union

import numpy.typing as npt

from . import _core
from ._functions import difference, integral, takes_velocity, velocity_law

__all__ = [
    "Bilinear",
    "Clearance",
    "Coulomb",
    "Cubic",
    "Exponential",
    "Function",
    "HuntCrossley",
    "KelvinVoigt",
    "Law",
    "Linear",
    "NoContact",
    "Penalty",
    "Polynomial",
    "Rigid",
    "Table",
]


class Law(_core.Law):
    """A contact law. Immutable; threads may share it.

    Attributes
    ----------
    gap: float
        Displacement at which the force starts, m; infinite without contact.
    unilateral: bool
        Whether the force vanishes below the gap and is never negative.
    is_rigid: bool
        Whether the force beyond the gap is infinite.
    depends_on_velocity: bool
        Whether the force depends on the velocity, too.
    rows: int
        The number of contact directions that it acts along, consecutive rows of ``Structure.S``.
    """

    _row = ""  # of the catalogue of laws with their parameters and ranges

    def __init__(self, law: _core.Law, keys: dict[str, Any]) -> None:
        super().__init__(law)
        self._keys = keys

    def _make(self, **values: Any) -> None:
        """Becomes the law of this row; the values are by the names of the catalogue."""
        Law.__init__(self, _core.make_law(self._row, values), {"law": self._row, **values})

    def force(self, displacement: npt.ArrayLike, velocity: float = 0.0) -> Any:
        """The force (N) at displacements (m, any shape) and one velocity (m/s); it opposes a positive displacement."""
        return super().force(displacement, velocity)[()]

    def tangent(self, displacement: npt.ArrayLike) -> Any:
        """The slope of the force (N/m) at displacements (m, any shape), at rest; at a kink that on its right."""
        return super().tangent(displacement)[()]

    def potential(self, displacement: npt.ArrayLike) -> Any:
        """The potential energy (J) at displacements (m, any shape), of the elastic part."""
        return super().potential(displacement)[()]

    def scene_keys(self) -> dict[str, Any]:
        """The keys of ``[contact]`` for this law in a scene. Raises ValueError where a scene has no such law."""
        return {key: value for key, value in self._keys.items() if key != "tangents"}  # which its directions define

    def __reduce__(self) -> Any:
        values = {key: value for key, value in self._keys.items() if key != "law"}
        return _restored_law, (type(self), values)

    def __repr__(self) -> str:
        values = ", ".join(f"{key}={value!r}" for key, value in self._keys.items() if key != "law")
        return f"{type(self).__name__}({values})"


def _restored_law(kind: type[Law], values: dict[str, Any]) -> Law:
    """The law of a class of the catalogue with these values, from a pickle."""
    law = kind.__new__(kind)
    law._make(**values)
    return law


class NoContact(Law):
    """No force at all: the linear structure."""

    _row = "none"

    def __init__(self) -> None:
        self._make()


class Penalty(Law):
    """A linear spring behind a gap, without adhesion: f(u) = k max(u - g, 0).

    Parameters: `stiffness` k > 0, N/m; `gap` g, m. Raises ValueError for others.
    """

    _row = "linear"

    def __init__(self, stiffness: float, gap: float = 0.0) -> None:
        self._make(stiffness=stiffness, gap=gap)


Linear = Penalty  # as a scene calls this law


class Exponential(Law):
    """The exponential spring f(u) = max(a (exp(alpha (u - g)) - 1), 0) [JL14, eq. (5)].

    Parameters: `constant` a > 0, N; `exponent` alpha > 0, 1/m; `gap` g, m. Raises ValueError for others.
    """

    _row = "exponential"

    def __init__(self, constant: float, exponent: float, gap: float = 0.0) -> None:
        self._make(constant=constant, exponent=exponent, gap=gap)


class Rigid(Law):
    """A rigid obstacle at a gap: u <= g, f >= 0, f (u - g) = 0.

    Without a restitution it needs a ``Structure(..., contact_mass="redistribute")``, whose contacts have no mass: with mass
    and without a law of impact a continuum of motions satisfies it, and solving raises ValueError. With one, contacts have
    mass, and impacts leave the obstacle with `restitution` times the velocity before them; ``structure.scene(law, ...)``
    solves for their motions with :func:`wavebalance.run`. Parameters: `gap` g, m; `restitution` e in 0..1, or None.
    """

    _row = "rigid"

    def __init__(self, gap: float = 0.0, restitution: float | None = None) -> None:
        if restitution is None:
            self._make(gap=gap)
        else:
            self._make(gap=gap, restitution=restitution)


class Coulomb(Law):
    """Coulomb friction along one or two tangents, of a contact that has a normal direction before them or none.

    Parameters: `friction` >= 0; `tangential_stiffness` > 0, N/m, in series with the slider, or None for rigid friction, which
    needs contacts without mass; `normal_load` >= 0, N, at zero displacement; `normal_stiffness`, N/m, 0 without a normal
    direction; `slider`, m, its position at rest; `wear_coefficient`, 1/Pa; `tangents`, 1 or 2; `normal_gap`, m.

    Along one tangent, solved from event to event: `static_friction`, which ends sticking; `surface_speed`, m/s, of a
    belt or journal; `tangential_damping` and `normal_damping`, N s/m, parallel to the springs.
    """

    _row = "coulomb"

    def __init__(
        self,
        friction: float,
        tangential_stiffness: float | None,
        normal_load: float = 0.0,
        normal_stiffness: float = 0.0,
        slider: float = 0.0,
        wear_coefficient: float = 0.0,
        tangents: int = 1,
        normal_gap: float = 0.0,
        *,
        static_friction: float | None = None,
        surface_speed: float | None = None,
        tangential_damping: float | None = None,
        normal_damping: float | None = None,
    ) -> None:
        given = {name: value for name, value in locals().items() if name not in ("self", "__class__")}
        self._make(**{name: value for name, value in given.items() if value is not None})


class Bilinear(Law):
    """A spring of two slopes, which acts everywhere: k1 u up to the kink, with the slope k2 beyond it.

    Parameters: `slope_below` k1 and `slope_beyond` k2, N/m, of any sign; `kink`, m.
    """

    _row = "bilinear"

    def __init__(self, slope_below: float, slope_beyond: float, kink: float = 0.0) -> None:
        self._make(slopes=[slope_below, slope_beyond], gap=kink)


class Cubic(Law):
    """The cubic spring of Duffing's oscillator, f(u) = k3 u^3. Parameter: `stiffness` k3, N/m^3, not zero."""

    _row = "cubic"

    def __init__(self, stiffness: float) -> None:
        self._make(cubic_stiffness=stiffness)


class Polynomial(Law):
    """A spring that acts everywhere, f(u) = c1 u + c2 u^2 + ... Parameter: `coefficients` c1, c2, ..., N/m, N/m^2, ..."""

    _row = "polynomial"

    def __init__(self, coefficients: Sequence[float]) -> None:
        self._make(polynomial=[float(one) for one in coefficients])


class Clearance(Law):
    """A linear stop on either side of a clearance, as gears with backlash or a pipe between supports have.

    f(u) = k (u - g) beyond g, k' (u + g') below -g', zero between them.

    Parameters: `stiffness` k > 0, N/m; `gap` g >= 0, m; `stiffness_below` k' and `gap_below` g', by default the same.
    """

    _row = "clearance"

    def __init__(
        self, stiffness: float, gap: float, stiffness_below: float | None = None, gap_below: float | None = None
    ) -> None:
        below = stiffness if stiffness_below is None else stiffness_below
        at = gap if gap_below is None else gap_below
        self._make(stiffness=stiffness, gap=gap, stiffness_below=below, gap_below=at)


class Table(Law):
    """A spring by its measured characteristic: the monotone cubic interpolant of points.

    Parameters: `displacements`, m, ascending, and as many `forces`, N; or the name of a CSV file with both.
    """

    _row = "table"

    def __init__(
        self, displacements: Sequence[float] | npt.NDArray[Any] | str | os.PathLike[str], forces: Sequence[float] | npt.NDArray[Any] = ()
    ) -> None:
        if isinstance(displacements, (str, os.PathLike)):
            self._make(table=os.path.abspath(displacements))
            return
        self._points = [float(u) for u in displacements], [float(f) for f in forces]
        super().__init__(_core.table_law(*self._points), {"law": "table", "points": len(displacements)})

    def __reduce__(self) -> Any:
        return super().__reduce__() if "table" in self._keys else (Table, self._points)

    def scene_keys(self) -> dict[str, Any]:
        if "table" not in self._keys:
            raise ValueError("the table of the law is no file; a scene takes Table('name.csv')")
        return super().scene_keys()


class HuntCrossley(Law):
    """Contact that dissipates, f = max(k d^n (1 + c v), 0) for a penetration d = u - g > 0 [Hunt & Crossley 1975].

    Parameters: `stiffness` k > 0, N/m^n; `dissipation` c >= 0, s/m; `gap` g, m; `power` n in 1..10.
    """

    _row = "hunt_crossley"

    def __init__(self, stiffness: float, dissipation: float, gap: float = 0.0, power: float = 1.5) -> None:
        self._make(hertz_stiffness=stiffness, dissipation=dissipation, gap=gap, power=power)


class KelvinVoigt(Law):
    """A spring and a damper in parallel that do not pull, f = max(k d + c s(d) v, 0) for d = u - g > 0.

    Parameters: `stiffness` k > 0, N/m; `damping` c >= 0, N s/m; `gap` g, m; `depth` >= 0, m, over which the damper sets in.
    """

    _row = "kelvin_voigt"

    def __init__(self, stiffness: float, damping: float, gap: float = 0.0, depth: float = 0.0) -> None:
        self._make(stiffness=stiffness, damping=damping, gap=gap, damping_depth=depth)


class Function(Law):
    """A law of Python functions of one displacement (a float, m), or of displacement and velocity (m/s).

    This is slow: every sample of every Newton step calls Python with the interpreter's lock held, a few tenths of a
    microsecond each and ten to a hundred times the cost of a compiled law. A :class:`Table` of the same force is fast. A law
    of functions that pickle finds by name, none of them a lambda, can be pickled.

    Parameters
    ----------
    force:
        The force (N) at a displacement (m); with two arguments at a displacement and a velocity.
    tangent:
        Its slope (N/m) by the displacement, with the arguments of `force`; by default a central difference over 6e-6 times
        the displacement, or times `length` near zero.
    potential:
        Its integral (J) at rest from the gap; by default by quadrature between the kinks. Only energies need it.
    damping:
        Its slope (N s/m) by the velocity, of a force with two arguments; by default a central difference over 6e-6 times the
        velocity, or times `speed` near zero.
    gap:
        Where the force starts, m; for a law that acts everywhere a length that the motion has, or 0.
    unilateral:
        Whether the force vanishes below the gap and is never negative.
    monotone:
        Whether the force falls nowhere, so that a stiff law may be solved for its force; not with a velocity.
    kinks:
        Displacements at which the slope jumps, m, ascending. Sweeps stop at them; without them they may get lost.
    length, speed:
        A displacement (m) and a velocity (m/s) that the motion has.
    """

    def __init__(
        self,
        force: Callable[..., float],
        tangent: Callable[..., float] | None = None,
        potential: Callable[[float], float] | None = None,
        *,
        damping: Callable[[float, float], float] | None = None,
        gap: float = 0.0,
        unilateral: bool = False,
        monotone: bool = False,
        kinks: Sequence[float] = (),
        length: float = 1e-3,
        speed: float = 1e-1,
    ) -> None:
        breaks = [float(one) for one in kinks]
        named = {"damping": damping, "gap": gap, "unilateral": unilateral, "monotone": monotone}
        self._arguments = (force, tangent, potential, {**named, "kinks": breaks, "length": length, "speed": speed})
        if takes_velocity(force):
            if monotone:
                raise ValueError("monotone is True; a force of the velocity, too, is solved for its displacement: expected False")
            law = velocity_law(force, tangent, potential, damping, gap, unilateral, breaks, length, speed)
        elif damping is not None:
            raise ValueError("damping is given, but force takes a displacement alone; expected force(displacement, velocity)")
        else:
            slope = tangent if tangent is not None else difference(force, length)
            energy = potential if potential is not None else integral(force, gap, breaks)
            law = _core.function_law(force, slope, energy, gap, unilateral, monotone, breaks)
        super().__init__(law, {"force": force, "gap": gap})

    def __reduce__(self) -> Any:
        return _restored_function, self._arguments

    def scene_keys(self) -> dict[str, Any]:
        raise ValueError("a law of Python functions has no keys; a scene takes Table('name.csv') in its place")


def _restored_function(force: Any, tangent: Any, potential: Any, named: dict[str, Any]) -> Function:
    return Function(force, tangent, potential, **named)


LawLike = Union[_core.Law, Callable[..., float], Sequence[Union[_core.Law, Callable[..., float]]]]


def as_laws(laws: LawLike) -> Any:
    """Laws with functions replaced by :class:`Function`."""
    if isinstance(laws, _core.Law):
        return laws
    if isinstance(laws, Sequence):
        return [as_laws(one) for one in laws]
    return Function(laws) if callable(laws) else laws


def _signature_of(parameters: Sequence[dict[str, Any]]) -> inspect.Signature:
    """Those without a default come first; a gap that may be 0 is 0 where none is given."""
    both = inspect.Parameter.POSITIONAL_OR_KEYWORD
    gap = [one["name"] for one in parameters if one["name"] == "gap" and one["may_be_zero"]]
    defaults = {one["name"]: 0.0 if one["name"] in gap else one["default"] for one in parameters}
    needed = [one["name"] for one in parameters if one["required"] and one["name"] not in gap]
    return inspect.Signature(
        [inspect.Parameter(name, both) for name in needed]
        + [inspect.Parameter(name, both, default=value) for name, value in defaults.items() if name not in needed]
    )


def _class_of(row: dict[str, Any]) -> type[Law]:
    """The class of a row of the catalogue, with the parameters' own names."""
    signature = _signature_of(row["parameters"])

    def __init__(self: Law, *values: Any, **named: Any) -> None:
        bound = signature.bind(*values, **named)
        bound.apply_defaults()
        self._make(**{name: value for name, value in bound.arguments.items() if value is not None})

    name = "".join(word.capitalize() for word in row["name"].split("_"))
    lines = [f"`{one['name']}`{', ' + one['unit'] if one['unit'] else ''}: {one['help']}." for one in row["parameters"]]
    text = "\n\n    ".join([f"A law with the force {row['force']}.", *lines])
    made = type(name, (Law,), {"__init__": __init__, "__doc__": text, "__module__": __name__, "_row": row["name"]})
    made.__signature__ = signature  # type: ignore[attr-defined]
    return made


def _add_other_rows() -> None:
    """Makes the classes of the rows for which none is written above."""
    written = {one._row for one in Law.__subclasses__()}
    for row in _core.law_catalogue():
        if row["name"] not in written:
            made = _class_of(row)
            globals()[made.__name__] = made
            __all__.append(made.__name__)


_add_other_rows()
