#pragma once
#include <vector>

#include "wavebalance/app/compare/comparison.hpp"

// What tests of comparisons share.
namespace wavebalance::app {

inline const std::vector<BasisPair> two_pairs{{"fourier", "fourier"}, {"bspline", "bspline"}};

// By how much longer solves take under the sanitizers: budgets in seconds are as much longer there.
#ifdef __SANITIZE_ADDRESS__
inline constexpr int slowness = 10;
#else
inline constexpr int slowness = 1;
#endif

inline ComparisonOptions brief(double budget = 1.0) {
  ComparisonOptions options;
  options.pairs = two_pairs;
  options.budget = slowness * budget;
  options.largest_functions = 256;
  return options;
}

}  // namespace wavebalance::app
