#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <utility>

namespace wavebalance::solvers {

/// A point of a solution curve R(u, p) = 0 with its tangent, which has the length 1 in the inner product of
/// the curve. On the response curve of a ContactSystem u are displacements, and the product is
/// <(u, p), (v, q)> = u.v / (samples() displacement_scale^2) + p q / parameter_scale^2.
struct CurvePoint {
  Eigen::VectorXd displacement;  ///< m, samples() values
  double parameter = 0.0;
  Eigen::VectorXd displacement_tangent;
  double parameter_tangent = 0.0;
  double residual = 0.0;
  int orientation = 0;  ///< sign of det [R_u R_p; tangent^T]; 0 when unknown
  /// A grazing event: the law's slope jumps here, and the tangent belongs to the next segment.
  bool grazing = false;
};

/// The points (u, p) with row.u + parameter p = offset.
struct CurvePlane {
  Eigen::VectorXd row;
  double parameter = 0.0;
  double offset = 0.0;
  double tolerance = 0.0;  ///< on miss()

  double miss(const CurvePoint& point) const {
    return row.dot(point.displacement) + parameter * point.parameter - offset;
  }
};

/// The equations R(u, p) = 0 of a curve, as many as u has numbers, with the inner product that lengths are
/// measured in.
template <class E>
concept CurveEquations = requires(E equations, const E& constant, const CurvePoint& at,
                                  const Eigen::VectorXd& u, double number, const typename E::Pieces* pieces,
                                  Eigen::VectorXd& u_change, double& p_change) {
  // The relative residual, not finite where R cannot be evaluated: on the smooth continuation of some pieces
  // of R, where they are given.
  { equations.evaluate(at, pieces) } -> std::same_as<double>;
  { equations.residual() } -> std::convertible_to<Eigen::VectorXd>;  // where R was last evaluated
  // Solves [R_u R_p; row] (u_change, p_change) = right there, for a row (u, number) and a right side (u,
  // number). False where the matrix is singular.
  { equations.solve_bordered(u, number, u, number, u_change, p_change) } -> std::same_as<bool>;
  { constant.determinant_sign() } -> std::same_as<int>;  // of that matrix; 0 when unknown
  { constant.weighted(u) } -> std::convertible_to<Eigen::VectorXd>;
  { constant.squared_parameter_scale() } -> std::same_as<double>;  // (u, p).(u, p) = weighted(u).u + p^2 / it
  { constant.tolerance() } -> std::same_as<double>;                // on the relative residual
  { constant.max_corrections(true) } -> std::same_as<int>;         // with pieces, or without
};

/// Predictor and corrector of a curve by pseudo arc length: Newton's method on R = 0 within a plane, whose
/// bordered matrix passes smooth folds.
template <CurveEquations Equations>
class CurveCorrector {
 public:
  using Pieces = typename Equations::Pieces;

  explicit CurveCorrector(Equations curve) : curve_(std::move(curve)) {}

  Equations& curve() { return curve_; }
  const Equations& curve() const { return curve_; }

  /// The product of the tangents of two points.
  double inner(const CurvePoint& a, const CurvePoint& b) const {
    return curve_.weighted(a.displacement_tangent).dot(b.displacement_tangent) +
           a.parameter_tangent * b.parameter_tangent / curve_.squared_parameter_scale();
  }
  void normalize(CurvePoint& point) const {
    const double length = std::sqrt(inner(point, point));
    point.displacement_tangent /= length;
    point.parameter_tangent /= length;
  }
  /// The way between two points, as the tangent of one, not normalized.
  static CurvePoint chord(const CurvePoint& from, const CurvePoint& to) {
    CurvePoint way;
    way.displacement_tangent = to.displacement - from.displacement;
    way.parameter_tangent = to.parameter - from.parameter;
    return way;
  }
  /// The length of the chord of two points.
  double distance(const CurvePoint& from, const CurvePoint& to) const {
    const CurvePoint way = chord(from, to);
    return std::sqrt(inner(way, way));
  }
  CurvePoint ahead(const CurvePoint& from, double step) const {
    CurvePoint point;
    point.displacement = from.displacement + step * from.displacement_tangent;
    point.parameter = from.parameter + step * from.parameter_tangent;
    return point;
  }
  /// The plane through a point perpendicular to the tangent of `along`.
  CurvePlane plane_across(const CurvePoint& along, const CurvePoint& through) const {
    CurvePlane plane{curve_.weighted(along.displacement_tangent),
                     along.parameter_tangent / curve_.squared_parameter_scale(), 0.0, 1e-9};
    plane.offset = plane.miss(through);
    return plane;
  }

