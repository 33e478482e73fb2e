#pragma once
#include <string>
#include <vector>

#include "wavebalance/app/analysis/sweep.hpp"
#include "wavebalance/app/compose/structure_model.hpp"

namespace wavebalance::blade {

/// The Floquet multipliers outside the unit circle at one point of a curve.
struct PointCount {
  double frequency = 0.0;  ///< Hz
  int unstable = -1;       ///< -1 where it is not known
};

/// A curve in three parts, up to its fold at the highest frequency, on to that at the lowest, and beyond.
struct CurveParts {
  std::vector<solvers::TurningPoint> folds;  ///< two; none for a curve that does not turn twice
  std::vector<PointCount> counts;            ///< two per part, in their order along the curve
  /// One per point of the curve: the count of its part if both points of that have the same, else -1.
  std::vector<solvers::PointStability> points;

  /// "0 at 585 and 640 Hz, 1 at ..."
  std::string counts_text() const;
};

/// Counts the unstable multipliers at two points of each part, at a third and two thirds of its
/// frequencies. With many contacts in a stiff casing a count takes about a second, and all points would
/// take minutes. `sweep` needs its unknowns.
CurveParts curve_parts(const app::Scene& scene, const app::StructureModel& model, const app::Sweep& sweep);

}  // namespace wavebalance::blade
