#include <cmath>
#include <complex>
#include <numbers>

#include "wavebalance/wavelets/scaling_function.hpp"

namespace wavebalance::wavelets {
namespace {

std::complex<double> symbol(const Eigen::VectorXd& values, int first, double xi) {
  std::complex<double> sum = 0.0;
  for (Eigen::Index k = 0; k < values.size(); ++k)
    sum += values[k] * std::polar(1.0, -xi * double(first + k));
  return sum;
}

}  // namespace

TwoScaleFilter two_scale_filter(const ScalingFunction& phi) {
  if (phi.coefficients().size() == 1) return {0, phi.filter()};
  constexpr int points = 512, length = 224;
  TwoScaleFilter result{2 - length / 2, Eigen::VectorXd::Zero(length)};  // phi is symmetric about 2
  for (int i = 0; i < points; ++i) {
    const double xi = 2.0 * std::numbers::pi * i / points;
    const std::complex<double> value = symbol(phi.filter(), 0, xi) *
                                       symbol(phi.coefficients(), phi.first_coefficient(), 2.0 * xi) /
                                       symbol(phi.coefficients(), phi.first_coefficient(), xi);
    for (int l = 0; l < length; ++l)
      result.values[l] += (value * std::polar(1.0 / points, xi * double(result.first + l))).real();
  }
  return result;
}

}  // namespace wavebalance::wavelets
