#include "friction/rubbing_equations.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace wavebalance::solvers::detail {
namespace {

// What leads from the values at the nodes of a panel to the polynomial, its slope and its second derivative
// by x at one end.
struct PanelEnd {
  PanelEnd(const LegendreNodes& nodes, bool at_end) {
    const Eigen::ArrayXd k = Eigen::ArrayXd::LinSpaced(nodes.count(), 0.0, double(nodes.count() - 1));
    Eigen::ArrayXd one = Eigen::ArrayXd::Ones(nodes.count()), first = 0.5 * k * (k + 1.0),
                   second = 0.125 * (k - 1.0) * k * (k + 1.0) * (k + 2.0);
    if (!at_end)
      for (Index i = 0; i < nodes.count(); ++i) {
        if (i % 2 == 0)
          first[i] = -first[i];
        else
          one[i] = -one[i], second[i] = -second[i];
      }
    value = nodes.coefficients.transpose() * one.matrix();
    slope = nodes.coefficients.transpose() * first.matrix();
    bend = nodes.coefficients.transpose() * second.matrix();
  }
  Eigen::VectorXd value, slope, bend;
};

// A linear condition on the forces at the nodes of two panels, weight(tangent) - factor weight(normal) = 0.
struct EndCondition {
  int tangent = -1, normal = -1;  // panels; -1 without
  double factor = 0.0;
  double constant = 0.0;                                  // N, that is subtracted
  const Eigen::VectorXd *row = nullptr, *rate = nullptr;  // by nodes, and its derivative by x
};

class Assembly {
 public:
  Assembly(const RubbingModel& model, const RubbingIterate& at, const LegendreNodes& nodes)
      : model_(model), at_(at), nodes_(nodes), begin_(nodes, false), end_(nodes, true) {
    result_.grid = at.layout.panels.grid();
    find_panels();
    set_forces();
  }

  RubbingEvaluation run(bool with_jacobian) {
    const Index unknowns = result_.free_count + sliders() + instants();
    result_.residual.setZero(unknowns);
    if (with_jacobian) result_.jacobian.setZero(unknowns, unknowns);
    if (result_.grid.panels.empty()) return std::move(result_);
    influence_ = model_.poles.response.influence(result_.grid, nodes_, false);
    const std::vector<Instant> places = instants_of(result_.grid.panels, nodes_);
    const auto own = influence_.displacement.topLeftCorner(count(), count());
    const Eigen::VectorXd u = model_.poles.free_displacement(places) - own * result_.force;
    result_.displacement_size = std::max(tiny, u.cwiseAbs().maxCoeff());
    set_rounding(own.cwiseAbs() * result_.force.cwiseAbs());
    if (with_jacobian) set_motion_by_unknowns();
    for (std::size_t p = 0; p < result_.grid.panels.size(); ++p) set_law(p, u, with_jacobian);
    for (const RubbingPhase& phase : at_.layout.phases)
      if (phase.slider >= 0)
        set_condition(result_.free_count + phase.slider, phase.begin, slider_of(phase), with_jacobian);
    for (Index k = 0; k < instants(); ++k)
      set_condition(result_.free_count + sliders() + k, int(k), instant_of(int(k)), with_jacobian);
    Eigen::VectorXd parts = Eigen::VectorXd::Zero(count());
    for (Index i = 0; i < count(); ++i)
      if (const int free = result_.free[std::size_t(i)]; free >= 0) parts[i] = result_.residual[free];
    result_.moved = (own * parts).cwiseAbs().maxCoeff();
    return std::move(result_);
  }

 private:
  static constexpr double tiny = 1e-300;

  Index count() const { return result_.force.size(); }
  Index sliders() const { return at_.layout.sliders; }
  Index instants() const { return Index(at_.layout.instants.size()); }
  const RubbingPhase& phase(int number) const { return at_.layout.phases[std::size_t(number)]; }
  const RubbingContact& contact_of(const RubbingPhase& phase) const {
    return model_.contacts[std::size_t(phase.contact)];
  }

  // From the sizes of what adds up to the displacements, m.
  void set_rounding(const Eigen::VectorXd& sums) {
    constexpr double rounding = 10.0 * std::numeric_limits<double>::epsilon();
    for (std::size_t p = 0; p < result_.grid.panels.size(); ++p) {
      const FrictionConstants& constants = contact_of(owner(p)).constants;
      const double stiffness = is_tangent(p) ? constants.tangential_stiffness : constants.normal_stiffness;
      const double largest = sums.segment(nodes_.count() * Index(p), nodes_.count()).maxCoeff();
      result_.rounding = std::max(result_.rounding, rounding * stiffness * largest);
    }
  }

