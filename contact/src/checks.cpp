#include "checks.hpp"

#include <sstream>
#include <stdexcept>

namespace wavebalance::contact::detail {

std::string text(double value) {
  std::ostringstream digits;
  digits.precision(17);
  digits << value;
  return digits.str();
}

void reject(const std::string& where, const std::string& argument, double value, const std::string& allowed) {
  throw std::invalid_argument(where + ": " + argument + " is " + text(value) + "; it must be " + allowed);
}

void require_positive(const char* where, const char* argument, double value) {
  if (!(value > 0.0) || !std::isfinite(value)) reject(where, argument, value, "positive and finite");
}

void require_finite(const char* where, const char* argument, double value) {
  if (!std::isfinite(value)) reject(where, argument, value, "finite");
}

void require_at_least(const char* where, const char* argument, double value, double least, Bound bound) {
  if (std::isfinite(value) && (bound == Bound::open ? value > least : value >= least)) return;
  reject(where, argument, value,
         std::string("finite and ") + (bound == Bound::open ? "above " : "at least ") + text(least));
}

void require_length(const char* where, const char* array, std::size_t length, std::size_t expected) {
  if (length == expected) return;
  throw std::invalid_argument(std::string(where) + ": " + array + " has " + std::to_string(length) +
                              " entries; it must have " + std::to_string(expected));
}

}  // namespace wavebalance::contact::detail
