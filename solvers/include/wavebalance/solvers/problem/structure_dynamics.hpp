#pragma once
#include <mutex>
#include <optional>

#include "wavebalance/solvers/stability/contact_dynamics.hpp"

namespace wavebalance::solvers {

/// The poles of a structure, computed by whichever thread needs them first.
class StructureDynamics {
 public:
  /// Those of `structure`, which must be the same in each call; null where it has no modes to compute. O(n^3)
  /// the first time.
  const ContactDynamics* of(const LinearStructure& structure);

 private:
  std::once_flag once_;
  std::optional<ContactDynamics> dynamics_;
};

}  // namespace wavebalance::solvers
