#include "checks.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

namespace wavebalance::contact {
namespace {

[[noreturn]] void reject(const char* law, const char* argument, double value, const char* allowed) {
  std::ostringstream message;
  message.precision(17);
  message << law << ": " << argument << " is " << value << "; it must be " << allowed;
  throw std::invalid_argument(message.str());
}

}  // namespace

void require_positive(const char* law, const char* argument, double value) {
  if (!(value > 0.0) || !std::isfinite(value)) reject(law, argument, value, "positive and finite");
}

void require_finite(const char* law, const char* argument, double value) {
  if (!std::isfinite(value)) reject(law, argument, value, "finite");
}

void require_at_least(const char* law, const char* argument, double value, double least, Bound bound) {
  if (std::isfinite(value) && (bound == Bound::open ? value > least : value >= least)) return;
  std::ostringstream allowed;
  allowed << "finite and " << (bound == Bound::open ? "above " : "at least ") << least;
  reject(law, argument, value, allowed.str().c_str());
}

void require_equal_lengths(const char* law, std::size_t displacement, std::size_t force,
                           std::size_t tangent) {
  if (force == displacement && tangent == displacement) return;
  throw std::invalid_argument(std::string(law) + "::evaluate: displacement, force and tangent have " +
                              std::to_string(displacement) + ", " + std::to_string(force) + " and " +
                              std::to_string(tangent) + " entries; they must have the same number");
}

void require_length(const char* function, const char* array, std::size_t length, std::size_t expected) {
  if (length == expected) return;
  throw std::invalid_argument(std::string(function) + ": " + array + " has " + std::to_string(length) +
                              " entries; it must have " + std::to_string(expected));
}

}  // namespace wavebalance::contact
