#include "wavebalance/app/compose/structure_dynamics.hpp"

#include <stdexcept>

namespace wavebalance::app {

const solvers::ContactDynamics* StructureDynamics::of(const solvers::LinearStructure& structure) {
  std::call_once(once_, [&] {
    try {
      dynamics_.emplace(structure);
    } catch (const std::invalid_argument&) {
      dynamics_.reset();
    }
  });
  return dynamics_ ? &*dynamics_ : nullptr;
}

}  // namespace wavebalance::app
