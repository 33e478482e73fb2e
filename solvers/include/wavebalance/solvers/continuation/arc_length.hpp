#pragma once
#include <Eigen/Core>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "wavebalance/solvers/balance/contact_system.hpp"
#include "wavebalance/solvers/continuation/curve_corrector.hpp"

namespace wavebalance::solvers {

/// The parameter of a solution curve R(u; p) = 0.
class CurveParameter {
 public:
  virtual ~CurveParameter() = default;
  /// Whether there is a system of parameter p; a step that leads to another is too long.
  virtual bool contains(double p) const = 0;
  /// Sets the parameter of the system to p; evaluate() must follow.
  virtual void set(ContactSystem& system, double p) const = 0;
  /// dR/dp at the state last evaluated.
  virtual void slope(ContactSystem& system, Eigen::VectorXd& slope) const = 0;
};

/// p = CondensedProblem::load_frequency(), Hz.
class FrequencyParameter final : public CurveParameter {
 public:
  bool contains(double p) const override;
  void set(ContactSystem& system, double p) const override;
  void slope(ContactSystem& system, Eigen::VectorXd& slope) const override;
};

/// p = CondensedProblem::load_scale(), at the frequency that the problem has.
class LoadScaleParameter final : public CurveParameter {
 public:
  bool contains(double p) const override;
  void set(ContactSystem& system, double p) const override;
  void slope(ContactSystem& system, Eigen::VectorXd& slope) const override;
};

/// Which grazing events are solved for: the points of the curve where a sample reaches its gap, so that the
/// law's slope jumps and the curve has a kink.
enum class GrazingEvents {
  where_needed,       ///< those that no step passes
  at_turning_points,  ///< also those at turning points, and the first and the last contact
  all,                ///< no turning point can be missed; a few solves per event
  /// All where they are few, up to 512 samples, with a long step where the next event is not found. A pair
  /// that keeps an undamped Nyquist coefficient uses at_turning_points, because only long steps pass its
  /// resonances. The cost of all grows like the square of the samples, while each kink and the turning
  /// points that long steps miss become smaller. Beyond 512 samples it is where_needed, and a long step
  /// that contains a turning point is at most 0.02, so that the parameter varies by less than a thousandth
  /// of its scale within it.
  automatic
};

/// Scales, steps and limits of a curve followed by arc length. Lengths are in the scaled inner product of
/// CurvePoint.
struct ArcLengthOptions {
  double displacement_scale = 1.0;  ///< m: an rms change of u of this size is an arc length of 1
  double parameter_scale = 1.0;     ///< a change of p of this size is an arc length of 1
  /// At each point lengths are measured by how its contacts vibrate: by the rms of each less its mean, at
  /// least by this share of displacement_scale. Laws of one instant change over a gap: displacement_scale is
  /// then the most. Friction changes over how far it slips, which has no bound. 1: by displacement_scale
  /// everywhere. In (0, 1].
  double least_scale = 1.0;
  double initial_step = 0.02;  ///< scaled arc length
  double min_step = 1e-3;      ///< scaled arc length of a long step; within a piece steps may be 1e-4 of it
  double max_step = 0.25;      ///< scaled arc length
  /// rad, between the tangent of a point and the chord to the next, and between the tangents of successive
  /// points; the latter may differ by twice as much after a long step of more than 512 samples.
  static constexpr double max_angle = 0.35;
  /// Newton steps per point; half as many after a long step, twice as many with more than 512 samples.
  int max_corrections = 8;
  double tolerance = 1e-10;  ///< on the relative residual
  GrazingEvents grazing_events = GrazingEvents::at_turning_points;
  /// Operations of the linear systems of all points. The curve ends with no_point when they are used up.
  double max_operations = std::numeric_limits<double>::infinity();

  /// Throws std::invalid_argument for a number out of its range; scales of 0 mean a default of the caller.
  void validate() const;
};

namespace detail {

/// The equations of ArcLength.
struct ResponseEquations {
  using Pieces = LawSegments;

  ResponseEquations(ContactSystem& contacts, const CurveParameter& along, const ArcLengthOptions& lengths);

  ContactSystem& system;
  const CurveParameter& parameter;
  ArcLengthOptions options;
  bool many_samples;  ///< so many that steps pass grazing events together
  /// Value of the operation counter at which the curve must stop.
  double operation_limit = std::numeric_limits<double>::infinity();
  Eigen::VectorXd slope;
  Eigen::VectorXd scales;  ///< C, m: instead of displacement_scale for each contact, at the present point

