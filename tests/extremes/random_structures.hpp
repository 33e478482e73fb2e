#pragma once
#include <cstdint>

#include "wavebalance/solvers/structure/linear_structure.hpp"

namespace wavebalance::extremes {

/// A structure with one to six contacts, and the frequency of its load.
struct RandomStructure {
  solvers::LinearStructure structure;
  double frequency = 0.0;  ///< Hz
};

/// Chains, chains with masses over six decades, two equal chains coupled by 1e-3 of a spring, and full
/// matrices with given natural frequencies, of 2 to 20 degrees of freedom. The same for one seed on every
/// machine.
RandomStructure random_structure(std::uint64_t seed);

}  // namespace wavebalance::extremes
