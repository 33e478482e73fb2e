#pragma once
#include <vector>

#include "wavebalance/app/compare/comparison.hpp"

// What tests of comparisons share.
namespace wavebalance::app {

inline const std::vector<BasisPair> two_pairs{{"fourier", "fourier"}, {"bspline", "bspline"}};

inline ComparisonOptions brief(double budget = 1.0) {
  ComparisonOptions options;
  options.pairs = two_pairs;
  options.budget = budget;
  options.largest_functions = 256;
  return options;
}

}  // namespace wavebalance::app
