#include "wavebalance/solvers/impacts/impact_motion.hpp"

#include <algorithm>
#include <cmath>
#include <future>
#include <limits>
#include <numbers>
#include <numeric>

#include "collocation/exact_solution_parts.hpp"
#include "impacts/impact_equations.hpp"
#include "impacts/impact_parts.hpp"
#include "linalg/damped_newton.hpp"
#include "linalg/dense.hpp"
#include "linalg/index.hpp"
#include "linalg/option_checks.hpp"

namespace wavebalance::solvers {

namespace {

double within_period(double time) {
  const double share = time - std::floor(time);
  return share < 1.0 ? share : 0.0;
}

// Newton's method on the equations of impacts, which damped_newton() drives.
class ImpactSystem {
 public:
  ImpactSystem(const detail::ImpactModel& model, const detail::ImpactUnknowns& unknowns,
               const Observer& observer)
      : equations_(model, unknowns.contacts, unknowns.impulse_scale), observer_(observer) {}

  double evaluate(const Eigen::VectorXd& unknowns) {
    equations_.evaluate(unknowns);
    return norm();
  }
  double norm() const { return equations_.residual().norm(); }
  bool is_solved() const { return equations_.is_solved(); }
  bool direction(Eigen::VectorXd& step) const {
    const detail::Lu<double> factors(equations_.matrix());
    if (factors.is_singular()) return false;
    step = factors.solve(equations_.residual());
    return step.allFinite();
  }
  bool goes_on(int iteration) const {
    return solvers::goes_on(observer_, {"impacts", iteration, norm(), "residual", missing});
  }
  double largest() const {
    return equations_.impacts() > 0 ? equations_.residual().cwiseAbs().maxCoeff() : 0.0;
  }

