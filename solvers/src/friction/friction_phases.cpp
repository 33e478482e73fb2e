#include "wavebalance/solvers/friction/friction_phases.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>

#include "friction/rubbing_agreement.hpp"
#include "friction/rubbing_newton.hpp"
#include "friction/rubbing_parts.hpp"
#include "linalg/index.hpp"
#include "phases/phase_refinement.hpp"

namespace wavebalance::solvers {
namespace {

using namespace detail;

PhasesStatus friction_refusal(const PhasesProblem& problem) {
  const ContactDynamics& dynamics = problem.dynamics;
  for (int row = 0; row < dynamics.contacts(); row += problem.laws[row].rows()) {
    const std::optional<FrictionConstants> constants = problem.laws[row].friction();
    if (!constants) return PhasesStatus::mixed_laws;
    if (constants->tangents > 1) return PhasesStatus::slip_in_a_plane;
    if (!std::isfinite(constants->tangential_stiffness)) return PhasesStatus::rigid_contact;
  }
  if (dynamics.structurally_damped()) return PhasesStatus::structural_damping;
  if (dynamics.holding() > 0.0) return PhasesStatus::free_structure;
  constexpr double least = 1e-9;
  for (const ContactPole& pole : dynamics.poles())
    if (!(std::abs(1.0 - std::exp(pole.exponent / problem.frequency)) > least)) return PhasesStatus::resonant;
  return PhasesStatus::converged;
}

std::vector<RubbingContact> contacts_of(const PhasesProblem& problem) {
  std::vector<RubbingContact> contacts;
  for (int row = 0; row < problem.dynamics.contacts(); row += problem.laws[row].rows()) {
    RubbingContact contact{-1, row, *problem.laws[row].friction(), problem.laws[row]};
    if (contact.constants.normal_rows > 0) {
      contact.normal = row;
      contact.tangent = row + 1;
    }
    contacts.push_back(std::move(contact));
  }
  return contacts;
}

void require_friction_sizes(const PhasesProblem& problem, const Eigen::MatrixXd& start,
                            const Eigen::MatrixXd& start_force) {
  const int rows = problem.dynamics.contacts();
  problem.laws.require(rows);
  if (problem.contact_free.rows() != rows || problem.contact_free.cols() < 1)
    throw std::invalid_argument("friction_phases: contact_free has " +
                                std::to_string(problem.contact_free.rows()) + " rows; the structure has " +
                                std::to_string(rows) + " contact directions");
  if (start.rows() != rows || start.cols() < 8 || !start.allFinite())
    throw std::invalid_argument("friction_phases: start is " + std::to_string(start.rows()) + " x " +
                                std::to_string(start.cols()) + "; it must have a finite row for each of " +
                                std::to_string(rows) + " contact directions and at least 8 columns");
  if (start_force.size() > 0 && (start_force.rows() != start.rows() || start_force.cols() != start.cols()))
    throw std::invalid_argument("friction_phases: start_force is " + std::to_string(start_force.rows()) +
                                " x " + std::to_string(start_force.cols()) +
                                "; it must be as large as start, or empty");
  if (!(problem.frequency > 0.0) || !std::isfinite(problem.frequency))
    throw std::invalid_argument("friction_phases: frequency is " + std::to_string(problem.frequency) +
                                " Hz; it must be positive and finite");
}

class RubbingSearch {
 public:
  RubbingSearch(const RubbingModel& model, const ContactPhasesOptions& options, const Eigen::MatrixXd& start,
                const Eigen::MatrixXd& start_force, const ContactDynamics& dynamics)
      : model_(model),
        dynamics_(dynamics),
        options_(options),
        operations_left_(options.max_operations),
        start_(start),
        start_force_(start_force),
        observer_([this](const Progress& progress) {
          cancelled_ = cancelled_ || !goes_on(options_.observer, progress);
          return !cancelled_;
        }) {}

  PhaseMotion run() {
    find();
    if (found_) refine();
    return describe();
  }

 private:
  static constexpr double of_newton = 1e-12;

  bool stopped() const { return cancelled_ || exhausted_; }

  ContactMotion sampled(const RubbingIterate& iterate, Index samples) const {
    return model_.poles.motion(iterate.forces, nodes_,
                               Eigen::VectorXd::LinSpaced(samples, 0.0, 1.0 - 1.0 / double(samples)));
  }

  double operations_of_step(const RubbingLayout& layout) const {
    const double nodes = double(nodes_.count()) * double(layout.panels.grid().panels.size()),
                 unknowns = double(unknowns_of(layout, nodes_)),
                 poles = double(model_.poles.response.poles());
    return unknowns * unknowns * unknowns / 1.5 + 4.0 * nodes * nodes * poles + 1.0;
  }
  // Whether so many steps are left.
  bool may_take(const RubbingLayout& layout, double steps) {
    exhausted_ = operations_left_ < steps * operations_of_step(layout);
    return !exhausted_;
  }

