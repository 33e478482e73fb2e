#pragma once
#include <cmath>
#include <vector>

#include "problem/curve_segments.hpp"
#include "wavebalance/solvers/problem/structure_points.hpp"

namespace wavebalance::solvers::detail {

/// Instants at which motions are compared, periods.
const Eigen::VectorXd& comparison_times();

/// The same bifurcation or grazing point, followed from elsewhere.
bool is_same(const ExactEvent& a, const ExactEvent& b);

/// The change of the parameter that has length 1, a 20th of the interval.
inline double unit_of_parameter(const StructurePointsOptions& options) {
  return std::abs(options.to - options.from) / 20.0;
}

/// With how much work one curve of the structure is followed.
struct CurveEffort {
  double points, operations;
};

/// The exact curve along one segment of a balance's curve.
struct OnSegment {
  std::vector<ExactEvent> events;
  bool complete = false;  ///< followed from one end of the stretch to the other, or out of the interval
  bool apart = false;     ///< its ends lie on different curves of the structure
  bool with_multipliers = false, cancelled = false;
  bool exhausted = false;  ///< a curve ended because its effort was used up
};

/// Follows the curve of the structure from the first point of a stretch of a balance's curve, and where that
/// does not come past its last one, back from that. `whole`: through the interval of the options, whatever
/// becomes of the balance's curve, otherwise little farther than the stretch.
OnSegment structure_along(ContactProblem& problem, const FrequencySweep& curve, const CurveSegment& stretch,
                          bool whole, const StructurePointsOptions& options, CurveEffort effort,
                          const Observer& observer);

/// Whether a motion lies within `reach` of a point of a balance's curve, as arc length: of the parameter by
/// `scale`, of the displacements by what the motion vibrates.
bool lies_on(ContactProblem& problem, const FrequencySweep& curve, const ExactEvent& event, double scale,
             double reach);

}  // namespace wavebalance::solvers::detail
