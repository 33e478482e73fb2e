#include "structure/modal_flow.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "linalg/dense.hpp"

namespace wavebalance::solvers {
namespace {

Eigen::MatrixXd with_mass_everywhere(Eigen::MatrixXd mass) {
  const double least = 1e-9 * mass.diagonal().mean();
  for (Eigen::Index i = 0; i < mass.rows(); ++i)
    if (mass(i, i) < least) mass(i, i) = least;
  return mass;
}

// First-order form of q'' + damping q' + (diag(stiffness) + skew) q = input f, of y = (sigma q, q').
Eigen::MatrixXd first_order(const Eigen::VectorXd& sigma, const Eigen::VectorXd& stiffness,
                            const std::optional<Eigen::MatrixXd>& skew, const Eigen::MatrixXd& damping) {
  const Eigen::Index m = sigma.size();
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
  const Eigen::Index all = eigen->values.size(), m = std::min<Eigen::Index>(all, max_modes);
  const Eigen::Index contacts = structure.contacts();
  ModalFlow flow;
  flow.shapes_ = eigen->vectors.leftCols(m);
  flow.projection_ = detail::transposed_product(flow.shapes_, mass);
  const Eigen::VectorXd stiffness = eigen->values.head(m);
  flow.sigma_ = stiffness.cwiseMax(0.0).cwiseSqrt().cwiseMax(2.0 * std::numbers::pi * frequency);
  const Eigen::MatrixXd contact = structure.contact_directions * eigen->vectors;
  flow.contact_ = contact.leftCols(m);
  Eigen::MatrixXd damping = detail::transposed_product(flow.shapes_, structure.damping * flow.shapes_);
  if (structure.loss_factor > 0.0)
    damping.diagonal() += structure.loss_factor * stiffness.cwiseMax(0.0).cwiseSqrt();
  std::optional<Eigen::MatrixXd> skew;
  if (circulatory)
    skew = detail::transposed_product(flow.shapes_,
                                      (Eigen::MatrixXd(structure.stiffness) - elastic) * flow.shapes_);
  // Van Loan's block matrix for a force that is linear in time.
  const Eigen::Index states = 2 * m, size = states + 2 * contacts;
  Eigen::MatrixXd block = Eigen::MatrixXd::Zero(size, size);
  block.topLeftCorner(states, states) = step * first_order(flow.sigma_, stiffness, skew, damping);
  block.block(m, states, m, contacts) = -step * flow.contact_.transpose();
  block.block(states, states + contacts, contacts, contacts).setIdentity();
  // In the energy norm of a damped structure the powers do not grow.
  const Eigen::MatrixXd exponential = detail::exponential(block);
  flow.exponential_ = exponential.topLeftCorner(states, states);
  flow.end_ = exponential.block(0, states + contacts, states, contacts);
  flow.begin_ = exponential.block(0, states, states, contacts) - flow.end_;
  flow.step_compliance_.resize(contacts, contacts);
  for (Eigen::Index c = 0; c < contacts; ++c)
    flow.step_compliance_.col(c) = -flow.contact_displacement(flow.end_.col(c));
  flow.step_mobility_ = -flow.contact_ * flow.end_.bottomRows(m);
  const Eigen::MatrixXd omitted = contact.rightCols(all - m);
  const Eigen::VectorXd flexibilities = eigen->values.tail(all - m).cwiseInverse();
  flow.step_compliance_ += detail::product_transposed(omitted * flexibilities.asDiagonal(), omitted);
  return flow;
}

Eigen::VectorXd ModalFlow::advance(const Eigen::VectorXd& state, const Eigen::VectorXd& force) const {
  Eigen::VectorXd next = exponential_ * state;
  if (!force.isZero(0.0)) next.noalias() += begin_ * force;
  return next;
}

void ModalFlow::add_force(Eigen::VectorXd& state, const Eigen::VectorXd& force) const {
  state.noalias() += end_ * force;
}

Eigen::VectorXd ModalFlow::contact_displacement(const Eigen::VectorXd& state) const {
  return contact_ * state.head(modes()).cwiseQuotient(sigma_);
}

Eigen::VectorXd ModalFlow::contact_velocity(const Eigen::VectorXd& state) const {
  return contact_ * state.tail(modes());
}

Eigen::VectorXd ModalFlow::state(const Eigen::VectorXd& displacement, const Eigen::VectorXd& velocity) const {
  Eigen::VectorXd state(states());
  state.head(modes()) = sigma_.cwiseProduct(projection_ * displacement);
  state.tail(modes()) = projection_ * velocity;
  return state;
}

}  // namespace wavebalance::solvers
