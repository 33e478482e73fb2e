#pragma once
#include <complex>
#include <cstddef>
#include <vector>

#include "wavebalance/solvers/impacts/impact_family.hpp"
#include "wavebalance/solvers/impacts/impact_motion.hpp"
#include "wavebalance/solvers/stability/curve_stability.hpp"

namespace wavebalance::solvers {

/// Where a curve of motions with impacts starts and ends, and how it is followed. Arc lengths: a change of an
/// instant by a 20th of the period, of an impulse by velocity_scale / J, and of the parameter by
/// parameter_scale, have length 1 each; velocity_scale is the speed of the contacts without contact.
struct ImpactCurveOptions {
  double from = 0.0;             ///< Hz or load scale, where the first motion is
  double to = 0.0;               ///< either side of `from`
  int periods = 1;               ///< of the load, after which the motions repeat
  double parameter_scale = 0.0;  ///< Hz or load scale; 0: a 20th of the interval
  double first_step = 0.02;      ///< arc length
  double largest_step = 0.2;     ///< arc length
  double smallest_step = 1e-8;   ///< arc length; the curve is lost below
  double largest_turn = 0.35;    ///< rad, between the tangents of successive points with the same impacts
  int max_points = 5000;
  int max_impacts = 40;    ///< in a period; where more appear they accumulate, and the curve is lost
  bool stability = true;   ///< multipliers at each point, and the points where they pass the unit circle
  Observer observer = {};  ///< called after each point with its value

  /// Throws std::invalid_argument for a number out of its range.
  void validate() const;
};

/// A motion on a curve.
struct ImpactPoint {
  double value = 0.0;  ///< Hz or load scale
  ImpactMotion motion;
  double slope = 0.0;            ///< of the parameter by arc length: its sign is that in which the curve goes
  Eigen::VectorXcd multipliers;  ///< impact_multipliers(); empty unless asked for
  int unstable = -1;             ///< unstable_count(); -1 where not known
};

/// A special point, solved for with the parameter as unknown.
struct ImpactEvent {
  SpecialPointType type = SpecialPointType::fold;
  double value = 0.0;                                 ///< Hz or load scale
  std::complex<double> multiplier{missing, missing};  ///< the one at the unit circle, Im >= 0
  ImpactMotion motion;
  std::size_t next_point = 0;  ///< index of the first point of the curve behind it
  bool turns = false;          ///< of a grazing: the parameter reverses there, as it does at a fold
};

/// A curve of motions with impacts.
struct ImpactCurve {
  SweepStatus status = SweepStatus::no_start;
  std::vector<ImpactPoint> points;
  std::vector<ImpactEvent> events;
};

/// The curve of motions over the parameter of `family`, from one that has converged at options.from until it
/// leaves the interval, by pseudo arc length on the 2 K equations of impact_motion() and the parameter, so
/// that folds are points as any other.
///
/// A motion ends where an impulse vanishes, and where a contact touches its obstacle between impacts. Both
/// are solved for as the equations of impacts of which one has no impulse, which are regular there. From this
/// grazing motion the curve goes on with one impact less, or more, on the side on which the motions are ones
/// of the structure. Where two impacts of different contacts pass each other, it goes on in the other order.
///
/// Special points are zeros along the curve: of the parameter's slope (fold), of impact_determinant() at z =
/// 1 (branch) and z = -1 (period doubling), of the modulus of a complex multiplier less 1 (Neimark-Sacker),
/// of an impulse (grazing).
///
/// Throws std::invalid_argument for options out of range, and a first motion that has not converged or near
/// which the family has none at options.from. O(K^2 poles + K^3) for each step of Newton's method, and
/// impact_multipliers() for each point.
ImpactCurve impact_curve(const ImpactFamily& family, const ImpactMotion& first,
                         const ImpactCurveOptions& options);

/// The curve of motions of twice as many periods that begins at a period doubling of a curve with `options`.
/// `no_start` where none is found beside it. Throws as impact_curve(), and for an event of another type.
ImpactCurve doubled_curve(const ImpactFamily& family, const ImpactEvent& event, ImpactCurveOptions options);

}  // namespace wavebalance::solvers
