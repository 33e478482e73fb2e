#include "refinable.hpp"

#include <Eigen/QR>
#include <cmath>
#include <stdexcept>
#include <string>

namespace wavebalance::wavelets::detail {
namespace {

using Matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

// [2^d mask - I; moments 0..d] over the interior integers. The moments are taken about the middle of the
// support and in units of its half length, which changes none of the conditions and keeps the rows of
// order 1.
Matrix eigenvector_equations(const ExtendedVector& mask, int first, int derivative) {
  const int length = static_cast<int>(mask.size()), interior = length - 2;
  const long double half = 0.5L * (length - 1), middle = first + half, scale = std::ldexp(1.0L, derivative);
  Matrix equations = Matrix::Zero(interior + derivative + 1, interior);
  for (int i = 0; i < interior; ++i) {
    const int k = first + 1 + i;
    for (int j = 0; j < interior; ++j) {
      const int index = 2 * k - (first + 1 + j) - first;
      if (index >= 0 && index < length) equations(i, j) = scale * mask[index];
    }
    equations(i, i) -= 1;
    for (int power = 0; power <= derivative; ++power)
      equations(interior + power, i) = std::pow((k - middle) / half, power);
  }
  return equations;
}

}  // namespace

Eigen::VectorXd values_at_integers(const ExtendedVector& mask, int first, int derivative) {
  const int length = static_cast<int>(mask.size()), interior = length - 2;
  if (interior == 0) return Eigen::Vector2d(1.0, 0.0);
  const Matrix equations = eigenvector_equations(mask, first, derivative);
  ExtendedVector right_side = ExtendedVector::Zero(equations.rows());
  // (-1)^d d! / half^d, factor by factor
  right_side[interior + derivative] = 1;
  for (int k = 1; k <= derivative; ++k) right_side[interior + derivative] *= -k / (0.5L * (length - 1));
  Eigen::VectorXd values = Eigen::VectorXd::Zero(length);
  values.segment(1, interior) = equations.colPivHouseholderQr().solve(right_side).cast<double>();
  return values;
}

Eigen::VectorXd values_at_dyadics(const ExtendedVector& extended, int level, int derivative) {
  const Eigen::VectorXd filter = extended.cast<double>();
  const Eigen::Index support = filter.size() - 1;
  Eigen::VectorXd table = values_at_integers(extended, 0, derivative);
  for (int j = 0; j < level; ++j) {
    Eigen::VectorXd finer = Eigen::VectorXd::Zero(2 * table.size() - 1);
    for (Eigen::Index n = 0; n < table.size(); ++n) finer[2 * n] = table[n];
    const Eigen::Index one = Eigen::Index{1} << j;
    for (Eigen::Index n = 1; n < finer.size(); n += 2) {
      double sum = 0.0;
      for (Eigen::Index l = 0; l <= support && l * one <= n; ++l)
        if (n - l * one < table.size()) sum += filter[l] * table[n - l * one];
      finer[n] = std::ldexp(sum, derivative);
    }
    table.swap(finer);
  }
  return table;
}

void require_in_range(const char* name, int value, int lowest, int highest) {
  if (value < lowest || value > highest)
    throw std::invalid_argument(std::string(name) + " = " + std::to_string(value) +
                                ", allowed: " + std::to_string(lowest) + ".." + std::to_string(highest));
}

}  // namespace wavebalance::wavelets::detail
