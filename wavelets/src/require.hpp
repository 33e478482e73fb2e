#pragma once
#include <stdexcept>
#include <string>

namespace wavebalance::wavelets::detail {

/// Throws std::invalid_argument "<argument> is <found>; it must be <allowed>".
[[noreturn]] inline void reject(const std::string& argument, const std::string& found,
                                const std::string& allowed) {
  throw std::invalid_argument(argument + " is " + found + "; it must be " + allowed);
}

/// Throws std::invalid_argument "<argument> is <value>; it must be in <lowest>..<highest>" unless it is.
inline void require_in_range(const std::string& argument, int value, int lowest, int highest) {
  if (value < lowest || value > highest)
    reject(argument, std::to_string(value), "in " + std::to_string(lowest) + ".." + std::to_string(highest));
}

}  // namespace wavebalance::wavelets::detail
