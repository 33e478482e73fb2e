#pragma once
#include <vector>

#include "wavebalance/app/analysis/sweep.hpp"
#include "wavebalance/app/plot/plot.hpp"

namespace wavebalance::app {

/// A bifurcation or grazing point in a picture.
struct PlacedPoint {
  solvers::SpecialPointType type = solvers::SpecialPointType::fold;
  double x = 0.0, y = 0.0;
};

/// The stable and the unstable lines of a curve, each as a series that NaN interrupts.
struct StabilityParts {
  Series solid;
  Series dashed;  ///< its label ends in ", unstable"; without points where all is stable
};

/// A curve of at least two points, some marked by `unstable`, cut at its bifurcation and grazing points: a
/// line is dashed if one of its ends is unstable; see draw_by_stability().
StabilityParts parts_by_stability(const Series& curve, const std::vector<bool>& unstable,
                                  const std::vector<PlacedPoint>& special = {});

/// Adds `curve`, whose points have the stability of `points`, through its bifurcation and grazing points,
/// which are given in their order along it: solid, and dashed where it is unstable. The label of the dashed
/// part ends in
/// ", unstable". Between two bifurcation points of one line that are no grazings it is dashed if an end of
/// the line is unstable. Without `points` the curve is solid.
void draw_by_stability(Panel& panel, const Series& curve, const std::vector<solvers::PointStability>& points,
                       const std::vector<PlacedPoint>& special);

/// Marks bifurcation and grazing points in black, one symbol and one entry of the legend for each kind.
void draw_special_points(Panel& panel, const std::vector<PlacedPoint>& points);

}  // namespace wavebalance::app
