#pragma once
#include <complex>
#include <cstddef>
#include <string_view>
#include <vector>

#include "wavebalance/solvers/response/frequency_sweep.hpp"
#include "wavebalance/solvers/stability/unstable_multipliers.hpp"

namespace wavebalance::solvers {

/// The stability of one point of a curve.
struct PointStability {
  StabilityStatus status = StabilityStatus::no_response;
  int unstable = -1;  ///< multipliers outside the unit circle; -1 unless converged
  int contacts = 0;   ///< intervals of contact within the period, of all contacts
  int fold = 0;       ///< StabilitySigns::fold; with counts only it may be 0, as flip
  int flip = 0;       ///< StabilitySigns::flip
};

/// The type of a bifurcation or grazing point of a curve.
enum class SpecialPointType {
  fold,             ///< a real multiplier passes 1 where the frequency reverses
  period_doubling,  ///< a real multiplier passes -1: a motion of two periods begins
  neimark_sacker,   ///< a complex pair leaves the unit circle: a quasi-periodic motion begins
  grazing,          ///< an interval of contact appears, vanishes, splits or joins another
  branch,           ///< a real multiplier passes 1 where the frequency goes on: another curve begins
  krein_collision,  ///< of free motions: two pairs of multipliers meet on the unit circle and leave it
  slip,             ///< the first contact with friction begins to slip or to open, or the last ceases to
  stick             ///< a contact with friction that slips or is open all along begins to stick, or ceases to
};

std::string_view to_string(SpecialPointType type);

/// A bifurcation or grazing point between two points of a curve that differ in stability or in contact.
struct SpecialPoint {
  SpecialPointType type = SpecialPointType::fold;
  double frequency = 0.0;             ///< Hz, in the middle of the bracket
  double bracket = 0.0;               ///< Hz, between the ends of the bracket
  std::complex<double> multiplier;    ///< the one at the unit circle, Im >= 0; NaN at a grazing and a slip
  double max_displacement = 0.0;      ///< m, as in SweepPoint
  double max_abs_displacement = 0.0;  ///< m
  bool located = false;               ///< to the tolerance; otherwise no point within the bracket was found
  Eigen::VectorXd unknown;            ///< PeriodicResponse::unknown at one end of the bracket
  double unknown_parameter = 0.0;     ///< the frequency (Hz) or load scale at that end
  double load_scale = 1.0;            ///< in the middle of the bracket, whose width is then in its unit
  std::size_t next_point = 0;         ///< index of the first point of a response curve behind it
  double vibration = 0.0;             ///< m, as in SweepPoint
};

/// How the stability of a curve is found.
struct CurveStabilityOptions {
  StabilityOptions stability;
  double tolerance = 1e-6;     ///< width of a bracket over the distance of two points of the curve
  bool special_points = true;  ///< whether they are located; without them counts need far less
  int output_points =
      1024;           ///< times per period at which the maxima of bifurcation and grazing points are taken
  Observer observer;  ///< called after each point

  /// Throws std::invalid_argument for a number out of its range.
  void validate() const;
};

/// The stability along a curve.
struct CurveStability {
  std::vector<PointStability> points;  ///< one for each point of the curve; fewer if cancelled
  std::vector<SpecialPoint> special_points;
  bool cancelled = false;  ///< the observer returned false

  /// The status of the first point whose stability is not known; converged if there is none.
  StabilityStatus status() const;
};

/// The stability of every point of a curve that frequency_sweep() or amplitude_sweep() has traced on
/// `problem` with keep_unknowns, and its bifurcation and grazing points. Where two neighbours differ in the
/// count, in a sign or in the number of intervals of contact, the curve between them is divided, each time
/// with a new solution of the balance, until a bracket of the tolerance has a single difference: at the
/// grazing that samples predict, else in the middle. Two changes between neighbours that cancel each other
/// are not noticed.
///
/// Throws std::invalid_argument for a curve without unknowns and as unstable_multipliers does. One
/// unstable_multipliers() per point, about 7 responses per grazing point, and about 20 responses and counts
/// per other bifurcation or grazing point.
CurveStability curve_stability(CondensedProblem& problem, const ContactLaws& laws,
                               const FrequencySweep& curve, DynamicsAlong dynamics,
                               const CurveStabilityOptions& options = {});

}  // namespace wavebalance::solvers
