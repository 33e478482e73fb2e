"""Daubechies filters in decimal numbers of 50 digits, and how far those in double precision are from them.

Newton's method on the equations that define the filter of L coefficients,
    sum_l p_l p_{l+2m} = 2 delta_m,   sum_l (-1)^l T_n(x_l) p_l = 0,   m, n = 0..L/2-1,
with T_n Chebyshev polynomials and x_l the l-th of L uniform points of [-1, 1]: no root of any polynomial, on which the
program's filters rest. It starts from one of these, which only decides which solution is meant.
"""

import dataclasses
from decimal import Decimal, localcontext

import numpy as np
import scipy.linalg.lapack

from wavebalance import wavelets

DIGITS = 50


@dataclasses.dataclass
class FilterAccuracy:
    """Errors of a filter in double precision."""

    coefficients: int
    filter_error: float  # max |p_l - exact| / max |p_l|
    relative_error: float  # max |p_l - exact| / |p_l|: the smallest coefficients, too
    orthogonality: float  # max over m of |sum_l p_l p_{l+2m} - 2 delta_m|, summed exactly
    condition: float  # of the equations of the filter, 2-norm
    values_error: float = 0.0  # max |phi(k) - exact| at the integers, over the largest
    values_condition: float = 0.0  # of the equations for phi at the integers


def solve_dense(matrix, right):
    """Gaussian elimination with row exchanges."""
    rows = [[*row, value] for row, value in zip(matrix, right)]
    size = len(rows)
    for column in range(size):
        pivot = max(range(column, size), key=lambda row: abs(rows[row][column]))
        rows[column], rows[pivot] = rows[pivot], rows[column]
        head = rows[column]
        for row in range(column + 1, size):
            if rows[row][column]:
                factor = rows[row][column] / head[column]
                rows[row][column:] = [a - factor * b for a, b in zip(rows[row][column:], head[column:])]
    solution = [Decimal(0)] * size
    for row in reversed(range(size)):
        known = sum(rows[row][k] * solution[k] for k in range(row + 1, size))
        solution[row] = (rows[row][size] - known) / rows[row][row]
    return solution


def moment_rows(length):
    """(-1)^l T_n(x_l) as row n."""
    points = [Decimal(2 * l - length + 1) / (length - 1) for l in range(length)]
    before, now, rows = points, [Decimal(1)] * length, []
    for _ in range(length // 2):
        rows.append([value if l % 2 == 0 else -value for l, value in enumerate(now)])
        before, now = now, [2 * x * b - a for x, a, b in zip(points, before, now)]
    return rows


def equations(p, moments):
    """Jacobian and residual."""
    length = len(p)
    jacobian, residual = [], []
    for m in range(length // 2):
        row = [Decimal(0)] * length
        for l in range(length - 2 * m):
            row[l] += p[l + 2 * m]
            row[l + 2 * m] += p[l]
        jacobian.append(row)
        residual.append(sum(p[l] * p[l + 2 * m] for l in range(length - 2 * m)) - (2 if m == 0 else 0))
    residual += [sum(a * b for a, b in zip(row, p)) for row in moments]
    return jacobian + moments, residual


def exact_filter(start):
    p, moments = list(start), moment_rows(len(start))
    for _ in range(20):
        change = solve_dense(*equations(p, moments))
        p = [a - b for a, b in zip(p, change)]
        if max(map(abs, change)) < Decimal("1e-26"):
            return p
    raise ArithmeticError(f"Newton's method did not converge for {len(p)} coefficients")


def condition(matrix):
    """The largest over the smallest singular value, by Jacobi rotations, which keep even the smallest ones accurate."""
    singular, _, _, scale, _, info = scipy.linalg.lapack.dgejsv(np.array(matrix, dtype=float), jobu=3, jobv=3)
    assert info == 0
    return singular.max() / singular.min()


def value_equations(p):
    """phi(k) = sum_l p_l phi(2k - l), k = 1..L-2, the last equation replaced by sum phi = 1."""
    size = len(p) - 2

    def entry(k, m):
        return (p[2 * k - m] if 0 <= 2 * k - m < len(p) else Decimal(0)) - (1 if k == m else 0)

    return [*([entry(k, m) for m in range(1, size + 1)] for k in range(1, size)), [Decimal(1)] * size]


def compare_values(p, result):
    matrix = value_equations(p)
    exact = solve_dense(matrix, [Decimal(0)] * (len(p) - 3) + [Decimal(1)])
    _, values = wavelets.scaling_function(f"daubechies{result.coefficients}", level=0)
    error = max(abs(a - Decimal(float(b))) for a, b in zip(exact, values[1:]))
    result.values_error = float(error / max(map(abs, exact)))
    result.values_condition = condition(matrix)


def filter_accuracy(coefficients):
    with localcontext() as context:
        context.prec = DIGITS
        computed = [Decimal(float(p)) for p in wavelets.filter(f"daubechies{coefficients}")]
        exact = exact_filter(computed)
        jacobian, residual = equations(computed, moment_rows(coefficients))
        errors = [abs(a - b) for a, b in zip(exact, computed)]
        result = FilterAccuracy(
            coefficients, float(max(errors) / max(map(abs, exact))),
            float(max(e / abs(a) for e, a in zip(errors, exact))),
            float(max(map(abs, residual[: coefficients // 2]))), condition(jacobian))
        if coefficients > 2:
            compare_values(exact, result)
    return result
