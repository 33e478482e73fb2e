#pragma once
#include <complex>
#include <functional>
#include <optional>
#include <vector>

#include "stability/floquet_determinant.hpp"

namespace wavebalance::solvers {

/// The change of the argument of a function over an interval of nu, on which it has no zeros. `at` has the
/// logarithm and its derivative by i nu. Steps between the ascending `points` are halved until the argument
/// changes by at most pi / 3 and agrees with its derivative, and until the derivative excludes zeros near
/// the step. Nothing if that needs more than `max_evaluations`.
std::optional<double> argument_change(const std::function<FloquetDeterminant::Value(double)>& at,
                                      const std::vector<double>& points, int max_evaluations);

/// The change of arg Delta(i nu) over nu = 0..omega / 2, from points around each natural frequency, folded
/// into that interval. Nothing where the determinant has max_evaluations.
std::optional<double> determinant_change(FloquetDeterminant& determinant, int max_evaluations);

/// The same of N(i nu) = Delta prod (1 - exp((lambda_j - i nu) T)) = prod (1 - mu_j / z), a polynomial in 1
/// / z for infinitely many harmonics, from its values at uniform points of the unit circle. They are
/// doubled until the polynomial through them has no high powers that matter; the argument belongs to the
/// polynomial. This needs only logarithms of the determinant, as many as there are multipliers that do not
/// decay. `own` is the number of exponents with a positive real part that have not been divided out.
struct PolynomialChange {
  double change = 0.0;
  int own = 0;
};
/// The evaluations with which polynomial_change() begins, mostly all that it needs.
int first_evaluations(const FloquetDeterminant& determinant);
std::optional<PolynomialChange> polynomial_change(FloquetDeterminant& determinant, int max_evaluations);

}  // namespace wavebalance::solvers
