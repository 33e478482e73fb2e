#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include "flow/flow_engine.hpp"
#include "linalg/root.hpp"

namespace wavebalance::solvers {

// Closer at the beginning, where a state may end soon after an event.
ContactFlow::Engine::DensePoints::DensePoints() {
  constexpr int even = 33, close = 7;
  std::vector<std::pair<double, double>> points;
  for (int k = 0; k < even; ++k)
    points.emplace_back(-std::cos(std::numbers::pi * k / (even - 1)),
                        (k % 2 == 0 ? 1.0 : -1.0) * (k % (even - 1) == 0 ? 0.5 : 1.0));
  for (int k = 0; k < close; ++k) points.emplace_back(-1.0 + std::ldexp(1.0, -6 - 2 * k), 0.0);
  std::sort(points.begin(), points.end());
  at.resize(Index(points.size()));
  weight = at;
  for (Index k = 0; k < at.size(); ++k) std::tie(at[k], weight[k]) = points[std::size_t(k)];
}

double ContactFlow::Engine::DensePoints::interpolated(const std::vector<double>& values, double x) const {
  double sum = 0.0, weights = 0.0;
  for (Index k = 0; k < at.size(); ++k) {
    if (x == at[k]) return values[std::size_t(k)];
    sum += weight[k] / (x - at[k]) * values[std::size_t(k)];
    weights += weight[k] / (x - at[k]);
  }
  return sum / weights;
}

// The guard and its rate by x.
ContactFlow::Engine::GuardValue ContactFlow::Engine::guard_at(const Solved& panel, const Guard& guard,
                                                              double at) const {
  const detail::PoleWaves waves(poles_, nodes_, panel.shape->half(), Eigen::VectorXd::Constant(1, at));
  const detail::Signals signals = motion(*panel.shape).at(waves, panel.values);
  const detail::LocalValues local(contacts_, guard.contact, signals, 0);
  const Dual value =
      contacts_.law(guard.contact).guard(now_.state[std::size_t(guard.contact)], guard.exit, local.signals());
  return {value.value, panel.shape->half() *
                           detail::SlopeOfSignals{contacts_, guard.contact, value, 0.0}.rate(signals, 0)};
}

// A guard that a contact at rest keeps at zero is not as small as its values are.
double ContactFlow::Engine::scale_of(const Dual& guard, int rows) const {
  const double rate = 2.0 * std::numbers::pi / poles_.period();
  const std::array<double, 4> scales{length_, length_ * rate, length_ * rate * rate, force_size_};
  double sum = 0.0;
  for (std::size_t k = 0; k < scales.size(); ++k)
    for (int i = 0; i < rows; ++i)
      sum += std::abs(guard.slope[k * std::size_t(rows) + std::size_t(i)]) * scales[k];
  return sum;
}

double ContactFlow::Engine::clear_of(const Guard& guard) const {
  constexpr double rounding = 1e-11;
  const int state = now_.state[std::size_t(guard.contact)];
  return rounding * size_.at({guard.contact, 64 * state + guard.exit});
}

ContactFlow::Engine::GuardSamples ContactFlow::Engine::sample_guard(const Solved& panel,
                                                                    const detail::Signals& dense,
                                                                    detail::LocalValues& local,
                                                                    const Guard& guard) {
  const Index c = guard.contact;
  const int state = now_.state[std::size_t(c)];
  const LawMachine& law = contacts_.law(c);
  const Index first = panel.shape->nodes() + 1;
  GuardSamples samples;
  double& size = size_[{c, 64 * state + guard.exit}];
  for (Index k = 0; k < dense_.at.size(); ++k) {
    local.move_to(dense, first + k);
    const Dual value = law.guard(state, guard.exit, local.signals());
    samples.value.push_back(value.value);
    samples.rate.push_back(panel.shape->half() *
                           detail::SlopeOfSignals{contacts_, c, value, 0.0}.rate(dense, first + k));
    size = std::max({size, std::abs(value.value), k == 0 ? scale_of(value, law.rows()) : 0.0});
    if (k == 0 && law.remembers(state) && law.memories() == 1)
      samples.by_memory = value.slope[std::size_t(4 * law.rows())];
  }
  samples.clear = clear_of(guard);
  return samples;
}

// Where a guard vanishes between two places at which it has different signs. The interpolant of the dense
// points is exact but for modes that decay within a panel: a step or two of Newton's method from its root
// are, too, or the guard itself is bracketed.
std::optional<double> ContactFlow::Engine::root_of(const Solved& panel, const Guard& guard,
                                                   const GuardSamples& samples, detail::Sample a,
                                                   detail::Sample b) const {
  constexpr double rounding = 1e-14, settled = 1e-9;
  constexpr int steps = 3;
  const auto rough =
      detail::root([&](double x) { return dense_.interpolated(samples.value, x); }, a, b, rounding);
  double x = rough.value_or(a.at);
  for (int n = 0; rough && n < steps; ++n) {
    const GuardValue now = guard_at(panel, guard, x);
    const double step = -now.value / now.rate;
    if (!(x + step >= std::min(a.at, b.at) && x + step <= std::max(a.at, b.at))) break;
    x += step;
    if (std::abs(step) < settled) return x;
  }
  return detail::root([&](double at) { return guard_at(panel, guard, at).value; }, a, b, rounding);
}

// Where a guard first goes below zero between two points at which it is positive, if it does: a touch that
// the points miss. Its cubic shows whether it comes near.
std::optional<double> ContactFlow::Engine::touch(const Solved& panel, const Guard& guard,
                                                 const GuardSamples& samples, std::size_t k) const {
  const double low = dense_.at[Index(k)], width = dense_.at[Index(k) + 1] - low, a = samples.value[k],
               b = samples.value[k + 1], u = width * samples.rate[k], v = width * samples.rate[k + 1];
  if (!(u < 0.0 && v > 0.0)) return std::nullopt;
  const double c2 = 3.0 * (b - a) - 2.0 * u - v, c3 = u + v - 2.0 * (b - a),
               lowest = -u / (c2 + std::sqrt(c2 * c2 - 3.0 * c3 * u)),
               least = a + lowest * (u + lowest * (c2 + lowest * c3));
  constexpr double near = 0.2;
  if (least > near * std::min(a, b)) return std::nullopt;
  const auto at = [&](double t) { return guard_at(panel, guard, low + t * width).value; };
  const auto rate = [&](double t) { return guard_at(panel, guard, low + t * width).rate; };
  const auto deepest = detail::root(rate, {0.0, u}, {1.0, v}, 1e-9);
  if (!deepest || at(*deepest) >= -samples.clear) return std::nullopt;
  return root_of(panel, guard, samples, {low, a}, {low + *deepest * width, at(*deepest)});
}

// Guards that vanish at the beginning, behind an event, count by their first clear value. Nothing where that
// is after `until`.
std::optional<double> ContactFlow::Engine::hit_of(const Solved& panel, const detail::Signals& dense,
                                                  detail::LocalValues& local, const Guard& guard,
                                                  double until) {
  const GuardSamples samples = sample_guard(panel, dense, local, guard);
  if (options_.margins && contacts_.law(guard.contact).remembers(now_.state[std::size_t(guard.contact)]))
    at_rest_[{guard.contact, guard.exit}] = samples;
  const std::vector<double>& g = samples.value;
  const auto is_clear = [&](std::size_t k) { return std::abs(g[k]) > samples.clear; };
  std::size_t k = 0;
  while (k < g.size() && !is_clear(k)) ++k;
  // A value slightly below zero after an event that does not fall counts as zero; so does the velocity of a
  // contact that stuck, which a perturbation or rounding causes.
  const bool from_stick = !events_.empty() && events_.back().contact == int(guard.contact) &&
                          events_.back().time == time_ &&
                          contacts_.law(guard.contact).kind(events_.back().from) == ContactState::stick;
  if (k == 0 && g[0] < 0.0 && (from_stick || g[0] > -left_over * samples.clear)) {
    std::size_t next = 0;
    while (next < g.size() && g[next] < samples.clear && g[next] >= g[0] - samples.clear) ++next;
    if (next == g.size() || g[next] >= samples.clear) k = next;
  }
  if (k == g.size()) return std::nullopt;
  if (g[k] < 0.0) {
    double largest_rate = 0.0;
    for (const double rate : samples.rate) largest_rate = std::max(largest_rate, std::abs(rate));
    if (k == 0 || samples.rate[0] <= 1e-9 * largest_rate) return -1.0;
    double low = dense_.at[Index(k)], at_low = g[k];
    while ((at_low = guard_at(panel, guard, low).value) <= 0.0) {
      low = -1.0 + 0.5 * (low + 1.0);
      if (low + 1.0 < 1e-13) return -1.0;
    }
    return root_of(panel, guard, samples, {low, at_low}, {dense_.at[Index(k)], g[k]});
  }
  for (std::size_t last = k++; k < g.size() && dense_.at[Index(last)] < until; ++k) {
    if (!is_clear(k)) continue;
    if (g[k] < 0.0)
      return root_of(panel, guard, samples, {dense_.at[Index(last)], g[last]}, {dense_.at[Index(k)], g[k]});
    if (last + 1 == k)
      if (const auto touched = touch(panel, guard, samples, last)) return touched;
    last = k;
  }
  return std::nullopt;
}

std::optional<ContactFlow::Engine::Hit> ContactFlow::Engine::first_hit(const Solved& panel,
                                                                       const detail::Signals& dense,
                                                                       double until) {
  at_rest_.clear();
  std::optional<Hit> best;
  for (Index c = 0; c < contacts_.count(); ++c) {
    detail::LocalValues local(contacts_, c, dense, 0);
    const int exits = int(contacts_.law(c).exits(now_.state[std::size_t(c)]).size());
    for (int exit = 0; exit < exits; ++exit) {
      const Guard guard{c, exit};
      const auto at = hit_of(panel, dense, local, guard, best ? best->at : until);
      if (at && (!best || *at < best->at)) best = Hit{*at, guard};
    }
  }
  return best;
}

// By Gauss's rule on the part of the panel that is kept.
void ContactFlow::Engine::measure(const detail::Signals& dense, const Solved& panel, double end) {
  const double length = panel.shape->half() * (end + 1.0);
  const auto integral = [&](const std::vector<double>& values) {
    double mean = 0.0;
    for (Index k = 0; k < nodes_.count(); ++k)
      mean += nodes_.coefficients(0, k) *
              dense_.interpolated(values, 0.5 * (end + 1.0) * (nodes_.points[k] + 1.0) - 1.0);
    return length * mean;
  };
  for (Index c = 0; c < contacts_.count(); ++c) {
    const int state = now_.state[std::size_t(c)];
    const ContactState kind = contacts_.law(c).kind(state);
    FrictionCycle& cycle = cycles_[std::size_t(c)];
    cycle.share(kind) += length;
    if (kind != ContactState::stick && kind != ContactState::slip) continue;
    std::array<std::vector<double>, 3> values;
    detail::LocalValues local(contacts_, c, dense, 0);
    for (Index k = 0; k < dense_.at.size(); ++k) {
      local.move_to(dense, panel.shape->nodes() + 1 + k);
      const Sliding now = contacts_.law(c).sliding(state, local.signals());
      values[0].push_back(now.power);
      values[1].push_back(now.speed);
      values[2].push_back(now.wear);
    }
    cycle.work += integral(values[0]);
    if (kind == ContactState::stick) continue;
    cycle.slip += integral(values[1]);
    cycle.wear += integral(values[2]);
  }
}

// The least values of the guards by which sliders at rest would leave it: between the dense points of the
// part that is kept where their rate vanishes.
void ContactFlow::Engine::keep_margins(double end) {
  for (const auto& entry : at_rest_) {
    const GuardSamples& samples = entry.second;
    Margin& margin =
        margins_.try_emplace(entry.first, Margin{samples.value[0], samples.by_memory}).first->second;
    for (std::size_t k = 0; k < samples.value.size() && dense_.at[Index(k)] <= end; ++k) {
      margin.least = std::min(margin.least, samples.value[k]);
      if (k == 0 || !(samples.rate[k - 1] < 0.0 && samples.rate[k] > 0.0)) continue;
      const auto lowest = detail::root([&](double x) { return dense_.interpolated(samples.rate, x); },
                                       {dense_.at[Index(k) - 1], samples.rate[k - 1]},
                                       {dense_.at[Index(k)], samples.rate[k]}, 1e-9);
      if (lowest) margin.least = std::min(margin.least, dense_.interpolated(samples.value, *lowest));
    }
  }
}

bool ContactFlow::Engine::changed(Index c) const {
  return std::any_of(events_.begin(), events_.end(),
                     [&](const FlowEvent& event) { return event.contact == int(c); });
}

Eigen::MatrixXd ContactFlow::Engine::held() const {
  const double rate = 2.0 * std::numbers::pi / poles_.period();
  Eigen::MatrixXd result(0, poles_.states() + contacts_.memories());
  for (Index c = 0; c < contacts_.count(); ++c) {
    const LawMachine& law = contacts_.law(c);
    const int state = now_.state[std::size_t(c)];
    if (changed(c) || law.kind(state) != ContactState::stick || law.remembers(state)) continue;
    const Index row = contacts_.row(c) + law.rows() - 1, next = result.rows();
    result.conservativeResize(next + 2, Eigen::NoChange);
    result.bottomRows(2).setZero();
    result.row(next).head(poles_.states()) = poles_.real_outputs(0).row(row);
    result.row(next + 1).head(poles_.states()) = poles_.real_outputs(1).row(row) / rate;
  }
  return result;
}

// A slider by which the guards of its two exits are equally near to zero lies in the middle.
Eigen::VectorXd ContactFlow::Engine::off_center() const {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(contacts_.memories());
  for (Index c = 0; c < contacts_.count(); ++c) {
    if (changed(c) || !contacts_.law(c).remembers(now_.state[std::size_t(c)])) continue;
    double up = 0.0, down = 0.0, stiffness = 0.0;
    for (auto it = margins_.lower_bound({c, 0}); it != margins_.end() && it->first.first == c; ++it) {
      const Margin& margin = it->second;
      if (margin.by_memory > 0.0) up = margin.least;
      if (margin.by_memory < 0.0) down = margin.least;
      stiffness += std::abs(margin.by_memory);
    }
    if (stiffness > 0.0) result[contacts_.memory_begin(c)] = (up - down) / stiffness;
  }
  return result;
}

}  // namespace wavebalance::solvers
