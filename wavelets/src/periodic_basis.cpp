#include "wavebalance/wavelets/periodic_basis.hpp"

#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "require.hpp"
#include "wavebalance/wavelets/bspline.hpp"

namespace wavebalance::wavelets {
namespace {

Eigen::Index modulo(Eigen::Index n, Eigen::Index period) { return ((n % period) + period) % period; }

Eigen::VectorXd wrapped_coefficients(const ScalingFunction& function, int period) {
  Eigen::VectorXd wrapped = Eigen::VectorXd::Zero(period);
  for (Eigen::Index k = 0; k < function.coefficients().size(); ++k)
    wrapped[modulo(function.first_coefficient() + k, period)] += function.coefficients()[k];
  return wrapped;
}

}  // namespace

PeriodicBasis::PeriodicBasis(ScalingFunction scaling_function, int level)
    : scaling_function_(std::move(scaling_function)), level_(level) {
  detail::require_in_range("PeriodicBasis: level", level, 0, 24);
}

Eigen::VectorXd PeriodicBasis::samples(int points, int derivative) const {
  if (points < 1) detail::reject("PeriodicBasis::samples: points", std::to_string(points), "at least 1");
  detail::require_in_range("PeriodicBasis::samples: derivative of " + scaling_function_.name(), derivative, 0,
                           pointwise_derivatives());
  const Eigen::VectorXd values = scaling_function_.spline_degree() ? spline_samples(points, derivative)
                                                                   : dyadic_samples(points, derivative);
  return values * std::ldexp(1.0, level_ * derivative);
}

// g(l/points) = sum_j c~[i - j mod M] B(x - i + j) with x = M l/points, i = floor(x), c~ the wrapped
// coefficients. x - i has only points / gcd(points, M) values.
Eigen::VectorXd PeriodicBasis::spline_samples(int points, int derivative) const {
  const Eigen::Index period = functions();
  const int degree = *scaling_function_.spline_degree();
  const Eigen::VectorXd wrapped = wrapped_coefficients(scaling_function_, functions());
  Eigen::VectorXd preceded(period + degree);  // c~ after the `degree` values that precede it on the circle
  for (Eigen::Index i = 0; i < preceded.size(); ++i) preceded[i] = wrapped[modulo(i - degree, period)];
  const Eigen::Index common = std::gcd(period, Eigen::Index{points});
  Eigen::MatrixXd values(degree + 1, points / common);  // B(x - i + j) with j descending
  for (Eigen::Index f = 0; f < values.cols(); ++f)
    values.col(f) = bspline_values(degree, static_cast<double>(f * common) / points, derivative).reverse();
  Eigen::VectorXd result(points);
  for (Eigen::Index l = 0; l < points; ++l) {
    const Eigen::Index cell = l * period / points;
    result[l] = preceded.segment(cell, degree + 1).dot(values.col(l * period % points / common));
  }
  return result;
}

Eigen::VectorXd PeriodicBasis::dyadic_samples(int points, int derivative) const {
  if ((points & (points - 1)) != 0)
    detail::reject(
        "PeriodicBasis::samples: points", std::to_string(points),
        "a power of two for " + scaling_function_.name() + ", which is known at dyadic points only");
  const int period = functions();
  int refinement = 0;
  while ((static_cast<long long>(period) << refinement) < points) ++refinement;
  const Eigen::VectorXd table = scaling_function_.values(refinement, derivative);
  // x = n 2^-refinement is t = n / fine on the circle. With fewer points than functions only every stride-th
  // value is kept.
  const Eigen::Index fine = static_cast<Eigen::Index>(period) << refinement, stride = fine / points;
  Eigen::VectorXd result = Eigen::VectorXd::Zero(points);
  for (Eigen::Index n = 0; n < table.size(); ++n) {
    const Eigen::Index wrapped = n % fine;
    if (wrapped % stride == 0) result[wrapped / stride] += table[n];
  }
  return result;
}

std::complex<double> PeriodicBasis::fourier_coefficient(int harmonic) const {
  return scaling_function_.fourier_transform_at_cycles(std::ldexp(static_cast<double>(harmonic), -level_)) /
         static_cast<double>(functions());
}

}  // namespace wavebalance::wavelets
