#include "forced_blade.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "wavebalance/solvers/response/forced_response.hpp"
#include "wavebalance/solvers/time/motion.hpp"

namespace wavebalance::blade {
namespace {

/// From frequency_from to frequency_to, both included, at most largest_step apart; of more than max_points
/// the first ones.
std::vector<double> uniform_frequencies(const app::Analysis& analysis) {
  constexpr double rounding = 1e-9;  // so that rounding does not add a step to an interval of n steps
  const double from = analysis.frequency_from, width = analysis.frequency_to - from;
  const double steps = std::max(1.0, std::ceil(std::abs(width) / analysis.largest_step - rounding));
  const int count = static_cast<int>(std::min(steps + 1.0, static_cast<double>(analysis.max_points)));
  std::vector<double> frequencies;
  for (int i = 0; i < count; ++i) frequencies.push_back(from + width * i / steps);
  return frequencies;
}

}  // namespace

std::vector<BladeResponse> stepped_sweep(const app::Scene& scene, const app::StructureModel& model) {
  solvers::ForcedResponseOptions nearby;
  nearby.fallbacks = false;
  nearby.newton.max_iterations = 12;  // enough on a branch
  solvers::ContactProblem problem = app::compose_problem(scene, model);
  solvers::CondensedProblem& condensed = problem.condensed();
  Eigen::VectorXd guess;
  std::vector<BladeResponse> responses;
  for (const double frequency : uniform_frequencies(scene.analysis)) {
    BladeResponse& response = responses.emplace_back();
    response.frequency = frequency;
    try {
      condensed.set_frequency(frequency);
      auto found = solvers::forced_response(condensed, problem.laws(), nearby, guess);
      if (!found.converged())  // the branch ends here
        found = solvers::forced_response(condensed, problem.laws(), {});
      guess = found.converged() ? found.displacement : Eigen::VectorXd();
      response.converged = found.converged();
      response.displacement = solvers::by_contact(found.displacement, model.contacts());
      response.force = solvers::by_contact(found.contact_force, model.contacts());
    } catch (const solvers::SingularSystem&) {  // the response is missing
    }
  }
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
