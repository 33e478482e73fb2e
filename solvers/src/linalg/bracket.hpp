#pragma once
#include <algorithm>
#include <optional>

namespace wavebalance::solvers::detail {

/// An interval in which a function changes its sign, and its values at the ends.
struct Bracket {
  double low, high;
  double low_value, high_value;

  bool has_sign_change() const { return low_value * high_value <= 0.0; }
};

/// Narrows `bracket` by false position. Every third step halves it, because pure false position is slow at
/// a kink. `function(x)` returns its value as std::optional<double>. The search ends when that is empty,
/// which gives false, when `is_close(bracket, value)`, or after `max_steps` steps.
template <class Function, class IsClose>
bool narrow(Bracket& bracket, int max_steps, Function&& function, IsClose&& is_close) {
  for (int step = 0; step < max_steps; ++step) {
    const double width = bracket.high - bracket.low;
    const double regula = bracket.low + width * bracket.low_value / (bracket.low_value - bracket.high_value);
    const double x = step % 3 == 2 ? 0.5 * (bracket.low + bracket.high)
                                   : std::clamp(regula, std::min(bracket.low, bracket.high),
                                                std::max(bracket.low, bracket.high));
    const std::optional<double> value = function(x);
    if (!value) return false;
    if (*value == 0.0) return true;
    const bool below = bracket.low_value * *value > 0.0;
    (below ? bracket.low : bracket.high) = x;
    (below ? bracket.low_value : bracket.high_value) = *value;
    if (is_close(bracket, *value)) return true;
  }
  return true;
}

}  // namespace wavebalance::solvers::detail
