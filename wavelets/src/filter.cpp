#include "wavebalance/wavelets/filter.hpp"

#include <cmath>
#include <string>

#include "require.hpp"

namespace wavebalance::wavelets {

Eigen::VectorXd bspline_filter(int degree) {
  detail::require_in_range("bspline_filter: degree", degree, 0, 19);
  Eigen::VectorXd filter(degree + 2);
  filter[0] = std::ldexp(1.0, -degree);
  for (int k = 1; k <= degree + 1; ++k) filter[k] = filter[k - 1] * (degree + 2 - k) / k;
  return filter;
}

int zeros_at_pi(const Eigen::VectorXd& filter) {
  if (filter.size() == 0 || !(std::abs(filter.sum() - 2.0) < 1e-8))
    detail::reject("zeros_at_pi: the sum of the filter's " + std::to_string(filter.size()) + " coefficients",
                   std::to_string(filter.sum()), "2");
  const auto length = static_cast<int>(filter.size());
  const long double centre = 0.5L * (length - 1);
  // Moments with (l - centre)/centre instead of l: the terms are of order 1, and the moments up to an order
  // vanish exactly when the moments with l do.
  for (int order = 0; order < length; ++order) {
    long double moment = 0, scale = 0;
    for (int l = 0; l < length; ++l) {
      const long double x = length == 1 ? 0 : (l - centre) / centre;
      const long double term = filter[l] * std::pow(x, order);
      moment += l % 2 == 0 ? term : -term;
      scale += std::abs(term);
    }
    if (std::abs(moment) > 1e-11L * scale) return order;
  }
  return length - 1;
}

}  // namespace wavebalance::wavelets
