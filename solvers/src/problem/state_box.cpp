#include "problem/state_box.hpp"

#include "linalg/dense.hpp"
#include "period/modal_flow.hpp"

namespace wavebalance::solvers::detail {

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

}  // namespace wavebalance::solvers::detail
