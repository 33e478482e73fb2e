#include "flow/variation.hpp"

#include <algorithm>

#include "linalg/dense.hpp"

namespace wavebalance::solvers::detail {
namespace {

// For a row of the structure at point k: the change of its d-th derivative by the states.
Eigen::RowVectorXd by_states(const ContactPoles& poles, const PoleWaves& waves, Index k, int level,
                             Index row) {
  return poles.row_of(poles.outputs(level).row(row).cwiseProduct(waves.decay.col(k).transpose()));
}

// Effect of free forces at q nodes on the states up to point k, states x free q.
Eigen::MatrixXd states_by_forces(const ContactPoles& poles, const FreeForces& free, const PoleWaves& waves,
                                 Index k, Index q) {
  const Eigen::MatrixXcd inputs = poles.inputs() * free.combine.cast<std::complex<double>>();
  Eigen::MatrixXd result(poles.states(), inputs.cols() * q);
  Eigen::VectorXcd at_node(poles.poles());
  for (Index f = 0; f < inputs.cols(); ++f)
    for (Index m = 0; m < q; ++m) {
      for (Index j = 0; j < at_node.size(); ++j)
        at_node[j] = -inputs(j, f) * waves.driven[std::size_t(j)](k, m);
      result.col(f * q + m) = poles.real_of(at_node).col(0);
    }
  return result;
}

}  // namespace

Eigen::MatrixXd Variation::of_unknowns(const Contacts& contacts, const ContactStates& now,
                                       const FreeForces& free, const PanelMotion& motion,
                                       const NodeValues& values) const {
  const PanelShape& shape = motion.shape;
  const double holding = motion.poles.holding();
  const Index q = shape.nodes(), count = free.count();
  if (count == 0) return Eigen::MatrixXd::Zero(0, poles_.cols());
  const Signals signals = motion.at(shape.waves(), values);
  const auto equations = law_equations(contacts, now, free, holding > 0.0, signals, q);
  Eigen::MatrixXd by_start = Eigen::MatrixXd::Zero(count * q, poles_.rows()),
                  by_memory = Eigen::MatrixXd::Zero(count * q, memory_.rows());
  for (Index e = 0; e < count; ++e) {
    const Index c = free.contact(std::size_t(e));
    for (Index n = 0; n < q; ++n) {
      const SlopeOfSignals slope{contacts, c, equations[std::size_t(e)][std::size_t(n)], holding};
      for (Index r = contacts.row(c); r < contacts.row(c) + contacts.law(c).rows(); ++r)
        for (int d = 0; d < 3; ++d)
          if (const double s = slope.by(d, r); s != 0.0)
            by_start.row(e * q + n) += s * by_states(motion.poles, shape.waves(), n, d, r);
      for (Index m = 0; m < contacts.law(c).memories(); ++m)
        by_memory(e * q + n, contacts.memory_begin(c) + m) = slope.by_memory(m);
    }
  }
  return -motion.factor.solve(equations_by_unknowns(contacts, free, shape, equations, holding),
                              product(by_start, poles_) + product(by_memory, memory_));
}

void Variation::pass_delay(const PanelMotion& motion, const NodeValues& values) {
  if (delay_.isZero(0.0)) return;
  const Eigen::VectorXd begin = product(values.force, motion.shape.at_begin());
  const Eigen::MatrixXcd input = motion.poles.inputs() * begin.cast<std::complex<double>>();
  poles_ += motion.poles.real_of(input) * delay_;
  memory_ -= product(values.memory_rate, motion.shape.at_begin()) * delay_;
  delay_.setZero();
}

double Variation::unresolved(const Contacts& contacts, const ContactStates& now, const PanelMotion& motion,
                             const NodeValues& values) const {
  Variation behind = *this;
  behind.pass_delay(motion, values);
  const FreeForces free(contacts, now.state, motion.poles.holding() > 0.0);
  const Eigen::MatrixXd changes = behind.of_unknowns(contacts, now, free, motion, values);
  const Index q = motion.shape.nodes(), forces = Index(free.rows.size());
  const double size = std::max(force_size_, largest(changes.topRows(forces * q)));
  double result = 0.0;
  for (Index f = 0; f < forces; ++f)
    result = std::max(result, motion.shape.unresolved(changes.middleRows(f * q, q).transpose(), size));
  return result;
}

void Variation::over(const Contacts& contacts, const ContactStates& now, const PanelMotion& motion,
                     const NodeValues& values, const PoleWaves& waves, Index k) {
  const ContactPoles& poles = motion.poles;
  const Index q = motion.shape.nodes();
  pass_delay(motion, values);
  const FreeForces free(contacts, now.state, poles.holding() > 0.0);
  const Eigen::MatrixXd changes = of_unknowns(contacts, now, free, motion, values);
  const Index of_forces = Index(free.rows.size()) * q;
  poles.multiply(waves.decay.col(k), poles_);
  if (of_forces > 0) force_size_ = std::max(force_size_, changes.topRows(of_forces).cwiseAbs().maxCoeff());
  if (!free.rows.empty())
    poles_ += product(states_by_forces(poles, free, waves, k, q), changes.topRows(of_forces));
  if (!free.moving.empty()) {
    const Eigen::RowVectorXd integral = motion.shape.integrals(waves.points.segment(k, 1));
    for (std::size_t m = 0; m < free.moving.size(); ++m)
      memory_.row(free.moving[m].second) +=
          product(integral, changes.middleRows(of_forces + Index(m) * q, q));
  }
  std::array<Eigen::MatrixXd, 3> forces;
  for (std::size_t d = 0; d < 3; ++d) {
    Eigen::MatrixXd at_end(Index(free.rows.size()), poles_.cols());
    for (Index f = 0; f < at_end.rows(); ++f)
      at_end.row(f) = product(waves.forces[d].row(k), changes.middleRows(f * q, q));
    forces[d] = product(free.combine, at_end);
  }
  for (int d = 0; d < 3; ++d) {
    ends_[std::size_t(d)] = product(poles.real_outputs(d), poles_);
    for (int m = 0; m <= d; ++m) ends_[std::size_t(d)] -= product(poles.feed(d, m), forces[std::size_t(m)]);
  }
  ends_[3] = forces[0];
}

Eigen::RowVectorXd Variation::change(const Contacts& contacts, Index c, const Dual& value) const {
  Eigen::RowVectorXd result = Eigen::RowVectorXd::Zero(poles_.cols());
  const int rows = contacts.law(c).rows();
  for (int kind = 0; kind < 4; ++kind)
    for (int i = 0; i < rows; ++i)
      result += value.slope[std::size_t(kind * rows + i)] * ends_[std::size_t(kind)].row(contacts.row(c) + i);
  for (Index m = 0; m < contacts.law(c).memories(); ++m)
    result += value.slope[std::size_t(4 * rows + m)] * memory_.row(contacts.memory_begin(c) + m);
  return result;
}

void Variation::through(const Contacts& contacts, const ContactPoles& poles, const Event& event,
                        const Signals& signals, const Eigen::VectorXcd& before) {
  const double holding = poles.holding();
  ends_[3] += holding * ends_[0];
  const auto rate = [&](const Dual& value) {
    return SlopeOfSignals{contacts, event.contact, value, 0.0}.rate(signals, 0);
  };
  if (!event.forced) last_delay_ = -change(contacts, event.contact, event.guard) / rate(event.guard);
  Eigen::VectorXcd after = before, jump = Eigen::VectorXcd::Zero(before.size());
  Eigen::MatrixXd next = poles_;
  if (event.impulse) {
    const Eigen::VectorXcd input = poles.inputs().col(event.impulse_row);
    after -= input * event.impulse->value;
    next -= poles.real_of(input) * change(contacts, event.contact, *event.impulse);
    jump -= input * rate(*event.impulse);
  }
  const Eigen::VectorXd force = signals[force_kind].col(0) - holding * signals[0].col(0);
  jump +=
      poles.exponents().cwiseProduct(before - after) - poles.inputs() * force.cast<std::complex<double>>();
  next += poles.real_of(jump) * last_delay_;
  Eigen::MatrixXd moved = memory_ + signals.memory_rate * last_delay_;
  for (Index m = 0; m < contacts.law(event.contact).memories(); ++m) {
    auto row = moved.row(contacts.memory_begin(event.contact) + m);
    if (event.memory.empty()) {
      row.setZero();
      continue;
    }
    const Dual& value = event.memory[std::size_t(m)];
    row = change(contacts, event.contact, value) + rate(value) * last_delay_;
  }
  poles_ = std::move(next);
  memory_ = std::move(moved);
  delay_ = last_delay_;
}

}  // namespace wavebalance::solvers::detail
