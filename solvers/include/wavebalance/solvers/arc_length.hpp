#pragma once
#include <Eigen/Core>
#include <functional>
#include <vector>

#include "wavebalance/solvers/contact_system.hpp"

namespace wavebalance::solvers {

/// The parameter of a solution curve R(u; p) = 0.
class CurveParameter {
 public:
  virtual ~CurveParameter() = default;
  /// Whether there is a system of parameter p; a step that leads to another is too long.
  virtual bool contains(double p) const = 0;
  /// Makes the system that of parameter p; evaluate() must follow.
  virtual void set(ContactSystem& system, double p) const = 0;
  /// dR/dp at the state last evaluated.
  virtual void slope(ContactSystem& system, Eigen::VectorXd& slope) const = 0;
};

/// p = frequency in Hz.
class FrequencyParameter final : public CurveParameter {
 public:
  bool contains(double p) const override;
  void set(ContactSystem& system, double p) const override;
  void slope(ContactSystem& system, Eigen::VectorXd& slope) const override;
};

/// p = ln of the factor on the contact law: 0 is the law itself.
class StiffnessParameter final : public CurveParameter {
 public:
  bool contains(double p) const override;
  void set(ContactSystem& system, double p) const override;
  void slope(ContactSystem& system, Eigen::VectorXd& slope) const override;
};

struct ArcLengthOptions {
  double displacement_scale = 1.0;  ///< m: an rms change of u of this size is an arc length of 1
  double parameter_scale = 1.0;     ///< a change of p of this size is an arc length of 1
  double initial_step = 0.02;
  double smallest_step = 1e-3;  ///< below it the step is taken to end at a corner of the curve
  double largest_step = 0.25;
  double largest_angle = 0.35;  ///< rad, between the tangents of successive points
  int max_corrections = 8;
  double tolerance = 1e-10;  ///< on the relative residual
};

/// A point of a solution curve with its unit tangent in the scaled inner product
/// <(u, p), (v, q)> = u.v / (samples() displacement_scale^2) + p q / parameter_scale^2.
struct CurvePoint {
  Eigen::VectorXd displacement;  ///< m, samples() values
  double parameter = 0.0;
  Eigen::VectorXd displacement_tangent;
  double parameter_tangent = 0.0;
  double residual = 0.0;
  int orientation = 0;  ///< sign of det [R_u R_p; tangent^T]; 0 when unknown
  bool corner = false;  ///< the contact law's slope jumps here; the tangent is that of the side ahead
};

/// Pseudo-arc-length continuation of a piecewise smooth solution curve. A smooth fold is passed by the
/// bordered Newton matrix. At a corner, where a sample reaches the gap and the law's slope jumps, steps along
/// the tangent of the side behind may miss the curve however short they are: the corner is then solved for (R
/// = 0 with that sample at the gap) and left along the tangent of the side ahead, on which every sample at
/// its gap moves to the side whose stiffness it has. Orientation is by the sign of det [R_u R_p; tangent^T],
/// which stays over folds and corners: a step that lands on a part of the curve that faces back is taken
/// shorter.
class ArcLength {
 public:
  enum class Status { advanced, no_point };

  ArcLength(ContactSystem& system, const CurveParameter& parameter, ArcLengthOptions options);

  /// Starts at a solution `displacement` of parameter p, towards growing (direction = +1) or falling p.
  Status start(const Eigen::VectorXd& displacement, double p, double direction);
  /// Goes one step along the curve. O(corrections (active^3 + N log N)).
  Status advance();
  /// Between previous() and point(), the point where `value` vanishes, by false position along the last step;
  /// `value` must change its sign between the two. False when the corrector fails or the sign does not
  /// change.
  bool locate(const std::function<double(const CurvePoint&)>& value, CurvePoint& point);

  const CurvePoint& point() const { return point_; }
  const CurvePoint& previous() const { return previous_; }

 private:
  bool correct(const CurvePoint& from, double step, CurvePoint& to, int& corrections);
  bool tangent_at(CurvePoint& point, const CurvePoint& along);
  bool same_sides(const CurvePoint& candidate) const;
  bool continues(const CurvePoint& candidate, double step) const;
  bool is_at_gap(const CurvePoint& point, int sample) const;
  bool step_along();
  bool turn_corner(double within);
  int crossing_ahead(double& distance) const;
  int passed_before(int sample, const CurvePoint& corner, double& fraction) const;
  bool solve_corner(int sample, double distance, CurvePoint& corner);
  std::vector<int> samples_at_gap(const CurvePoint& point) const;
  bool corner_tangent(int sample, const std::vector<int>& together, const std::vector<bool>& presses,
                      bool through, CurvePoint& corner);
  bool leave_corner(int sample, CurvePoint& corner);
  void normalize(CurvePoint& point) const;
  double inner(const CurvePoint& a, const CurvePoint& b) const;
  Eigen::VectorXd scaled(const Eigen::VectorXd& tangent) const;

  ContactSystem& system_;
  const CurveParameter& parameter_;
  ArcLengthOptions options_;
  CurvePoint point_, previous_;
  double step_ = 0.0;
  double last_step_ = 0.0;
  bool oriented_ = true;  // whether a step must keep the orientation
  Eigen::VectorXd slope_, change_;
};

}  // namespace wavebalance::solvers
