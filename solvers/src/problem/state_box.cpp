#include "problem/state_box.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "linalg/dense.hpp"
#include "period/modal_flow.hpp"
#include "wavebalance/solvers/response/forced_response.hpp"
#include "wavebalance/solvers/response/response_motion.hpp"

namespace wavebalance::solvers::detail {
namespace {

// The displacements of all degrees of freedom under the static loads alone, with the contacts that they
// close; at rest where that is not found.
Eigen::VectorXd standing(ContactProblem& problem) {
  CondensedProblem& condensed = problem.condensed();
  condensed.set_load_scale(0.0);
  const PeriodicResponse held = forced_response(condensed, problem.laws(), {});
  Eigen::VectorXd displacement = Eigen::VectorXd::Zero(problem.structure().size());
  if (held.converged()) displacement = structure_motion(condensed, held, 1).displacement.col(0);
  condensed.set_load_scale(condensed.full_load());
  return displacement;
}

// The motion about its mean.
Motion vibration_of(Motion motion) {
  motion.displacement.colwise() -= Eigen::VectorXd(motion.displacement.rowwise().mean());
  return motion;
}

// By what a vibration is to be multiplied so that its displacements reach a gap from where the structure
// stands.
double factor_to_gap(const ContactProblem& problem, const Eigen::VectorXd& stands, const Motion& vibration) {
  const Eigen::SparseMatrix<double>& directions = problem.structure().contact_directions;
  const Eigen::VectorXd gaps = problem.laws().gaps(problem.contacts()) - directions * stands;
  const Eigen::VectorXd largest = (directions * vibration.displacement).cwiseAbs().rowwise().maxCoeff();
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
  box.middle_ = box.displacement_ = box.velocity_ = Eigen::VectorXd::Zero(flow->modes());
  return box;
}

void StateBox::set_middle(const Eigen::VectorXd& displacement) { middle_ = projection_ * displacement; }

void StateBox::include(const Motion& motion, double factor) {
  const auto largest = [&](const Eigen::MatrixXd& values, const Eigen::VectorXd& from) -> Eigen::VectorXd {
    return factor * (product(projection_, values).colwise() - from).cwiseAbs().rowwise().maxCoeff();
  };
  displacement_ = displacement_.cwiseMax(largest(motion.displacement, middle_));
  velocity_ = velocity_.cwiseMax(largest(motion.velocity, Eigen::VectorXd::Zero(middle_.size())));
}

StructureState StateBox::random(std::mt19937& generator) const {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto within = [&](Eigen::VectorXd modes, const Eigen::VectorXd& sides) -> Eigen::VectorXd {
    for (Eigen::Index i = 0; i < sides.size(); ++i) modes[i] += sides[i] * uniform(generator);
    return shapes_ * modes;
  };
  StructureState state;
  state.displacement = within(middle_, displacement_);
  state.velocity = within(Eigen::VectorXd::Zero(velocity_.size()), velocity_);
  return state;
}

std::optional<StateBox> box_of_free_motion(ContactProblem& problem, double frequency) {
  constexpr double larger = 2.0;
  constexpr int points_of_period = 256;
  problem.condensed().set_load_frequency(frequency);
  auto box = StateBox::make(problem.structure(), frequency, SettlingOptions{}.max_modes);
  if (!box) return box;
  const Eigen::VectorXd stands = standing(problem);
  PeriodicResponse open;
  open.frequency = problem.condensed().frequency();
  open.force_on_held_structure = Eigen::VectorXd::Zero(problem.samples());
  Motion free = vibration_of(structure_motion(problem.condensed(), open, points_of_period));
  const double factor = larger * factor_to_gap(problem, stands, free);
  box->set_middle(stands);
  free.displacement.colwise() += stands;
  box->include(free, factor);
  return box;
}

}  // namespace wavebalance::solvers::detail
