#include "period_oracle/shooting_propagator.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

namespace wavebalance::oracle {
namespace {

constexpr int finest_level = 30;
constexpr double two_pi = 2.0 * std::numbers::pi;
using NodeVector = StepTable::NodeVector;
using NodeMatrix = StepTable::NodeMatrix;

}  // namespace

ContactPropagator::ContactPropagator(ModalStructure modes, solvers::AnyContactLaw law, double load_scale,
                                     int base_steps, double tolerance)
    : modes_(std::move(modes)),
      law_(std::move(law)),
      load_scale_(load_scale),
      base_steps_(base_steps),
      tolerance_(tolerance),
      linear_contact_(modes_.linear_response.cols()) {
  for (Eigen::Index m = 0; m < linear_contact_.size(); ++m)
    linear_contact_[m] = (modes_.linear_response.col(m).array() * modes_.contact.array()).sum();
}

const StepTable& ContactPropagator::table(int level) {
  const double period = two_pi / modes_.angular_frequency;
  while (static_cast<int>(tables_.size()) <= level)
    tables_.emplace_back(modes_, period / (std::ldexp(1.0, static_cast<int>(tables_.size())) * base_steps_));
  return tables_[level];
}

double ContactPropagator::linear_contact(double periods) const {
  return solvers::series_value(linear_contact_, periods);
}

/// Newton on u = displacement + node_force f_c(u), from the constant force at the step's start; leaves u in
/// displacement, the force and its slope in the attempt.
bool ContactPropagator::solve_nodes(const StepTable& step, NodeVector& displacement, double begin_force) {
  constexpr int iterations = 15;
  const NodeVector free = displacement;
  displacement += step.node_force.rowwise().sum() * begin_force;
  for (int i = 0; i < iterations; ++i) {
    law_.evaluate({displacement.data(), StepTable::nodes}, {attempt_.force.data(), StepTable::nodes},
                  {attempt_.tangent.data(), StepTable::nodes});
    const NodeVector residual = displacement - free - step.node_force * attempt_.force;
    if (!residual.allFinite()) return false;
    if (residual.cwiseAbs().maxCoeff() <= 1e-15 * displacement.cwiseAbs().maxCoeff()) return true;
    const NodeMatrix jacobian = NodeMatrix::Identity() - step.node_force * attempt_.tangent.asDiagonal();
    displacement -= jacobian.lu().solve(residual);
  }
  return false;
}

void ContactPropagator::attempt_step(const StepTable& step, double begin, double length,
                                     const Eigen::VectorXd& state) {
  const int n = modes_.size();
  attempt_.accepted = false;
  NodeVector displacement = step.node_state * state;
  for (int i = 0; i < StepTable::nodes; ++i)
    displacement[i] += linear_contact(begin + length * StepTable::points()[i]);
  const double begin_force = law_.force(linear_contact(begin) + modes_.contact.dot(state.head(n)));
  if (!solve_nodes(step, displacement, begin_force)) return;
  attempt_.state.noalias() = step.end_force * attempt_.force;
  attempt_.state.head(n) +=
      step.from_q_to_q.cwiseProduct(state.head(n)) + step.from_v_to_q.cwiseProduct(state.tail(n));
  attempt_.state.tail(n) +=
      step.from_q_to_v.cwiseProduct(state.head(n)) + step.from_v_to_v.cwiseProduct(state.tail(n));
  const double end_force =
      law_.force(linear_contact(begin + length) + modes_.contact.dot(attempt_.state.head(n)));
  const double miss = std::max(std::abs(StepTable::at_begin().dot(attempt_.force) - begin_force),
                               std::abs(StepTable::at_end().dot(attempt_.force) - end_force));
  attempt_.accepted = length * miss <= tolerance_ * (load_scale_ + attempt_.force.cwiseAbs().maxCoeff());
}

void ContactPropagator::propagate_sensitivity(const StepTable& step, Eigen::MatrixXd& sensitivity) const {
  const int n = modes_.size();
  const bool contact = (attempt_.tangent.array() != 0.0).any();
  Eigen::MatrixXd force;
  if (contact) {
    const NodeMatrix jacobian = NodeMatrix::Identity() - step.node_force * attempt_.tangent.asDiagonal();
    force = jacobian.lu().solve(step.node_state * sensitivity);
    force.array().colwise() *= Eigen::VectorXd(attempt_.tangent).array();
  }
  const Eigen::MatrixXd q = sensitivity.topRows(n);
  sensitivity.topRows(n) =
      step.from_q_to_q.asDiagonal() * q + step.from_v_to_q.asDiagonal() * sensitivity.bottomRows(n);
  sensitivity.bottomRows(n) =
      (step.from_v_to_v.asDiagonal() * sensitivity.bottomRows(n) + step.from_q_to_v.asDiagonal() * q).eval();
  if (contact) sensitivity += step.end_force * force;
}

bool ContactPropagator::propagate_period(Eigen::VectorXd& state, Eigen::MatrixXd* sensitivity,
                                         int coarsest_level, const Recorder& recorder) {
  const std::int64_t units = std::int64_t{base_steps_} << finest_level;
  const std::int64_t coarsest = std::int64_t{1} << (finest_level - coarsest_level);
  int level = coarsest_level;
  for (std::int64_t position = 0; position < units;) {
    const std::int64_t length = std::int64_t{1} << (finest_level - level);
    const double scale = 1.0 / static_cast<double>(units);
    const StepTable& step = table(level);
    attempt_step(step, static_cast<double>(position) * scale, static_cast<double>(length) * scale, state);
    if (!attempt_.accepted) {
      if (++level > finest_level) return false;
      continue;
    }
    if (recorder && position % coarsest == 0) recorder(static_cast<int>(position / coarsest), state);
    if (sensitivity != nullptr) propagate_sensitivity(step, *sensitivity);
    state.swap(attempt_.state);
    ++steps_;
    position += length;
    if (level > coarsest_level && position % (2 * length) == 0) --level;
  }
  return true;
}

}  // namespace wavebalance::oracle
