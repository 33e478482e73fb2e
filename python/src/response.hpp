#pragma once

#include "problem.hpp"
#include "wavebalance/solvers/balance/contact_laws.hpp"
#include "wavebalance/solvers/response/forced_response.hpp"

namespace wavebalance::python {

/// A periodic response with what it belongs to.
struct Response {
  std::shared_ptr<Problem> problem;
  solvers::ContactLaws laws;
  solvers::PeriodicResponse found;
  double wall_seconds = 0.0;  ///< of the condensation and the solution
};

/// A solution at a frequency (Hz) near the guess (contacts x points, m), the response before it, or the
/// motion without contact.
Response solve(const std::shared_ptr<Problem>& problem, solvers::ContactLaws laws, double frequency,
               const solvers::ForcedResponseOptions& options, const Eigen::VectorXd& guess,
               const Eigen::VectorXd& guess_force);

}  // namespace wavebalance::python
