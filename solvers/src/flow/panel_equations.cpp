#include "flow/panel_equations.hpp"

#include <algorithm>
#include <cmath>

#include "linalg/dense.hpp"

namespace wavebalance::solvers::detail {
namespace {

// Kinds that a law reads, in the order of its gradient: u, v, a, f.
constexpr std::array<int, 4> read_kinds{0, 1, 2, force_kind};

}  // namespace

Contacts::Contacts(std::vector<ContactMachine> machines) : machines_(std::move(machines)), memory_begins_{0} {
  for (const ContactMachine& one : machines_)
    memory_begins_.push_back(memory_begins_.back() + one.law->memories());
}

LocalValues::LocalValues(const Contacts& contacts, Index c, const Signals& signals, Index point)
    : rows_(std::size_t(contacts.law(c).rows())),
      memories_(std::size_t(contacts.law(c).memories())),
      row_(contacts.row(c)),
      memory_begin_(contacts.memory_begin(c)) {
  int number = 0;
  for (std::size_t k = 0; k < read_kinds.size(); ++k)
    for (std::size_t i = 0; i < rows_; ++i) values_[k][i] = Dual::signal(0.0, number++);
  for (std::size_t j = 0; j < memories_; ++j) memory_[j] = Dual::signal(0.0, number++);
  move_to(signals, point);
}

void LocalValues::move_to(const Signals& signals, Index point) {
  for (std::size_t k = 0; k < read_kinds.size(); ++k)
    for (std::size_t i = 0; i < rows_; ++i)
      values_[k][i].value = signals[std::size_t(read_kinds[k])](row_ + Index(i), point);
  for (std::size_t j = 0; j < memories_; ++j)
    memory_[j].value = signals.memory(memory_begin_ + Index(j), point);
}

LocalSignals LocalValues::signals() const {
  const auto of = [&](std::size_t k) { return std::span<const Dual>(values_[k].data(), rows_); };
  return {of(0), of(1), of(2), of(3), std::span<const Dual>(memory_.data(), memories_)};
}

// Springs that hold the structure act on open contacts, too, so that all forces are then unknown.
FreeForces::FreeForces(const Contacts& contacts, const std::vector<int>& states, bool all) {
  Index total = 0;
  for (Index c = 0; c < contacts.count(); ++c) total += contacts.law(c).rows();
  constant.setZero(total);
  for (Index c = 0; c < contacts.count(); ++c) {
    const auto forces = contacts.law(c).forces(states[std::size_t(c)]);
    for (std::size_t i = 0; i < forces.size(); ++i)
      if (all || forces[i].free) rows.emplace_back(c, contacts.row(c) + Index(i));
    if (contacts.law(c).moves(states[std::size_t(c)]))
      for (Index m = 0; m < contacts.law(c).memories(); ++m)
        moving.emplace_back(c, contacts.memory_begin(c) + m);
    if (all) continue;
    for (std::size_t i = 0; i < forces.size(); ++i)
      if (!forces[i].free) constant[contacts.row(c) + Index(i)] = forces[i].constant;
  }
  combine.setZero(total, Index(rows.size()));
  for (std::size_t k = 0; k < rows.size(); ++k) combine(rows[k].second, Index(k)) = 1.0;
  if (all || rows.empty()) return;
  for (Index c = 0; c < contacts.count(); ++c) {
    const auto forces = contacts.law(c).forces(states[std::size_t(c)]);
    for (std::size_t i = 0; i < forces.size(); ++i)
      for (std::size_t k = 0; k < forces.size() && !forces[i].free; ++k)
        combine.row(contacts.row(c) + Index(i)) +=
            forces[i].of_rows[k] * combine.row(contacts.row(c) + Index(k));
  }
}

namespace {

// Residual of moving memories: rates less the rates of the law.
void add_rates(const Contacts& contacts, const ContactStates& now, const FreeForces& free,
               const Signals& signals, Index nodes, std::vector<std::vector<Dual>>& equations) {
  for (std::size_t k = 0; k < free.moving.size();) {
    const Index c = free.moving[k].first;
    const auto count = std::size_t(contacts.law(c).memories());
    const std::size_t first = equations.size();
    equations.resize(first + count, std::vector<Dual>(std::size_t(nodes)));
    for (Index n = 0; n < nodes; ++n) {
      const LocalValues local(contacts, c, signals, n);
      std::array<Dual, 2> rates;
      contacts.law(c).rates(now.state[std::size_t(c)], local.signals(), {rates.data(), count});
      for (std::size_t m = 0; m < count; ++m)
        equations[first + m][std::size_t(n)] =
            Dual(signals.memory_rate(free.moving[k + m].second, n)) - rates[m];
    }
    k += count;
  }
}

}  // namespace

std::vector<std::vector<Dual>> law_equations(const Contacts& contacts, const ContactStates& now,
                                             const FreeForces& free, bool all_free, const Signals& signals,
                                             Index nodes) {
  std::vector<std::vector<Dual>> equations;
  for (Index c = 0; c < contacts.count(); ++c) {
    const int state = now.state[std::size_t(c)];
    const auto forces = contacts.law(c).forces(state);
    const auto own = std::size_t(std::count_if(forces.begin(), forces.end(), [](auto& f) { return f.free; }));
    const std::size_t count = all_free ? forces.size() : own, first = equations.size();
    if (count == 0) continue;
    equations.resize(first + count, std::vector<Dual>(std::size_t(nodes)));
    std::array<Dual, 3> values;
    LocalValues local(contacts, c, signals, 0);
    for (Index n = 0; n < nodes; ++n) {
      local.move_to(signals, n);
      values.fill(Dual());
      if (own > 0) contacts.law(c).equations(state, local.signals(), {values.data(), own});
      std::size_t next = 0;
      for (std::size_t i = 0, e = 0; i < forces.size(); ++i) {
        if (!forces[i].free && !all_free) continue;
        Dual& out = equations[first + e++][std::size_t(n)];
        if (forces[i].free) {
          out = values[next++];
          continue;
        }
        out = local.signals().force[i] - forces[i].constant;
        for (std::size_t k = 0; k < forces.size(); ++k)
          out.add(local.signals().force[k], -forces[i].of_rows[k]);
      }
    }
  }
  add_rates(contacts, now, free, signals, nodes, equations);
  return equations;
}

double SlopeOfSignals::by(int kind, Index row) const {
  const int rows = contacts.law(contact).rows();
  const Index i = row - contacts.row(contact);
  if (i < 0 || i >= rows) return 0.0;
  const auto slope = [&](int k) { return value.slope[std::size_t(k * rows + int(i))]; };
  const double own = slope(std::min(kind, 3));
  return kind == 0 ? own + holding * slope(3) : own;
}

double SlopeOfSignals::by_memory(Index j) const {
  return value.slope[std::size_t(4 * contacts.law(contact).rows() + int(j))];
}

double SlopeOfSignals::rate(const Signals& signals, Index point) const {
  double sum = 0.0;
  const int rows = contacts.law(contact).rows();
  for (std::size_t k = 0; k < read_kinds.size(); ++k)
    for (int i = 0; i < rows; ++i)
      sum += value.slope[k * std::size_t(rows) + std::size_t(i)] *
             signals[std::size_t(read_kinds[k] + 1)](contacts.row(contact) + i, point);
  for (Index m = 0; m < contacts.law(contact).memories(); ++m)
    sum += by_memory(m) * signals.memory_rate(contacts.memory_begin(contact) + m, point);
  return sum;
}

namespace {

// (count q) x (R q): by all node forces.
Eigen::MatrixXd equations_by_forces(const Contacts& contacts, const FreeForces& free, const PanelShape& shape,
                                    const std::vector<std::vector<Dual>>& equations, double holding) {
  const Index q = shape.nodes(), rows = free.constant.size();
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(Index(equations.size()) * q, rows * q);
  for (std::size_t e = 0; e < equations.size(); ++e) {
    const Index c = free.contact(e);
    for (Index n = 0; n < q; ++n) {
      const SlopeOfSignals slope{contacts, c, equations[e][std::size_t(n)], holding};
      auto target = result.row(Index(e) * q + n);
      for (Index r = contacts.row(c); r < contacts.row(c) + contacts.law(c).rows(); ++r) {
        for (int d = 0; d < 3; ++d)
          if (const double s = slope.by(d, r); s != 0.0) target += s * shape.influence(d).row(r * q + n);
        target[r * q + n] += slope.by(force_kind, r);
      }
    }
  }
  return result;
}

// Columns of all forces at q nodes combined to columns of free forces.
Eigen::MatrixXd by_free_forces(const Eigen::MatrixXd& by_all, const FreeForces& free, Index q) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(by_all.rows(), free.combine.cols() * q);
  for (Index k = 0; k < free.combine.cols(); ++k)
    for (Index b = 0; b < free.combine.rows(); ++b)
      if (const double s = free.combine(b, k); s != 0.0)
        result.middleCols(k * q, q) += s * by_all.middleCols(b * q, q);
  return result;
}

}  // namespace

