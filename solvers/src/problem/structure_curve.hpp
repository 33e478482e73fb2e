#pragma once
#include <cmath>
#include <vector>

#include "problem/curve_stretches.hpp"
#include "wavebalance/solvers/problem/structure_points.hpp"

namespace wavebalance::solvers::detail {

/// Instants at which motions are compared, periods.
const Eigen::VectorXd& comparison_times();

/// The same special point, followed from elsewhere.
bool is_same(const ExactEvent& a, const ExactEvent& b);

/// The change of the parameter that has length 1, a 20th of the interval.
inline double unit_of_parameter(const StructurePointsOptions& options) {
  return std::abs(options.to - options.from) / 20.0;
}

/// With how much work one curve of the structure is followed.
struct CurveEffort {
  double points, operations;
};

/// What the structure has along one stretch of a balance's curve.
struct OnStretch {
  std::vector<ExactEvent> events;
  bool complete = false;  ///< followed from one end of the stretch to the other, or out of the interval
  bool apart = false;     ///< its ends lie on different curves of the structure
  bool with_multipliers = false, cancelled = false;

  /// Those that are not there yet; `from_behind`: in the opposite order.
  void add(std::vector<ExactEvent> more, bool from_behind);
};

/// A motion of the structure from which a stretch is followed.
struct StretchStart {
  double value = 0.0, direction = 1.0;
  PhaseMotion motion;  ///< not converged where none was found

  bool exists() const { return motion.converged(); }
};

/// Follows the curve of the structure along stretches of that of a balance.
class StructureCurve {
 public:
  StructureCurve(ContactProblem& problem, const FrequencySweep& curve, const StructurePointsOptions& options,
                 CurveEffort effort, Observer observer)
      : problem_(problem),
        curve_(curve),
        options_(options),
        effort_(effort),
        observer_(std::move(observer)) {}

  /// From the first point of a stretch, and where that does not come past its last one, back from that.
  OnStretch along(const Stretch& stretch) const;
  /// From the first point of the balance's curve through the whole interval, whatever becomes of the
  /// balance's, and back from its last point where the structure's does not pass that.
  OnStretch along_whole(const Stretch& all) const;

 private:
  OnStretch from_both_ends(const Stretch& stretch, ValueRange range, bool first_decides) const;
  StretchStart start_of(const Stretch& stretch, bool forwards) const;
  ExactCurve followed(ValueRange range, const StretchStart& start) const;
  ValueRange wider(const Stretch& stretch) const;

  ContactProblem& problem_;
  const FrequencySweep& curve_;
  const StructurePointsOptions& options_;
  CurveEffort effort_;
  Observer observer_;
};

/// Whether a motion lies within `reach` of a point of a balance's curve, as arc length: of the parameter by
/// `scale`, of the displacements by what the motion vibrates.
bool lies_on(ContactProblem& problem, const FrequencySweep& curve, const ExactEvent& event, double scale,
             double reach);

}  // namespace wavebalance::solvers::detail
