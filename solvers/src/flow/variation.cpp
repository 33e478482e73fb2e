#include "flow/variation.hpp"

#include "linalg/dense.hpp"

namespace wavebalance::solvers::detail {
namespace {

using Complex = std::complex<double>;

// Of a row of the structure at point k: the change of its d-th derivative by the states.
Eigen::RowVectorXd by_states(const ContactPoles& poles, const PoleWaves& waves, Index k, int level, Index row,
                             const Eigen::MatrixXcd& changes) {
  const Eigen::RowVectorXcd weights =
      poles.outputs(level).row(row).cwiseProduct(waves.decay.col(k).transpose());
  Eigen::RowVectorXd result = Eigen::RowVectorXd::Zero(changes.cols());
  for (Index j = 0; j < changes.rows(); ++j)
    result += weights[j].real() * changes.row(j).real() - weights[j].imag() * changes.row(j).imag();
  return result;
}

}  // namespace

void Variation::over(const Contacts& contacts, const ContactStates& now, const PanelMotion& motion,
                     const Eigen::MatrixXd& force, const PoleWaves& waves, Index k) {
  const ContactPoles& poles = motion.poles;
  const PanelShape& shape = motion.shape;
  const double holding = poles.holding();
  const Index q = shape.nodes(), rows = poles.rows(), columns = poles_.cols();
  // The forces behind an instant that came later.
  if (!delay_.isZero(0.0)) {
    const Eigen::VectorXd begin = product(force, shape.at_begin());
    poles_ += (poles.inputs() * begin.cast<Complex>()) * delay_.cast<Complex>();
    delay_.setZero();
  }
  const FreeForces free(contacts, now.state, holding > 0.0);
  Eigen::MatrixXd changes = Eigen::MatrixXd::Zero(rows, q * columns);  // of the forces: R x q for each column
  if (!free.rows.empty()) {
    const Signals signals = motion.at(shape.waves(), force);
    const auto equations = law_equations(contacts, now, holding > 0.0, signals, q);
    const Eigen::MatrixXd by_all = equations_by_forces(contacts, free, shape, equations, holding);
    const Index count = Index(free.rows.size());
    Eigen::MatrixXd by_free = Eigen::MatrixXd::Zero(count * q, count * q),
                    by_start = Eigen::MatrixXd::Zero(count * q, columns);
    for (Index f = 0; f < count; ++f)
      for (Index b = 0; b < rows; ++b)
        if (free.combine(b, f) != 0.0)
          by_free.middleCols(f * q, q) += free.combine(b, f) * by_all.middleCols(b * q, q);
    for (Index e = 0; e < count; ++e) {
      const Index c = free.rows[std::size_t(e)].first;
      for (Index n = 0; n < q; ++n) {
        const SlopeOfSignals slope{contacts, c, equations[std::size_t(e)][std::size_t(n)], holding};
        for (Index r = contacts.row(c); r < contacts.row(c) + contacts.law(c).rows(); ++r)
          for (int d = 0; d < 3; ++d)
            if (const double s = slope.by(d, r); s != 0.0)
              by_start.row(e * q + n) += s * by_states(poles, shape.waves(), n, d, r, poles_);
        for (Index m = 0; m < contacts.law(c).memories(); ++m)
          by_start.row(e * q + n) += slope.by_memory(m) * memory_.row(contacts.memory_begin(c) + m);
      }
    }
    const Eigen::MatrixXd solved = solve_for_forces(by_free, by_start);
    for (Index f = 0; f < count; ++f)
      for (Index b = 0; b < rows; ++b)
        if (free.combine(b, f) != 0.0)
          for (Index i = 0; i < columns; ++i)
            changes.row(b).segment(i * q, q) -=
                free.combine(b, f) * solved.col(i).segment(f * q, q).transpose();
  }
  // The signals at the end, then the states there.
  Eigen::MatrixXcd next(poles_.rows(), columns);
  const Eigen::MatrixXcd inputs = poles.inputs() * changes.cast<Complex>();  // P x q K
  for (Index j = 0; j < poles_.rows(); ++j)
    for (Index i = 0; i < columns; ++i)
      next(j, i) =
          waves.decay(j, k) * poles_(j, i) -
          (waves.driven[std::size_t(j)].row(k) * inputs.row(j).segment(i * q, q).transpose()).value();
  poles_ = std::move(next);
  std::array<Eigen::MatrixXd, 3> forces;
  for (int d = 0; d < 3; ++d) {
    const Eigen::VectorXd at = waves.forces[std::size_t(d)].row(k).transpose();
    forces[std::size_t(d)].resize(rows, columns);
    for (Index i = 0; i < columns; ++i)
      forces[std::size_t(d)].col(i) = product(changes.middleCols(i * q, q), at);
  }
  for (int d = 0; d < 3; ++d) {
    ends_[std::size_t(d)] = (poles.outputs(d) * poles_).real();
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
  const Eigen::RowVectorXd delay = -change(contacts, event.contact, event.guard) / rate(event.guard);
  Eigen::VectorXcd after = before, jump = Eigen::VectorXcd::Zero(before.size());
  Eigen::MatrixXcd next = poles_;
  if (event.impulse) {
    const Eigen::VectorXcd input = poles.inputs().col(event.impulse_row);
    after -= input * event.impulse->value;
    next -= input * change(contacts, event.contact, *event.impulse).cast<Complex>();
    jump -= input * rate(*event.impulse);
  }
  const Eigen::VectorXd force = signals[force_kind].col(0) - holding * signals[0].col(0);
  jump += poles.exponents().cwiseProduct(before - after) - poles.inputs() * force.cast<Complex>();
  next += jump * delay.cast<Complex>();
  for (Index m = 0; m < contacts.law(event.contact).memories(); ++m) {
    auto row = memory_.row(contacts.memory_begin(event.contact) + m);
    if (event.memory.empty()) {
      row.setZero();
      continue;
    }
    const Dual& value = event.memory[std::size_t(m)];
    row = (change(contacts, event.contact, value) + rate(value) * delay).eval();
  }
  poles_ = std::move(next);
  delay_ = delay;
}

}  // namespace wavebalance::solvers::detail
