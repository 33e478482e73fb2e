#include "wavebalance/solvers/impacts/impact_response.hpp"

#include "impacts/impact_search.hpp"
#include "linalg/option_checks.hpp"

namespace wavebalance::solvers {

void ImpactResponseOptions::validate() const {
  detail::require_at_least("ImpactResponseOptions", "max_periods", max_periods, 1);
  detail::require_at_least("ImpactResponseOptions", "longest", longest, 1);
  detail::require_positive("ImpactResponseOptions", "near", near);
}

ImpactResponse impact_response(const ExactProblem& problem, const ImpactResponseOptions& options) {
  detail::require_impacts(problem);
  options.validate();
  if (options.start.size() != 0 && options.start.size() != Eigen::Index(problem.dynamics.poles().size()))
    detail::reject("ImpactResponseOptions", "the size of start", options.start.size(),
                   "0 or the number of poles");
  return detail::ImpactSearch(problem, options).run();
}

}  // namespace wavebalance::solvers