 private:
  detail::ImpactEquations equations_;
  const Observer& observer_;
};

ExactStatus status_of(detail::NewtonEnd end) {
  if (end == detail::NewtonEnd::solved) return ExactStatus::converged;
  return end == detail::NewtonEnd::cancelled ? ExactStatus::cancelled : ExactStatus::not_found;
}

// Steps that gain what rounding leaves, after the equations hold to their rounding errors.
void polish(ImpactSystem& system, Eigen::VectorXd& unknowns) {
  constexpr int most_steps = 3;
  Eigen::VectorXd step;
  for (int i = 0; i < most_steps; ++i) {
    const double before = system.norm();
    if (before == 0.0 || !system.direction(step)) return;
    const Eigen::VectorXd last = unknowns;
    unknowns -= step;
    if (system.evaluate(unknowns) < before) continue;
    unknowns = last;
    system.evaluate(unknowns);
    return;
  }
}

void check_start(const ExactProblem& problem, const std::vector<ImpactGuess>& start) {
  for (const ImpactGuess& guess : start) {
    if (guess.contact < 0 || guess.contact >= problem.dynamics.contacts())
      detail::reject("impact_motion", "contact", guess.contact, "a contact of the structure");
    if (!std::isfinite(guess.time)) detail::reject("impact_motion", "time", guess.time, "finite");
    if (!std::isfinite(guess.impulse)) detail::reject("impact_motion", "impulse", guess.impulse, "finite");
  }
}

void check_flights(detail::ImpactSolution& motion) {
  const double allowed = detail::allowed_penetration(motion);
  const std::size_t flights = std::max<std::size_t>(1, motion.impacts.size());
  for (std::size_t i = 0; i < flights; ++i) {
    detail::Flight flight = detail::flight_after(motion, i);
    const detail::Touch touch = flight.first_touch();
    if (touch.kind == detail::Touch::Kind::none) continue;
    const bool unknown = touch.kind == detail::Touch::Kind::unresolved;
    motion.status = unknown ? ExactStatus::grazing : ExactStatus::penetrating;
    if (unknown) return;
    const auto peak = flight.peak_after(touch);
    if (!(peak.height > allowed) || peak.height <= motion.penetration) continue;
    const double begin = motion.impacts.empty() ? 0.0 : motion.impacts[i].time;
    motion.penetration = peak.height;
    motion.penetration_time = within_period(begin + peak.time / motion.model->period());
    motion.penetrating_contact = touch.contact;
  }
}

bool in_order(const detail::ImpactUnknowns& unknowns) {
  const auto count = Index(unknowns.contacts.size());
  for (Index i = 0; i + 1 < count; ++i)
    if (unknowns.values[i + 1] < unknowns.values[i]) return false;
  return count == 0 || unknowns.values[count - 1] <= unknowns.values[0] + 1.0;
}

}  // namespace

namespace detail {

double impulse_scale_of(const ImpactModel& model) {
  return model.velocity_scale() / model.inverse_mass().diagonal().minCoeff();
}

namespace {

// Cells from impact to impact, without forces.
CellGrid grid_of(const std::vector<Impact>& impacts, double frequency) {
  CellGrid grid;
  for (const Impact& one : impacts) {
    if (grid.boundaries.empty() || one.time > grid.boundaries.back()) grid.boundaries.push_back(one.time);
    grid.impulses.push_back({one.contact, int(grid.boundaries.size()) - 1, one.impulse * frequency});
  }
  if (impacts.empty()) grid.boundaries.push_back(0.0);
  return grid;
}

}  // namespace

double allowed_penetration(const ImpactModel& model) { return 1e-12 * model.displacement_scale(); }

double allowed_penetration(const ImpactSolution& motion) {
  constexpr double rounding = 16.0 * std::numeric_limits<double>::epsilon(), soon = 1e-3;
  const ImpactModel& model = *motion.model;
  double largest = 0.0;
  for (int c = 0; c < model.contacts(); ++c) {
    double sum = 0.0;
    for (const Impact& impact : motion.impacts)
      sum += std::abs(impact.impulse) * model.green(c, impact.contact, soon).magnitude;
    largest = std::max(largest, sum);
  }
  return std::max(allowed_penetration(model), rounding * largest);
}

ImpactUnknowns unknowns_of(const ImpactModel& model, const std::vector<ImpactGuess>& start) {
  std::vector<ImpactGuess> sorted = start;
  for (ImpactGuess& guess : sorted) guess.time = within_period(guess.time);
  std::ranges::stable_sort(sorted, {}, &ImpactGuess::time);
  ImpactUnknowns unknowns;
  for (const ImpactGuess& guess : sorted) unknowns.contacts.push_back(guess.contact);
  unknowns.impulse_scale = impulse_scale_of(model);
  unknowns.values = values_of(sorted, unknowns.impulse_scale);
  return unknowns;
}

Eigen::MatrixXcd states_after(const ImpactModel& model, const std::vector<Impact>& impacts) {
  const auto count = Index(impacts.size());
  Eigen::MatrixXcd states = Eigen::MatrixXcd::Zero(model.poles(), count);
  for (Index i = 0; i < count; ++i)
    for (Index j = 0; j < count; ++j) {
      const Impact& other = impacts[static_cast<std::size_t>(j)];
      const double share = impacts[static_cast<std::size_t>(i)].time - other.time + (j > i ? 1.0 : 0.0);
      states.col(i) += other.impulse * model.state_after(other.contact, share);
    }
  return states;
}

ImpactSolution solution_of(std::shared_ptr<const ImpactModel> model, const ImpactUnknowns& unknowns) {
  ImpactSolution found;
  const auto count = Index(unknowns.contacts.size());
  for (Index i = 0; i < count; ++i) {
    Impact impact;
    impact.contact = unknowns.contacts[static_cast<std::size_t>(i)];
    impact.time = unknowns.values[i];
    impact.impulse = unknowns.impulse_scale * unknowns.values[count + i];
    const double restitution = model->restitution()[impact.contact];
    impact.velocity_before =
        impact.impulse * model->inverse_mass()(impact.contact, impact.contact) / (1.0 + restitution);
    impact.velocity_after = -restitution * impact.velocity_before;
    impact.energy_lost = 0.5 * impact.impulse * (impact.velocity_before + impact.velocity_after);
    found.impacts.push_back(impact);
  }
  found.states = states_after(*model, found.impacts);
  found.model = std::move(model);
  const auto pulls = [](const Impact& impact) { return !(impact.impulse > 0.0); };
  found.status = ExactStatus::converged;
  if (!in_order(unknowns))
    found.status = ExactStatus::wrong_order;
  else if (std::ranges::any_of(found.impacts, pulls))
    found.status = ExactStatus::pulling;
  else
    check_flights(found);
  // The first impact of the period is the first of the list.
  for (Impact& impact : found.impacts) impact.time = within_period(impact.time);
  std::vector<Index> order(found.impacts.size());
  std::iota(order.begin(), order.end(), Index{0});
  std::ranges::stable_sort(order, {}, [&](Index i) { return found.impacts[std::size_t(i)].time; });
  found.states = found.states(Eigen::all, order).eval();
  std::ranges::stable_sort(found.impacts, {}, &Impact::time);
  return found;
}

bool same_impacts_later(const std::vector<Impact>& a, const std::vector<Impact>& b, double later) {
  constexpr double agreement = 1e-6;
  return std::ranges::all_of(a, [&](const Impact& one) {
    return std::ranges::any_of(b, [&](const Impact& other) {
      const double apart = one.time + later - other.time;
      return one.contact == other.contact && std::abs(apart - std::round(apart)) <= agreement &&
             std::abs(one.impulse - other.impulse) <= agreement * std::abs(one.impulse);
    });
  });
}

int repeats_after(const std::vector<Impact>& impacts, int load_periods) {
  for (int k = 1; k < load_periods; ++k)
    if (load_periods % k == 0 && same_impacts_later(impacts, impacts, double(k) / load_periods)) return k;
  return load_periods;
}

Flight flight_after(const ImpactSolution& motion, std::size_t i) {
  const ImpactModel& model = *motion.model;
  const double allowed = allowed_penetration(motion);
  if (motion.impacts.empty())
    return {model, Eigen::VectorXcd::Zero(model.poles()), 0.0, model.period(), allowed};
  const bool last = i + 1 == motion.impacts.size();
  const double begin = motion.impacts[i].time;
  const double end = last ? motion.impacts.front().time + 1.0 : motion.impacts[i + 1].time;
  return {model, motion.states.col(Index(i)), begin, (end - begin) * model.period(), allowed};
}

ContactsAt ImpactSolution::at(double time) const {
  if (impacts.empty()) return model->free_motion(time);
  const double share = within_period(time);
  const auto after = std::ranges::upper_bound(impacts, share, {}, &Impact::time);
  const bool before_all = after == impacts.begin();
  const auto last = before_all ? std::prev(impacts.end()) : std::prev(after);
  const double since = share - last->time + (before_all ? 1.0 : 0.0);
  return model->motion(
      model->growth(since * model->period()).cwiseProduct(states.col(last - impacts.begin())), share);
}

ImpactSolution impact_solution(const ExactProblem& problem, const std::vector<ImpactGuess>& start,
                               const Observer& observer) {
  constexpr double smallest_step = 1e-6;
  constexpr int most_steps = 40;
  check_start(problem, start);
  const auto model = std::make_shared<const ImpactModel>(problem);
  ImpactSolution found;
  if (!start.empty() && model->is_resonant()) {
    found.status = ExactStatus::resonant;
    return found;
  }
  ImpactUnknowns unknowns = unknowns_of(*model, start);
  ImpactSystem system(*model, unknowns, observer);
  const NewtonRun run = damped_newton(system, unknowns.values, most_steps, smallest_step);
  if (run.end == NewtonEnd::solved) {
    polish(system, unknowns.values);
    found = solution_of(model, unknowns);
  } else {
    found.status = status_of(run.end);
  }
  found.iterations = run.iterations;
  found.residual = system.largest();
  return found;
}

ExactSolution motion_of(std::shared_ptr<const ImpactSolution> solution) {
  ExactSolution motion;
  motion.status = solution->status;
  motion.impacts = solution->impacts;
  motion.unknowns = 2 * int(solution->impacts.size());
  motion.iterations = solution->iterations;
  motion.residual = solution->residual;
  if (!solution->converged()) return motion;
  constexpr int nodes = 2;  // of no panels
  const ExactProblem& problem = solution->model->problem();
  ExactSolution::Parts parts{CollocationModel(problem, 1.0), {}, LegendreNodes(nodes), {}, {}};
  CellGrid grid = grid_of(motion.impacts, problem.frequency);
  if (!motion.impacts.empty())
    grid.begin = {grid.cells() - 1, parts.model.response.states(solution->states.rightCols(1))};
  parts.iterate.forces = PanelForces(std::move(grid), parts.nodes, {});
  if (!motion.impacts.empty())  // once they are requested
    parts.multipliers = [known = std::async(std::launch::deferred, [solution] {
                                   return multipliers_of(*solution);
                                 }).share()] { return known.get(); };
  motion.parts = ExactSolution::Parts::complete(std::move(parts));
  return motion;
}

}  // namespace detail

ExactSolution impact_motion(const ExactProblem& problem, const std::vector<ImpactGuess>& start,
                            const Observer& observer) {
  detail::require_impacts(problem);
  return detail::motion_of(
      std::make_shared<const detail::ImpactSolution>(detail::impact_solution(problem, start, observer)));
}

}  // namespace wavebalance::solvers
