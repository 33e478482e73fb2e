#include "wavebalance/solvers/impacts/impact_curve.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>

#include "impacts/impact_events.hpp"
#include "impacts/impact_switch.hpp"
#include "linalg/index.hpp"
#include "linalg/option_checks.hpp"
#include "wavebalance/solvers/impacts/impact_stability.hpp"

namespace wavebalance::solvers {

void ImpactCurveOptions::validate() const {
  const char* who = "ImpactCurveOptions";
  if (!std::isfinite(from)) detail::reject(who, "from", from, "finite");
  if (!std::isfinite(to) || to == from) detail::reject(who, "to", to, "finite and other than from");
  if (!(std::isfinite(parameter_scale) && parameter_scale >= 0.0))
    detail::reject(who, "parameter_scale", parameter_scale, "finite and at least 0");
  detail::require_at_least(who, "periods", periods, 1);
  detail::require_positive(who, "first_step", first_step);
  detail::require_positive(who, "largest_step", largest_step);
  detail::require_positive(who, "smallest_step", smallest_step);
  detail::require_positive(who, "largest_turn", largest_turn);
  detail::require_at_least(who, "max_points", max_points, 2);
  detail::require_at_least(who, "max_impacts", max_impacts, 1);
}

namespace {

using detail::ImpactPath, detail::ImpactPathScales, detail::ImpactPlace, detail::ImpactSwitch;

// Follows one curve from a place with a tangent.
class ImpactTracer {
 public:
  // Whether a curve ends between two places of one path.
  using Ends = std::function<bool(const ImpactPlace&, const ImpactPlace&)>;

  ImpactTracer(const ImpactFamily& family, const ImpactCurveOptions& options, const ImpactPathScales& scales,
               ImpactCurve& curve, Ends ends = {})
      : family_(family),
        options_(options),
        scales_(scales),
        curve_(curve),
        ends_(std::move(ends)),
        step_(options.first_step) {}

  void run(std::unique_ptr<ImpactPath> path, ImpactPlace first) {
    path_ = std::move(path);
    start_ = first.point;
    start_contacts_ = path_->contacts();
    Eigen::VectorXcd multipliers = multipliers_of(first.motion);
    accept(std::move(first), std::move(multipliers));
    while (curve_.status == SweepStatus::no_start) {
      const int count = static_cast<int>(curve_.points.size());
      if (count >= options_.max_points)
        curve_.status = SweepStatus::point_limit;
      else if (!goes_on(options_.observer, {"curve with impacts", count, last_.point.parameter}))
        curve_.status = SweepStatus::cancelled;
      else
        advance();
    }
  }

 private:
  bool within(double value) const {
    return value >= std::min(options_.from, options_.to) && value <= std::max(options_.from, options_.to);
  }

  void advance() {
    constexpr int few = 4;
    int corrections = 0;
    const double step = step_;
    const std::optional<ImpactPlace> next = path_->ahead(last_.point, step, &corrections);
    if (!next || turn_to(*next) > options_.largest_turn || !follow(*next, step)) {
      step_ = 0.5 * step;
      if (step_ < options_.smallest_step) curve_.status = SweepStatus::lost;
      return;
    }
    if (corrections <= few && step_ == step) step_ = std::min(options_.largest_step, 1.5 * step);
  }

  // The angle between the tangents of the last place and the next one.
  double turn_to(const ImpactPlace& next) const {
    return std::acos(std::clamp(path_->inner(last_.point, next.point), -1.0, 1.0));
  }

  // Takes a step to the next place or, where that is no motion of the structure, to the switch before it.
  bool follow(const ImpactPlace& next, double step) {
    if (next.motion.converged()) return within(next.point.parameter) ? go_to(next, step) : end_before(next);
    std::optional<ImpactSwitch> over = detail::impact_switch({family_, scales_, *path_, last_, next});
    if (!over) return false;
    if (!within(over->place.point.parameter)) return end_before(next);
    go_over(std::move(*over), step);
    return true;
  }

