#include "flow/flow_engine.hpp"

namespace wavebalance::solvers {

Eigen::VectorXd ContactFlow::displacements_by_state() const {
  const detail::ContactPoles& poles = engine_->poles_;
  Eigen::VectorXd result = Eigen::VectorXd::Ones(poles.states() + engine_->contacts_.memories());
  result.head(poles.states()) = poles.real_outputs(0).cwiseAbs().colwise().maxCoeff().transpose();
  return result;
}

Eigen::VectorXd ContactFlow::amplitudes_by_state() const {
  const detail::ContactPoles& poles = engine_->poles_;
  const Eigen::VectorXd amplitudes = poles.outputs(0).cwiseAbs().colwise().maxCoeff().transpose();
  Eigen::VectorXd result = Eigen::VectorXd::Ones(poles.states() + engine_->contacts_.memories());
  for (Index j = 0; j < poles.poles(); ++j)
    result.segment(poles.begin(std::size_t(j)), poles.is_pair(std::size_t(j)) ? 2 : 1)
        .setConstant(amplitudes[j]);
  return result;
}

void ContactFlow::perturb(const Eigen::MatrixXd& columns) {
  engine_->variation_ = {};
  if (columns.cols() == 0) return;
  engine_->variation_ = detail::Variation(columns.topRows(engine_->poles_.states()),
                                          columns.bottomRows(engine_->contacts_.memories()));
}

Eigen::MatrixXd ContactFlow::perturbation() const {
  const detail::Variation& variation = engine_->variation_;
  Eigen::MatrixXd result(engine_->poles_.states() + engine_->contacts_.memories(), variation.poles().cols());
  if (!variation.empty()) result << variation.poles(), variation.memory();
  return result;
}

}  // namespace wavebalance::solvers
