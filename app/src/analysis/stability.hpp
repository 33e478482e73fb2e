#pragma once
#include <string_view>

#include "wavebalance/app/analysis/analysis.hpp"
#include "wavebalance/solvers/balance/condensed_problem.hpp"
#include "wavebalance/solvers/response/periodic_response.hpp"

namespace wavebalance::app {

/// The stability of a converged response of `problem`, the condensation of the model's structure. Where the
/// motion of the structure near it was sought, it is that of this motion, or unknown where there is none.
ResponseStability response_stability(const solvers::CondensedProblem& problem,
                                     const solvers::ContactLaws& laws, const solvers::PeriodicResponse& found,
                                     const StructureModel& model,
                                     const solvers::PhaseMotion* motion = nullptr);

/// A response of a problem of several periods of the load, whose motion has no shorter period if one is
/// found.
solvers::PeriodicResponse several_periods(solvers::CondensedProblem& problem,
                                          const solvers::ContactLaws& laws, const StructureModel& model,
                                          const solvers::ForcedResponseOptions& how,
                                          const Eigen::VectorXd& guess = {});

/// The fields of the stability of a `motion`, and a warning where it is unstable.
void append_stability(Record& record, const ResponseStability& stability,
                      std::string_view motion = "response");

/// The turning points of a sweep, its stability and its special points. Where stability is known the turning
/// points are folds of the motion; those of the samples alone are named apart, with a warning.
void append_stability(Record& record, const Sweep& sweep);

/// The table `branches`, and a warning about each that was not followed to an end.
void append_branches(Record& record, const Sweep& sweep);

}  // namespace wavebalance::app
