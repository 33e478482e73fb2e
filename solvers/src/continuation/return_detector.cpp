#include "continuation/return_detector.hpp"

#include <algorithm>
#include <cmath>

namespace wavebalance::solvers {
namespace {

// Scaled arc lengths. The corrector leaves less than `same`, and no step within a piece that it accepts is
// longer than `away` while the curve is still at a kept point.
constexpr double same = 1e-6;
constexpr double away = 1e-4;

}  // namespace

double ReturnDetector::inner(const Eigen::VectorXd& u, double p, const Eigen::VectorXd& v, double q) const {
  const double displacement = options_.displacement_scale, parameter = options_.parameter_scale;
  return (u / displacement).dot(v / displacement) / double(u.size()) + p * q / (parameter * parameter);
}

double ReturnDetector::distance(const CurvePoint& a, const CurvePoint& b) const {
  const Eigen::VectorXd change = a.displacement - b.displacement;
  const double parameter = a.parameter - b.parameter;
  return std::sqrt(inner(change, parameter, change, parameter));
}

double ReturnDetector::beyond(const CurvePoint& point, const CurvePoint& kept) const {
  return inner(point.displacement - kept.displacement, point.parameter - kept.parameter,
               kept.displacement_tangent, kept.parameter_tangent);
}

double ReturnDetector::cosine(const CurvePoint& a, const CurvePoint& b) const {
  const auto product = [this](const CurvePoint& x, const CurvePoint& y) {
    return inner(x.displacement_tangent, x.parameter_tangent, y.displacement_tangent, y.parameter_tangent);
  };
  return product(a, b) / std::sqrt(product(a, a) * product(b, b));
}

bool ReturnDetector::is_same(const CurvePoint& point, const CurvePoint& kept) const {
  return distance(point, kept) <= same && cosine(point, kept) >= std::cos(options_.max_angle);
}

bool ReturnDetector::meets(ArcLength& curve, const CurvePoint& kept) const {
  if (is_same(curve.point(), kept)) return true;
  if (beyond(curve.previous(), kept) > 0.0 || beyond(curve.point(), kept) < 0.0) return false;
  CurvePoint found;
  return curve.locate([&](const CurvePoint& point) { return beyond(point, kept); }, found) &&
         is_same(found, kept);
}

// A grazing event has one tangent before and another after it. The next point is kept in its place, unless
// all points are such events.
void ReturnDetector::add(const CurvePoint& point, int count) {
  const int due = kept_.empty() ? 0 : (point.grazing ? 4 : 2) * kept_.back().count;
  if (count >= due && (count > 4 || !point.grazing)) kept_.push_back({point, count, false});
}

std::optional<std::size_t> ReturnDetector::returned_to(ArcLength& curve) {
  const double step = distance(curve.point(), curve.previous());
  for (std::size_t i = 0; i < kept_.size(); ++i) {
    KeptPoint& kept = kept_[i];
    const double reach = distance(curve.point(), kept.point);
    if (kept.left && reach <= 1.5 * step + same && meets(curve, kept.point)) return i;
    kept.left = kept.left || reach > away;
  }
  return std::nullopt;
}

void ReturnDetector::forget_after(std::size_t index) {
  kept_.resize(index + 1);
  for (KeptPoint& kept : kept_) kept.left = &kept != &kept_.back();
}

void ReturnDetector::forget_points_after(int count) {
  while (kept_.size() > 1 && kept_.back().count > count) kept_.pop_back();
  forget_after(kept_.size() - 1);
}

}  // namespace wavebalance::solvers