  bool go_to(const ImpactPlace& next, double step) {
    Eigen::VectorXcd multipliers = multipliers_of(next.motion);
    for (ImpactEvent& event : detail::impact_events(*path_, last_, next, step, multipliers_, multipliers)) {
      event.next_point = curve_.points.size();
      curve_.events.push_back(std::move(event));
    }
    if (ends_ && ends_(last_, next)) {
      curve_.status = SweepStatus::ended;
      return true;
    }
    if (is_back(next, step)) curve_.status = SweepStatus::closed;
    accept(next, std::move(multipliers));
    return true;
  }

  // Whether the curve passes its first point in the same direction.
  bool is_back(const ImpactPlace& next, double step) const {
    constexpr std::size_t few = 8;
    if (curve_.points.size() < few || path_->contacts() != start_contacts_) return false;
    const CurvePoint way = ImpactPath::chord(last_.point, start_),
                     rest = ImpactPath::chord(next.point, start_);
    const double before = path_->inner(way, last_.point), after = path_->inner(rest, next.point);
    return before > 0.0 && after <= 0.0 && path_->inner(way, way) <= 4.0 * step * step &&
           path_->inner(start_, next.point) > 0.0;
  }

  Eigen::VectorXcd multipliers_of(const ImpactMotion& motion) const {
    return options_.stability ? impact_multipliers(motion) : Eigen::VectorXcd();
  }

  void accept(ImpactPlace place, Eigen::VectorXcd multipliers) {
    ImpactPoint& added = curve_.points.emplace_back();
    added.value = place.point.parameter;
    added.motion = place.motion;
    added.slope = place.point.parameter_tangent;
    added.multipliers = multipliers;
    if (multipliers.size() > 0) added.unstable = unstable_count(multipliers);
    last_ = std::move(place);
    multipliers_ = std::move(multipliers);
  }

  // The last point, where the curve leaves the interval before a place of its path.
  bool end_before(const ImpactPlace& beyond) {
    const double low = std::min(options_.from, options_.to), high = std::max(options_.from, options_.to);
    const double from = last_.point.parameter, way = beyond.point.parameter - from;
    const double value = way < 0.0 ? low : high, share = (value - from) / way;
    if (!(share >= 0.0 && share <= 1.0)) return false;
    CurvePoint start = last_.point;
    start.displacement += share * (beyond.point.displacement - start.displacement);
    std::optional<ImpactPlace> place = path_->at_value(start, value);
    if (!place || !place->motion.converged() || !path_->set_tangent(place->point, last_.point)) return false;
    go_to(*place, path_->inner(ImpactPath::chord(last_.point, place->point), last_.point));
    if (curve_.status == SweepStatus::no_start)
      curve_.status = value == options_.to ? SweepStatus::reached_end : SweepStatus::returned;
    return true;
  }

  void go_over(ImpactSwitch over, double step) {
    const bool turns = over.place.point.parameter_tangent * last_.point.parameter_tangent < 0.0;
    if (over.grazing)
      curve_.events.push_back({SpecialPointType::grazing,
                               over.place.point.parameter,
                               {missing, missing},
                               over.place.motion,
                               curve_.points.size(),
                               turns});
    // With an impact more the multipliers are infinite there.
    const bool fewer = over.path->contacts().size() < path_->contacts().size();
    if (over.path->contacts().size() > std::size_t(options_.max_impacts)) curve_.status = SweepStatus::lost;
    multipliers_ = fewer ? multipliers_of(over.place.motion) : Eigen::VectorXcd();
    path_ = std::move(over.path);
    last_ = std::move(over.place);
    step_ = std::min(step, options_.first_step);
  }