  /// Sets `scales` for a solution.
  void set_scales(const Eigen::VectorXd& displacement);
  double evaluate(const CurvePoint& point, const LawSegments* sides);
  const Eigen::VectorXd& residual() const { return system.residual(); }
  bool solve_bordered(const Eigen::VectorXd& row, double last, const Eigen::VectorXd& right,
                      double last_right, Eigen::VectorXd& change, double& parameter_change);
  int determinant_sign() const { return system.determinant_sign(); }
  Eigen::VectorXd weighted(const Eigen::VectorXd& tangent) const;
  double squared_parameter_scale() const { return options.parameter_scale * options.parameter_scale; }
  double tolerance() const { return options.tolerance; }
  int max_corrections(bool in_piece) const;
  /// Whether corrections must lower the residual, for laws over a period.
  bool lowers_residual() const { return system.laws().act_over_period(); }
};

}  // namespace detail

/// Pseudo-arc-length continuation [H. B. Keller, in: Applications of Bifurcation Theory, 1977; R. Seydel,
/// Practical Bifurcation and Stability Analysis, 2010, chapter 4] of a piecewise smooth solution curve.
///
/// The bordered Newton matrix passes smooth folds. Long steps pass grazing events without solving for them.
/// Where a long step fails, or contains a turning point, the curve is followed piece by piece: while every
/// sample keeps its side of the gap the curve is smooth; the first sample that would change sides is placed
/// at its gap, and the next piece starts with that sample on the other side.
///
/// Kinks of laws over a period, such as friction, are not known beforehand. Where their state changes the
/// curve has a corner. Short steps approach it, and continue along the segment whose tangent leads into it.
///
/// The sign of det [R_u R_p; tangent^T] is the same on both sides of a fold and of a grazing event of one
/// sample. A long step to a point with the other sign is refused. The sign changes only where two curves
/// cross. That happens in symmetric structures, where several samples reach their gaps together: all of
/// them change sides. From there on the curve is followed segment by segment; with more than 512 samples,
/// which would need too many segments, by long steps that do not compare the sign.
class ArcLength : private CurveCorrector<detail::ResponseEquations> {
 public:
  /// no_point: no further point was found, or the operations are used up.
  enum class Status { advanced, no_point };

  ArcLength(ContactSystem& system, const CurveParameter& parameter, ArcLengthOptions options);

  /// Starts at a solution `displacement` of parameter p, towards growing (direction = +1) or falling p.
  Status start(const Eigen::VectorXd& displacement, double p, double direction);
  /// Starts at a solution, on that side of it to which its tangent points. Only the sign of the product with
  /// the curve's own tangent matters, which must not vanish.
  Status start(const CurvePoint& solution);
  /// Goes one step along the curve. O(corrections (active^3 + N log N)).
  Status advance();
  /// Finds the zero of `value` between previous() and point(), by false position along the last step. False
  /// when the corrector fails or `value` has the same sign at both.
  bool locate(const std::function<double(const CurvePoint&)>& value, CurvePoint& point);

  /// Finds the turning point between previous() and point() in the same way: to 1e-10 of the step, to 1e-4 of
  /// a long step of more than 512 samples.
  bool locate_turning_point(CurvePoint& point);
  /// Finds a point of the curve between two of its points, in the plane through their chord at `fraction` of
  /// it and perpendicular to it, whatever the present point. False when the corrector fails or leads farther
  /// from the chord than `farthest`, in arc length: to another curve. The point has no tangent.
  bool between(const CurvePoint& from, const CurvePoint& to, double fraction, CurvePoint& point,
               double farthest = std::numeric_limits<double>::infinity());
  /// The scaled arc length of the chord of two points, measured at the first.
  double distance(const CurvePoint& from, const CurvePoint& to);

  const CurvePoint& point() const { return point_; }
  const CurvePoint& previous() const { return previous_; }

 private:
  using Plane = CurvePlane;

  bool is_beyond_corner(const CurvePoint& candidate) const;
  std::optional<CurvePoint> point_from_corner(double length, bool backwards,
                                              std::optional<CurvePoint>& other);
  bool turn_corner();
  bool is_ahead(const CurvePoint& candidate, double max_turn) const;
  double max_turn() const;
  double growth(int corrections, double turn) const;
  bool locate(const std::function<double(const CurvePoint&)>& value, double width, CurvePoint& point);
  /// A sample and the kink of its law that it reaches; no sample where it is -1.
  struct Crossing {
    int sample = -1;
    int kink = 0;
  };
  int kink_at(const CurvePoint& point, int sample) const;
  bool touches(const LawSegments& pieces) const;
  bool skips_grazing_turn(const CurvePoint& candidate) const;
  void accept(CurvePoint&& candidate, const LawSegments& sides);

  bool step_far();
  bool step_in_piece();
  bool step_smoothly(double step, const LawSegments& sides, CurvePoint& candidate);
  bool pass_grazing_event(Crossing crossing, double distance, const LawSegments& sides);
  Crossing crossing_ahead(double& distance) const;
  Crossing passed(const CurvePoint& candidate, const LawSegments& sides) const;
  LawSegments sides_of(const CurvePoint& point) const;
  std::vector<Crossing> samples_at_kinks(const CurvePoint& point) const;
  bool leads_to(Crossing crossing, const LawSegments& sides, CurvePoint& event);
  bool tangent_through(int sample, bool inwards, CurvePoint& event);
  bool grazing_tangent(int sample, const std::vector<Crossing>& together, const std::vector<bool>& beyond,
                       CurvePoint& event);
  bool leave_grazing_event(int sample, const CurvePoint& arrives, CurvePoint& event);

  ContactSystem& system_;
  const CurveParameter& parameter_;
  ArcLengthOptions options_;
  bool events_first_ = false;  // long steps only where the next grazing event is not found
  CurvePoint point_, previous_;
  Eigen::VectorXd previous_scales_;  // in which the tangent of previous_ has the length 1
  double step_ = 0.0;
  double last_step_ = 0.0;             // from previous_ to point_, along the tangent of previous_
  LawSegments last_sides_;             // sides of the piece that both lie on; empty if there may be several
  double reversal_step_ = 0.0;         // length of the last long step that contained a turning point
  double piecewise_arc_length_ = 0.0;  // arc length that is to be followed piece by piece
  // Curves have crossed, so that the orientation is no check of long steps.
  bool orientation_unknown_ = false;
  Eigen::VectorXd slope_;
};

}  // namespace wavebalance::solvers
