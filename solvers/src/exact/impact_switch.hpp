#pragma once
#include <memory>
#include <optional>

#include "exact/impact_path.hpp"

namespace wavebalance::solvers::detail {

/// How a curve goes on with other impacts: the path, and the place with its tangent where it begins.
struct ImpactSwitch {
  std::unique_ptr<ImpactPath> path;
  ImpactPlace place;
  bool grazing = true;  ///< the impacts are others; false: they are the same in another order
};

/// A step along a path, from a place with a tangent to one that is no motion of the structure.
struct ImpactStep {
  const ProblemFamily& family;
  const ImpactPathScales& scales;
  ImpactPath& path;
  const ImpactPlace &last, &next;
};

/// The switch between both: where the first impulse vanishes that is negative at the end; where a contact
/// touches its obstacle that has passed it at the end; or in the new order of impacts that have passed each
/// other. Its motion has converged. Nothing where there is no such place within about the step.
std::optional<ImpactSwitch> impact_switch(const ImpactStep& step);

/// The unknowns without impact i.
Eigen::VectorXd without_impact(const Eigen::VectorXd& unknowns, Eigen::Index i);
/// The unknowns with an impact before impact i that has an instant and no impulse.
Eigen::VectorXd with_impact(const Eigen::VectorXd& unknowns, Eigen::Index i, double time);

}  // namespace wavebalance::solvers::detail
