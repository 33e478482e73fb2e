#include "wavebalance/solvers/impacts/impact_motion.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <string>

#include "impacts/impact_equations.hpp"
#include "impacts/impact_parts.hpp"
#include "linalg/damped_newton.hpp"
#include "linalg/dense.hpp"
#include "linalg/enum_table.hpp"
#include "linalg/index.hpp"
#include "linalg/option_checks.hpp"

namespace wavebalance::solvers {

std::string_view to_string(ImpactStatus status) {
  using enum ImpactStatus;
  return detail::name_in<ImpactStatus>({{converged, "converged"},
                                        {iteration_limit, "iteration_limit"},
                                        {singular, "singular"},
                                        {wrong_order, "wrong_order"},
                                        {pulling, "pulling"},
                                        {penetrating, "penetrating"},
                                        {grazing, "grazing"},
                                        {resonant, "resonant"},
                                        {chattering, "chattering"},
                                        {lasting_contact, "lasting_contact"},
                                        {not_settled, "not_settled"},
                                        {too_many_impacts, "too_many_impacts"},
                                        {cancelled, "cancelled"}},
                                       status);
}

void ImpactMotionOptions::validate() const {
  detail::require_at_least("ImpactMotionOptions", "max_iterations", max_iterations, 1);
}

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

ImpactStatus status_of(detail::NewtonEnd end) {
  switch (end) {
    case detail::NewtonEnd::solved:
      return ImpactStatus::converged;
    case detail::NewtonEnd::singular:
      return ImpactStatus::singular;
    case detail::NewtonEnd::cancelled:
      return ImpactStatus::cancelled;
    default:
      return ImpactStatus::iteration_limit;
  }
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

void check_start(const ImpactsProblem& problem, const std::vector<ImpactGuess>& start) {
  for (const ImpactGuess& guess : start) {
    if (guess.contact < 0 || guess.contact >= problem.dynamics.contacts())
      detail::reject("impact_motion", "contact", guess.contact, "a contact of the structure");
    if (!std::isfinite(guess.time)) detail::reject("impact_motion", "time", guess.time, "finite");
    if (!std::isfinite(guess.impulse)) detail::reject("impact_motion", "impulse", guess.impulse, "finite");
  }
}

// The states of all poles right after each impact.
Eigen::MatrixXcd states_after(const detail::ImpactModel& model, const std::vector<Impact>& impacts) {
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

void check_flights(ImpactMotion& motion) {
  const double allowed = detail::allowed_penetration(motion);
  const std::size_t flights = std::max<std::size_t>(1, motion.impacts.size());
  for (std::size_t i = 0; i < flights; ++i) {
    detail::Flight flight = detail::flight_after(motion, i);
    const detail::Touch touch = flight.first_touch();
    if (touch.kind == detail::Touch::Kind::none) continue;
    const bool unknown = touch.kind == detail::Touch::Kind::unresolved;
    motion.status = unknown ? ImpactStatus::grazing : ImpactStatus::penetrating;
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

double allowed_penetration(const ImpactModel& model) { return 1e-12 * model.displacement_scale(); }

double allowed_penetration(const ImpactMotion& motion) {
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
  const auto count = Index(sorted.size());
  unknowns.values.resize(2 * count);
  for (Index i = 0; i < count; ++i) {
    unknowns.values[i] = sorted[static_cast<std::size_t>(i)].time;
    unknowns.values[count + i] = sorted[static_cast<std::size_t>(i)].impulse / unknowns.impulse_scale;
  }
  return unknowns;
}

ImpactMotion motion_of(std::shared_ptr<const ImpactModel> model, const ImpactUnknowns& unknowns,
                       ImpactMotion found) {
  const auto count = Index(unknowns.contacts.size());
  for (Index i = 0; i < count; ++i) {
    Impact impact;
    impact.contact = unknowns.contacts[static_cast<std::size_t>(i)];
    impact.time = unknowns.values[i];
    impact.impulse = unknowns.impulse_scale * unknowns.values[count + i];
    const double restitution = model->problem().restitution[impact.contact];
    impact.velocity_before =
        impact.impulse * model->inverse_mass()(impact.contact, impact.contact) / (1.0 + restitution);
    impact.velocity_after = -restitution * impact.velocity_before;
    impact.energy_lost = 0.5 * impact.impulse * (impact.velocity_before + impact.velocity_after);
    found.impacts.push_back(impact);
  }
  found.states = states_after(*model, found.impacts);
  found.model = std::move(model);
  const auto pulls = [](const Impact& impact) { return !(impact.impulse > 0.0); };
  found.status = ImpactStatus::converged;
  if (!in_order(unknowns))
    found.status = ImpactStatus::wrong_order;
  else if (std::ranges::any_of(found.impacts, pulls))
    found.status = ImpactStatus::pulling;
  else
    check_flights(found);
  // The first impact of the period is the first of the list.
  for (Impact& impact : found.impacts) impact.time = within_period(impact.time);
  std::vector<std::size_t> order(found.impacts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return found.impacts[i].time; });
  const std::vector<Impact> impacts = found.impacts;
  const Eigen::MatrixXcd states = found.states;
  for (std::size_t i = 0; i < order.size(); ++i) {
    found.impacts[i] = impacts[order[i]];
    found.states.col(Index(i)) = states.col(Index(order[i]));
  }
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

int repeats_after(const ImpactMotion& motion, int load_periods) {
  for (int k = 1; k < load_periods; ++k)
    if (load_periods % k == 0 && same_impacts_later(motion.impacts, motion.impacts, double(k) / load_periods))
      return k;
  return load_periods;
}

Flight flight_after(const ImpactMotion& motion, std::size_t i) {
  const ImpactModel& model = *motion.model;
  const double allowed = allowed_penetration(motion);
  if (motion.impacts.empty())
    return {model, Eigen::VectorXcd::Zero(model.poles()), 0.0, model.period(), allowed};
  const bool last = i + 1 == motion.impacts.size();
  const double begin = motion.impacts[i].time;
  const double end = last ? motion.impacts.front().time + 1.0 : motion.impacts[i + 1].time;
  return {model, motion.states.col(Index(i)), begin, (end - begin) * model.period(), allowed};
}

}  // namespace detail

ImpactMotion impact_motion(const ImpactsProblem& problem, const std::vector<ImpactGuess>& start,
                           const ImpactMotionOptions& options) {
  constexpr double smallest_step = 1e-6;
  problem.validate();
  options.validate();
  check_start(problem, start);
  const auto model = std::make_shared<const detail::ImpactModel>(problem);
  ImpactMotion found;
  if (!start.empty() && model->is_resonant()) {
    found.status = ImpactStatus::resonant;
    return found;
  }
  detail::ImpactUnknowns unknowns = detail::unknowns_of(*model, start);
  ImpactSystem system(*model, unknowns, options.observer);
  const detail::NewtonRun run =
      detail::damped_newton(system, unknowns.values, options.max_iterations, smallest_step);
  found.iterations = run.iterations;
  found.residual = system.largest();
  found.status = status_of(run.end);
  if (found.status != ImpactStatus::converged) return found;
  polish(system, unknowns.values);
  found.residual = system.largest();
  return detail::motion_of(model, unknowns, std::move(found));
}

namespace {

const detail::ImpactModel& model_of(const ImpactMotion& motion) {
  if (!motion.has_solution()) throw std::invalid_argument("ImpactMotion: there is no solution to evaluate");
  return *motion.model;
}

detail::ContactState motion_at(const ImpactMotion& motion, double time) {
  const detail::ImpactModel& model = model_of(motion);
  if (motion.impacts.empty()) return model.free_motion(time);
  const double share = within_period(time);
  const auto after = std::ranges::upper_bound(motion.impacts, share, {}, &Impact::time);
  const bool before_all = after == motion.impacts.begin();
  const auto last = before_all ? std::prev(motion.impacts.end()) : std::prev(after);
  const double since = share - last->time + (before_all ? 1.0 : 0.0);
  const Eigen::VectorXcd state = motion.states.col(last - motion.impacts.begin());
  return model.motion(model.growth(since * model.period()).cwiseProduct(state), share);
}

}  // namespace

Eigen::MatrixXd ImpactMotion::displacement(const Eigen::VectorXd& times) const {
  Eigen::MatrixXd values(model_of(*this).contacts(), times.size());
  for (Index k = 0; k < times.size(); ++k) values.col(k) = motion_at(*this, times[k]).displacement;
  return values;
}

Eigen::MatrixXd ImpactMotion::velocity(const Eigen::VectorXd& times) const {
  Eigen::MatrixXd values(model_of(*this).contacts(), times.size());
  for (Index k = 0; k < times.size(); ++k) values.col(k) = motion_at(*this, times[k]).velocity;
  return values;
}

double ImpactMotion::frequency() const { return model_of(*this).problem().frequency; }

double ImpactMotion::energy_lost() const {
  double sum = 0.0;
  for (const Impact& impact : impacts) sum += impact.energy_lost;
  return sum;
}

Eigen::MatrixXcd ImpactMotion::force_harmonics(int count) const {
  detail::require_at_least("ImpactMotion", "count", count, 1);
  const detail::ImpactModel& own = model_of(*this);
  Eigen::MatrixXcd harmonics = Eigen::MatrixXcd::Zero(own.contacts(), count);
  for (const Impact& impact : impacts)
    for (int n = 0; n < count; ++n)
      harmonics(impact.contact, n) += (n == 0 ? 1.0 : 2.0) * impact.impulse / own.period() *
                                      std::polar(1.0, -2.0 * std::numbers::pi * n * impact.time);
  return harmonics;
}

}  // namespace wavebalance::solvers
