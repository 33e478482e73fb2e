#pragma once
#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "exact/held_newton.hpp"
#include "phases/phase_agreement.hpp"
#include "wavebalance/solvers/exact/exact_curve.hpp"

namespace wavebalance::solvers::detail {

/// A passage that moves by so much of a period has made a unit of arc length.
inline constexpr double passage_scale = 0.05;

/// A motion of a curve, and how the curve goes on from it.
struct PathPoint {
  double value = 0.0;
  double place = 0.0;  ///< arc length from the first point with these phases
  PhaseIterate iterate;
  Eigen::VectorXd direction;     ///< as of HeldSolution, forwards along the curve
  Eigen::VectorXd displacement;  ///< m, of all contacts at times l / N
  double vibration = 0.0;        ///< m, rms of the displacement about its mean
  double force_size = 1.0;       ///< N
  PhaseMotion motion;
  Layout phases_of_motion;  ///< others than those of the iterate where it is no motion of the structure
  bool agrees = false;

  Eigen::Index passages() const { return static_cast<Eigen::Index>(iterate.layout.passages.size()); }
  Eigen::Index forces() const { return direction.size() - 1 - passages(); }
  /// Of the parameter, the passage and the unknown held, forwards along the curve.
  double slope() const { return direction[direction.size() - 1]; }
  double motion_of(int passage) const { return direction[forces() + passage]; }
  double motion_of(const Held& held) const { return direction[held.number(forces(), passages())]; }
};

/// What is expected at another place of the curve.
struct Prediction {
  double value = 0.0;
  PhaseIterate iterate;
};

/// What does not change along a curve.
class PathModel {
 public:
  PathModel(const PhaseFamily& family, const PhaseMotion& first, const ExactCurveOptions& options);
  PathModel(const PathModel&) = delete;
  PathModel& operator=(const PathModel&) = delete;

  const PhaseFamily& family() const { return family_; }
  const ExactCurveOptions& options() const { return options_; }
  double length() const { return length_; }
  double parameter_scale() const { return parameter_scale_; }
  double arc_length(const PathPoint& from, const PathPoint& to) const;
  /// The unknown that changes fastest forwards from a point, of passages, forces and, if it may be held, the
  /// parameter; and by what share of a unit of arc length it does.
  Held fastest(const PathPoint& at, bool parameter) const;
  double speed(const PathPoint& at) const;
  /// Of the change of the unknown held, forwards: 1 or -1.
  double sign_of(const PathPoint& at, const Held& held) const;
  /// Of the angle between the way from one point to another with the same phases and the direction there, in
  /// the parameter and the passages; of that to a prediction, with the direction of the point.
  double cosine(const PathPoint& from, const PathPoint& to) const;
  double cosine(const PathPoint& from, const Prediction& to) const;
  /// Of a point from where it was expected, of the parameter and the passages; as arc length.
  double distance(const Prediction& expected, const PathPoint& found) const;

  /// A start with fewer panels or nodes, where those of the last point resolve it far better than they have
  /// to.
  PhaseIterate coarser(const PathPoint& last, PhaseIterate start) const;

  /// The solution near a start with an unknown held, with as many nodes and panels as the tolerance needs and
  /// max_operations of its options allow.
  /// `forwards`: the sign of the change of the unknown held along the curve. Nothing where Newton's method
  /// does not converge, and at once after the observer has returned false.
  std::optional<PathPoint> solve(double value, PhaseIterate start, const Held& held, double forwards) const;

  /// Calls the observer with the number of points that a curve has and with the value of the last one, which
  /// are its progress in what follows, too. False where it returns false, or has.
  bool goes_on(int points, double value);
  /// Whether the observer has returned false. What was not found since then says nothing.
  bool cancelled() const { return cancelled_; }

 private:
  PathPoint point_of(HeldSolution solution, const LegendreNodes& nodes, double error) const;
  /// Whether a few steps with these panels and nodes stay below max_operations.
  bool affords(const PhaseIterate& iterate, const LegendreNodes& nodes) const;
  Eigen::VectorXd change(const PathPoint& from, double value, const Layout& layout) const;
  double cosine(const Eigen::VectorXd& way, const PathPoint& at) const;

  const PhaseFamily& family_;
  const ExactCurveOptions& options_;
  double length_, vibration_, parameter_scale_;
  Eigen::VectorXd times_;
  Progress progress_{"exact curve"};
  mutable bool cancelled_ = false;
  Observer observer_;  // called within each step of Newton's method until it has returned false
};

/// A layout with the forces that `force` gives at times of its panels, by these nodes.
using ForceInPanel = std::function<double(const Panel& panel, double time)>;
PhaseIterate with_forces(Layout layout, const LegendreNodes& nodes, const ForceInPanel& force);
/// The same forces by other nodes, and by the panels of the layout.
PhaseIterate with_nodes(const PhaseIterate& iterate, const LegendreNodes& nodes);

/// Along the tangent, to first order.
Prediction along_tangent(const PathPoint& at, double distance, double speed);
/// By the polynomial through points with the same phases, which may have other panels.
Prediction through(const std::vector<const PathPoint*>& points, double place);

/// The point at a share of the way between two neighbours, as zero_between() has it.
std::optional<PathPoint> point_between(const PathModel& model, const PathPoint& a, const PathPoint& b,
                                       const Held& held, double share);

/// A zero of a function of the points between two neighbours, at which it has different signs, to rounding.
/// `held`: an unknown that changes monotonically from one to the other. Nothing where a point between them is
/// not found.
std::optional<PathPoint> zero_between(const PathModel& model, const PathPoint& a, const PathPoint& b,
                                      const Held& held,
                                      const std::function<double(const PathPoint&)>& function);

}  // namespace wavebalance::solvers::detail
