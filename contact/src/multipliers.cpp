#include "wavebalance/contact/multipliers.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>

#include "checks.hpp"

namespace wavebalance::contact {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

void require_finite_entries(const char* array, std::span<const double> values) {
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i]))
      detail::require_finite("MultiplierUpdate", (array + ("[" + std::to_string(i) + "]")).c_str(),
                             values[i]);
}

// Violation of a constraint g <= 0: positive where g > 0, negative where g < 0 although the multiplier is not
// zero.
double violation_of(double g, double theta) { return std::isnan(g) || g > -theta ? g : -theta; }

std::vector<double> products(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> result(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) result[i] = a[i] * b[i];
  return result;
}

}  // namespace

double powell_measure(std::span<const double> g, std::span<const double> theta) {
  detail::require_length("powell_measure", "theta", theta.size(), g.size());
  double measure = 0.0;
  for (std::size_t i = 0; i < g.size(); ++i)
    measure = detail::larger(measure, std::abs(violation_of(g[i], theta[i])));
  return measure;
}

double powell_measure(std::span<const double> h) {
  double measure = 0.0;
  for (double value : h) measure = detail::larger(measure, std::abs(value));
  return measure;
}

void MultiplierOptions::validate() const {
  detail::require_at_least("MultiplierOptions", "improvement", improvement, 1.0, detail::Bound::open);
  detail::require_at_least("MultiplierOptions", "growth", growth, 1.0, detail::Bound::open);
  detail::require_positive("MultiplierOptions", "inequality_tolerance", inequality_tolerance);
  detail::require_positive("MultiplierOptions", "equality_tolerance", equality_tolerance);
  detail::require_at_least("MultiplierOptions", "largest_growth", largest_growth, 1.0, detail::Bound::closed);
}

bool MultiplierStep::converged() const {
  return inequality == MultiplierAction::satisfied && equality == MultiplierAction::satisfied;
}

bool MultiplierStep::stalled() const {
  const auto idle = [](MultiplierAction action) {
    return action == MultiplierAction::satisfied || action == MultiplierAction::stalled;
  };
  return !converged() && idle(inequality) && idle(equality);
}

MultiplierUpdate::MultiplierUpdate(std::vector<double> inequality_penalties,
                                   std::vector<double> equality_penalties, MultiplierOptions options)
    : options_(options) {
  options_.validate();
  inequality_ = make_family("inequality_penalties", std::move(inequality_penalties));
  equality_ = make_family("equality_penalties", std::move(equality_penalties));
}

MultiplierUpdate::Family MultiplierUpdate::make_family(const char* name,
                                                       std::vector<double> penalties) const {
  Family family;
  for (std::size_t i = 0; i < penalties.size(); ++i) {
    const std::string entry = std::string(name) + "[" + std::to_string(i) + "]";
    detail::require_positive("MultiplierUpdate", entry.c_str(), penalties[i]);
    family.largest_penalty.push_back(detail::saturate(penalties[i] * options_.largest_growth));
  }
  family.shift.assign(penalties.size(), 0.0);
  family.penalty = std::move(penalties);
  family.reference = infinity;
  return family;
}

std::vector<double> MultiplierUpdate::inequality_multipliers() const {
  return products(inequality_.penalty, inequality_.shift);
}

std::vector<double> MultiplierUpdate::equality_multipliers() const {
  return products(equality_.penalty, equality_.shift);
}

double MultiplierUpdate::inequality_term(std::span<const double> g) const {
  detail::require_length("MultiplierUpdate::inequality_term", "g", g.size(), inequality_.shift.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < g.size(); ++i) {
    const double positive = detail::larger(0.0, g[i] + inequality_.shift[i]);
    sum += inequality_.penalty[i] * positive * positive;
  }
  return 0.5 * sum;
}

void MultiplierUpdate::inequality_force(std::span<const double> g, std::span<double> force,
                                        std::span<double> tangent) const {
  const std::size_t count = inequality_.shift.size();
  detail::require_length("MultiplierUpdate::inequality_force", "g", g.size(), count);
  detail::require_length("MultiplierUpdate::inequality_force", "force", force.size(), count);
  detail::require_length("MultiplierUpdate::inequality_force", "tangent", tangent.size(), count);
  for (std::size_t i = 0; i < count; ++i) {
    const double shifted = g[i] + inequality_.shift[i];
    force[i] = inequality_.penalty[i] * detail::larger(0.0, shifted);
    tangent[i] = shifted < 0.0 ? 0.0 : inequality_.penalty[i];
  }
}

