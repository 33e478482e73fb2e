#pragma once
#include <functional>
#include <limits>
#include <string_view>
#include <vector>

#include "wavebalance/solvers/stability/curve_stability.hpp"

namespace wavebalance::solvers {

/// How a branch ended.
enum class BranchEnd {
  special_point,  ///< it arrived at another bifurcation or grazing point of the curve that it left
  parent_curve,   ///< it arrived at that curve where no bifurcation or grazing point was found
  from_end,       ///< it left the interval at `from`
  to_end,         ///< it left the interval at `to`
  no_start,       ///< no motion of the branch was found near the bifurcation or grazing point
  closed,         ///< it came back to an earlier point of itself
  lost,           ///< no further point was found
  unbounded,      ///< as SweepStatus::unbounded
  point_limit,    ///< max_points was reached
  cancelled       ///< the observer returned false
};

std::string_view to_string(BranchEnd end);

/// How a branch ended whose curve has this status: `special_point` for SweepStatus::ended.
BranchEnd end_of(SweepStatus status);

/// A branch of periodic responses that begins at a bifurcation point of another one.
struct Branch {
  int parent = 0;         ///< the curve that it leaves: 0 for the main one, i for the i-th branch, from 1
  int special_point = 0;  ///< index among the bifurcation and grazing points of the parent
  int periods = 1;        ///< period of its motions over the period of the main curve's problem
  BranchEnd end = BranchEnd::no_start;
  int end_point =
      -1;  ///< index of the bifurcation or grazing point of the parent at which it arrived; -1 for none
  FrequencySweep curve;      ///< of its problem; frequencies are forcing frequencies, and the parameter is
                             ///< the one of the main curve
  CurveStability stability;  ///< likewise
};

/// Which branches are followed.
struct BranchOptions {
  FrequencySweepOptions sweep;  ///< as for the main curve; max_points holds for each branch
  CurveStabilityOptions stability;
  int largest_period = 2;  ///< Branch::periods at most; 1 leaves period doublings out
  int max_branches = 16;
  int load_periods = 1;  ///< in a period of the main curve, CondensedProblem::periods()
  Observer observer;     ///< called after each point of a branch

  /// Throws std::invalid_argument for a number out of its range.
  void validate() const;
};

/// Makes a problem for motions of `periods` periods of the main curve's problem: its load in harmonics
/// `periods` times as high, `periods` times the points and the functions of as many harmonics, so that a
/// motion of the main curve repeated is a solution. One without frequency or in the displacement form, whose
/// load scale has the unit of the main curve's.
using BranchProblems = std::function<CondensedProblem(int periods)>;

/// Follows the branches of a curve, and the period-doubled ones of these, up to largest_period and
/// max_branches. Motions of two periods begin at a period doubling: u* repeated plus a small multiple of
/// the null vector, by floquet_exponents(), is corrected in the plane perpendicular to that vector, and the
/// curve from there by arc length. It is one curve, since its other side is the same motion one period
/// later. At branch points of the main curve that are located both sides are followed. A branch ends where
/// it arrives at the curve that it left: there the difference between u and u one period later vanishes and
/// changes sign [R. Seydel, Practical Bifurcation and Stability Analysis, 2010, chapter 5]. No further
/// branch begins at that point.
///
/// Nothing is followed at folds, grazings and Neimark-Sacker points, where the motions that begin are not
/// periodic. Throws std::invalid_argument for options out of range, a problem of other sizes, and a curve as
/// curve_stability() does. Each branch costs as much as a curve of its points.
std::vector<Branch> follow_branches(const BranchProblems& problems, const ContactLaws& laws,
                                    DynamicsAlong dynamics, const FrequencySweep& main,
                                    const CurveStability& stability, const BranchOptions& options);

}  // namespace wavebalance::solvers