Eigen::MatrixXd equations_by_unknowns(const Contacts& contacts, const FreeForces& free,
                                      const PanelShape& shape,
                                      const std::vector<std::vector<Dual>>& equations, double holding) {
  const Index q = shape.nodes(), forces = Index(free.rows.size()) * q, rates = Index(free.moving.size()) * q;
  Eigen::MatrixXd result =
      by_free_forces(equations_by_forces(contacts, free, shape, equations, holding), free, q);
  if (rates == 0) return result;
  result.conservativeResize(Eigen::NoChange, forces + rates);
  result.rightCols(rates).setZero();
  result.bottomRightCorner(rates, rates).setIdentity();
  const Eigen::MatrixXd integrals = shape.integrals(shape.waves().points.head(q));
  for (std::size_t e = 0; e < equations.size(); ++e)
    for (std::size_t k = 0; k < free.moving.size(); ++k) {
      const auto [c, m] = free.moving[k];
      if (c != free.contact(e)) continue;
      for (Index n = 0; n < q; ++n) {
        const SlopeOfSignals slope{contacts, c, equations[e][std::size_t(n)], holding};
        result.row(Index(e) * q + n).segment(forces + Index(k) * q, q) +=
            slope.by_memory(m - contacts.memory_begin(c)) * integrals.row(n);
      }
    }
  return result;
}