double MultiplierUpdate::equality_term(std::span<const double> h) const {
  detail::require_length("MultiplierUpdate::equality_term", "h", h.size(), equality_.shift.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < h.size(); ++i) {
    const double shifted = h[i] + equality_.shift[i];
    sum += equality_.penalty[i] * shifted * shifted;
  }
  return 0.5 * sum;
}

void MultiplierUpdate::equality_force(std::span<const double> h, std::span<double> force) const {
  detail::require_length("MultiplierUpdate::equality_force", "h", h.size(), equality_.shift.size());
  detail::require_length("MultiplierUpdate::equality_force", "force", force.size(), equality_.shift.size());
  for (std::size_t i = 0; i < h.size(); ++i) force[i] = equality_.penalty[i] * (h[i] + equality_.shift[i]);
}

MultiplierStep MultiplierUpdate::update(std::span<const double> g, std::span<const double> h) {
  detail::require_length("MultiplierUpdate::update", "g", g.size(), inequality_.shift.size());
  detail::require_length("MultiplierUpdate::update", "h", h.size(), equality_.shift.size());
  require_finite_entries("g", g);
  require_finite_entries("h", h);
  MultiplierStep step;
  step.inequality_measure = powell_measure(g, inequality_.shift);
  step.equality_measure = powell_measure(h);
  std::vector<double> violation(g.size());
  for (std::size_t i = 0; i < g.size(); ++i) violation[i] = violation_of(g[i], inequality_.shift[i]);
  step.inequality = advance(inequality_, violation, step.inequality_measure, options_.inequality_tolerance);
  step.equality = advance(equality_, h, step.equality_measure, options_.equality_tolerance);
  return step;
}

// [LL10, Algorithm 3, lines 11-21 and 23-32]. Violations are those before the update.
MultiplierAction MultiplierUpdate::advance(Family& family, std::span<const double> violation, double measure,
                                           double tolerance) const {
  if (measure < tolerance) return MultiplierAction::satisfied;
  const double previous = family.reference, threshold = previous / options_.improvement;
  if (measure >= previous)
    return increase_penalties(family, violation, threshold) ? MultiplierAction::penalties_increased
                                                            : MultiplierAction::stalled;
  family.reference = measure;
  for (std::size_t i = 0; i < violation.size(); ++i) family.shift[i] += violation[i];
  if (measure >= threshold && increase_penalties(family, violation, threshold))
    return MultiplierAction::multipliers_and_penalties_updated;
  return MultiplierAction::multipliers_updated;
}

// Increases the penalties of the constraints that eq. (26) selects and keeps their multipliers kappa theta.
// Returns false if all of these penalties are at their largest value.
bool MultiplierUpdate::increase_penalties(Family& family, std::span<const double> violation,
                                          double threshold) const {
  bool increased = false;
  for (std::size_t i = 0; i < violation.size(); ++i) {
    if (std::abs(violation[i]) < threshold || family.penalty[i] >= family.largest_penalty[i]) continue;
    const double penalty = std::min(options_.growth * family.penalty[i], family.largest_penalty[i]);
    family.shift[i] *= family.penalty[i] / penalty;
    family.penalty[i] = penalty;
    increased = true;
  }
  return increased;
}

void MultiplierUpdate::restart(std::span<const double> inequality_multipliers,
                               std::span<const double> equality_multipliers) {
  const bool keep = inequality_multipliers.empty() && equality_multipliers.empty();
  if (!keep) {
    detail::require_length("MultiplierUpdate::restart", "inequality_multipliers",
                           inequality_multipliers.size(), inequality_.shift.size());
    detail::require_length("MultiplierUpdate::restart", "equality_multipliers", equality_multipliers.size(),
                           equality_.shift.size());
    for (double multiplier : inequality_multipliers)
      detail::require_at_least("MultiplierUpdate::restart", "inequality_multipliers", multiplier, 0.0,
                               detail::Bound::closed);
    require_finite_entries("equality_multipliers", equality_multipliers);
    for (std::size_t i = 0; i < inequality_multipliers.size(); ++i)
      inequality_.shift[i] = inequality_multipliers[i] / inequality_.penalty[i];
    for (std::size_t i = 0; i < equality_multipliers.size(); ++i)
      equality_.shift[i] = equality_multipliers[i] / equality_.penalty[i];
  }
  inequality_.reference = infinity;
  equality_.reference = infinity;
}

}  // namespace wavebalance::contact
