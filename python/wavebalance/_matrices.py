"""Matrices as SciPy has them, and files of them."""

from __future__ import annotations

import numbers
import os
from pathlib import Path
from typing import Any

import numpy as np
import scipy.sparse

from . import _core


def is_matrix(value: Any) -> bool:
    """Whether a value is an array or a sparse matrix."""
    return scipy.sparse.issparse(value) or isinstance(value, np.ndarray)


#: Parameter that replaces complex numbers of a part of a structure; other parts must be real.
_INSTEAD = {
    **dict.fromkeys(("K", "stiffness"), "; structural damping K (1 + i eta) is loss_factor = eta"),
    **dict.fromkeys(("C", "damping"), "; structural damping is the structure's loss_factor"),
    "load": "; a phase phi is that of forces=[(shape, [0, F * exp(1j * phi)])] with n real values of shape, or phase of "
    "[[forcing.terms]] in a scene",
}


def as_real(value: Any, name: str) -> Any:
    """The value, or its real part where all imaginary parts are zero. Raises ValueError for other complex numbers."""
    array = value if scipy.sparse.issparse(value) else np.asarray(value)
    if not np.iscomplexobj(array):
        return value
    if np.any((array.data if scipy.sparse.issparse(array) else array).imag):
        raise ValueError(f"{name} holds complex numbers; expected real ones{_INSTEAD.get(name, '')}")
    return array.real


def as_number(value: Any, name: str, allowed: str) -> float:
    """A plain number as a float. Raises TypeError for texts, arrays and complex numbers, with what is allowed."""
    if isinstance(value, numbers.Real) or (np.ndim(value) == 0 and isinstance(value, np.ndarray) and value.dtype.kind in "iuf"):
        return float(value)
    raise TypeError(f"{name} is {_shown(value)}; expected {allowed}")


def as_count(value: Any, name: str, allowed: str) -> int:
    """A whole number as an int. Raises TypeError for anything else, with what is allowed."""
    if isinstance(value, (int, np.integer)) and not isinstance(value, bool):
        return int(value)
    raise TypeError(f"{name} is {_shown(value)}; expected {allowed}")


def _shown(value: Any) -> str:
    return f"an array of {np.size(value)} numbers" if np.ndim(value) > 0 else repr(value)


def as_csc(value: Any, name: str) -> scipy.sparse.csc_matrix:
    """A matrix of doubles in compressed columns, with its entries sorted and none twice. Raises ValueError."""
    value = as_real(value, name)
    try:
        matrix = scipy.sparse.csc_matrix(value, dtype=float)
    except (TypeError, ValueError) as error:
        raise ValueError(f"{name} is no real matrix: {error}") from None
    if not matrix.has_canonical_format:
        matrix = matrix.copy()
        matrix.sum_duplicates()
    return matrix


def is_numpy_file(name: Any) -> bool:
    """Whether a name belongs to an array in a format of NumPy or SciPy."""
    return isinstance(name, (str, os.PathLike)) and os.fspath(name).endswith((".npz", ".npy"))


def load_matrix(file: Path) -> Any:
    """The matrix of a .npz file as ``scipy.sparse.save_npz`` writes it, or of a .npy file. Raises OSError, ValueError."""
    try:
        return np.load(file) if file.suffix == ".npy" else scipy.sparse.load_npz(file)
    except (ValueError, KeyError) as error:
        raise ValueError(f"{file}: no matrix of scipy.sparse.save_npz or numpy.save ({error})") from None


def write_matrix(file: Path, matrix: Any, name: str) -> None:
    """Writes a matrix, or a vector as a column, in the format of Matrix Market with all digits."""
    column = matrix if scipy.sparse.issparse(matrix) or np.ndim(matrix) == 2 else np.reshape(matrix, (-1, 1))
    file.write_text(_core.matrix_market_text(as_csc(column, name)), encoding="utf-8")
