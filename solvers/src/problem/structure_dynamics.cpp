#include "wavebalance/solvers/problem/structure_dynamics.hpp"

#include <stdexcept>

namespace wavebalance::solvers {

const ContactDynamics* StructureDynamics::of(const LinearStructure& structure) {
  std::call_once(once_, [&] {
    try {
      dynamics_.emplace(structure);
    } catch (const std::invalid_argument&) {
      dynamics_.reset();
    }
  });
  return dynamics_ ? &*dynamics_ : nullptr;
}

}  // namespace wavebalance::solvers
