#include "problem/state_box.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "linalg/dense.hpp"
#include "period/modal_flow.hpp"
#include "wavebalance/solvers/response/response_motion.hpp"

namespace wavebalance::solvers::detail {
namespace {

// By what the motion without contact is to be multiplied so that its displacements reach a gap.
double factor_to_gap(const ContactProblem& problem, const Motion& free) {
  const Eigen::VectorXd gaps = problem.laws().gaps(problem.contacts());
  const Eigen::VectorXd largest =
      (problem.structure().contact_directions * free.displacement).cwiseAbs().rowwise().maxCoeff();
  double factor = std::numeric_limits<double>::infinity();
  for (Eigen::Index c = 0; c < gaps.size(); ++c)
    if (gaps[c] > 0.0 && largest[c] > 0.0) factor = std::min(factor, gaps[c] / largest[c]);
  return std::isfinite(factor) ? std::max(1.0, factor) : 1.0;
}

}  // namespace

std::optional<StateBox> StateBox::make(const LinearStructure& structure, double frequency, int max_modes) {
  const auto flow = ModalFlow::make(structure, frequency, 1.0 / frequency, max_modes);
  if (!flow) return std::nullopt;
  StateBox box;
  box.shapes_ = flow->shapes();
  box.projection_ = flow->projection();
  box.displacement_ = box.velocity_ = Eigen::VectorXd::Zero(flow->modes());
  return box;
}

void StateBox::include(const Motion& motion, double factor) {
  const auto largest = [&](const Eigen::MatrixXd& values) -> Eigen::VectorXd {
    return factor * product(projection_, values).cwiseAbs().rowwise().maxCoeff();
  };
  displacement_ = displacement_.cwiseMax(largest(motion.displacement));
  velocity_ = velocity_.cwiseMax(largest(motion.velocity));
}

StructureState StateBox::random(std::mt19937& generator) const {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto within = [&](const Eigen::VectorXd& sides) -> Eigen::VectorXd {
    Eigen::VectorXd modes(sides.size());
    for (Eigen::Index i = 0; i < sides.size(); ++i) modes[i] = sides[i] * uniform(generator);
    return shapes_ * modes;
  };
  StructureState state;
  state.displacement = within(displacement_);
  state.velocity = within(velocity_);
  return state;
}

std::optional<StateBox> box_of_free_motion(ContactProblem& problem, double frequency) {
  constexpr double larger = 2.0;
  constexpr int points_of_period = 256;
  problem.condensed().set_load_frequency(frequency);
  auto box = StateBox::make(problem.structure(), frequency, SettlingOptions{}.max_modes);
  if (!box) return box;
  PeriodicResponse open;
  open.frequency = problem.condensed().frequency();
  open.force_on_held_structure = Eigen::VectorXd::Zero(problem.samples());
  const Motion free = structure_motion(problem.condensed(), open, points_of_period);
  box->include(free, larger * factor_to_gap(problem, free));
  return box;
}

}  // namespace wavebalance::solvers::detail
