#include "phases/legendre_integrals.hpp"

#include <algorithm>
#include <cmath>

#include "linalg/gauss_rule.hpp"
#include "linalg/index.hpp"

namespace wavebalance::solvers::detail {
namespace {

using Complex = std::complex<double>;

// (exp(w) - 1) / w with exp(w) given, by its series where that cancels.
Complex mean_exponential(Complex w, Complex exponential) {
  if (std::norm(w) > 0.25) return (exponential - 1.0) / w;
  Complex sum = 1.0, term = 1.0;
  for (int n = 2; n < 17; ++n) sum += term *= w * (1.0 / n);
  return sum;
}

// Up to which k the recurrence is followed upwards, and where the boundary value problem ends.
struct Ranges {
  Index upwards, last;
};

// Near the negative real axis a solution grows by exp(k^2 / (2 |z|)) upwards from k = 0, near the imaginary
// axis none does below |z|. Beyond |z| the elimination from above has pivots of at least k + 1.
Ranges ranges_of(Complex z, Index count) {
  constexpr Index padding = 16;
  const double size = std::abs(z);
  const bool real = std::abs(z.real()) > 0.3 * std::abs(z.imag());
  const auto whole = Index(std::min(size, 1e6));
  const bool all = real ? size > 0.25 * double(count * count) : whole >= count;
  if (all) return {count - 1, count - 1};
  return {real ? 0 : whole, (whole > 0 ? std::max(count, whole) + whole / 2 : count) + padding};
}

}  // namespace

Eigen::MatrixXd legendre_values(const Eigen::VectorXd& points, Index count) {
  Eigen::MatrixXd values(points.size(), count);
  values.col(0).setOnes();
  if (count > 1) values.col(1) = points;
  for (Index k = 1; k + 1 < count; ++k)
    values.col(k + 1) =
        (double(2 * k + 1) * points.cwiseProduct(values.col(k)) - double(k) * values.col(k - 1)) /
        double(k + 1);
  return values;
}

ExponentialIntegrals::ExponentialIntegrals(const Eigen::VectorXd& points, Index count)
    : points_(points), count_(count), decay_(points.size()) {}

void ExponentialIntegrals::reserve(Index last) {
  if (last < jumps_.cols()) return;
  const Index columns = last + 1 + last / 2;
  const Eigen::MatrixXd values = legendre_values(points_, columns + 1);
  jumps_.setZero(points_.size(), columns);
  jumps_.rightCols(columns - 1) = values.rightCols(columns - 1) - values.leftCols(columns - 1);
  y_.resize(points_.size(), columns);
  inverse_.resize(columns);
}

void ExponentialIntegrals::compute(Complex z) {
  const auto [upwards, last] = ranges_of(z, count_);
  reserve(last);
  const Complex one_over = upwards > 0 ? 1.0 / z : 0.0;
  for (Index i = 0; i < points_.size(); ++i) {
    const double reach = points_[i] + 1.0;
    decay_[i] = std::polar(std::exp(z.real() * reach), z.imag() * reach);
    y_(i, 0) = reach * mean_exponential(z * reach, decay_[i]);
    if (upwards > 0) y_(i, 1) = (y_(i, 0) - points_[i] - decay_[i]) * one_over;
  }
  for (Index k = 1; k < upwards; ++k)
    y_.col(k + 1) = y_.col(k - 1) + (double(2 * k + 1) * one_over) * y_.col(k) - one_over * jumps_.col(k);
  if (last > upwards) solve_downwards(z, upwards, last);
}

// The columns k in (from, last] of the solution with column `from` given and column last + 1 zero.
void ExponentialIntegrals::solve_downwards(Complex z, Index from, Index last) {
  inverse_[last] = 1.0 / double(2 * last + 1);
  y_.col(last) = jumps_.col(last).cast<Complex>();
  for (Index k = last - 1; k > from; --k) {
    const Complex factor = z * inverse_[k + 1];
    inverse_[k] = 1.0 / (double(2 * k + 1) + factor * z);
    y_.col(k) = jumps_.col(k) + factor * y_.col(k + 1);
  }
  for (Index k = from + 1; k < std::max(count_, from + 1); ++k)
    y_.col(k) = inverse_[k] * y_.col(k) - (inverse_[k] * z) * y_.col(k - 1);
}

LegendreNodes::LegendreNodes(Index count) {
  const QuadratureRule rule = gauss_rule(static_cast<int>(count));
  points = 2.0 * rule.points.array() - 1.0;
  const Eigen::MatrixXd values = legendre_values(points, count);
  coefficients = values.transpose() * (2.0 * rule.weights).asDiagonal();
  for (Index k = 0; k < count; ++k) coefficients.row(k) *= 0.5 * double(2 * k + 1);
}

}  // namespace wavebalance::solvers::detail