  const ImpactFamily& family_;
  const ImpactCurveOptions& options_;
  const ImpactPathScales& scales_;
  ImpactCurve& curve_;
  Ends ends_;
  std::unique_ptr<ImpactPath> path_;
  ImpactPlace last_;
  Eigen::VectorXcd multipliers_;  // at last_
  CurvePoint start_;
  std::vector<int> start_contacts_;
  double step_;
};

ImpactPathScales scales_of(const ImpactMotion& first, const ImpactCurveOptions& options) {
  ImpactPathScales scales;
  scales.periods = options.periods;
  scales.impulse = detail::impulse_scale_of(*first.model);
  scales.parameter =
      options.parameter_scale > 0.0 ? options.parameter_scale : std::abs(options.to - options.from) / 20.0;
  return scales;
}

std::vector<int> contacts_of(const std::vector<Impact>& impacts) {
  std::vector<int> contacts;
  for (const Impact& impact : impacts) contacts.push_back(impact.contact);
  return contacts;
}

// The first place, with its tangent towards options.to.
std::optional<ImpactPlace> first_place(ImpactPath& path, const ImpactMotion& first,
                                       const ImpactCurveOptions& options, const ImpactPathScales& scales) {
  CurvePoint start;
  start.displacement = path.unknowns_of(first.impacts);
  start.parameter = options.from;
  std::optional<ImpactPlace> place = path.at_value(start, options.from);
  if (!place || !place->motion.converged()) return std::nullopt;
  CurvePoint along = place->point;
  along.displacement_tangent = Eigen::VectorXd::Zero(along.displacement.size());
  along.parameter_tangent = options.to > options.from ? scales.parameter : -scales.parameter;
  if (!path.set_tangent(place->point, along)) return std::nullopt;
  return place;
}

// The motion over twice its period, one after the other.
std::vector<Impact> twice(const std::vector<Impact>& impacts) {
  std::vector<Impact> all;
  for (const double begin : {0.0, 0.5})
    for (Impact impact : impacts) {
      impact.time = begin + 0.5 * impact.time;
      all.push_back(impact);
    }
  return all;
}

// What differs between both halves of the period.
Eigen::VectorXd difference_of_halves(const CurvePoint& at) {
  const Index half = at.displacement.size() / 4;
  Eigen::VectorXd difference(2 * half);
  difference << at.displacement.segment(half, half) - at.displacement.head(half),
      at.displacement.tail(half) - at.displacement.segment(2 * half, half);
  difference.head(half).array() -= 0.5;
  return difference;
}

bool halves_pass_each_other(const ImpactPlace& last, const ImpactPlace& next) {
  return last.point.displacement.size() == next.point.displacement.size() &&
         last.point.displacement.size() % 4 == 0 &&
         difference_of_halves(last.point).dot(difference_of_halves(next.point)) < 0.0;
}

}  // namespace

ImpactCurve impact_curve(const ImpactFamily& family, const ImpactMotion& first,
                         const ImpactCurveOptions& options) {
  options.validate();
  if (!first.converged()) throw std::invalid_argument("impact_curve: the first motion has not converged");
  const ImpactPathScales scales = scales_of(first, options);
  auto path = std::make_unique<ImpactPath>(family, scales, contacts_of(first.impacts));
  std::optional<ImpactPlace> place = first_place(*path, first, options, scales);
  if (!place)
    throw std::invalid_argument("impact_curve: near the first motion the family has none at options.from");
  ImpactCurve curve;
  ImpactTracer(family, options, scales, curve).run(std::move(path), std::move(*place));
  return curve;
}

ImpactCurve doubled_curve(const ImpactFamily& family, const ImpactEvent& event, ImpactCurveOptions options) {
  if (event.type != SpecialPointType::period_doubling)
    throw std::invalid_argument("doubled_curve: the event is no period doubling");
  options.periods *= 2;
  options.validate();
  const ImpactPathScales scales = scales_of(event.motion, options);
  const std::vector<Impact> impacts = twice(event.motion.impacts);
  auto path = std::make_unique<ImpactPath>(family, scales, contacts_of(impacts));
  CurvePoint start;
  start.displacement = path->unknowns_of(impacts);
  start.parameter = event.value;
  ImpactCurve curve;
  std::optional<ImpactPlace> place = path->at_value(start, event.value);
  if (!place) return curve;
  place->point.displacement_tangent = path->null_direction();
  place->point.parameter_tangent = 0.0;
  path->normalize(place->point);
  std::optional<ImpactPlace> first = path->ahead(place->point, options.first_step);
  if (!first || !first->motion.converged()) return curve;
  ImpactTracer(family, options, scales, curve, halves_pass_each_other)
      .run(std::move(path), std::move(*first));
  return curve;
}

}  // namespace wavebalance::solvers