  // Newton's method, as many steps as the operations allow; none where they do not allow three.
  std::optional<RubbingIterate> newton(RubbingIterate iterate) {
    if (!may_take(iterate.layout, 3.0) || stopped()) return std::nullopt;
    const double of_step = operations_of_step(iterate.layout);
    const int most = static_cast<int>(std::min<double>(options_.max_iterations, operations_left_ / of_step));
    RubbingSolution solution =
        solve_rubbing(model_, std::move(iterate), nodes_, {most, of_newton, observer_});
    operations_left_ -= of_step * (solution.iterations + 1);
    result_.iterations += solution.iterations;
    result_.residual = solution.residual;
    last_ = std::move(solution.iterate);
    if (!solution.converged || stopped()) return std::nullopt;
    return last_;
  }

  // The forces of given phases, on panels that resolve them roughly: before that, Newton's method has no
  // derivatives by the instants. Nothing where the operations do not allow it.
  std::optional<RubbingIterate> resolved(RubbingLayout layout) {
    constexpr double rough = 1e-3;
    constexpr int levels = 6;
    const Index many_nodes = std::min(12, options_.max_nodes);
    RubbingIterate iterate;
    for (int level = 0; level < levels; ++level) {
      if (!may_take(layout, 1.0)) return std::nullopt;
      iterate = with_forces(model_, std::move(layout), nodes_);
      if (unresolved_part(iterate.forces) < rough) break;
      if (nodes_.count() < many_nodes)
        nodes_ = LegendreNodes(many_nodes);
      else if (!may_cut(iterate) || !cut(iterate, rough))
        break;
      layout = iterate.layout;
    }
    return iterate;
  }

  // A solution for the phases of an iterate whose panels resolve the forces roughly, so that it tells whether
  // the phases are right, with sliders that do not move where they may stay.
  std::optional<RubbingIterate> solved(RubbingIterate iterate) {
    constexpr double rough = 1e-4, settled = 1e-12, rounding = 1e-7, most_allowed = 1e-2;
    constexpr int most_rounds = 30;
    constexpr Index many_nodes = 16;
    for (int round = 0; round < most_rounds; ++round) {
      std::optional<RubbingIterate> now = newton(std::move(iterate));
      if (!now) return std::nullopt;
      iterate = *std::move(now);
      const double unresolved = unresolved_part(iterate.forces);
      if (unresolved > rough && nodes_.count() < std::min<Index>(many_nodes, options_.max_nodes)) {
        nodes_ = LegendreNodes(std::min<Index>(many_nodes, options_.max_nodes));
        continue;
      }
      if (unresolved > rough && may_cut(iterate) && cut(iterate, rough)) continue;
      const RubbingAgreement agreement =
          agreement_of(model_, iterate, nodes_, std::clamp(30.0 * unresolved, rounding, most_allowed));
      if (!agreement.agrees) return std::nullopt;
      if (agreement.largest_move < std::max(settled, 0.01 * unresolved)) return iterate;
      for (std::size_t i = 0; i < agreement.moved.size(); ++i)
        iterate.layout.phases[i].held += agreement.moved[i];
    }
    return std::nullopt;
  }

  // A slider that does not move is where the forces of the start have it, which come from the periods before:
  // the law over one period does not know them.
  void hold_as_start(RubbingLayout& layout) const {
    if (start_force_.size() == 0) return;
    for (RubbingPhase& phase : layout.phases) {
      if (!phase.always() || phase.state != RubbingState::stick) continue;
      const RubbingContact& contact = model_.contacts[std::size_t(phase.contact)];
      phase.held = contact.constants.tangential_stiffness * start_.row(contact.tangent).mean() -
                   start_force_.row(contact.tangent).mean();
    }
  }

  // The phases of the start, then those that the law has along what was found, sampled more finely where they
  // were tried before.
  void find() {
    constexpr Index least_samples = 1024, most_samples = 1 << 15;
    ContactMotion motion{start_, periodic_slopes(start_)};
    Index samples = std::max<Index>(least_samples, start_.cols());
    const double size = rms_of(start_);
    std::vector<RubbingLayout> tried;
    for (int change = 0; !stopped(); ++change) {
      RubbingLayout layout = rubbing_layout(model_.contacts, motion);
      hold_as_start(layout);
      const bool again = std::any_of(tried.begin(), tried.end(),
                                     [&](const RubbingLayout& other) { return other.has_states_of(layout); });
      if (again) {
        samples *= 4;
        tried.clear();
        if (samples > most_samples) return;
      }
      tried.push_back(layout);
      found_ = resolved(std::move(layout));
      if (found_) found_ = solved(*std::move(found_));
      if (found_ || change == options_.max_changes) return;
      ++result_.changes;
      motion.displacement = sampled(last_, samples).displacement;
      motion.velocity = periodic_slopes(motion.displacement);
      const double now = rms_of(motion.displacement);
      if (!(now < 100.0 * size)) return;
    }
  }

