#pragma once

#include <algorithm>
#include <random>

#include "wavebalance/solvers/structure/condensation.hpp"

namespace wavebalance::solvers::testing {

// The same structure with its degrees of freedom in another order, which is not tridiagonal any more.
inline LinearStructure shuffled(const LinearStructure& structure, std::mt19937& generator) {
  Eigen::PermutationMatrix<Eigen::Dynamic> order(structure.size());
  order.setIdentity();
  auto& indices = order.indices();
  std::shuffle(indices.data(), indices.data() + indices.size(), generator);
  LinearStructure out = structure;
  out.mass = structure.mass.twistedBy(order);
  out.damping = structure.damping.twistedBy(order);
  out.stiffness = structure.stiffness.twistedBy(order);
  out.load = order * structure.load;
  for (int& dof : out.contact_dofs) dof = indices[dof];
  return out;
}

inline constexpr CondensationMethod all_methods[] = {CondensationMethod::tridiagonal,
                                                     CondensationMethod::modal, CondensationMethod::dense,
                                                     CondensationMethod::sparse};

}  // namespace wavebalance::solvers::testing
