#pragma once
#include <cstdint>

#include "wavebalance/app/scene/scene.hpp"
#include "wavebalance/solvers/balance/contact_laws.hpp"
#include "wavebalance/solvers/structure/linear_structure.hpp"

namespace wavebalance::extremes {

/// A structure with one to six contacts and stops of 1 to 1e4 times the static stiffness, the frequency of
/// its load, and a pair of bases.
struct RandomStructure {
  solvers::LinearStructure structure;
  solvers::ContactLaws laws;
  double frequency = 0.0;  ///< Hz
  app::Time time;
};

/// Chains, chains with masses over six decades, two equal chains coupled by 1e-3 of a spring, and full
/// matrices with given natural frequencies, of 2 to 20 degrees of freedom. Gaps are -0.3 to 1 times the
/// contact-free amplitude of their contact. The same for one seed on every machine.
RandomStructure random_structure(std::uint64_t seed);

}  // namespace wavebalance::extremes