  bool may_cut(const RubbingIterate& iterate) const {
    return Index(iterate.forces.panels().size()) < options_.max_panels;
  }
  // Whether the layout was cut anywhere.
  static bool cut(RubbingIterate& iterate, double share) {
    PhaseIterate panels{iterate.layout.panels, iterate.forces};
    if (!divide(panels, share)) return false;
    iterate.layout.panels = std::move(panels.layout);
    iterate.layout.join_cuts();
    return true;
  }

  // More nodes, or where these did not help or there are no more of them, more panels.
  bool finer(RubbingIterate& iterate, double gain) {
    constexpr double slow = 10.0, rounding = 1e-12;
    constexpr Index many_nodes = 12;
    const Index q = nodes_.count();
    const bool resolved = gain < slow && unresolved_part(iterate.forces) < rounding;
    const bool cuts = q >= options_.max_nodes || (gain < slow && q >= many_nodes);
    if (cuts && !resolved && may_cut(iterate) && cut(iterate, std::max(rounding, 0.1 * options_.tolerance)))
      return true;
    if (resolved) return false;
    if (q >= options_.max_nodes) return false;
    nodes_ = LegendreNodes(std::min<Index>(options_.max_nodes, q + std::max<Index>(2, q / 3)));
    return true;
  }

  // The distance from the solution before is about the error of that one; errors of fast modes fall slower
  // than they seem to.
  void refine() {
    constexpr double rounding = 1e-13, safety = 3.0;
    result_.estimated_error = std::numeric_limits<double>::infinity();
    const Index samples = std::max<Index>(256, start_.cols());
    ContactMotion motion = sampled(*found_, samples);
    if (found_->forces.panels().empty()) result_.estimated_error = 0.0;
    double before = result_.estimated_error, gain = before;
    while (result_.estimated_error > options_.tolerance && !stopped()) {
      RubbingIterate next = *found_;
      const LegendreNodes nodes = nodes_;
      if (!finer(next, gain)) return;
      auto better = solved(std::move(next));
      if (!better) {
        nodes_ = nodes;
        return;
      }
      ContactMotion now = sampled(*better, samples);
      const double distance =
          std::max(rounding, rms_of(now.displacement - motion.displacement) / rms_of(now.displacement));
      gain = before / distance;
      before = distance;
      result_.estimated_error = safety * distance;
      found_ = std::move(better);
      motion = std::move(now);
    }
  }

  PhaseMotion describe() {
    if (exhausted_) result_.status = PhasesStatus::too_many_phases;
    if (cancelled_) result_.status = PhasesStatus::cancelled;
    if (!found_) return std::move(result_);
    result_.unknowns = static_cast<int>(unknowns_of(found_->layout, nodes_));
    if (result_.estimated_error <= options_.tolerance)
      result_.status = PhasesStatus::converged;
    else if (!cancelled_)
      result_.status = PhasesStatus::tolerance_missed;
    const Eigen::MatrixXd own = sampled(*found_, start_.cols()).displacement;
    result_.start_error = (start_ - own).norm() / own.norm();
    set_rubbing_parts(result_, model_, *found_, nodes_, dynamics_);
    return std::move(result_);
  }

  const RubbingModel& model_;
  const ContactDynamics& dynamics_;
  const ContactPhasesOptions& options_;
  double operations_left_;
  Eigen::MatrixXd start_, start_force_;
  LegendreNodes nodes_{options_.nodes};
  PhaseMotion result_;
  std::optional<RubbingIterate> found_;
  RubbingIterate last_;
  Observer observer_;  // that of the options, which is not called after it has returned false
  bool cancelled_ = false, exhausted_ = false;
};

}  // namespace

PhaseMotion friction_phases(const PhasesProblem& problem, const Eigen::MatrixXd& start,
                            const ContactPhasesOptions& options, const Eigen::MatrixXd& start_force) {
  options.validate();
  require_friction_sizes(problem, start, start_force);
  PhaseMotion result;
  result.status = friction_refusal(problem);
  if (!result.converged()) return result;
  const RubbingModel model{PhaseModel(problem, start.cwiseAbs().maxCoeff()), contacts_of(problem)};
  return RubbingSearch(model, options, start, start_force, problem.dynamics).run();
}

PhaseMotion phases_of_any_law(const PhasesProblem& problem, const Eigen::MatrixXd& start,
                              const ContactPhasesOptions& options, const Eigen::MatrixXd& start_force) {
  return (problem.laws.act_over_period() ? friction_phases : contact_phases)(problem, start, options,
                                                                             start_force);
}

}  // namespace wavebalance::solvers
