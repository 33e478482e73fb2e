#include "continuation/milestones.hpp"

#include <algorithm>
#include <cmath>

namespace wavebalance::solvers {
namespace {

// Scaled arc lengths. The corrector leaves less than `same`, and no step within a piece that it accepts is
// longer than `away` while the curve is still at a milestone.
constexpr double same = 1e-6;
constexpr double away = 1e-4;

}  // namespace

double Milestones::inner(const Eigen::VectorXd& u, double p, const Eigen::VectorXd& v, double q) const {
  const double displacement = options_.displacement_scale, parameter = options_.parameter_scale;
  return (u / displacement).dot(v / displacement) / double(u.size()) + p * q / (parameter * parameter);
}

double Milestones::distance(const CurvePoint& a, const CurvePoint& b) const {
  const Eigen::VectorXd change = a.displacement - b.displacement;
  const double parameter = a.parameter - b.parameter;
  return std::sqrt(inner(change, parameter, change, parameter));
}

double Milestones::beyond(const CurvePoint& point, const CurvePoint& milestone) const {
  return inner(point.displacement - milestone.displacement, point.parameter - milestone.parameter,
               milestone.displacement_tangent, milestone.parameter_tangent);
}

bool Milestones::is_same(const CurvePoint& point, const CurvePoint& milestone) const {
  return distance(point, milestone) <= same &&
         inner(point.displacement_tangent, point.parameter_tangent, milestone.displacement_tangent,
               milestone.parameter_tangent) >= std::cos(options_.max_angle);
}

bool Milestones::meets(ArcLength& curve, const CurvePoint& milestone) const {
  if (is_same(curve.point(), milestone)) return true;
  if (beyond(curve.previous(), milestone) > 0.0 || beyond(curve.point(), milestone) < 0.0) return false;
  CurvePoint found;
  return curve.locate([&](const CurvePoint& point) { return beyond(point, milestone); }, found) &&
         is_same(found, milestone);
}

// A grazing event has one tangent before and another after it and is no milestone: the next point is.
void Milestones::pass(const CurvePoint& point, int count) {
  const bool due = milestones_.empty() || count >= 2 * milestones_.back().count;
  if (due && !point.grazing) milestones_.push_back({point, count, false});
}

std::optional<std::size_t> Milestones::returned(ArcLength& curve) {
  const double step = distance(curve.point(), curve.previous());
  for (std::size_t i = 0; i < milestones_.size(); ++i) {
    Milestone& milestone = milestones_[i];
    const double reach = distance(curve.point(), milestone.point);
    if (milestone.left && reach <= 1.5 * step + same && meets(curve, milestone.point)) return i;
    milestone.left = milestone.left || reach > away;
  }
  return std::nullopt;
}

void Milestones::resume(std::size_t index) {
  milestones_.resize(index + 1);
  for (Milestone& milestone : milestones_) milestone.left = &milestone != &milestones_.back();
}

}  // namespace wavebalance::solvers
