#include "daubechies_reference.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "wavebalance/wavelets/filter.hpp"
#include "wavebalance/wavelets/scaling_function.hpp"

namespace wavebalance::extremes {
namespace {

#if defined(__SIZEOF_FLOAT128__)
__extension__ typedef __float128 Quad;
#else
using Quad = long double;
#endif
using Vector = std::vector<Quad>;
using Matrix = std::vector<Vector>;

Quad absolute(Quad value) { return value < 0 ? -value : value; }

/// Gaussian elimination with row exchanges; a square system.
Vector solve_dense(Matrix matrix, Vector right) {
  const std::size_t size = right.size();
  for (std::size_t column = 0; column < size; ++column) {
    std::size_t pivot = column;
    for (std::size_t row = column + 1; row < size; ++row)
      if (absolute(matrix[row][column]) > absolute(matrix[pivot][column])) pivot = row;
    std::swap(matrix[column], matrix[pivot]);
    std::swap(right[column], right[pivot]);
    for (std::size_t row = column + 1; row < size; ++row) {
      const Quad factor = matrix[row][column] / matrix[column][column];
      for (std::size_t k = column; k < size; ++k) matrix[row][k] -= factor * matrix[column][k];
      right[row] -= factor * right[column];
    }
  }
  for (std::size_t row = size; row-- > 0;) {
    for (std::size_t k = row + 1; k < size; ++k) right[row] -= matrix[row][k] * right[k];
    right[row] /= matrix[row][row];
  }
  return right;
}

/// (-1)^l T_n(x_l) as row n.
Matrix moment_rows(std::size_t length) {
  Matrix rows(length / 2, Vector(length));
  for (std::size_t l = 0; l < length; ++l) {
    const Quad x = (2 * static_cast<Quad>(l) - static_cast<Quad>(length - 1)) / static_cast<Quad>(length - 1);
    Quad before = x, now = 1;  // T_{-1} = T_1
    for (auto& row : rows) {
      row[l] = l % 2 == 0 ? now : -now;
      before = std::exchange(now, 2 * x * now - before);
    }
  }
  return rows;
}

struct Equations {
  Matrix jacobian;
  Vector residual;
};

Equations equations(const Vector& p, const Matrix& moments) {
  const std::size_t length = p.size(), half = length / 2;
  Equations result{Matrix(length, Vector(length, 0)), Vector(length, 0)};
  for (std::size_t m = 0; m < half; ++m) {
    for (std::size_t l = 0; l + 2 * m < length; ++l) {
      result.residual[m] += p[l] * p[l + 2 * m];
      result.jacobian[m][l] += p[l + 2 * m];
      result.jacobian[m][l + 2 * m] += p[l];
    }
    result.jacobian[half + m] = moments[m];
    for (std::size_t l = 0; l < length; ++l) result.residual[half + m] += moments[m][l] * p[l];
  }
  result.residual[0] -= 2;
  return result;
}

Vector exact_filter(const Eigen::VectorXd& start) {
  Vector p(start.begin(), start.end());
  const Matrix moments = moment_rows(p.size());
  for (int step = 0; step < 20; ++step) {
    const Equations at = equations(p, moments);
    const Vector change = solve_dense(at.jacobian, at.residual);
    Quad largest = 0;
    for (std::size_t l = 0; l < p.size(); ++l) {
      p[l] -= change[l];
      largest = std::max(largest, absolute(change[l]));
    }
    if (largest < 1e-26) return p;
  }
  throw std::runtime_error("filter_accuracy: Newton's method did not converge for " +
                           std::to_string(p.size()) + " coefficients");
}

/// Rotates two columns in their plane until they are orthogonal. Returns whether a rotation was needed.
bool orthogonalize(Eigen::Ref<Eigen::VectorXd> a, Eigen::Ref<Eigen::VectorXd> b) {
  const double inner = a.dot(b), first = a.squaredNorm(), second = b.squaredNorm();
  if (std::abs(inner) <= std::numeric_limits<double>::epsilon() * std::sqrt(first * second)) return false;
  const double zeta = (second - first) / (2.0 * inner);
  const double tangent = std::copysign(1.0 / (std::abs(zeta) + std::hypot(1.0, zeta)), zeta);
  const double cosine = 1.0 / std::hypot(1.0, tangent), sine = tangent * cosine;
  const Eigen::VectorXd before = a;
  a = cosine * before - sine * b;
  b = sine * before + cosine * b;
  return true;
}

/// The largest over the smallest singular value, by one-sided Jacobi rotations (Hestenes, 1958), which keep
/// even the smallest ones accurate and compile in a fraction of the time of Eigen's decompositions. O(n^3)
/// per sweep.
double condition(const Matrix& matrix) {
  Eigen::MatrixXd values(matrix.size(), matrix[0].size());
  for (Eigen::Index i = 0; i < values.rows(); ++i)
    for (Eigen::Index j = 0; j < values.cols(); ++j)
      values(i, j) = static_cast<double>(matrix[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)]);
  constexpr int max_sweeps = 60;
  bool turned = true;
  for (int sweep = 0; turned && sweep < max_sweeps; ++sweep) {
    turned = false;
    for (Eigen::Index i = 0; i < values.cols(); ++i)
      for (Eigen::Index j = i + 1; j < values.cols(); ++j)
        turned = orthogonalize(values.col(i), values.col(j)) || turned;
  }
  const Eigen::VectorXd singular = values.colwise().norm();
  return singular.maxCoeff() / singular.minCoeff();
}

/// phi(k) = sum_l p_l phi(2k - l), k = 1..L-2, the last equation replaced by sum phi = 1.
Matrix value_equations(const Vector& p) {
  const std::size_t size = p.size() - 2;
  Matrix matrix(size, Vector(size, 0));
  for (std::size_t k = 1; k < size; ++k)
    for (std::size_t m = 1; m <= size; ++m) {
      if (2 * k >= m && 2 * k - m < p.size()) matrix[k - 1][m - 1] = p[2 * k - m];
      if (k == m) matrix[k - 1][m - 1] -= 1;
    }
  matrix[size - 1].assign(size, 1);
  return matrix;
}

void compare_values(const Vector& p, FilterAccuracy& result) {
  const Matrix matrix = value_equations(p);
  Vector right(p.size() - 2, 0);
  right.back() = 1;
  const Vector exact = solve_dense(matrix, right);
  const Eigen::VectorXd values = wavelets::ScalingFunction::daubechies(result.coefficients).values(0, 0);
  Quad error = 0, largest = 0;
  for (std::size_t k = 0; k < exact.size(); ++k) {
    error = std::max(error, absolute(exact[k] - values[static_cast<Eigen::Index>(k) + 1]));
    largest = std::max(largest, absolute(exact[k]));
  }
  result.values_error = static_cast<double>(error / largest);
  result.values_condition = condition(matrix);
}

}  // namespace

FilterAccuracy filter_accuracy(int coefficients) {
  const Eigen::VectorXd filter = wavelets::daubechies_filter(coefficients);
  const Vector exact = exact_filter(filter), computed(filter.begin(), filter.end());
  const Equations at = equations(computed, moment_rows(computed.size()));
  FilterAccuracy result;
  result.coefficients = coefficients;
  Quad error = 0, relative = 0, largest = 0;
  for (std::size_t l = 0; l < exact.size(); ++l) {
    const Quad difference = absolute(exact[l] - computed[l]);
    error = std::max(error, difference);
    relative = std::max(relative, difference / absolute(exact[l]));
    largest = std::max(largest, absolute(exact[l]));
  }
  result.filter_error = static_cast<double>(error / largest);
  result.relative_error = static_cast<double>(relative);
  for (std::size_t m = 0; m < exact.size() / 2; ++m)
    result.orthogonality = std::max(result.orthogonality, static_cast<double>(absolute(at.residual[m])));
  result.condition = condition(at.jacobian);
  if (coefficients > 2) compare_values(exact, result);
  return result;
}

}  // namespace wavebalance::extremes
