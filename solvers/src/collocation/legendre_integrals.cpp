#include "collocation/legendre_integrals.hpp"

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

// The division of complex numbers, which guards against overflow, takes most of the time of a recurrence.
double reciprocal(double x) { return 1.0 / x; }
Complex reciprocal(Complex x) { return std::conj(x) / std::norm(x); }

// Up to which k the recurrence is followed upwards, and where the boundary value problem ends.
struct Ranges {
  Index upwards, last;
};

bool is_near_real_axis(Complex z) { return std::abs(z.real()) > 0.3 * std::abs(z.imag()); }

// Near the negative real axis a solution grows by exp(k^2 / (2 |z|)) upwards from k = 0, near the imaginary
// axis none does below |z|. Beyond |z| the elimination from above has pivots of at least k + 1. The error
// of the zero beyond the last one decays downwards to rounding, like the growing solution.
Ranges ranges_of(Complex z, Index count) {
  constexpr Index padding = 16;
  constexpr double digits = 40.0;  // e-folds
  if (follows_upwards(z, count)) return {count - 1, count - 1};
  const bool real = is_near_real_axis(z);
  const auto whole = Index(std::min(std::abs(z), 1e6));
  Index last = whole > 0 ? std::max(count, whole) + whole / 2 : count;
  if (real)
    last = std::min(last, Index(std::sqrt(double(count * count) + 2.0 * digits * std::norm(z) / -z.real())));
  return {real ? 0 : whole, last + padding};
}

}  // namespace

bool follows_upwards(Complex z, Index count) {
  return is_near_real_axis(z) ? std::abs(z) > 0.25 * double(count * count) : std::abs(z) >= double(count);
}

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
    inverse_[k] = reciprocal(double(2 * k + 1) + factor * z);
    y_.col(k) = jumps_.col(k) + factor * y_.col(k + 1);
  }
  for (Index k = from + 1; k < std::max(count_, from + 1); ++k)
    y_.col(k) = inverse_[k] * y_.col(k) - (inverse_[k] * z) * y_.col(k - 1);
}

template class ExponentialIntegrals<double>;
template class ExponentialIntegrals<Complex>;

Index most_coefficients(Complex z) {
  const double turns = std::abs(z.imag());
  return Index(turns + 8.0 * std::cbrt(turns) + 9.0 * std::sqrt(std::abs(z.real())) + 17.0);
}

Index exponential_series(Complex z, Eigen::Ref<Eigen::VectorXd> real, Eigen::Ref<Eigen::VectorXd> imag) {
  constexpr double rounding = 1e-17, tiny = 1e-300;
  const double size = std::abs(z);
  real.setZero();
  imag.setZero();
  real[0] = 1.0;
  if (size < rounding) return 1;
  const double inverse_re = z.real() / (size * size), inverse_im = -z.imag() / (size * size);
  double above_re = 0.0, above_im = 0.0, re = tiny, im = 0.0, sum_re = 0.0, sum_im = 0.0;
  Index length = most_coefficients(z);
  for (Index n = length - 1;; --n) {
    const double weight = double(2 * n + 1), sign = n % 2 == 0 ? 1.0 : -1.0;
    real[n] = weight * re;
    imag[n] = weight * im;
    sum_re += sign * real[n];
    sum_im += sign * imag[n];
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
  for (Index n = 0; n < length; ++n) {
    const double own = real[n];
    real[n] = own * scale.real() - imag[n] * scale.imag();
    imag[n] = own * scale.imag() + imag[n] * scale.real();
  }
  while (length > 1 && std::abs(real[length - 1]) + std::abs(imag[length - 1]) < rounding) --length;
  return length;
}

// The recurrence is stable at and below the diagonal; above it the columns follow by symmetry.
Eigen::MatrixXd convolution(const Eigen::VectorXd& kernel, Index count) {
  const Index last = kernel.size(), rows = last + count;
  // Entry k + 1 of these belongs to P_k; the entries next to the ends are zero.
  Eigen::VectorXd over(rows + 2), scaled = Eigen::VectorXd::Zero(rows + 2);
  for (Index k = -1; k <= rows; ++k) over[k + 1] = 1.0 / double(2 * k + 1);
  Eigen::MatrixXd b = Eigen::MatrixXd::Zero(rows, count);
  for (Index k = 0; k < last; ++k) scaled[k + 1] = kernel[k] * over[k + 1];
  b(0, 0) = kernel[0] - scaled[2];
  for (Index k = 1; k <= last; ++k) b(k, 0) = scaled[k] - scaled[k + 2];
  for (Index n = 1; n < count; ++n) {
    const double *before = b.col(n - 1).data(), *o = over.data() + 1;
    double *own = b.col(n).data(), *s = scaled.data() + 1;
    for (Index k = n - 1; k < last + n; ++k) s[k] = before[k] * o[k];
    s[last + n] = s[last + n + 1] = 0.0;
    const double weight = double(2 * n - 1);
    if (n > 1) {
      const double* two = b.col(n - 2).data();
      for (Index k = n; k <= last + n; ++k) own[k] = weight * (s[k - 1] - s[k + 1]) + two[k];
    } else {
      for (Index k = 1; k <= last; ++k) own[k] = s[k - 1] - s[k + 1] - before[k];
      own[last + 1] = s[last];
    }
    for (Index k = 0; k < n; ++k)
      own[k] = ((k + n) % 2 == 0 ? 1.0 : -1.0) * double(2 * k + 1) / double(2 * n + 1) * b(n, k);
  }
  return b;
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
