#pragma once
#include <vector>

#include "wavebalance/app/compare/comparison.hpp"

// Common parts of tests of comparisons.
namespace wavebalance::app {

inline const std::vector<BasisPair> two_pairs{{"fourier", "fourier"}, {"bspline", "bspline"}};

// Factor by which sanitizers slow solves down: budgets in seconds are as much longer there. clang reports
// them by __has_feature, gcc by a macro.
#ifdef __has_feature
inline constexpr bool sanitized = __has_feature(address_sanitizer);
#elif defined(__SANITIZE_ADDRESS__)
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif
inline constexpr int slowness = sanitized ? 10 : 1;

inline ComparisonOptions brief(double budget = 1.0) {
  ComparisonOptions options;
  options.pairs = two_pairs;
  options.budget = slowness * budget;
  options.largest_functions = 256;
  return options;
}

}  // namespace wavebalance::app
