#include "period/modal_flow.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "linalg/dense.hpp"
#include "linalg/index.hpp"

namespace wavebalance::solvers {
namespace {

double least_mass(const Eigen::VectorXd& diagonal) { return 1e-9 * diagonal.mean(); }

// The number of degrees of freedom with less than the least mass.
Index without_mass(const LinearStructure& structure) {
  const Eigen::VectorXd diagonal = structure.mass.diagonal();
  return (diagonal.array() < least_mass(diagonal)).count();
}

Eigen::MatrixXd with_mass_everywhere(Eigen::MatrixXd mass) {
  const double least = least_mass(mass.diagonal());
  for (Index i = 0; i < mass.rows(); ++i)
    if (mass(i, i) < least) mass(i, i) = least;
  return mass;
}

// First-order form of q'' + damping q' + (diag(stiffness) + skew) q = input f, of y = (sigma q, q').
Eigen::MatrixXd first_order(const Eigen::VectorXd& sigma, const Eigen::VectorXd& stiffness,
                            const std::optional<Eigen::MatrixXd>& skew, const Eigen::MatrixXd& damping) {
  const Index m = sigma.size();
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(2 * m, 2 * m);
  matrix.topRightCorner(m, m) = sigma.asDiagonal();
  matrix.bottomLeftCorner(m, m) = (-stiffness.cwiseQuotient(sigma)).asDiagonal();
  if (skew) matrix.bottomLeftCorner(m, m) -= *skew * sigma.cwiseInverse().asDiagonal();
  matrix.bottomRightCorner(m, m) = -damping;
  return matrix;
}

}  // namespace

std::optional<ModalFlow> ModalFlow::make(const LinearStructure& structure, double frequency, double step,
                                         int max_modes) {
  const Eigen::MatrixXd mass = with_mass_everywhere(Eigen::MatrixXd(structure.mass));
  const bool circulatory = !is_symmetric(structure.stiffness);
  Eigen::MatrixXd elastic(structure.stiffness);
  if (circulatory) elastic = (0.5 * (elastic + elastic.transpose())).eval();
  const auto eigen = detail::symmetric_eigen(elastic, mass);
  if (!eigen) return std::nullopt;
  const Index all = eigen->values.size(), m = std::min<Index>(all - without_mass(structure), max_modes);
  if (m < 1) return std::nullopt;
  ModalFlow flow;
  flow.shapes_ = eigen->vectors.leftCols(m);
  flow.projection_ = detail::transposed_product(flow.shapes_, mass);
  const Eigen::VectorXd stiffness = eigen->values.head(m);
  flow.sigma_ = stiffness.cwiseMax(0.0).cwiseSqrt().cwiseMax(2.0 * std::numbers::pi * frequency);
  const Eigen::MatrixXd contact = structure.contact_directions * eigen->vectors;
  flow.contact_ = contact.leftCols(m);
  flow.to_contact_ = flow.contact_ * flow.sigma_.cwiseInverse().asDiagonal();
  Eigen::MatrixXd damping = detail::transposed_product(flow.shapes_, structure.damping * flow.shapes_);
  if (structure.loss_factor > 0.0)
    damping.diagonal() += structure.loss_factor * stiffness.cwiseMax(0.0).cwiseSqrt();
  std::optional<Eigen::MatrixXd> skew;
  if (circulatory)
    skew = detail::transposed_product(flow.shapes_,
                                      (Eigen::MatrixXd(structure.stiffness) - elastic) * flow.shapes_);
  flow.rates_ = first_order(flow.sigma_, stiffness, skew, damping);
  const Eigen::MatrixXd omitted = contact.rightCols(all - m);
  const Eigen::VectorXd flexibilities = eigen->values.tail(all - m).cwiseInverse();
  flow.static_compliance_ = detail::product_transposed(omitted * flexibilities.asDiagonal(), omitted);
  flow.set_step(step);
  return flow;
}

ModalFlow ModalFlow::over(double step) const {
  ModalFlow other = *this;
  other.set_step(step);
  return other;
}

void ModalFlow::set_constant_load(const Eigen::VectorXd& load) {
  constant_ = shapes_.transpose() * load;
  set_step(step_);
}

// Van Loan's block matrix for a force that is linear in time.
void ModalFlow::set_step(double step) {
  step_ = step;
  const Index m = modes(), states = 2 * m, contacts = contact_.rows(), size = states + 2 * contacts;
  Eigen::MatrixXd block = Eigen::MatrixXd::Zero(size, size);
  block.topLeftCorner(states, states) = step * rates_;
  block.block(m, states, m, contacts) = -step * contact_.transpose();
  block.block(states, states + contacts, contacts, contacts).setIdentity();
  // In the energy norm of a damped structure the powers do not grow.
  const Eigen::MatrixXd exponential = detail::exponential(block);
  exponential_ = exponential.topLeftCorner(states, states);
  end_ = exponential.block(0, states + contacts, states, contacts);
  begin_ = exponential.block(0, states, states, contacts) - end_;
  contact_exponential_ = to_contact_ * exponential_.topRows(m);
  step_compliance_ = static_compliance_;
  for (Index c = 0; c < contacts; ++c) step_compliance_.col(c) -= contact_displacement(end_.col(c));
  step_mobility_ = -contact_ * end_.bottomRows(m);
  drift_.setZero(states);
  contact_drift_.setZero(contacts);
  if (constant_.isZero(0.0)) return;
  Eigen::MatrixXd driven = Eigen::MatrixXd::Zero(states + 1, states + 1);
  driven.topLeftCorner(states, states) = step * rates_;
  driven.col(states).segment(m, m) = step * constant_;
  drift_ = detail::exponential(driven).col(states).head(states);
  contact_drift_ = contact_displacement(drift_);
}

Eigen::VectorXd ModalFlow::advance(const Eigen::VectorXd& state, const Eigen::VectorXd& force) const {
  Eigen::VectorXd next = exponential_ * state + drift_;
  if (!force.isZero(0.0)) next.noalias() += begin_ * force;
  return next;
}

void ModalFlow::add_force(Eigen::VectorXd& state, const Eigen::VectorXd& force) const {
  state.noalias() += end_ * force;
}

Eigen::VectorXd ModalFlow::contact_displacement(const Eigen::VectorXd& state) const {
  return to_contact_ * state.head(modes());
}

void ModalFlow::add_contact_displacement(const Eigen::VectorXd& state, Eigen::VectorXd& to) const {
  to.noalias() += to_contact_ * state.head(modes());
}

void ModalFlow::add_contact_displacement_after(const Eigen::VectorXd& state, Eigen::VectorXd& to) const {
  to += contact_drift_;
  to.noalias() += contact_exponential_ * state;
}

void ModalFlow::add_contact_velocity(const Eigen::VectorXd& state, Eigen::VectorXd& to) const {
  to.noalias() += contact_ * state.tail(modes());
}

Eigen::VectorXd ModalFlow::state(const Eigen::VectorXd& displacement, const Eigen::VectorXd& velocity) const {
  Eigen::VectorXd state(states());
  state.head(modes()) = sigma_.cwiseProduct(projection_ * displacement);
  state.tail(modes()) = projection_ * velocity;
  return state;
}

}  // namespace wavebalance::solvers
