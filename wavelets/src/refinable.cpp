#include "refinable.hpp"

#include <Eigen/LU>

#include "wavebalance/wavelets/filter.hpp"

namespace wavebalance::wavelets::detail {
namespace {

// The vector v = T v with sum 1, T[k, m] = mask[2k - m]. The mask has a zero at pi, so the columns of T sum
// to 1, and the equations are equivalent to (T - I + E) v = (1, .., 1) with E the matrix of ones.
ExtendedVector eigenvector_at_integers(const ExtendedVector& mask) {
  using Matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
  const Eigen::Index length = mask.size(), interior = length - 2;
  ExtendedVector values = ExtendedVector::Unit(length, 0);
  if (interior == 0) return values;
  Matrix equations = Matrix::Ones(interior, interior) - Matrix::Identity(interior, interior);
  for (Eigen::Index k = 1; k <= interior; ++k)
    for (Eigen::Index m = 1; m <= interior; ++m)
      if (2 * k - m >= 0 && 2 * k - m < length) equations(k - 1, m - 1) += mask[2 * k - m];
  values[0] = 0.0L;
  values.segment(1, interior) = equations.partialPivLu().solve(ExtendedVector::Ones(interior));
  return values;
}

// Values at twice as many points: the given values, and between them values of the refinement equation.
Eigen::VectorXd refine(const Eigen::VectorXd& table, const Eigen::VectorXd& mask, Eigen::Index one) {
  Eigen::VectorXd finer = Eigen::VectorXd::Zero(2 * table.size() - 1);
  for (Eigen::Index n = 0; n < table.size(); ++n) finer[2 * n] = table[n];
  for (Eigen::Index n = 1; n < finer.size(); n += 2) {
    double sum = 0.0;
    for (Eigen::Index l = 0; l < mask.size() && l * one <= n; ++l)
      if (n - l * one < table.size()) sum += mask[l] * table[n - l * one];
    finer[n] = sum;
  }
  return finer;
}

// Applies values - values(. - stride) `times` times; each time the support grows by one stride.
template <class Vector>
Vector backward_differences(const Vector& values, Eigen::Index stride, int times) {
  Vector result = Vector::Zero(values.size() + times * stride);
  result.head(values.size()) = values;
  for (int d = 0; d < times; ++d)
    for (Eigen::Index k = result.size() - 1; k >= stride; --k) result[k] -= result[k - stride];
  return result;
}

}  // namespace

ExtendedVector extended_bspline_filter(int degree, int removed) {
  if (removed > degree) return ExtendedVector::Constant(1, 2.0L);
  return bspline_filter(degree - removed).cast<long double>();
}

Eigen::VectorXd values_at_integers(const ExtendedVector& divided, int derivative) {
  return backward_differences(eigenvector_at_integers(divided), 1, derivative).cast<double>();
}

Refinable refinable(const ExtendedVector& divided) {
  return {divided.cast<double>(), eigenvector_at_integers(divided).cast<double>()};
}

Eigen::VectorXd values_at_dyadics(const Refinable& phi, int level, int derivative) {
  Eigen::VectorXd table = phi.integers;
  for (int j = 0; j < level; ++j) table = refine(table, phi.mask, Eigen::Index{1} << j);
  return backward_differences(table, Eigen::Index{1} << level, derivative);
}

}  // namespace wavebalance::wavelets::detail