  /// Newton's method on R = 0 in the plane from `point` on, on the smooth continuation of one piece when it
  /// is given. Where the residual does not fall and the parameter hardly changes, the parameter is held: the
  /// matrices of R round differently from one parameter to the next, and at one of them not at all.
  bool solve_in(const CurvePlane& plane, const Pieces* pieces, CurvePoint& point, int& corrections) {
    constexpr double near = 1e-8, falls = 0.1;  // near: scaled arc length
    bool held = false;
    const double least_change = near * std::sqrt(curve_.squared_parameter_scale());
    double parameter_change = 0.0;
    const int most = curve_.max_corrections(pieces != nullptr);
    point.residual = curve_.evaluate(point, pieces);
    for (corrections = 0; corrections <= most && std::isfinite(point.residual); ++corrections) {
      const double miss = plane.miss(point), before = point.residual;
      if (before <= curve_.tolerance() && (held || std::abs(miss) <= plane.tolerance)) return true;
      const CurvePlane in = held ? at_parameter(point) : plane;
      if (!curve_.solve_bordered(in.row, in.parameter, curve_.residual(), in.miss(point), change_,
                                 parameter_change))
        return false;
      take_change(pieces, held ? 0.0 : parameter_change, point);
      held = held || (std::abs(parameter_change) <= least_change && std::abs(plane.miss(point)) <= near &&
                      point.residual > falls * before);
    }
    return false;
  }

  static CurvePlane at_parameter(const CurvePoint& point) {
    return {Eigen::VectorXd::Zero(point.displacement.size()), 1.0, point.parameter, 0.0};
  }

  /// Takes the whole change, or of equations without known pieces a part of it that lowers the residual: such
  /// a force changes its slopes from sample to sample, among which whole steps may cycle. Evaluates the
  /// point.
  void take_change(const Pieces* pieces, double parameter_change, CurvePoint& point) {
    bool damped = false;
    if constexpr (requires { curve_.lowers_residual(); }) damped = curve_.lowers_residual();
    constexpr double least = 1.0 / 64.0;
    const CurvePoint from = point;
    for (double share = 1.0;; share *= 0.5) {
      point.displacement = from.displacement - share * change_;
      point.parameter = from.parameter - share * parameter_change;
      point.residual = curve_.evaluate(point, pieces);
      if (!damped || share <= least || point.residual < from.residual) return;
    }
  }

  /// The tangent at an evaluated point, with the orientation of the tangent of `along`.
  bool tangent_at(CurvePoint& point, const CurvePoint& along) {
    const double last = along.parameter_tangent / curve_.squared_parameter_scale();
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(curve_.residual().size());
    if (!curve_.solve_bordered(curve_.weighted(along.displacement_tangent), last, zero, 1.0,
                               point.displacement_tangent, point.parameter_tangent))
      return false;
    if (!point.displacement_tangent.allFinite() || !std::isfinite(point.parameter_tangent)) return false;
    const int sign = curve_.determinant_sign();
    point.orientation = sign == 0 ? along.orientation : sign;
    normalize(point);
    return true;
  }

  /// Solves for the point in the plane at distance `step` along the tangent of `from`, and for its tangent.
  bool correct(const CurvePoint& from, double step, const Pieces* pieces, CurvePoint& to, int& corrections) {
    to = ahead(from, step);
    return solve_in(plane_across(from, to), pieces, to, corrections) && tangent_at(to, from);
  }

  /// Solves for a point, without a tangent, in the plane through the chord of two points at `fraction` of it
  /// and perpendicular to it. False also for one farther from the chord than `farthest`: Newton's method may
  /// lead to another curve, which meets the plane, too.
  bool between(const CurvePoint& from, const CurvePoint& to, double fraction, double farthest,
               CurvePoint& point, int& corrections) {
    CurvePoint way = chord(from, to), start;
    normalize(way);
    start.displacement = (1.0 - fraction) * from.displacement + fraction * to.displacement;
    start.parameter = (1.0 - fraction) * from.parameter + fraction * to.parameter;
    point = start;
    return solve_in(plane_across(way, start), nullptr, point, corrections) &&
           distance(start, point) <= farthest;
  }

 private:
  Equations curve_;
  Eigen::VectorXd change_;
};

/// Outcome of an attempted step.
enum class StepAttempt { taken, too_long, lost };

/// Halves `step` until `attempt(step)` is taken. False, with a step of at least `shortest`, where one is lost
/// or shorter ones are too long, too.
template <class Attempt>
bool halve_until_taken(double& step, double shortest, Attempt&& attempt) {
  for (; step >= shortest; step *= 0.5) {
    const StepAttempt result = attempt();
    if (result == StepAttempt::taken) return true;
    if (result == StepAttempt::lost) break;
  }
  step = std::max(step, shortest);
  return false;
}

}  // namespace wavebalance::solvers
