#include "forced_blade.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "stepped_sweep.hpp"
#include "wavebalance/solvers/response/forced_response.hpp"
#include "wavebalance/solvers/time/motion.hpp"

namespace wavebalance::blade {
std::vector<BladeResponse> stepped_sweep(const app::Scene& scene, const app::StructureModel& model) {
  const auto& analysis = scene.analysis;
  const auto frequencies = uniform_frequencies(analysis.frequency_from, analysis.frequency_to,
                                               analysis.largest_step, analysis.max_points);
  solvers::ForcedResponseOptions nearby;
  nearby.fallbacks = false;
  nearby.newton.max_iterations = 12;  // enough on a branch
  solvers::ContactProblem problem = app::compose_problem(scene, model);
  Eigen::VectorXd guess;
  const auto solve = [&](solvers::CondensedProblem& at) -> BladeResponse {
    auto found = solvers::forced_response(at, problem.laws(), nearby, guess);
    if (!found.converged()) found = solvers::forced_response(at, problem.laws(), {});  // the branch ends here
    guess = found.converged() ? found.displacement : Eigen::VectorXd();
    return {at.frequency(), found.converged(), solvers::by_contact(found.displacement, model.contacts()),
            solvers::by_contact(found.contact_force, model.contacts())};
  };
  std::vector<BladeResponse> responses;
  for (auto& found : steps_over(problem.condensed(), frequencies, solve))
    responses.push_back(found ? std::move(*found)
                              : BladeResponse{frequencies[responses.size()], false, {}, {}});
  return responses;
}

app::Scene reversed(app::Scene scene) {
  std::swap(scene.analysis.frequency_from, scene.analysis.frequency_to);
  return scene;
}

const BladeResponse& at(const std::vector<BladeResponse>& responses, double frequency) {
  const double step = responses.size() > 1 ? std::abs(responses[1].frequency - responses[0].frequency) : 0.0;
  for (const auto& response : responses)
    if (std::abs(response.frequency - frequency) <= 0.5 * step) return response;
  throw std::out_of_range("no response at " + std::to_string(frequency) + " Hz");
}

std::vector<double> largest_displacements(const std::vector<BladeResponse>& responses) {
  std::vector<double> largest;
  for (const auto& response : responses)
    largest.push_back(response.converged ? response.displacement.maxCoeff()
                                         : std::numeric_limits<double>::quiet_NaN());
  return largest;
}

double rms_difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  const Eigen::Index common = std::min(a.cols(), b.cols());
  if (a.rows() != b.rows() || common == 0 || a.cols() % common != 0 || b.cols() % common != 0)
    throw std::invalid_argument(
        fmt::format("rms_difference: {} x {} and {} x {} samples have no common times", a.rows(), a.cols(),
                    b.rows(), b.cols()));
  const auto thinned = [common](const Eigen::MatrixXd& samples) -> Eigen::MatrixXd {
    return samples(Eigen::all, Eigen::seqN(0, common, samples.cols() / common));
  };
  return (thinned(a) - thinned(b)).norm() / thinned(b).norm();
}

}  // namespace wavebalance::blade
