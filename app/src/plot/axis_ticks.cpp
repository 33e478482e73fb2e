#include "plot/plot_parts.hpp"

#include <fmt/format.h>

#include <cmath>

namespace wavebalance::app {

std::vector<double> few_ticks(double lower, double upper) {
  const double least = (upper - lower) / 5.0, decade = std::pow(10.0, std::floor(std::log10(least)));
  double step = 10.0 * decade;
  for (const double factor : {5.0, 2.0, 1.0})
    if (factor * decade >= least) step = factor * decade;
  std::vector<double> ticks;
  constexpr double rounding = 1e-9;  // of a step
  for (double i = std::ceil(lower / step - rounding); i <= upper / step + rounding; ++i)
    ticks.push_back(i * step);
  return ticks;
}

std::vector<double> logarithmic_ticks(double lower, double upper) {
  for (const std::vector<double>& digits :
       {std::vector{1.0}, std::vector{1.0, 2.0, 5.0}, std::vector{1.0, 2.0, 3.0, 5.0, 7.0},
        std::vector{1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0}}) {
    std::vector<double> ticks;
    for (double decade = std::pow(10.0, std::floor(std::log10(lower))); decade <= upper; decade *= 10.0)
      for (const double digit : digits)
        if (digit * decade >= lower * (1.0 - 1e-9) && digit * decade <= upper * (1.0 + 1e-9))
          ticks.push_back(digit * decade);
    if (ticks.size() >= 3) return ticks;
  }
  return few_ticks(lower, upper);
}

std::string tick_text(double value) {
  const double exponent = std::floor(std::log10(value) + 1e-9), mantissa = value / std::pow(10.0, exponent);
  if (std::abs(exponent) < 4.0) return fmt::format("{:.6g}", value);
  const std::string power = fmt::format("10^{{{}}}", exponent);
  return std::abs(mantissa - 1.0) < 1e-9 ? power : fmt::format("{:.6g}·{}", mantissa, power);
}

}  // namespace wavebalance::app
