#include "branches/branch_arrival.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace wavebalance::solvers {
namespace {

CurvePoint way_between(const CurvePoint& to, const CurvePoint& from) {
  return curve_point(to.displacement - from.displacement, to.parameter - from.parameter);
}

}  // namespace

Eigen::VectorXd repeated(const Eigen::VectorXd& samples, int contacts, int times) {
  const Eigen::Index points = samples.size() / contacts;
  Eigen::VectorXd result(samples.size() * times);
  for (int c = 0; c < contacts; ++c)
    result.segment(c * points * times, points * times) =
        samples.segment(c * points, points).replicate(times, 1);
  return result;
}

Eigen::VectorXd alternating_part(const Eigen::VectorXd& samples, int contacts) {
  const Eigen::Index points = samples.size() / contacts, half = points / 2;
  Eigen::VectorXd result(contacts * half);
  for (int c = 0; c < contacts; ++c)
    result.segment(c * half, half) =
        0.5 * (samples.segment(c * points, half) - samples.segment(c * points + half, half));
  return result;
}

double alternating_share(const Eigen::VectorXd& samples, int contacts) {
  const double whole = samples.norm();
  return whole > 0.0 ? std::sqrt(2.0) * alternating_part(samples, contacts).norm() / whole : 0.0;
}

double Scales::inner(const CurvePoint& a, const CurvePoint& b) const {
  return a.displacement.dot(b.displacement) / (double(a.displacement.size()) * displacement * displacement) +
         a.parameter * b.parameter / (parameter * parameter);
}

std::optional<SweepStart> motion_beside(ContactSystem& system, const CurvePoint& origin,
                                        const Eigen::VectorXd& change, const Scales& scales,
                                        SweepParameter parameter) {
  const CurveParameter& along = curve_parameter(parameter);
  ArcLengthOptions lengths;
  lengths.displacement_scale = scales.displacement;
  lengths.parameter_scale = scales.parameter;
  lengths.max_corrections = 32;
  CurvePoint beyond = origin, first;
  beyond.displacement += 2.0 * change;
  if (!ArcLength(system, along, lengths).between(origin, beyond, 0.5, first)) return std::nullopt;
  along.set(system, first.parameter);
  return SweepStart{response_at(system, first.displacement), change, {}};
}

bool lies_on(const FrequencySweep& curve, const CurvePoint& origin, const CurvePoint& first,
             const Scales& scales) {
  constexpr double parallel = 0.98;  // cosine
  const CurvePoint way = way_between(first, origin);
  const double length = scales.inner(way, way);
  double nearest = std::numeric_limits<double>::infinity(), cosine = 0.0;
  for (const SweepPoint& point : curve.points) {
    const CurvePoint to =
        way_between(curve_point(point.unknown, parameter_of(point, curve.parameter)), origin);
    const double distance = scales.inner(to, to);
    if (distance < length || distance >= nearest) continue;
    nearest = distance;
    cosine = scales.inner(way, to) / std::sqrt(length * distance);
  }
  return std::abs(cosine) > parallel;
}

Arrival::Arrival(const Parent& parent, int special_point, int contacts, Scales scales)
    : scales_(scales),
      contacts_(contacts),
      doubled_(parent.special_points()[std::size_t(special_point)].type == SpecialPointType::period_doubling),
      started_at_(special_point) {
  const SpecialPointType type = parent.special_points()[std::size_t(special_point)].type;
  const int times = doubled_ ? 2 : 1;
  for (std::size_t i = 0; i < parent.special_points().size(); ++i) {
    const SpecialPoint& other = parent.special_points()[i];
    if (other.type != type) continue;
    ends_.emplace_back(int(i), curve_point(repeated(other.unknown, contacts, times),
                                           parameter_of(other, parent.curve->parameter)));
  }
}

bool Arrival::operator()(const CurvePoint& before, const CurvePoint& after) {
  if (doubled_) return meets_half_period(before, after);
  for (const auto& [index, point] : ends_) {
    if (index == started_at_ || !passes(before, after, point)) continue;
    end_point_ = index;
    return true;
  }
  return false;
}

bool Arrival::is_beside(const CurvePoint& last) const {
  constexpr double beside = 0.1;
  return doubled_ && alternating_share(last.displacement, contacts_) < beside;
}

void Arrival::note_nearest(const CurvePoint& last, double reach) {
  if (end_point_ >= 0) return;
  double least = reach;
  for (const auto& [index, point] : ends_) {
    const CurvePoint way = way_between(last, point);
    const double distance = std::sqrt(scales_.inner(way, way));
    if (distance > least) continue;
    least = distance;
    end_point_ = index;
  }
}

// The difference between half periods vanishes at the curve of half the period. Beyond it the motion is the
// same one half a period later.
bool Arrival::meets_half_period(const CurvePoint& before, const CurvePoint& after) {
  constexpr double vanished = 1e-6;
  const Eigen::VectorXd a = alternating_part(before.displacement, contacts_),
                        b = alternating_part(after.displacement, contacts_);
  const CurvePoint way = way_between(after, before);
  step_ = std::sqrt(scales_.inner(way, way));
  largest_ = std::max(largest_, a.norm());
  return a.dot(b) <= 0.0 || b.norm() < vanished * largest_;
}

// Whether the step leads past `point`. Beyond it, it may have gone over to the other curve.
bool Arrival::passes(const CurvePoint& before, const CurvePoint& after, const CurvePoint& point) const {
  constexpr double nearness = 0.6;  // of the length of the step
  const CurvePoint way = way_between(after, before), to = way_between(point, before);
  const double length = scales_.inner(way, way);
  const double share = std::clamp(scales_.inner(to, way) / length, 0.0, 1.0);
  const CurvePoint apart =
      curve_point(to.displacement - share * way.displacement, to.parameter - share * way.parameter);
  return scales_.inner(apart, apart) <= nearness * nearness * length;
}

}  // namespace wavebalance::solvers
