#pragma once
#include <memory>
#include <mutex>

#include "wavebalance/solvers/stability/contact_dynamics.hpp"

namespace wavebalance::solvers {

/// The poles of a structure, computed by whichever thread needs them first.
class StructureDynamics {
 public:
  /// The dynamics of `structure`, which must be the same in each call except for the speed of a rotor; null
  /// if it has no modes. O(n^3) the first time, and for a rotor at each other speed.
  std::shared_ptr<const ContactDynamics> of(const LinearStructure& structure);

 private:
  std::mutex mutex_;
  bool known_ = false;
  double speed_ = 0.0;  // of dynamics_
  std::shared_ptr<const ContactDynamics> dynamics_;
};

}  // namespace wavebalance::solvers
