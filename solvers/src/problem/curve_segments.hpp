#pragma once
#include <cstddef>
#include <vector>

#include "wavebalance/solvers/stability/curve_stability.hpp"

namespace wavebalance::solvers::detail {

/// Part of a curve, from one of its points to another, with the numbers of bifurcation and grazing points
/// within.
struct CurveSegment {
  std::size_t first = 0, last = 0;
  std::vector<std::size_t> points;
};

/// How far points of a curve are apart.
class CurveDistance {
 public:
  /// `scale`: change of the parameter that has length 1.
  CurveDistance(const FrequencySweep& curve, double scale);

  /// For a motion with a value of the parameter and a largest displacement (m).
  double between(const SpecialPoint& a, double value, double max_abs_displacement) const;

 private:
  SweepParameter parameter_;
  double scale_, largest_;
};

/// The segments around bifurcation and grazing points, without segments of grazings if `grazings` is false,
/// in the order of the curve: on either side at least three points of the curve and, unless it ends before,
/// up to the first point farther away than `reach`. Overlapping segments are merged. If there are more than
/// `most`, segments with other points than grazings are kept, and the first ones.
std::vector<CurveSegment> segments_about(const FrequencySweep& curve, const std::vector<SpecialPoint>& points,
                                         const CurveDistance& distance, double reach, std::size_t most,
                                         bool grazings);

/// The lowest and the highest value of the parameter on a part of a curve.
struct ValueRange {
  double low, high;
};
ValueRange values_on(const FrequencySweep& curve, std::size_t first, std::size_t last);

/// The direction in which the parameter goes from a point on, 1 or -1, forwards or backwards along the
/// curve: towards the first point farther away than `least`, or the last one.
double direction_from(const FrequencySweep& curve, std::size_t point, bool forwards, double least);

}  // namespace wavebalance::solvers::detail
