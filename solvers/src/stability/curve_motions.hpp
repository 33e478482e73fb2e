#pragma once
#include <utility>

#include "wavebalance/solvers/stability/curve_stability.hpp"
#include "wavebalance/solvers/time/translate_spectrum.hpp"

namespace wavebalance::solvers {

inline CurvePoint curve_point(Eigen::VectorXd displacement, double parameter) {
  CurvePoint point;
  point.displacement = std::move(displacement);
  point.parameter = parameter;
  return point;
}

/// The motions on a curve and between its points.
class CurveMotions {
 public:
  /// Lengths as in `options` with the parameter_scale by which frequency_sweep() measures steps, and where
  /// displacement_scale is 0 the largest displacement. Throws std::invalid_argument, of `who`, for a curve
  /// without unknowns. Keeps all by reference.
  CurveMotions(const char* who, CondensedProblem& problem, const ContactLaws& laws,
               const FrequencySweep& curve, ArcLengthOptions options, int output_points);

  ArcLength& path() { return path_; }
  double value_of(const SweepPoint& point) const { return parameter_of(point, curve_.parameter); }
  CurvePoint at(const SweepPoint& point) const { return curve_point(point.unknown, value_of(point)); }
  PeriodicResponse response(const CurvePoint& point);
  /// The share of the chord between two points at which the number of contact intervals first changes, by
  /// linear interpolation of samples; 0.5 if no sample determines it.
  double share_of_grazing(const CurvePoint& a, const CurvePoint& b) const;
  /// A bifurcation or grazing point between two others, in the middle of which its parameter is, with the
  /// displacements and the unknown of the first. `next` is the index of the point of the curve behind it.
  SpecialPoint special_point(SpecialPointType type, const CurvePoint& a, const CurvePoint& b,
                             std::size_t next);

 private:
  const FrequencySweep& curve_;
  ContactSystem system_;
  ArcLength path_;
  TrialEvaluator evaluator_;
  int points_;  // samples of a contact
};

}  // namespace wavebalance::solvers
