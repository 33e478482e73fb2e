"""Matrices as SciPy has them, and files of them."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import numpy as np
import scipy.sparse

from . import _core


def is_matrix(value: Any) -> bool:
    """Whether a value is an array or a sparse matrix."""
    return scipy.sparse.issparse(value) or isinstance(value, np.ndarray)


def as_csc(value: Any, name: str) -> scipy.sparse.csc_matrix:
    """A matrix of doubles in compressed columns, with its entries sorted and none twice. Raises ValueError."""
    try:
        matrix = scipy.sparse.csc_matrix(value, dtype=float)
    except (TypeError, ValueError) as error:
        raise ValueError(f"{name} is no real matrix: {error}") from None
    if not matrix.has_canonical_format:
        matrix = matrix.copy()
        matrix.sum_duplicates()
    return matrix


def is_numpy_file(name: Any) -> bool:
    """Whether a name is that of an array in a format of NumPy or SciPy."""
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
    _core.write_matrix_market(os.fspath(file), as_csc(column, name))
