#pragma once
#include <cmath>
#include <deque>
#include <vector>

#include "exact/exact_events.hpp"

namespace wavebalance::solvers::detail {

/// Follows one curve, from its first point forwards. Derived classes define a step. A path is used by one
/// tracer at a time.
class CurveTracer {
 public:
  CurveTracer(CurvePath& path, ExactCurve& curve, PointOnCurve first);
  virtual ~CurveTracer() = default;

  void run();

 protected:
  /// Adds points, changes the step length, or sets the status of the curve.
  virtual void advance() = 0;
  /// About so many floating-point operations a point took.
  virtual double operations_of(const CurvePoint& point) const = 0;
  virtual bool same_unknowns(const CurvePoint& a, const CurvePoint& b) const = 0;
  /// Adds the bifurcation and grazing points between the last point and the next at which contacts change
  /// what they do.
  virtual void append_changes(const CurvePoint& next, std::vector<PlacedEvent>& events);

  const ExactCurveOptions& options() const { return path_.options(); }
  ExactCurve& curve() { return curve_; }
  /// The last ones with the same unknowns.
  std::deque<PointOnCurve>& points() { return points_; }
  const std::deque<PointOnCurve>& points() const { return points_; }
  /// Notes the bifurcation and grazing points between the last point and the next.
  void note_events(const CurvePoint& next);
  bool within(double value) const;
  Eigen::VectorXcd multipliers_of(const CurvePoint& point) const;
  void accept(PointOnCurve point);
  /// Goes on from a point that is none of the curve, with its multipliers where they are known.
  void go_on_from(PointOnCurve point, Eigen::VectorXcd multipliers);
  void go_to(PointOnCurve next);
  /// The curve leaves its interval between its last point and this one.
  void end_before(const CurvePoint& next);
  /// Half the step; the curve is lost where that is too short.
  void shorten_step();
  /// Whether the last points are near enough for their polynomial to predict the next one.
  bool is_smooth() const;
  /// Whether a solution is the next point of the curve: so far off what was expected, so far from the last
  /// point, and with this cosine of the angle between the way and its direction. Then it gets its place and
  /// its side.
  template <class Point>
  bool fits(Point& next, double off, double arc, double ahead) {
    constexpr double close = 0.05, farthest = 0.25, longest = 2.5;
    if (off > farthest * step_ || arc > longest * step_ || std::abs(ahead) < least_cosine) return false;
    if (ahead < 0.0) next.turn_around();
    growth_ = off < close * step_ ? 1.5 : 1.0;
    next.place = points_.back()->place + arc;
    return true;
  }
  /// Takes such a point, up to the end of the interval.
  void take(PointOnCurve next);
  void note(SpecialPointType type, const CurvePoint& at);

  double step_;
  static constexpr double least_cosine = 0.3;

 private:
  bool turns_as_it_ends() const;
  double behind() const { return options().behind > 0.0 ? options().behind : options().from; }
  SweepStatus end_at(double value) const;
  PointOnCurve first_between(const CurvePoint& next) const;

  CurvePath& path_;
  ExactCurve& curve_;
  double operations_ = 0.0, growth_ = 1.5;
  const PointOnCurve first_;
  std::deque<PointOnCurve> points_;
  Eigen::VectorXcd multipliers_;  // of the last one
};

}  // namespace wavebalance::solvers::detail
