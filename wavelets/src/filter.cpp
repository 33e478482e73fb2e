#include "wavebalance/wavelets/filter.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace wavebalance::wavelets {

Eigen::VectorXd bspline_filter(int degree) {
  if (degree < 0 || degree > 19)
    throw std::invalid_argument("bspline_filter: degree = " + std::to_string(degree) + ", allowed: 0..19");
  Eigen::VectorXd filter(degree + 2);
  filter[0] = std::ldexp(1.0, -degree);
  for (int k = 1; k <= degree + 1; ++k) filter[k] = filter[k - 1] * (degree + 2 - k) / k;
  return filter;
}

int zeros_at_pi(const Eigen::VectorXd& filter) {
  if (filter.size() == 0 || !(std::abs(filter.sum() - 2.0) < 1e-8))
    throw std::invalid_argument("zeros_at_pi: filter of length " + std::to_string(filter.size()) +
                                " sums to " + std::to_string(filter.sum()) + ", allowed: a sum of 2");
  const auto length = static_cast<int>(filter.size());
  const long double centre = 0.5L * (length - 1);
  // Powers of (l - centre)/centre instead of l: of order 1, and they vanish together.
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
