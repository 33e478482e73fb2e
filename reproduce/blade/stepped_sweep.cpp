#include "stepped_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace wavebalance::blade {

std::vector<double> uniform_frequencies(double from, double to, double max_step, int max_count) {
  if (!std::isfinite(from) || !std::isfinite(to) || !(max_step > 0.0) || max_count < 1)
    throw std::invalid_argument("uniform_frequencies: from " + std::to_string(from) + " to " +
                                std::to_string(to) + ", max_step " + std::to_string(max_step) +
                                ", max_count " + std::to_string(max_count) +
                                "; the frequencies must be finite and the others positive");
  constexpr double rounding = 1e-9;  // so that rounding does not add a step to an interval of n steps
  const double steps = std::max(1.0, std::ceil(std::abs(to - from) / max_step - rounding));
  const int count = static_cast<int>(std::min(steps + 1.0, static_cast<double>(max_count)));
  std::vector<double> frequencies;
  for (int i = 0; i < count; ++i) frequencies.push_back(from + (to - from) * i / steps);
  return frequencies;
}

}  // namespace wavebalance::blade
