#pragma once
#include <Eigen/Core>
#include <optional>

#include "wavebalance/solvers/balance/condensed_problem.hpp"
#include "wavebalance/solvers/balance/contact_laws.hpp"

namespace wavebalance::solvers::detail {

/// A problem in which contacts that are closed at rest are springs of the structure, with their slopes at
/// rest. Its laws act in addition to these springs; its motions equal the original problem's.
struct SpringsAtRest {
  CondensedProblem problem;
  ContactLaws laws;
};

/// `rest` has the displacement at rest, samples() values, m. Nothing where no contact has a slope there,
/// where laws depend on velocities or their past, or where the structure has no matrices or structural
/// damping. Condenses once.
std::optional<SpringsAtRest> springs_at_rest(const CondensedProblem& problem, const ContactLaws& laws,
                                             const Eigen::VectorXd& rest);

}  // namespace wavebalance::solvers::detail
