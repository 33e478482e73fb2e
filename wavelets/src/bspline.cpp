#include "wavebalance/wavelets/bspline.hpp"

#include <cmath>
#include <numbers>
#include <string>

#include "require.hpp"

namespace wavebalance::wavelets {

Eigen::VectorXd bspline_values(int degree, double fraction, int derivative) {
  detail::require_in_range("bspline_values: derivative", derivative, 0, degree);
  if (!(fraction >= 0.0 && fraction < 1.0))
    detail::reject("bspline_values: fraction", std::to_string(fraction), "in [0, 1)");
  Eigen::VectorXd values = Eigen::VectorXd::Zero(degree + 1);
  values[0] = 1.0;
  for (int n = 1; n <= degree - derivative; ++n)
    for (int j = n; j >= 0; --j) {
      const double x = fraction + j;
      values[j] = (x * values[j] + (j > 0 ? (n + 1 - x) * values[j - 1] : 0.0)) / n;
    }
  // B_n' = B_{n-1} - B_{n-1}(. - 1)
  for (int d = 0; d < derivative; ++d)
    for (int j = degree; j > 0; --j) values[j] -= values[j - 1];
  return values;
}

double cubic_gram_symbol(double cosine) {
  return (((cosine + 60.0) * cosine + 297.0) * cosine + 272.0) / 630.0;
}

Eigen::VectorXd orthonormal_cubic_coefficients(int largest) {
  detail::require_in_range("orthonormal_cubic_coefficients: largest", largest, 0, 100);
  constexpr int points = 512;
  Eigen::VectorXd coefficients = Eigen::VectorXd::Zero(largest + 1);
  for (int i = 0; i < points; ++i) {
    const double value = 1.0 / std::sqrt(cubic_gram_symbol(std::cos(2.0 * std::numbers::pi * i / points)));
    for (int k = 0; k <= largest; ++k)
      coefficients[k] += value * std::cos(2.0 * std::numbers::pi * (i * k % points) / points);
  }
  return coefficients / points;
}

}  // namespace wavebalance::wavelets
