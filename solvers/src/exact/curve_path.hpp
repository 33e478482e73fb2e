#pragma once
#include <Eigen/Core>
#include <functional>
#include <memory>

#include "wavebalance/solvers/exact/exact_curve.hpp"

namespace wavebalance::solvers::detail {

/// A motion of a curve.
struct CurvePoint {
  double value = 0.0;            ///< of the parameter
  double place = 0.0;            ///< arc length from the first point with the same unknowns
  double slope = 0.0;            ///< of the parameter by arc length, forwards along the curve
  Eigen::VectorXd displacement;  ///< m, of all contacts at times l / N
  double vibration = 0.0;        ///< m, rms of the displacement about its mean
  ExactSolution motion;
  bool agrees = true;  ///< whether it is a motion of the structure
};

using PointOnCurve = std::shared_ptr<const CurvePoint>;

/// Constants along a curve.
class CurvePath {
 public:
  CurvePath(const ProblemFamily& family, const ExactSolution& first, const ExactCurveOptions& options);
  CurvePath(const CurvePath&) = delete;
  CurvePath& operator=(const CurvePath&) = delete;
  virtual ~CurvePath() = default;

  const ProblemFamily& family() const { return family_; }
  const ExactCurveOptions& options() const { return options_; }
  double parameter_scale() const { return parameter_scale_; }

  /// The point at a share of the way between two neighbours, whose parameter `turns` between them or does
  /// not. None where it is not found.
  virtual PointOnCurve between(const CurvePoint& a, const CurvePoint& b, double share, bool turns) const = 0;
  /// By the displacements, relative to the vibration, and by the parameter.
  double arc_length(const CurvePoint& from, const CurvePoint& to) const;

  /// Calls the observer with the number of points that a curve has and with the value of the last one, which
  /// are its progress in what follows, too. False where it returns false, or has.
  bool goes_on(int points, double value);
  /// Whether the observer has returned false. Later failures are then not significant.
  bool cancelled() const { return cancelled_; }

 protected:
  const Eigen::VectorXd& times() const { return times_; }
  double length() const { return length_; }        ///< m, the largest displacement of the first motion
  double vibration() const { return vibration_; }  ///< m, of the first motion
  const Observer& observer() const { return observer_; }

 private:
  const ProblemFamily& family_;
  const ExactCurveOptions& options_;
  double length_, vibration_, parameter_scale_;
  Eigen::VectorXd times_;
  Progress progress_{"exact curve"};
  mutable bool cancelled_ = false;
  Observer observer_;  // called within each step of Newton's method until it has returned false
};

/// m, the rms of displacements about their mean.
double vibration_of(const Eigen::MatrixXd& displacement);

/// A zero of a function of the points between two neighbours, at which it has different signs, to rounding.
/// None where a point between them is not found.
PointOnCurve zero_between(const CurvePath& path, const CurvePoint& a, const CurvePoint& b, bool turns,
                          const std::function<double(const CurvePoint&)>& function);

}  // namespace wavebalance::solvers::detail
