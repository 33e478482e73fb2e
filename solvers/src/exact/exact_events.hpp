#pragma once
#include <complex>
#include <vector>

#include "exact/curve_path.hpp"

namespace wavebalance::solvers::detail {

/// The multiplier nearest to a place on the unit circle, Im >= 0; NaN where none is known.
std::complex<double> nearest(const Eigen::VectorXcd& multipliers, std::complex<double> place);

/// A bifurcation or grazing point: the motion there with its place along the curve, and the parameter.
struct PlacedEvent {
  SpecialPointType type;
  PointOnCurve point;
  double value;
  std::complex<double> multiplier{missing, missing};
};

struct EventsBetween {
  std::vector<PlacedEvent> events;  ///< in their order
  /// Whether the count of multipliers outside the circle changes as it does at these.
  bool explained = true;
};

/// The bifurcation and grazing points between two neighbours with the same unknowns: folds, and with
/// `stability` where multipliers pass the unit circle. `of_a` and `of_b` are the multipliers of the
/// neighbours. A step whose points do not explain the change of their count is halved.
EventsBetween events_between(const CurvePath& path, const CurvePoint& a, const CurvePoint& b,
                             const Eigen::VectorXcd& of_a, const Eigen::VectorXcd& of_b);

}  // namespace wavebalance::solvers::detail