  // The panels of each phase of forces follow each other.
  void find_panels() {
    const std::size_t phases = at_.layout.panels.phases.size();
    first_.assign(phases, -1);
    last_.assign(phases, -1);
    owner_.assign(phases, -1);
    for (std::size_t p = 0; p < result_.grid.panels.size(); ++p) {
      const auto number = std::size_t(result_.grid.panels[p].phase);
      if (first_[number] < 0) first_[number] = int(p);
      last_[number] = int(p);
    }
    for (std::size_t i = 0; i < at_.layout.phases.size(); ++i) {
      const RubbingPhase& own = at_.layout.phases[i];
      for (const int forces : {own.normal, own.tangent})
        if (forces >= 0) owner_[std::size_t(forces)] = int(i);
    }
  }

  const RubbingPhase& owner(std::size_t panel) const {
    return phase(owner_[std::size_t(result_.grid.panels[panel].phase)]);
  }
  bool is_tangent(std::size_t panel) const {
    return owner(panel).tangent == result_.grid.panels[panel].phase;
  }
  // The panel of the normal force beside one of the tangential force.
  std::size_t partner(std::size_t panel) const {
    const RubbingPhase& own = owner(panel);
    return panel - std::size_t(first_[std::size_t(own.tangent)]) +
           std::size_t(first_[std::size_t(own.normal)]);
  }

  // Those of slip follow from the normal ones.
  void set_forces() {
    const Index q = nodes_.count();
    result_.force.resize(q * Index(result_.grid.panels.size()));
    result_.free.assign(std::size_t(count()), -1);
    for (std::size_t p = 0; p < result_.grid.panels.size(); ++p) {
      const Panel& panel = result_.grid.panels[p];
      if (is_tangent(p) && owner(p).state == RubbingState::slip) continue;
      for (Index j = 0; j < q; ++j) {
        result_.force[q * Index(p) + j] = at_.forces.in_phase(panel.phase, panel.time(nodes_.points[j]));
        result_.free[std::size_t(q * Index(p) + j)] = int(result_.free_count++);
      }
    }
    for (std::size_t p = 0; p < result_.grid.panels.size(); ++p) {
      const RubbingPhase& own = owner(p);
      if (!is_tangent(p) || own.state != RubbingState::slip) continue;
      const RubbingContact& contact = contact_of(own);
      auto force = result_.force.segment(q * Index(p), q);
      const double factor = own.sign * contact.constants.friction;
      if (contact.has_normal())
        force = factor * result_.force.segment(q * Index(partner(p)), q);
      else
        force.setConstant(factor * contact.constants.normal_load);
    }
    result_.force_size = std::max(tiny, count() > 0 ? result_.force.cwiseAbs().maxCoeff() : 0.0);
  }

  // Displacements at all nodes by the free forces and by the instants, towards the other side.
  void set_motion_by_unknowns() {
    const Index q = nodes_.count(), n = count();
    by_forces_ = Eigen::MatrixXd::Zero(n, result_.free_count);
    for (Index i = 0; i < n; ++i)
      if (const int free = result_.free[std::size_t(i)]; free >= 0)
        by_forces_.col(free) += influence_.displacement.col(i).head(n);
    for (std::size_t p = 0; p < result_.grid.panels.size(); ++p) {
      const RubbingPhase& own = owner(p);
      if (!is_tangent(p) || own.state != RubbingState::slip || own.normal < 0) continue;
      const double factor = own.sign * contact_of(own).constants.friction;
      for (Index j = 0; j < q; ++j)
        by_forces_.col(result_.free[std::size_t(q * Index(partner(p)) + j)]) +=
            factor * influence_.displacement.col(q * Index(p) + j).head(n);
    }
    by_instants_ = Eigen::MatrixXd::Zero(n, instants());
    for (Index k = 0; k < instants(); ++k) {
      const RubbingInstant& at = at_.layout.instants[std::size_t(k)];
      const RubbingPhase &before = phase(at.before), &after = phase(at.after);
      add_impulse(k, at.tangent, before.tangent, after.tangent);
      add_impulse(k, at.normal, before.normal, after.normal);
    }
  }

  // What a later instant adds is the force before it less that after it, for so long.
  void add_impulse(Index instant, int passage, int before, int after) {
    if (passage < 0) return;
    double impulse = 0.0;
    const Index q = nodes_.count();
    if (before >= 0 && last_[std::size_t(before)] >= 0)
      impulse += end_.value.dot(result_.force.segment(q * last_[std::size_t(before)], q));
    if (after >= 0 && first_[std::size_t(after)] >= 0)
      impulse -= begin_.value.dot(result_.force.segment(q * first_[std::size_t(after)], q));
    by_instants_.col(instant) += impulse * influence_.displacement.col(count() + passage).head(count());
  }

