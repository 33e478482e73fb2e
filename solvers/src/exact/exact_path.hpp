#pragma once
#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "collocation/interval_agreement.hpp"
#include "exact/curve_path.hpp"
#include "exact/held_newton.hpp"

namespace wavebalance::solvers::detail {

/// A passage that moves by so much of a period has made a unit of arc length.
inline constexpr double passage_scale = 0.05;

/// A motion of a curve by its intervals, and how the curve goes on from it.
struct PathPoint : CurvePoint {
  CollocationIterate iterate;
  Eigen::VectorXd direction;   ///< as of HeldSolution, forwards along the curve
  double force_size = 1.0;     ///< N
  Layout intervals_of_motion;  ///< differ from the iterate's if it is no exact motion

  Eigen::Index passages() const { return static_cast<Eigen::Index>(iterate.layout.passages.size()); }
  Eigen::Index forces() const { return direction.size() - 1 - passages(); }
  /// Changes of the parameter, the passage and the fixed unknown, forwards along the curve.
  double motion_of_parameter() const { return direction[direction.size() - 1]; }
  double motion_of(int passage) const { return direction[forces() + passage]; }
  double motion_of(const Held& held) const { return direction[held.number(forces(), passages())]; }
  void turn_around() {
    direction = -direction;
    slope = -slope;
  }
};

/// Prediction at another place of the curve.
struct Prediction {
  double value = 0.0;
  CollocationIterate iterate;
};

/// A curve by contact intervals.
class PathModel : public CurvePath {
 public:
  using CurvePath::CurvePath;

  /// As of CurvePath, but at least by the instants of contact.
  double arc_length(const PathPoint& from, const PathPoint& to) const;
  PointOnCurve between(const CurvePoint& a, const CurvePoint& b, double share, bool turns) const override;
  /// The unknown that changes fastest forwards from a point, of passages, forces and, if it may be held, the
  /// parameter; and by what share of a unit of arc length it does.
  Held fastest(const PathPoint& at, bool parameter) const;
  double speed(const PathPoint& at) const;
  /// Sign of the change of the fixed unknown, forwards: 1 or -1.
  double sign_of(const PathPoint& at, const Held& held) const;
  /// Cosine of the angle between the secant from one point to another with the same contact intervals and
  /// the tangent there, in the parameter and the passages; for a prediction, with the tangent at the point.
  double cosine(const PathPoint& from, const PathPoint& to) const;
  double cosine(const PathPoint& from, const Prediction& to) const;
  /// Distance of a point from its prediction, in the parameter and the passages; as arc length.
  double distance(const Prediction& expected, const PathPoint& found) const;

  /// A start with fewer panels or nodes, if the last point resolves the solution far better than necessary.
  CollocationIterate coarser(const PathPoint& last, CollocationIterate start) const;

  /// The solution near a start with an unknown held, with as many nodes and panels as the tolerance needs and
  /// max_operations of its options allow.
  /// `forwards`: the sign of the change of the unknown held along the curve. Nothing where Newton's method
  /// does not converge, and at once after the observer has returned false.
  std::optional<PathPoint> solve(double value, CollocationIterate start, const Held& held,
                                 double forwards) const;

 private:
  PathPoint point_of(HeldSolution solution, const LegendreNodes& nodes, double error) const;
  /// Whether a few steps with these panels and nodes stay below max_operations.
  bool affords(const CollocationIterate& iterate, const LegendreNodes& nodes) const;
  Eigen::VectorXd change(const PathPoint& from, double value, const Layout& layout) const;
  double cosine(const Eigen::VectorXd& way, const PathPoint& at) const;
};

/// A layout with the forces that `force` gives at times of its panels, by these nodes.
using ForceInPanel = std::function<double(const Panel& panel, double time)>;
CollocationIterate with_forces(Layout layout, const LegendreNodes& nodes, const ForceInPanel& force);
/// The same forces by other nodes, and by the panels of the layout.
CollocationIterate with_nodes(const CollocationIterate& iterate, const LegendreNodes& nodes);

/// Along the tangent, to first order.
Prediction along_tangent(const PathPoint& at, double distance, double speed);
/// By the polynomial through points with the same intervals, which may have other panels.
Prediction through(const std::vector<const PathPoint*>& points, double place);

}  // namespace wavebalance::solvers::detail
