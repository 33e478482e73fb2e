#include "phases/legendre_integrals.hpp"

#include <algorithm>
#include <cmath>

#include "linalg/gauss_rule.hpp"
#include "linalg/index.hpp"

namespace wavebalance::solvers::detail {
namespace {

using Complex = std::complex<double>;

// (exp(w) - 1) / w by its series, |w| < 1/2.
template <class Scalar>
Scalar mean_exponential(Scalar w) {
  Scalar sum = 1.0, term = 1.0;
  for (int n = 2; n < 17; ++n) sum += term *= w * (1.0 / n);
  return sum;
}

// Without the cost of what is below the least number.
template <class Scalar>
Scalar decayed(Scalar w) {
  constexpr double negligible = -300.0;
  return std::real(w) < negligible ? Scalar(0.0) : std::exp(w);
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

template <class Scalar>
ExponentialIntegrals<Scalar>::ExponentialIntegrals(const Eigen::VectorXd& points, Index count)
    : points_(points), count_(count), decay_(points.size()) {}

template <class Scalar>
void ExponentialIntegrals<Scalar>::reserve(Index last) {
  if (last < jumps_.cols()) return;
  const Index columns = last + 1 + last / 2;
  const Eigen::MatrixXd values = legendre_values(points_, columns + 1);
  jumps_.setZero(points_.size(), columns);
  jumps_.rightCols(columns - 1) = values.rightCols(columns - 1) - values.leftCols(columns - 1);
  y_.resize(points_.size(), columns);
  inverse_.resize(columns);
}

template <class Scalar>
void ExponentialIntegrals<Scalar>::compute(Scalar z) {
  const auto [upwards, last] = ranges_of(z, count_);
  reserve(last);
  const double size = std::abs(z);
  const Scalar one_over = size > 0.0 ? 1.0 / z : Scalar(0.0);
  for (Index i = 0; i < points_.size(); ++i) {
    const double reach = points_[i] + 1.0;
    decay_[i] = decayed(z * reach);
    y_(i, 0) = size * reach < 0.5 ? reach * mean_exponential(z * reach) : (decay_[i] - 1.0) * one_over;
    if (upwards > 0) y_(i, 1) = (y_(i, 0) - points_[i] - decay_[i]) * one_over;
  }
  for (Index k = 1; k < upwards; ++k)
    y_.col(k + 1) = y_.col(k - 1) + (double(2 * k + 1) * one_over) * y_.col(k) - one_over * jumps_.col(k);
  if (last > upwards) solve_downwards(z, upwards, last);
}

// The columns k in (from, last] of the solution with column `from` given and column last + 1 zero.
template <class Scalar>
void ExponentialIntegrals<Scalar>::solve_downwards(Scalar z, Index from, Index last) {
  inverse_[last] = 1.0 / double(2 * last + 1);
  y_.col(last) = jumps_.col(last).cast<Scalar>();
  for (Index k = last - 1; k > from; --k) {
    const Scalar factor = z * inverse_[k + 1];
    inverse_[k] = 1.0 / (double(2 * k + 1) + factor * z);
    y_.col(k) = jumps_.col(k) + factor * y_.col(k + 1);
  }
  for (Index k = from + 1; k < std::max(count_, from + 1); ++k)
    y_.col(k) = inverse_[k] * y_.col(k) - (inverse_[k] * z) * y_.col(k - 1);
}

template class ExponentialIntegrals<double>;
template class ExponentialIntegrals<Complex>;

std::vector<Complex> exponential_series(Complex z) {
  constexpr double rounding = 1e-17, tiny = 1e-300;
  const double size = std::abs(z);
  if (size < rounding) return {1.0};
  const double turns = std::abs(z.imag());
  const auto last =
      static_cast<std::size_t>(turns + 8.0 * std::cbrt(turns) + 9.0 * std::sqrt(std::abs(z.real())) + 16.0);
  std::vector<Complex> series(last + 1);
  const double inverse_re = z.real() / (size * size), inverse_im = -z.imag() / (size * size);
  double above_re = 0.0, above_im = 0.0, re = tiny, im = 0.0, sum_re = 0.0, sum_im = 0.0;
  for (std::size_t n = last;; --n) {
    const double weight = double(2 * n + 1), sign = n % 2 == 0 ? 1.0 : -1.0;
    series[n] = {weight * re, weight * im};
    sum_re += sign * weight * re;
    sum_im += sign * weight * im;
    if (n == 0) break;
    const double a = weight * inverse_re, b = weight * inverse_im;
    const double below_re = above_re + a * re - b * im, below_im = above_im + a * im + b * re;
    above_re = re;
    above_im = im;
    re = below_re;
    im = below_im;
  }
  // exp(z (x + 1)) is 1 at x = -1.
  const Complex scale = 1.0 / Complex(sum_re, sum_im);
  for (Complex& coefficient : series)
    coefficient = {coefficient.real() * scale.real() - coefficient.imag() * scale.imag(),
                   coefficient.real() * scale.imag() + coefficient.imag() * scale.real()};
  while (series.size() > 1 && std::norm(series.back()) < rounding * rounding) series.pop_back();
  return series;
}

// The recurrence is stable at and below the diagonal; above it the columns follow by symmetry.
Eigen::MatrixXd convolution(const Eigen::VectorXd& kernel, Index count) {
  const Index last = kernel.size(), rows = last + count;
  // Entry k + 1 of a column belongs to P_k; those beside the ends are zero.
  const Eigen::ArrayXd degree = Eigen::ArrayXd::LinSpaced(rows + 2, -1.0, double(rows));
  const Eigen::ArrayXd over = (2.0 * degree + 1.0).inverse();
  Eigen::ArrayXXd b = Eigen::ArrayXXd::Zero(rows + 2, count);
  Eigen::ArrayXd scaled = Eigen::ArrayXd::Zero(rows + 2);  // of the column before, over 2 k + 1
  scaled.segment(1, last) = kernel.array() * over.segment(1, last);
  b.col(0).segment(2, last) = scaled.segment(1, last) - scaled.segment(3, last);
  b(1, 0) = kernel[0] - scaled[2];
  for (Index n = 1; n < count; ++n) {
    const Index size = last + 1;  // k from n to last + n
    scaled = b.col(n - 1) * over;
    auto own = b.col(n).segment(n + 1, size);
    own = double(2 * n - 1) * (scaled.segment(n, size) - scaled.segment(n + 2, size));
    if (n > 1)
      own += b.col(n - 2).segment(n + 1, size);
    else
      own -= b.col(0).segment(2, size);
    for (Index k = 0; k < n; ++k)
      b(k + 1, n) = ((k + n) % 2 == 0 ? 1.0 : -1.0) * double(2 * k + 1) / double(2 * n + 1) * b(n + 1, k);
  }
  return b.middleRows(1, rows);
}

LegendreNodes::LegendreNodes(Index count) {
  constexpr Index longest_series = 128;
  const QuadratureRule rule = gauss_rule(static_cast<int>(count));
  points = 2.0 * rule.points.array() - 1.0;
  values = legendre_values(points, count + longest_series);
  coefficients = values.leftCols(count).transpose() * (2.0 * rule.weights).asDiagonal();
  for (Index k = 0; k < count; ++k) coefficients.row(k) *= 0.5 * double(2 * k + 1);
}

}  // namespace wavebalance::solvers::detail