  void set_law(std::size_t p, const Eigen::VectorXd& u, bool with_jacobian) {
    const RubbingPhase& own = owner(p);
    const FrictionConstants& constants = contact_of(own).constants;
    const bool tangent = is_tangent(p);
    if (tangent && own.state == RubbingState::slip) return;
    const double stiffness = tangent ? constants.tangential_stiffness : constants.normal_stiffness;
    const double constant = !tangent          ? constants.normal_load
                            : own.slider >= 0 ? -at_.sliders[own.slider]
                                              : -own.held;
    for (Index j = 0; j < nodes_.count(); ++j) {
      const Index i = nodes_.count() * Index(p) + j, row = result_.free[std::size_t(i)];
      result_.residual[row] = result_.force[i] - constant - stiffness * u[i];
      if (!with_jacobian) continue;
      result_.jacobian.row(row).head(result_.free_count) = stiffness * by_forces_.row(i);
      result_.jacobian(row, row) += 1.0;
      if (tangent && own.slider >= 0) result_.jacobian(row, result_.free_count + own.slider) = 1.0;
      if (instants() > 0)  // Eigen offers no row of a matrix without columns
        result_.jacobian.row(row).tail(instants()) = stiffness * by_instants_.row(i);
    }
  }

  // f_t - sign mu f_n at an end of a stick.
  EndCondition on_limit(const RubbingPhase& stick, double sign, bool at_end, const Eigen::VectorXd& row,
                        const Eigen::VectorXd& rate, bool constant) const {
    const RubbingContact& contact = contact_of(stick);
    const double factor = sign * contact.constants.friction;
    const std::vector<int>& panels = at_end ? last_ : first_;
    EndCondition condition{panels[std::size_t(stick.tangent)], -1, factor, 0.0, &row, &rate};
    if (contact.has_normal())
      condition.normal = panels[std::size_t(stick.normal)];
    else if (constant)
      condition.constant = factor * contact.constants.normal_load;
    return condition;
  }

  EndCondition slider_of(const RubbingPhase& stick) const {
    return on_limit(stick, stick.sign, false, begin_.value, begin_.slope, true);
  }

  EndCondition instant_of(int instant) const {
    const RubbingInstant& at = at_.layout.instants[std::size_t(instant)];
    const RubbingPhase &before = phase(at.before), &after = phase(at.after);
    if (before.state == RubbingState::open)
      return {-1, first_[std::size_t(after.normal)], -1.0, 0.0, &begin_.value, &begin_.slope};
    if (after.state == RubbingState::open)
      return {-1, last_[std::size_t(before.normal)], -1.0, 0.0, &end_.value, &end_.slope};
    if (after.state == RubbingState::slip)
      return on_limit(before, after.sign, true, end_.value, end_.slope, true);
    return on_limit(after, after.sign, false, begin_.slope, begin_.bend, false);
  }

  void set_condition(Index row, int instant, const EndCondition& condition, bool with_jacobian) {
    const Index q = nodes_.count();
    double value = -condition.constant, rate = 0.0;
    const auto add = [&](int panel, double factor) {
      if (panel < 0 || factor == 0.0) return;
      const auto forces = result_.force.segment(q * panel, q);
      value += factor * condition.row->dot(forces);
      rate += factor * 2.0 / result_.grid.panels[std::size_t(panel)].length() * condition.rate->dot(forces);
      if (!with_jacobian) return;
      for (Index j = 0; j < q; ++j)
        result_.jacobian(row, result_.free[std::size_t(q * panel + j)]) += factor * (*condition.row)[j];
    };
    add(condition.tangent, 1.0);
    add(condition.normal, -condition.factor);
    result_.residual[row] = value;
    if (with_jacobian) result_.jacobian(row, result_.free_count + sliders() + instant) += rate;
  }

  const RubbingModel& model_;
  const RubbingIterate& at_;
  const LegendreNodes& nodes_;
  PanelEnd begin_, end_;
  RubbingEvaluation result_;
  Influence influence_;
  Eigen::MatrixXd by_forces_, by_instants_;  // n x f and n x m
  std::vector<int> first_, last_, owner_;    // of the phases of forces: panels, and the phase they belong to
};

}  // namespace

RubbingEvaluation evaluate(const RubbingModel& model, const RubbingIterate& at, const LegendreNodes& nodes,
                           bool with_jacobian) {
  return Assembly(model, at, nodes).run(with_jacobian);
}

}  // namespace wavebalance::solvers::detail
