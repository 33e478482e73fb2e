"""Structures and pairs of bases."""

from __future__ import annotations

import functools
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt
import scipy.sparse

from . import _core
from ._matrices import as_count, as_csc, as_real
from ._turning import Unbalance, speed, turning_forces, turning_part, unbalance_load
from .laws import Law, LawLike, as_laws

__all__ = ["Pair", "Structure"]

_PAIR_DIRECTIONS = (  # keys of [[contact.pairs]]
    ("dofs", "coefficients"),
    ("tangent", "tangent_coefficients"),
    ("second_tangent", "second_tangent_coefficients"),
)
Matrix = Any
Force = tuple[npt.ArrayLike, npt.ArrayLike]


class Structure(_core.Structure):
    """The linear part of a vibrating structure, M u'' + C u' + K u = load cos(2 pi f t) + forces - S^T f_c(S u).

    Parameters
    ----------
    M, C, K:
        Mass (kg), damping (N s/m) and stiffness (N/m), n × n, SciPy sparse or anything that converts to it, clamped rows and
        columns removed. ``C=None`` is none.
    load:
        Amplitude of the cosine load, N, n real values; a load with a phase is one of `forces`.
    contacts:
        The directions of contact S, C × n: contact c has the displacement ``S[c] @ u``, positive towards its obstacle. Or a
        list of degrees of freedom, from 0.
    static_load:
        A force that does not vary, N, n values.
    forces:
        Further periodic forces ``(shape, harmonics)``: shape, N, n values, times Re sum_m harmonics[m] exp(2 pi i m f t).
    loss_factor:
        eta of structural damping, K (1 + i eta) at the harmonics above 0. Its motions have no known stability.
    unsymmetric:
        Whether C and K may be unsymmetric, as gyroscopic and circulatory ones are.
    free:
        Whether the structure is free to move and held only by its contacts.
    gyroscopic:
        G, n × n and skew-symmetric: the damping is C + Omega G at the speed Omega.
    spin_stiffness:
        K_s, n × n and symmetric: the stiffness is K + Omega^2 K_s.
    spin_speed:
        Omega, rad/s; 0 turns with the load, Omega = 2 pi f, also along a curve over its frequency.
    unbalance:
        Loads (amount, dofs), (amount, dofs, phase) or (amount, dofs, phase, n): kg m, one or two degrees of freedom, from 0,
        towards the second of which it turns from the first, degrees, and the harmonic, 1 unless given. Its force is
        amount Omega^2 with Omega = 2 pi n f, so that shafts may turn at speeds in the ratio of integers.
    contact_mass:
        "keep", or "redistribute" for contacts without mass, which rigid obstacles need: the structure is replaced by its
        lowest n - C modes and contacts that deflect by the flexibility of the others. O(n^3).

    Attributes
    ----------
    M, C, K: scipy.sparse.csc_matrix
        As above, n × n.
    S: scipy.sparse.csr_matrix
        Directions of contact, C × n.
    load: numpy.ndarray
        n values, N.
    size, contacts: int
        The number of degrees of freedom that are solved for, n, and C.

    Raises
    ------
    ValueError
        Sizes that do not fit, matrices that are not symmetric or definite, rows of S that are zero, with the row (from 0).
    """

    def __init__(
        self,
        M: Matrix,
        C: Matrix | None,
        K: Matrix,
        load: npt.ArrayLike,
        contacts: Matrix | Sequence[int],
        *,
        static_load: npt.ArrayLike | None = None,
        forces: Sequence[Force] = (),
        loss_factor: float = 0.0,
        unsymmetric: bool = False,
        free: bool = False,
        gyroscopic: Matrix | None = None,
        spin_stiffness: Matrix | None = None,
        spin_speed: float = 0.0,
        unbalance: Sequence[Unbalance] = (),
        contact_mass: str = "keep",
    ) -> None:
        self.M, self.K = as_csc(M, "M"), as_csc(K, "K")
        self.C = scipy.sparse.csc_matrix(self.K.shape) if C is None else as_csc(C, "C")
        self.load = _vector(load, "load")
        self.S = _directions(contacts, len(self.load))
        self.unsymmetric, self.loss_factor, self.contact_mass = unsymmetric, loss_factor, contact_mass
        if contact_mass not in ("keep", "redistribute"):
            raise ValueError(f'contact_mass is {contact_mass!r}; expected "keep" or "redistribute"')
        self._forces = [(_vector(shape, "shape of a force"), np.ravel(np.asarray(h, complex)), 0) for shape, h in forces]
        if static_load is not None:
            self._forces.append((_vector(static_load, "static_load"), np.ones(1, complex), 0))
        self._unbalance = [unbalance_load(one, len(self.load)) for one in unbalance]
        self.gyroscopic = turning_part(gyroscopic, "gyroscopic", -1.0)
        self.spin_stiffness = turning_part(spin_stiffness, "spin_stiffness", 1.0)
        self.spin_speed = speed(spin_speed, self.turns)
        if self.spin_stiffness is not None and not spin_speed and (free or loss_factor):
            raise ValueError("spin_stiffness follows the load; expected spin_speed > 0 beside free or loss_factor")
        self._problem: tuple[_core.Pair, Any] | None = None
        self._arguments = {
            "static_load": static_load,
            "forces": tuple(forces),
            "loss_factor": loss_factor,
            "unsymmetric": unsymmetric,
            "free": free,
            "gyroscopic": gyroscopic,
            "spin_stiffness": spin_stiffness,
            "spin_speed": spin_speed,
            "unbalance": tuple(unbalance),
            "contact_mass": contact_mass,
        }
        none = scipy.sparse.csc_matrix(self.K.shape)
        super().__init__(
            self.M,
            self.C,
            self.K,
            self.load,
            as_csc(self.S, "contacts"),
            self._forces + [force for one in self._unbalance for force in turning_forces(*one, len(self.load))],
            loss_factor,
            unsymmetric,
            free,
            none if self.gyroscopic is None else self.gyroscopic,
            none if self.spin_stiffness is None else self.spin_stiffness,
            self.spin_speed,
            contact_mass == "redistribute",
        )

    @property
    def turns(self) -> bool:
        """Whether it has a gyroscopic matrix or a spin stiffness."""
        return self.gyroscopic is not None or self.spin_stiffness is not None

    def __reduce__(self) -> Any:
        damping = self.C if self.C.nnz else None
        return _restored_structure, ((self.M, damping, self.K, self.load, self.S), self._arguments)

    def scene(
        self, laws: LawLike, *, frequency: float | None = None, pair: Pair | None = None, **analysis: Any
    ) -> dict[str, Any]:
        """This structure as a scene, for :func:`wavebalance.run`, :func:`wavebalance.compare` and studies.

        Parameters
        ----------
        laws:
            One law, or one per contact; laws of Python functions have no keys.
        frequency:
            Forcing frequency, Hz.
        pair:
            Trial and weight functions; 63 Fourier functions with 256 points by default. None with ``Rigid(gap,
            restitution)`` and with rigid, static, moving or damped friction, whose motions have no functions.
        analysis:
            Keys of ``[analysis]``, such as ``type="frequency_sweep"``.

        Raises
        ------
        ValueError
            For laws without keys.
        """
        structure: dict[str, Any] = {"type": "matrices", "mass": self.M, "stiffness": self.K}
        if self.C.nnz:
            structure["damping"] = self.C
        for key, value in (("unsymmetric", self.unsymmetric), ("free", self.is_free), ("loss_factor", self.loss_factor)):
            if value:
                structure[key] = value
        for key, matrix in (("gyroscopic", self.gyroscopic), ("spin_stiffness", self.spin_stiffness)):
            if matrix is not None:
                structure[key] = matrix
        if self.spin_speed:
            structure["spin_speed"] = self.spin_speed
        forcing: dict[str, Any] = {"load": self.load, "amplitude": 1.0}
        if frequency is not None:
            forcing["frequency"] = float(frequency)
        terms = [term for shape, series, _ in self._forces for term in _terms(shape, series)]
        for amount, dofs, phase, harmonic in self._unbalance:
            rows = [dof + 1 for dof in dofs]
            terms.append({"kind": "unbalance", "dofs": rows, "amplitude": amount, "phase": phase, "harmonic": harmonic})
        if terms:
            forcing["terms"] = terms
        result = {"structure": structure, "contact": self._contact_keys(laws), "forcing": forcing}
        if self.contact_mass != "keep":
            result["contact"]["mass"] = self.contact_mass
        if not _core.needs_events(self, as_laws(laws)):
            result["time"] = (default_pair() if pair is None else pair).scene_keys()
        elif pair is not None:
            raise ValueError(f"motions under {laws!r} are solved from event to event and have no functions; expected no pair")
        if analysis:
            result["analysis"] = analysis
        return result

    def _contact_keys(self, laws: LawLike) -> dict[str, Any]:
        given = as_laws(laws)
        each = list(given) if isinstance(given, Sequence) else [given] * (self.contacts // given.rows)
        rows = sum(one.rows for one in each if isinstance(one, Law))
        if rows != self.contacts or not all(isinstance(one, Law) for one in each):
            raise ValueError(
                f"laws are {len(each)}; expected one law, or one for each of {self.contacts} contacts; a law of several rows "
                "takes as many directions"
            )
        first = each[0].scene_keys()
        # "none" and "rigid" hold for all contacts of a scene.
        kept = {"none": (), "rigid": tuple(key for key in ("gap", "restitution") if key in first)}.get(first["law"])
        pairs = []
        begin = 0
        for contact, law in enumerate(each):
            keys = law.scene_keys()
            if kept is not None and keys["law"] != first["law"]:
                raise ValueError(f"laws[{contact}] is {law!r}; expected {first['law']!r} for all contacts, as for the first")
            own = keys if kept is None else {key: keys[key] for key in kept}
            pair: dict[str, Any] = {}
            in_plane = keys["law"] == "coulomb" and law.rows == 2 and not keys.get("normal_stiffness")
            directions = _PAIR_DIRECTIONS[::2] if in_plane else _PAIR_DIRECTIONS  # two tangents without a normal
            for names, row in zip(directions, self.S[begin : begin + law.rows]):
                pair.update(zip(names, ([int(i) + 1 for i in row.indices], row.data.tolist())))
            pairs.append({**pair, **own})
            begin += law.rows
        return {**first, "pairs": pairs}


def _restored_structure(matrices: tuple[Any, ...], arguments: dict[str, Any]) -> Structure:
    return Structure(*matrices, **arguments)


def _terms(shape: npt.NDArray[np.float64], series: npt.NDArray[np.complex128]) -> list[dict[str, Any]]:
    """A force as entries of ``[[forcing.terms]]``, one for each harmonic that it has."""
    terms: list[dict[str, Any]] = []
    for harmonic, value in enumerate(series):
        if value == 0.0:
            continue
        term: dict[str, Any] = {"load": shape, "harmonic": harmonic}
        if harmonic == 0:
            terms.append({**term, "amplitude": float(value.real)})
        else:
            terms.append({**term, "amplitude": float(abs(value)), "phase": float(np.degrees(np.angle(value)))})
    return terms


class Pair(_core.Pair):
    """Trial and weight functions over one period, with the points at which the contact force is evaluated.

    Parameters
    ----------
    name:
        "trial:weight" of "fourier", "haar", "bspline" and "daubechies6" (any even number), or one name for both.
    functions:
        Trial functions per degree of freedom; a power of two with wavelets, odd for Fourier functions only (a mean and
        both functions of each harmonic).
    points:
        Uniform points of the period, by default 4 times the functions, and at least 256.
    formulation:
        "distributional", "weak" or "strong": on which side the derivatives stand.
    inner_products:
        "quadrature" at the same points, or "exact".
    nyquist:
        "drop" or "keep" the coefficient without damping of an even number of functions.
    sample_offset:
        0 or 0.5: points at the left ends or in the middles of their intervals.

    Raises
    ------
    InadmissiblePair
        Where the duality pairing does not exist; a ``ValueError``.
    ValueError
        For names and sizes out of range.
    """

    def __init__(
        self,
        name: str = "fourier:fourier",
        functions: int = 63,
        points: int | None = None,
        *,
        formulation: str = "distributional",
        inner_products: str = "quadrature",
        nyquist: str = "drop",
        sample_offset: float = 0.0,
    ) -> None:
        self.name = name if ":" in name else f"{name}:{name}"
        functions = as_count(functions, "functions", "a whole number, as in Pair('haar:fourier', 64), with both bases in the name")
        count = _points(functions) if points is None else as_count(points, "points", "a whole number of points of the period")
        super().__init__(name, functions, count, formulation, inner_products, nyquist, sample_offset)
        trial, weight = self.name.split(":")
        self._keys = {
            "trial": trial,
            "weight": weight,
            "functions": functions,
            "quadrature_points": count,
            "formulation": formulation,
            "inner_products": inner_products,
            "nyquist": nyquist,
            "sample_offset": sample_offset,
        }

    def __reduce__(self) -> Any:
        return _restored_pair, (self.name, self._keys)

    def scene_keys(self) -> dict[str, Any]:
        """The keys of ``[time]`` in a scene; without sample_offset where it is 0, as modes have none."""
        return {key: value for key, value in self._keys.items() if key != "sample_offset" or value != 0.0}

    def symbol(self, derivative: int) -> npt.NDArray[np.complex128]:
        """The eigenvalues of A_d[i, j] = <p_i, q_j^(d)> over translates k = 0..M/2, for d = 0, 1 or 2; M values / 2 + 1."""
        return super().symbol(derivative)

    def __repr__(self) -> str:
        return f"Pair({self.name!r}, functions={self.functions}, points={self.points})"


def _restored_pair(name: str, keys: dict[str, Any]) -> Pair:
    named = ("formulation", "inner_products", "nyquist", "sample_offset")
    return Pair(name, keys["functions"], keys["quadrature_points"], **{key: keys[key] for key in named})


@functools.lru_cache(maxsize=1)
def default_pair() -> Pair:
    """A mean and 31 harmonics, with 256 points."""
    return Pair()


def _points(functions: int) -> int:
    return max(256, 4 * functions) if functions & (functions - 1) == 0 else max(256, 4 * (functions + 1))


def _vector(values: Any, name: str) -> npt.NDArray[np.float64]:
    values = as_real(values, name)
    try:
        dense = values.toarray() if scipy.sparse.issparse(values) else values
        vector = np.array(dense, dtype=float)
    except (TypeError, ValueError) as error:
        raise ValueError(f"{name} is no vector of numbers: {error}") from None
    return vector.ravel()


def _directions(contacts: Any, size: int) -> scipy.sparse.csr_matrix:
    if scipy.sparse.issparse(contacts) or np.ndim(contacts) == 2:
        return as_csc(contacts, "contacts").tocsr()
    dofs = np.atleast_1d(np.asarray(contacts))
    if dofs.ndim != 1 or not np.issubdtype(dofs.dtype, np.integer):
        raise ValueError("contacts is neither a matrix, contacts x n, nor a list of degrees of freedom")
    for dof in dofs:
        if not 0 <= dof < size:
            raise ValueError(f"contacts: degree of freedom {dof}; expected 0 to {size - 1}")
    ones = np.ones(len(dofs))
    return scipy.sparse.csr_matrix((ones, (np.arange(len(dofs)), dofs)), shape=(len(dofs), size))