Eigen::MatrixXd KeptFactor::solve(Eigen::MatrixXd matrix, const Eigen::MatrixXd& right) {
  constexpr double singular = 1e-12;
  if (matrix_.rows() != matrix.rows() || matrix_ != matrix) {
    matrix_ = std::move(matrix);
    factor_.compute(matrix_);
  }
  if (!factor_.is_singular(singular)) return factor_.solve(right);
  Eigen::MatrixXd result(right.rows(), right.cols());
  for (Index k = 0; k < right.cols(); ++k) result.col(k) = least_squares(matrix_, right.col(k));
  return result;
}

namespace {

// By the contact's own mass and the stiffness and damping of its law.
void add_slopes(const Contacts& contacts, const FreeForces& free,
                const std::vector<std::vector<Dual>>& equations, const PanelMotion& motion,
                SolvedPanel& result) {
  constexpr double eps = 2.2e-16, units = 4.0;
  // A displacement that a stiff law holds is a small sum of these.
  const double summands = motion.poles.displacement_scale() +
                          (motion.poles.outputs(0).cwiseAbs() * motion.state.cwiseAbs()).maxCoeff();
  for (std::size_t e = free.rows.size(); e < equations.size(); ++e)
    for (const Dual& value : equations[e]) {
      const SlopeOfSignals slope{contacts, free.contact(e), value, 0.0};
      for (Index m = 0; m < contacts.law(free.contact(e)).memories(); ++m)
        result.rate = std::max(result.rate, std::abs(slope.by_memory(m)));
    }
  for (std::size_t e = 0; e < free.rows.size(); ++e)
    for (std::size_t n = 0; n < equations[e].size(); ++n) {
      const auto [c, row] = free.rows[e];
      const SlopeOfSignals slope{contacts, c, equations[e][n], motion.poles.holding()};
      const double force = slope.by(force_kind, row);
      if (force == 0.0) continue;
      const double stiffness = std::abs(slope.by(0, row) / force),
                   damping = std::abs(slope.by(1, row) / force),
                   mobility = std::max(motion.poles.inverse_mass()(row, row), 0.0);
      result.rate = std::max(result.rate, std::sqrt(stiffness * mobility) + damping * mobility);
      result.rounding = std::max(result.rounding, units * eps * stiffness * summands);
    }
}

}  // namespace

double largest(const Eigen::MatrixXd& values) {
  return values.size() > 0 ? values.cwiseAbs().maxCoeff() : 0.0;
}

SolvedPanel solve_panel(const Contacts& contacts, const ContactStates& now, const PanelMotion& motion,
                        double force_size) {
  constexpr int most = 25;
  constexpr double rounding = 1e-13, stalled = 1e-9;
  const double holding = motion.poles.holding();
  const FreeForces free(contacts, now.state, holding > 0.0);
  const Index q = motion.shape.nodes(), count = free.count(), forces = Index(free.rows.size());
  Eigen::MatrixXd unknown = Eigen::MatrixXd::Zero(count, q);
  SolvedPanel result{{free.constant.replicate(1, q), Eigen::MatrixXd::Zero(contacts.memories(), q)},
                     count == 0};
  double last = 0.0;
  for (int n = 0; n < most && !result.converged; ++n) {
    const Signals signals = motion.at(motion.shape.waves(), result.values);
    const auto equations = law_equations(contacts, now, free, holding > 0.0, signals, q);
    Eigen::VectorXd residual(count * q);
    for (Index e = 0; e < count; ++e)
      for (Index k = 0; k < q; ++k) residual[e * q + k] = equations[std::size_t(e)][std::size_t(k)].value;
    const Eigen::VectorXd step = motion.factor.solve(
        equations_by_unknowns(contacts, free, motion.shape, equations, holding), residual);
    if (!step.allFinite()) return result;
    for (Index e = 0; e < count; ++e) unknown.row(e) -= step.segment(e * q, q).transpose();
    result.values.force = (free.combine * unknown.topRows(forces)).colwise() + free.constant;
    for (Index k = 0; k < count - forces; ++k)
      result.values.memory_rate.row(free.moving[std::size_t(k)].second) = unknown.row(forces + k);
    // Memories act by forces.
    const double size = std::max(force_size, largest(unknown.topRows(forces))),
                 change = forces > 0 || n > 0 ? largest(step.head(forces * q)) : size;
    result.converged = change <= rounding * size || (n > 0 && change < stalled * size && change > 0.1 * last);
    last = change;
    if (result.converged) add_slopes(contacts, free, equations, motion, result);
  }
  return result;
}

}  // namespace wavebalance::solvers::detail
