#include "wavebalance/contact/coulomb_law.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "checks.hpp"
#include "friction_march.hpp"

namespace wavebalance::contact {
namespace {

using detail::FrictionMarch;
using detail::Pair;

Pair slider_of(const FrictionParameters& parameters) {
  Pair slider{};
  std::copy(parameters.slider.begin(), parameters.slider.end(), slider.begin());
  return slider;
}

double distance(const Pair& one, const Pair& other) {
  return std::hypot(one[0] - other[0], one[1] - other[1]);
}

// The force of two tangents before the first sample that a period brings back, by Newton's method on the
// period from where two periods lead. A contact that slips little forgets slowly without it.
void close_period(FrictionMarch& march) {
  constexpr int most = 30;
  constexpr double closed = 1e-14;
  for (int i = 0; i < most; ++i) {
    const Pair begin = march.force();
    march.forget();
    march.period(nullptr);
    const Pair end = march.force();
    const double size = std::max(std::hypot(end[0], end[1]), std::hypot(begin[0], begin[1]));
    if (march.stuck() || !(distance(begin, end) > closed * size)) return;
    const Pair change = march.closed_change({end[0] - begin[0], end[1] - begin[1]});
    march.set_force(march.within_limit({begin[0] + change[0], begin[1] + change[1]}));
  }
}

// A step of the tangents in series with flexibilities: f = return(f_before, k (travel - h f)).
struct SeriesStep {
  double stiffness, first_limit, last_limit;
  double share;  // of the step in contact
  Pair force, travel, flexibility;
};

Pair increment_for(const SeriesStep& step, const Pair& force) {
  return {step.stiffness * (step.travel[0] - step.flexibility[0] * force[0]),
          step.stiffness * (step.travel[1] - step.flexibility[1] * force[1])};
}

// Rigid friction in series with springs: v goes straight, and f = return(f_before, (v - v_before) / h).
Pair end_of_rigid(const SeriesStep& step, int tangents) {
  Pair increment{};
  for (std::size_t i = 0; i < static_cast<std::size_t>(tangents); ++i)
    increment[i] = step.share * (step.travel[i] / step.flexibility[i] - step.force[i]);
  return detail::return_mapping({step.force, increment, step.first_limit, step.last_limit}, tangents, false)
      .force;
}

// The cut at the limit commutes with the series.
Pair end_of_one(const SeriesStep& step) {
  const double increment = increment_for(step, step.force)[0] / (1.0 + step.stiffness * step.flexibility[0]);
  return detail::return_mapping({step.force, {increment, 0.0}, step.first_limit, step.last_limit}, 1, false)
      .force;
}

// The step is shortened by the force at its end, which is found by repetition: a contraction.
Pair end_of_two(const SeriesStep& step) {
  constexpr int most = 100;
  constexpr double settled = 1e-15;
  const double yielding = 1.0 + step.stiffness * std::max(step.flexibility[0], step.flexibility[1]);
  Pair force = step.force;
  for (int round = 0; round < most; ++round) {
    const Pair target =
        detail::return_mapping({step.force, increment_for(step, force), step.first_limit, step.last_limit}, 2,
                               false)
            .force;
    const Pair next{force[0] + (target[0] - force[0]) / yielding,
                    force[1] + (target[1] - force[1]) / yielding};
    const double change = distance(next, force);
    force = next;
    if (!(change > settled * step.last_limit)) break;
  }
  return force;
}

constexpr const char* who = "CoulombLaw";

void require_states(const CoulombLaw& law, bool has_normal) {
  detail::require_finite(who, "surface_speed", law.surface_speed());
  detail::require_at_least(who, "tangential_damping", law.tangential_damping(), 0.0, detail::Bound::closed);
  detail::require_at_least(who, "normal_damping", law.normal_damping(), 0.0, detail::Bound::closed);
  if (!(law.static_friction() >= law.friction()) || std::isinf(law.static_friction()))
    detail::reject(who, "static_friction", law.static_friction(),
                   "at least friction = " + detail::text(law.friction()));
  if (law.tangential_damping() > 0.0 && law.rigid())
    detail::reject(who, "tangential_damping", law.tangential_damping(),
                   "0 without tangential_stiffness, the spring parallel to it");
  if (law.normal_damping() > 0.0 && !has_normal)
    detail::reject(who, "normal_damping", law.normal_damping(),
                   "0 where there is no normal direction, whose spring it is beside");
  if (law.tangents() > 1 && law.needs_states())
    detail::reject(who, "tangents", law.tangents(),
                   "1 with surface_speed, static_friction, tangential_damping or normal_damping");
}

}  // namespace

CoulombLaw::CoulombLaw(FrictionParameters parameters, std::optional<LinearLaw> normal)
    : parameters_(std::move(parameters)), normal_(normal) {
  detail::require_at_least(who, "friction", parameters_.friction, 0.0, detail::Bound::closed);
  if (!std::isinf(parameters_.tangential_stiffness) || parameters_.tangential_stiffness < 0.0)
    detail::require_positive(who, "tangential_stiffness", parameters_.tangential_stiffness);
  detail::require_at_least(who, "normal_load", parameters_.normal_load, 0.0, detail::Bound::closed);
  if (parameters_.tangents < 1 || parameters_.tangents > 2)
    detail::reject(who, "tangents", parameters_.tangents, "1 or 2");
  if (!parameters_.slider.empty())
    detail::require_length(who, "slider", parameters_.slider.size(),
                           static_cast<std::size_t>(parameters_.tangents));
  for (const double position : parameters_.slider) detail::require_finite(who, "slider", position);
  if (!normal_ && !(parameters_.normal_load > 0.0))
    detail::reject(who, "normal_load", parameters_.normal_load,
                   "positive where there is no normal direction, since the limit is friction times it");
  if (parameters_.static_friction == 0.0) parameters_.static_friction = parameters_.friction;
  require_states(*this, normal_.has_value());
}

bool CoulombLaw::needs_states() const {
  return static_friction() > friction() || surface_speed() != 0.0 || tangential_damping() > 0.0 ||
         normal_damping() > 0.0;
}

void CoulombLaw::require_steps() const {
  if (needs_states())
    throw std::invalid_argument(
        "CoulombLaw: surface_speed, static_friction, tangential_damping and normal_damping have no steps over "
        "samples; expected none of them, or a solver that goes from event to event");
}

double CoulombLaw::raw_normal_force(double normal_displacement) const {
  if (!normal_) return parameters_.normal_load;
  return parameters_.normal_load + normal_->stiffness() * (normal_displacement - normal_->gap());
}

CoulombLaw CoulombLaw::resolvent(std::span<const double> flexibility) const {
  constexpr double rounding = 1e-12;
  require_steps();
  detail::require_length(who, "flexibility", flexibility.size(), static_cast<std::size_t>(rows()));
  for (const double one : flexibility) detail::require_positive(who, "flexibility", one);
  const std::span<const double> tangential = flexibility.subspan(static_cast<std::size_t>(normal_rows()));
  if (tangents() == 2 && std::abs(tangential[1] - tangential[0]) > rounding * tangential[0])
    detail::reject(who, "flexibility of the second tangent", tangential[1], "that of the first one");
  FrictionParameters series = parameters_;
  series.tangential_stiffness = 1.0 / (1.0 / tangential_stiffness() + tangential[0]);
  if (!normal_) return CoulombLaw(std::move(series));
  const double yielding = 1.0 + normal_stiffness() * flexibility[0];
  series.normal_load /= yielding;
  return CoulombLaw(std::move(series), LinearLaw(normal_stiffness() / yielding, normal_->gap()));
}

// The first period begins with the slider at rest. With one tangent the force at the end of a period is a
// translation and cuts of that at its start, the translations adding up to zero, so that a second period
// changes it no more.
FrictionPeriod CoulombLaw::over_period(int points, std::span<const double> displacement,
                                       bool with_slopes) const {
  if (rigid())
    throw std::invalid_argument(
        "CoulombLaw: rigid friction has no force at a displacement; take its resolvent, the force form");
  require_steps();
  detail::require_length("CoulombLaw", "displacement", displacement.size(),
                         static_cast<std::size_t>(points * rows()));
  FrictionMarch march(*this, points, displacement, with_slopes);
  march.begin(slider_of(parameters_));
  march.period(nullptr);
  if (tangents() == 2 && !march.stuck()) {
    march.period(nullptr);
    if (!march.stuck()) {
      close_period(march);
      march.close_memory();
    }
  }
  FrictionPeriod period;
  march.period(&period);
  period.history_dependent = march.stuck();
  return period;
}

void CoulombLaw::start(std::span<const double> v, std::span<const double> flexibility,
                       std::span<double> force) const {
  std::array<double, 3> before{};
  if (normal_) before[0] = v[0];
  const Pair slider = slider_of(parameters_);
  std::copy_n(slider.begin(), tangents(), before.begin() + normal_rows());
  std::fill(force.begin(), force.end(), 0.0);
  step(std::span(before).first(static_cast<std::size_t>(rows())), v, flexibility, force);
}

void CoulombLaw::advance(std::span<const double> before, std::span<const double> v,
                         std::span<const double> flexibility, std::span<double> force) const {
  require_steps();
  step(before, v, flexibility, force);
}

void CoulombLaw::step(std::span<const double> before, std::span<const double> v,
                      std::span<const double> flexibility, std::span<double> force) const {
  double share = 1.0, first = parameters_.normal_load, last = first;
  if (normal_) {
    const double was = raw_normal_force(before[0]);
    const double now = raw_normal_force(v[0]) / (1.0 + normal_->stiffness() * flexibility[0]);
    if (now > 0.0 && was <= 0.0) share = now / (now - was);
    first = std::max(0.0, was);
    last = force[0] = std::max(0.0, now);
  }
  const auto begin = static_cast<std::size_t>(normal_rows());
  SeriesStep step{share * tangential_stiffness(), friction() * first, friction() * last, share, {}, {}, {}};
  for (std::size_t i = 0; i < static_cast<std::size_t>(tangents()); ++i) {
    step.force[i] = force[begin + i];
    step.travel[i] = v[begin + i] - before[begin + i];
    step.flexibility[i] = flexibility[begin + i];
  }
  const Pair result = rigid()           ? end_of_rigid(step, tangents())
                      : tangents() == 1 ? end_of_one(step)
                                        : end_of_two(step);
  std::copy_n(result.begin(), tangents(), force.begin() + normal_rows());
}

LawDescription CoulombLaw::description() {
  return {
      .name = "coulomb",
      .force =
          "elastic Coulomb friction: along the tangents a spring tangential_stiffness in series "
          "with a slider of limit friction N; N = normal_load, or max(normal_load + "
          "normal_stiffness (u - normal_gap), 0) with a normal displacement u",
      .parameters =
          {{"friction", "", "coefficient of friction", LawRange{.lower = 0.0, .upper = 1e3}},
           may_lack({"tangential_stiffness", "N/m",
                     "stiffness along the tangents in stick; without it friction is rigid, and the contact "
                     "must be massless unless it is integrated in time",
                     above_zero}),
           with_default(
               {"normal_load", "N", "normal force at zero displacement; above 0 without a normal direction",
                at_least_zero},
               0.0),
           with_default({"normal_stiffness", "N/m",
                         "stiffness along the normal direction; 0: there is none, and the normal force is "
                         "normal_load",
                         at_least_zero},
                        0.0),
           with_default({"slider", "m", "position of the slider at rest, along every tangent"}, 0.0),
           with_default(
               {"wear_coefficient", "1/Pa", "wear volume per normal force and slip distance", at_least_zero},
               0.0),
           with_default({"tangents", "", "number of tangents", {.lower = 1.0, .upper = 2.0}}, 1.0),
           with_default({"normal_gap", "m", "normal displacement at which the normal spring has no force"},
                        0.0),
           may_lack({"static_friction", "",
                     "static coefficient of friction, at least friction; equal to friction if not given",
                     LawRange{.lower = 0.0, .upper = 1e3}}),
           may_lack({"surface_speed", "m/s",
                     "speed of the surface along the tangent, as of a belt or a journal; 0 if not given"}),
           may_lack({"tangential_damping", "N s/m", "dashpot parallel to the spring tangential_stiffness",
                     at_least_zero}),
           may_lack(
               {"normal_damping", "N s/m",
                "dashpot beside the spring normal_stiffness, of a contact that does not pull; without it "
                "none",
                at_least_zero}),
           may_lack(
               {"normal_load_speed2", "N s^2",
                "normal force per squared angular forcing frequency, in addition to normal_load: a mass times its "
                "radius",
                at_least_zero}),
           may_lack(file_parameter(
               "normal_load_table",
               "CSV file with the columns frequency_Hz and normal_load in N, in addition to normal_load and "
               "interpolated monotonically"))},
      .beyond_gap_alone = false};
}

CoulombLaw CoulombLaw::of(const LawValues& values) {
  constexpr double rigid = std::numeric_limits<double>::infinity();
  if (const double grows = number_or(values, "normal_load_speed2", 0.0); grows != 0.0)
    detail::reject("CoulombLaw", "normal_load_speed2", grows,
                   "0: a law is made at one frequency, at which it is part of normal_load");
  if (values.contains("normal_load_table"))
    throw LawFault(
        "normal_load_table",
        "CoulombLaw: normal_load_table is given; a law is made at one frequency, at which it is part "
        "of normal_load");
  FrictionParameters parameters{
      number_of(values, "friction"), number_or(values, "tangential_stiffness", rigid),
      number_of(values, "normal_load"), static_cast<int>(number_of(values, "tangents"))};
  parameters.slider.assign(static_cast<std::size_t>(parameters.tangents), number_of(values, "slider"));
  parameters.static_friction = number_or(values, "static_friction", 0.0);
  parameters.surface_speed = number_or(values, "surface_speed", 0.0);
  parameters.tangential_damping = number_or(values, "tangential_damping", 0.0);
  parameters.normal_damping = number_or(values, "normal_damping", 0.0);
  const double stiffness = number_of(values, "normal_stiffness");
  if (stiffness > 0.0) return CoulombLaw(parameters, LinearLaw(stiffness, number_of(values, "normal_gap")));
  return CoulombLaw(parameters);
}

}  // namespace wavebalance::contact
