#pragma once
#include <complex>
#include <cstddef>
#include <limits>
#include <vector>

#include "wavebalance/solvers/exact/problem_family.hpp"
#include "wavebalance/solvers/stability/curve_stability.hpp"

namespace wavebalance::solvers {

/// Where an exact curve starts and ends, and how it is followed. Arc lengths: a change of the parameter by
/// parameter_scale, and a change of the displacements by as much as the first motion vibrates (rms), have
/// length 1 each.
struct ExactCurveOptions {
  double from = 0.0;    ///< Hz or load scale, where the first motion is
  double to = 0.0;      ///< either side of `from`
  double behind = 0.0;  ///< beyond this value on the other side a curve that turns ends, too; 0: at `from`
  double parameter_scale = 0.0;  ///< Hz or load scale; 0: a 20th of the interval
  double first_step = 0.02;      ///< arc length
  double largest_step = 0.2;     ///< arc length
  double smallest_step = 1e-7;   ///< arc length; the curve is lost below
  int max_points = 5000;
  /// exact_point_operations() of all points together, after which the curve has the status `point_limit`,
  /// too.
  double max_operations = std::numeric_limits<double>::infinity();
  bool stability = true;          ///< multipliers at each point, and the points where they pass the circle
  CollocationOptions exact = {};  ///< tolerance, nodes and panels of each motion
  Observer observer = {};         ///< called with the last point in each step of Newton's method

  /// Throws std::invalid_argument for a number out of its range.
  void validate() const;
};

/// A motion of the structure on a curve.
struct ExactPoint {
  double value = 0.0;  ///< Hz or load scale
  ExactSolution motion;
  double slope = 0.0;            ///< of the parameter by arc length: its sign is that in which the curve goes
  Eigen::VectorXcd multipliers;  ///< ExactSolution::multipliers(); empty unless requested and found
  int unstable = -1;             ///< multipliers outside the unit circle; -1 where not known
};

/// A bifurcation or grazing point, solved for with the parameter as unknown.
struct ExactEvent {
  SpecialPointType type = SpecialPointType::fold;
  double value = 0.0;                                 ///< Hz or load scale
  std::complex<double> multiplier{missing, missing};  ///< the one at the unit circle, Im >= 0
  ExactSolution motion;
  std::size_t next_point = 0;  ///< index of the first point of the curve behind it
  bool turns = false;  ///< of a grazing of impacts: the parameter reverses there, as it does at a fold
};

/// A curve of motions of the structure.
struct ExactCurve {
  SweepStatus status = SweepStatus::no_start;
  /// Status of the first motion: why a curve has `no_start`.
  ExactStatus start = ExactStatus::converged;
  std::vector<ExactPoint> points;
  std::vector<ExactEvent> events;
  /// Numbers of the points before which the count of multipliers outside the circle changes otherwise than by
  /// the events there: a bifurcation or grazing point is missing.
  std::vector<std::size_t> unexplained;
};

/// Estimated floating-point operations for a point of a curve like this motion, with its multipliers.
double exact_point_operations(const ExactSolution& motion, const ContactDynamics& dynamics);

/// The curve of motions of the structure over the parameter of `family`, by contact intervals, from a motion
/// that has converged at options.from until it leaves the interval, of which options.behind may be the end on
/// the side of its start, or comes back to its first point (`closed`): predicted by polynomials in the arc
/// length, corrected by Newton's method with the unknown that changes fastest held, so that folds are points
/// as any other. Where a phase appears or vanishes the grazing motion is solved for, and the curve goes on
/// with the other intervals.
///
/// Bifurcation and grazing points are zeros along the curve: of the parameter's slope (fold), of a
/// multiplier's modulus less 1 (period doubling, Neimark-Sacker, branch), of the distance from a breakpoint
/// (grazing).
///
/// With friction, of a first motion by the flow, and of laws of the velocity where the curve by collocation
/// is lost, the curve is followed by the map of a period of the flow from event to event instead, with the
/// same results. A slider that sticks all the time is then in the middle of the positions in which it does.
///
/// From a motion of impact_motion() the curve is followed by its equations, also over several periods of the
/// load; where impacts vanish or appear the grazing motion is solved for.
///
/// Throws std::invalid_argument for options out of range and a first motion that is not known. `lost` where
/// rigid contact begins or ends. O(n^3 + n^2 poles) for each Newton step of n unknowns, O(s^3) for the
/// multipliers of s states; by the map some twenty periods of the flow for each point, one of them with all
/// perturbations.
ExactCurve exact_curve(const ProblemFamily& family, const ExactSolution& first,
                       const ExactCurveOptions& options);

/// The curve of motions of twice as many periods that begins at a period doubling of a curve of impacts
/// with `options`. `no_start` if none is found near it. Throws as exact_curve(), and for another event.
ExactCurve doubled_curve(const ProblemFamily& family, const ExactEvent& event,
                         const ExactCurveOptions& options);

/// The curve through a motion at a value within the interval, from one of its ends to the other, or once
/// around: followed to options.to, and unless it is closed to options.from. Its status is `reached_end` where
/// its ends lie on both ends of the interval, `returned` where they lie on one, and otherwise what stopped
/// it. options.behind has no meaning. Throws as exact_curve() does, and for a value that is not within.
ExactCurve exact_curve_through(const ProblemFamily& family, double value, const ExactSolution& motion,
                               const ExactCurveOptions& options);

}  // namespace wavebalance::solvers
