#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

#include "flow/flow_engine.hpp"
#include "flow/law_machines.hpp"
#include "linalg/root.hpp"

namespace wavebalance::solvers {

// Forces that move no contact by a thousandth of its length in a period need few digits. The first ones of
// a power law, which rise as d^1.5 where it is touched, have none on any panel.
void ContactFlow::Engine::set_small_force(const ExactProblem& problem) {
  constexpr double share = 1e-3;
  const double rate = 2.0 * std::numbers::pi * problem.frequency;
  double mobility = 0.0;  // 1/kg
  for (int row = 0; row < int(poles_.rows()); ++row)
    mobility = std::max(mobility, detail::inverse_mass_of(problem.dynamics, row));
  if (mobility > 0.0) small_force_ = share * length_ * rate * rate / mobility;
}

// How the memories of the contacts move that do.
ContactFlow::Engine::Moving ContactFlow::Engine::moving() const {
  Moving result;
  for (Index c = 0; c < contacts_.count(); ++c) {
    const int state = now_.state[std::size_t(c)];
    if (!contacts_.law(c).moves(state)) continue;
    const auto rate = contacts_.law(c).settling_rate(state);
    result.turn = result.turn || !rate;
    result.settling_rate = std::max(result.settling_rate, rate.value_or(0.0));
  }
  return result;
}

// Whether the nodes of a panel resolve forces and perturbations. These may move faster than the motion
// does: at most one radian a node. Perturbations of moving sliders are fast on any panel near instants at
// which the force that turns them vanishes: there the unresolved impulse on perturbations counts.
ContactFlow::Engine::Fit ContactFlow::Engine::fit_of(const detail::PanelShape& panel,
                                                     const detail::SolvedPanel& found) const {
  // The coefficients of forces by sliders that move fall slowly where these turn sharply: the last ones are
  // less significant.
  constexpr double most_rounding = 1e-3, of_moving = 1e-3;
  const Eigen::MatrixXd& force = found.values.force;
  const Moving memories = moving();
  if (2.0 * memories.settling_rate * panel.half() > double(panel.nodes())) return Fit::too_long;
  if (!found.converged || !force.allFinite()) return Fit::too_long;
  const double size = std::max(force_size_, force.cwiseAbs().maxCoeff());
  if (found.rounding > most_rounding * size) return Fit::no_digits;
  const double tolerance = (memories.turn ? of_moving : 1.0) * options_.tolerance,
               allowed = std::max(tolerance * size, found.rounding);
  if (panel.unresolved(force, force_size_) * size > allowed) return Fit::too_long;
  const double turns = variation_.empty() ? 0.0 : 2.0 * found.rate * panel.half() / double(panel.nodes());
  if (turns <= 1.0) return Fit::fits;
  if (!memories.turn) return Fit::too_long;
  const double missed = variation_.unresolved(contacts_, now_, motion(panel), found.values) * 2.0 *
                        panel.half() / poles_.period();
  return missed <= options_.tolerance ? Fit::fits : Fit::too_long;
}

// Forces of the laws on the next panel, short enough to resolve them.
std::optional<ContactFlow::Engine::Solved> ContactFlow::Engine::solve_next() {
  constexpr int finest = 24;
  for (; level_ <= finest; ++level_) {
    const detail::PanelShape& panel = shape(level_);
    detail::SolvedPanel found = solve_panel(contacts_, now_, motion(panel), force_size_);
    const Fit fit = fit_of(panel, found);
    if (fit == Fit::no_digits) break;
    if (fit == Fit::too_long) {
      if (!found.converged) found.values = no_values();
      if (auto last = solve_to_end({&panel, found.values})) return last;
      continue;
    }
    const double rough = panel.unresolved(found.values.force, force_size_),
                 turns = variation_.empty() ? 0.0 : 2.0 * found.rate * panel.half() / double(panel.nodes());
    force_size_ = std::max(force_size_, found.values.force.cwiseAbs().maxCoeff());
    unresolved_ = std::max(unresolved_, rough - found.rounding / force_size_);
    if (rough < 0.01 * options_.tolerance && turns < 0.5) level_ = std::max(level_ - 1, coarsest_);
    return Solved{&panel, std::move(found.values)};
  }
  if (force_size_ >= small_force_) return std::nullopt;
  force_size_ = small_force_;
  level_ = coarsest_;
  return solve_next();
}

// A panel ends where equations become singular, if that is within one that it makes too long.
std::optional<ContactFlow::Engine::Solved> ContactFlow::Engine::solve_to_end(const Solved& too_long) {
  constexpr double rough = 1e-6;
  for (Index c = 0; c < contacts_.count(); ++c) {
    const Guard guard{c, contacts_.law(c).singular_exit(now_.state[std::size_t(c)])};
    if (guard.exit < 0) continue;
    const auto value = [&](double at) { return guard_at(too_long, guard, at).value; };
    const double begin = value(-1.0), end = value(1.0);
    if (!(begin > 0.0 && end < 0.0)) continue;
    const auto at = detail::root(value, {-1.0, begin}, {1.0, end}, rough);
    if (!at) continue;
    if (auto last = solve_to_end_of(guard, (*at + 1.0) * too_long.shape->half())) return last;
  }
  return std::nullopt;
}

// By Newton's method on its length, from a start near it.
std::optional<ContactFlow::Engine::Solved> ContactFlow::Engine::solve_to_end_of(const Guard& guard,
                                                                                double length) {
  constexpr int most = 8;
  constexpr double settled = 1e-12, rounding = 1e-15;  // of the length, and of the period
  const double longest = 2.0 * length;
  for (int n = 0; n < most && length > 0.0 && length <= longest; ++n) {
    const auto panel = std::make_shared<detail::PanelShape>(poles_, nodes_, 0.5 * length, dense_.at);
    detail::SolvedPanel found = solve_panel(contacts_, now_, motion(*panel), force_size_);
    if (!found.converged) return std::nullopt;
    Solved last{panel.get(), std::move(found.values), guard, panel};
    const GuardValue end = guard_at(last, guard, 1.0);
    const double step = -end.value / end.rate * panel->half();
    length += step;
    if (!(std::abs(step) < settled * length + rounding * poles_.period())) continue;
    found.values = last.values;
    if (fit_of(*panel, found) != Fit::fits) return std::nullopt;
    return last;
  }
  return std::nullopt;
}

}  // namespace wavebalance::solvers
