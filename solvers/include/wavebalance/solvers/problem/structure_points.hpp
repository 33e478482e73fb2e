#pragma once
#include <cstddef>
#include <string_view>
#include <vector>

#include "wavebalance/solvers/problem/exact_along.hpp"

namespace wavebalance::solvers {

/// The exact counterpart of a bifurcation point of harmonic balance.
enum class StructurePointStatus {
  found,      ///< one of its type
  repeated,   ///< one of its type, to which another bifurcation or grazing point of the balance is nearer
  none,       ///< none of its type: the curve of its motions passes without one
  not_known,  ///< the curve of its motions was not followed past it, or has no multipliers
  not_sought  ///< it was left out by the limits of the options, or came after an interruption
};

std::string_view to_string(StructurePointStatus status);

struct NearStructurePoint {
  StructurePointStatus status = StructurePointStatus::not_sought;
  std::size_t event = 0;  ///< of StructurePoints::events, if it is found or repeated
};

/// Extent and effort of the search for exact bifurcation points.
struct StructurePointsOptions {
  /// The interval of the parameter in which they lie, Hz or load scale, as of the sweep.
  double from = 0.0, to = 0.0;
  /// Arc length of the search on either side of a bifurcation point of harmonic balance. A 20th of the
  /// interval and the largest displacement have length 1 each.
  double reach = 0.25;
  std::size_t max_segments = 24;  ///< of the curve, those with multipliers at the unit circle first
  int max_points = 2000;          ///< motions on the whole curve; and on all stretches together
  double max_operations = 5e11;   ///< floating-point operations of all curves together
  double max_distance = 0.1;      ///< as of ExactAlongOptions
  double first_step = 0.02, largest_step = 0.2;  ///< as of ExactCurveOptions
  CollocationOptions exact{};
  int threads = 1;      ///< that process the segments one by one; 0: one per core
  Observer observer{};  ///< called only by the caller's thread

  /// Throws std::invalid_argument for a number out of its range.
  void validate() const;
};

/// Exact bifurcation points near the points of harmonic balance.
struct StructurePoints {
  /// Each once, in the order of the curve; ExactEvent::next_point is the number of the point of the balance's
  /// curve with which the stretch begins in which it was found.
  std::vector<ExactEvent> events;
  std::vector<NearStructurePoint> of_balance;  ///< one for each bifurcation or grazing point of the balance
  /// The curve of the structure through the motion near the first point of the balance's was followed until
  /// it left the interval: `events` are all that it has.
  bool whole = false;
  /// The motion near the last point of the balance's curve lies on another curve of the structure, which was
  /// followed out of the interval, too: the balance's curve has gone over from one to the other.
  bool apart = false;
  /// The numbers of the folds of a whole curve that lie farther than StructurePointsOptions::reach from every
  /// point of the balance's, which passes them by.
  std::vector<std::size_t> passed_by;
  bool cancelled = false;  ///< the observer returned false
};

/// The exact bifurcation and grazing points along a balance's curve. exact_curve() is followed from an
/// exact motion near the first point of the balance's curve, and back from its last point if it does not
/// reach that. If a quarter of the operations is not enough, or the curve is lost, it is followed only
/// along segments around the bifurcation and grazing points of the balance, likewise from both ends; if the
/// effort was too small, without segments that have only grazings. Neighbouring points share a segment, so
/// that one exact point appears once where samples split it, and additional exact points in a segment are
/// found. Outside all segments no points are computed.
///
/// `make` makes the problem on which the curve was traced with keep_unknowns; `points` are of its
/// CurveStability. Neither the order of the stretches nor the threads change a digit. Without events where
/// the structure has no modes to compute. Throws std::invalid_argument for options out of range, and as
/// ContactProblem::response() does. One exact_curve() or two, and as many per stretch.
StructurePoints structure_points(const ProblemMaker& make, const FrequencySweep& curve,
                                 const std::vector<SpecialPoint>& points,
                                 const StructurePointsOptions& options);

}  // namespace wavebalance::solvers
