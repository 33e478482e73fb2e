#pragma once
#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "exact/curve_path.hpp"
#include "exact/map_slopes.hpp"
#include "wavebalance/solvers/flow/contact_flow.hpp"

namespace wavebalance::solvers::detail {

/// A state in which a period begins at a value of the parameter.
struct MapStart : PeriodStart {
  double value = 0.0;
};

/// Events along a curve: a contact begins to touch, to open, to slip or to stick.
struct ContactPattern {
  std::vector<int> passages;  ///< of each contact, between open and not open, in a period
  std::vector<bool> sticks;   ///< whether each contact sticks in some of the period
  bool slips = false;         ///< whether a contact with friction slips or opens
  bool operator==(const ContactPattern&) const = default;
};
/// The pattern of the last period of a flow.
ContactPattern pattern_of(const ContactFlow& flow);

/// The unit vector of the parameter, after the states.
inline Eigen::VectorXd along_parameter(Eigen::Index states) {
  return Eigen::VectorXd::Unit(states + 1, states);
}

/// A motion of a curve by the map of a period of the flow, and how the curve goes on from it.
struct MapPoint : CurvePoint {
  MapStart start;
  Eigen::VectorXd weights;  ///< m, of the states in displacements
  MapSlopes slopes;
  ContactPattern pattern;
  std::vector<FlowEvent> events;           ///< of the period from the start
  double nearest_event = 1.0, calm = 1.0;  ///< periods: from the beginning, and the longest time without one
  Eigen::VectorXd direction;               ///< of the states and the parameter by arc length, forwards
  Eigen::VectorXd displacement_direction;  ///< m, of CurvePoint::displacement by arc length

  void turn_around() {
    direction = -direction;
    displacement_direction = -displacement_direction;
    slope = -slope;
  }
};

/// A curve of motions that come back after a period of the flow from event to event: x - P(x, parameter) =
/// 0. The contact states in a period follow from the laws, so their changes need no special treatment.
class MapPath : public CurvePath {
 public:
  using CurvePath::CurvePath;

  /// The point near a motion, from a time far from all events; `forwards`: the sign of the change of the
  /// parameter.
  std::shared_ptr<MapPoint> first(double value, const ExactSolution& motion, double forwards) const;
  /// The same point from a time farther from all events.
  std::shared_ptr<MapPoint> begun_anew(const MapPoint& point) const;
  /// The point near a start on the plane through it perpendicular to the direction of a neighbouring point.
  std::shared_ptr<MapPoint> solve(const MapStart& start, const MapPoint& beside) const;
  /// Displacements of all contacts, near these, that come back where contacts keep the states which they have
  /// at the beginning, and the point there.
  std::optional<Eigen::VectorXd> kept(double value, const Eigen::VectorXd& displacement) const;
  std::shared_ptr<MapPoint> solve_kept(double value, const Eigen::VectorXd& displacement) const;
  PointOnCurve between(const CurvePoint& a, const CurvePoint& b, double share, bool turns) const override;
  /// The parameter at a share of the way between two points, and what contacts do there.
  std::optional<std::pair<double, ContactPattern>> pattern_between(const MapPoint& a, const MapPoint& b,
                                                                   double share) const;

  /// CurvePoint::displacement of a motion.
  Eigen::VectorXd displacement_of(const ExactSolution& motion) const {
    return motion.displacement(times()).reshaped();
  }
  double arc_scale(const CurvePoint& at) const { return std::max(vibration(), at.vibration); }
  /// Estimated floating-point operations since the last call.
  double take_operations() const;

 private:
  struct Period;
  struct Step;
  /// A start that comes back.
  struct Closed {
    MapStart start;
    ContactFlow flow;
    double distance;
    int iterations;
    std::optional<MapSlopes> slopes;  // there or near
  };

  std::optional<Closed> closed_as_kept(double value, const Eigen::VectorXd& displacement) const;
  MapStart near_start(double value, const Eigen::MatrixXd& displacement, const Eigen::MatrixXd& force) const;
  std::optional<Period> period(const MapStart& start, double tolerance, bool with_map, int points = 0) const;
  Eigen::MatrixXd off_center_by_moves(const MapStart& start, const Period& own, double tolerance,
                                      const MapSlopes& slopes) const;
  void add_middles(const MapStart& start, const Period& own, double tolerance, MapSlopes& slopes) const;
  std::optional<MapSlopes> slopes_at(const MapStart& start, double tolerance) const;
  std::optional<Step> part_of(const Eigen::VectorXd& step, const MapStart& start, double distance,
                              double shortest, double tolerance) const;
  std::optional<Step> passed(const MapStart& start, const Period& now, double tolerance,
                             int& unsettled) const;
  std::optional<Closed> closed_as_it_rests(MapStart start, const Eigen::VectorXd& held,
                                           std::optional<MapSlopes> slopes, double tolerance) const;
  std::optional<Closed> closed(MapStart start, const Eigen::VectorXd& held, std::optional<MapSlopes> slopes,
                               double tolerance) const;
  std::shared_ptr<MapPoint> solved(const MapStart& start, const Eigen::VectorXd& held,
                                   const std::optional<MapSlopes>& slopes) const;
  std::shared_ptr<MapPoint> point_of(Closed found, const Eigen::VectorXd& held) const;
  /// Changes by a tangent: displacements (m), and the residual of the states.
  struct Along {
    Eigen::VectorXd displacement, away;
  };
  std::optional<Along> along(const MapPoint& point, const Eigen::VectorXd& tangent, double part) const;
  bool set_direction(MapPoint& point, const Eigen::VectorXd& held) const;
  std::pair<MapStart, Eigen::VectorXd> on_chord(const MapPoint& a, const MapPoint& b, double share,
                                                bool turns) const;
  /// The plane perpendicular to a change of states and parameter, with displacements and the parameter by
  /// their scales; `weights` are displacements by states.
  Eigen::VectorXd plane_across(const Eigen::VectorXd& change, const Eigen::VectorXd& weights) const;

  mutable double tolerance_ = 1e-10, operations_ = 0.0;
  mutable bool keeps_states_ = false;  // FlowOptions::keeps_states
};

}  // namespace wavebalance::solvers::detail
