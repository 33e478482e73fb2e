#include "wavebalance/solvers/problem/structure_dynamics.hpp"

#include <stdexcept>

namespace wavebalance::solvers {

std::shared_ptr<const ContactDynamics> StructureDynamics::of(const LinearStructure& structure) {
  const std::lock_guard lock(mutex_);
  const double speed = structure.turns() ? structure.turning.speed : 0.0;
  if (known_ && speed == speed_) return dynamics_;
  known_ = true;
  speed_ = speed;
  try {
    dynamics_ = std::make_shared<const ContactDynamics>(structure);
  } catch (const std::invalid_argument&) {
    dynamics_.reset();
  }
  return dynamics_;
}

}  // namespace wavebalance::solvers
