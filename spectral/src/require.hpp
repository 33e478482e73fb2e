#pragma once
#include <stdexcept>
#include <string>

namespace wavebalance::spectral::detail {

/// Throws std::invalid_argument "<argument> is <value>; it must be at least <least>" if the value is below.
inline void require_at_least(const std::string& argument, long long value, long long least) {
  if (value < least)
    throw std::invalid_argument(argument + " is " + std::to_string(value) + "; it must be at least " +
                                std::to_string(least));
}

/// Throws std::invalid_argument "<array> has <found> entries; it must have <expected>" if the two differ.
inline void require_length(const std::string& array, long long found, long long expected) {
  if (found != expected)
    throw std::invalid_argument(array + " has " + std::to_string(found) + " entries; it must have " +
                                std::to_string(expected));
}

}  // namespace wavebalance::spectral::detail
