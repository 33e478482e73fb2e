"""Bases in time: their values and inner products.

A basis is the M translates g(t - j/M) of one generator on the circle [0, 1). Its names are "fourier", "haar", "bspline"
(orthonormal cubic B-splines) and "daubechies6" (any even number of coefficients, 2 to 40).
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from . import _core

__all__ = ["connection_coefficients", "filter", "generator", "harmonic", "scaling_function", "sobolev_exponent"]

Numbers = npt.NDArray[np.float64]


def generator(basis: str, functions: int, points: int, derivative: int = 0) -> Numbers:
    """The d-th derivative of g at t = l / points, `points` values; the translates of g sum to 1.

    `functions` is M, a power of two for wavelets; Daubechies functions have values at a power of two of points.
    Raises ValueError for an unknown basis, other sizes, and a derivative without pointwise values.
    """
    return _core.basis_samples(basis, functions, points, derivative)


def harmonic(basis: str, functions: int, n: int) -> complex:
    """The Fourier coefficient of g, the integral of g(t) exp(-2 pi i n t) over the period."""
    return _core.basis_harmonic(basis, functions, n)


def sobolev_exponent(basis: str, functions: int = 4) -> float:
    """s, such that g has square-integrable derivatives of every order below s; infinite for Fourier functions.

    Two bases are an admissible pair where their exponents sum to more than 2.
    """
    return _core.basis_sobolev_exponent(basis, functions)


def filter(basis: str) -> Numbers:
    """The filter p of the refinement equation phi(x) = sum_l p_l phi(2x - l), which sums to 2; for "bspline" the
    filter of B."""
    return _core.wavelet_filter(basis)


def scaling_function(basis: str, level: int = 8, derivative: int = 0) -> tuple[Numbers, Numbers]:
    """x and phi^(derivative)(x) at the dyadic points of distance 2^-level over the support of a wavelet basis."""
    return _core.wavelet_values(basis, level, derivative)


def connection_coefficients(trial: str, weight: str | None = None, derivative: int = 1) -> tuple[npt.NDArray[np.int64], Numbers]:
    """l and r[l], the integral of phi_weight(x - l) phi_trial^(derivative)(x) over the real line, where it is not zero.

    `weight` is `trial` by default. Raises ValueError where the integral does not exist.
    """
    first, values = _core.wavelet_connection(trial, trial if weight is None else weight, derivative)
    return np.arange(first, first + len(values)), values
