#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/app/scene/scene.hpp"
#include "wavebalance/solvers/attractors/invariant_curve.hpp"
#include "wavebalance/solvers/time/record_statistics.hpp"

namespace wavebalance::app {

/// A row of a motion in time: a direction of contact, or an output.
struct MotionPlace {
  std::string name;
  std::string unit = "m";
  int number = 0;  ///< of its contact, from 1
  bool output = false;
};

/// The place of sums over the contacts.
inline constexpr const char* all_contacts = "all contacts";

/// A measure of a place over all recorded periods.
struct MotionMeasure {
  std::string place, quantity, unit;
  solvers::Estimate estimate;
};

/// Kind of a motion that was recorded for many periods.
enum class MotionKind {
  chaotic,         ///< perturbations grow: the largest Lyapunov exponent is positive beyond its error
  quasi_periodic,  ///< they neither grow nor decay, and the section is a closed curve
  periodic,        ///< the section repeats after `repeats` periods
  settling,        ///< they decay: it has not converged yet, or repeats after more periods than are
                   ///< recorded
  not_known
};
std::string name_of(MotionKind kind);

/// The largest solvers::InvariantCurve::residual, relative to the size of the section, of a quasi-periodic
/// motion.
inline constexpr double largest_curve_residual = 1e-3;

/// A motion that did not repeat, over many periods.
struct RecordedMotion {
  MotionKind kind = MotionKind::not_known;
  solvers::Estimate exponent;          ///< the largest Lyapunov exponent, per period of the load
  int repeats = 0;                     ///< periods after which the section repeats; 0 without
  solvers::InvariantCurve curve = {};  ///< through the section, displacements before velocities
  int transient = 0;                   ///< periods before the record
  int recorded = 0;
  double correlation = 0.0;  ///< solvers::batch_correlation() of the square of the leading displacement
  std::vector<MotionPlace> places;
  std::vector<MotionMeasure> measures;
  int leading = 0;                         ///< the place whose section and spectrum are drawn
  Eigen::MatrixXd displacement, velocity;  ///< Poincare section: places x periods
  solvers::PowerSpectrum spectrum;         ///< of the first 16 places

  bool is_aperiodic() const { return kind == MotionKind::chaotic || kind == MotionKind::quasi_periodic; }
  /// The measure of a place; not a number without one.
  solvers::Estimate of(const std::string& place, const std::string& quantity) const;
};

/// Goes on with the motion in time of a scene with analysis.type = "time_stepping" that did not repeat, by
/// events, for analysis.recorded_periods: from its last state where that is known, else from rest with as
/// many periods before as have passed, 1000 at most. Nothing where the response is no such motion, or where
/// no motion by events exists.
std::optional<RecordedMotion> recorded_motion(const Scene& scene, const StructureModel& model,
                                              const Response& response, const Observer& observer = {});

}  // namespace wavebalance::app
