#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "wavebalance/app/scene/scene.hpp"
#include "wavebalance/solvers/problem/exact_along.hpp"

namespace wavebalance::app {

/// Whether exact bifurcation points are computed along a curve of a scene. With many contacts they can take
/// a hundred times as long as the curve, and require analysis.phases.
bool seeks_exact_points(const Scene& scene);

/// How many bifurcation points of a curve have exact solutions unless analysis.phases requests all points.
inline constexpr std::size_t most_special_points_with_exact = 24;

/// The exact periodic solutions near a curve. Empty if not requested.
struct ExactAlongSweep {
  using Point = std::optional<solvers::ExactAtPoint>;

  Point peak;                         ///< of the main curve, with its motion
  std::vector<Point> special_points;  ///< one for each of CurveStability::special_points
  std::vector<Point> points;          ///< one for each point of the curve with analysis.phases; else none
};

/// "converged", "converged_beside" if found only a few points along the curve away, another
/// solvers::ExactStatus, or "not_computed".
std::string phases_status(const ExactAlongSweep::Point& point);
/// Whether the search found none nearby.
bool was_not_found(const ExactAlongSweep::Point& point);

/// The stability along a curve in its record.
struct StabilityAlong {
  std::vector<solvers::PointStability> points;
  /// Per point: "phases" if the count belongs to the exact motion, "balance", or "none" if no exact motion
  /// was found nearby and the stability is not known. Empty without ExactAlongSweep::points.
  std::vector<std::string> by;
  std::string status = "converged";  ///< or why the first count that is not known is not
};

/// A harmonic balance curve with the counts of the exact motions where these are known; null: without any.
StabilityAlong stability_along(const solvers::CurveStability& balance, const ExactAlongSweep* phases);

/// The index of the point with the largest displacement, of a curve with points.
std::size_t peak_of(const solvers::FrequencySweep& curve);
/// The index of the point that vibrates most.
std::size_t vibration_peak_of(const solvers::FrequencySweep& curve);

/// The relative error of the vibration, half the peak-to-peak value, at the peak of a curve against the
/// motion of the structure near it; NaN where that is not known there.
double error_of_vibration(const solvers::FrequencySweep& curve, const ExactAlongSweep::Point& peak,
                          int output_points);

}  // namespace wavebalance::app
