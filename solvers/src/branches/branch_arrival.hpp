#pragma once
#include <optional>
#include <utility>
#include <vector>

#include "stability/curve_motions.hpp"

namespace wavebalance::solvers {

/// A vector of `contacts` contacts whose samples are repeated `times` times each.
Eigen::VectorXd repeated(const Eigen::VectorXd& samples, int contacts, int times);

/// Half the difference between the first and the second half of each contact's samples: zero where the motion
/// repeats after half the period.
Eigen::VectorXd alternating_part(const Eigen::VectorXd& samples, int contacts);

/// The rms of that part over the rms of the samples; 0 of a motion at rest.
double alternating_share(const Eigen::VectorXd& samples, int contacts);

/// A curve whose bifurcation and grazing points begin branches, with its index as in Branch::parent.
struct Parent {
  int index = 0;
  int periods = 1;
  const FrequencySweep* curve = nullptr;
  const CurveStability* stability = nullptr;

  const std::vector<SpecialPoint>& special_points() const { return stability->special_points; }
};

/// Lengths in the space of unknowns and of what varies along a branch.
struct Scales {
  double displacement = 1.0, parameter = 1.0;

  double inner(const CurvePoint& a, const CurvePoint& b) const;
};

/// A start of a curve at the solution in the plane perpendicular to `change` through its end from the point
/// `origin` of another curve, at whatever frequency or load scale; nothing if there is none. Sets it in the
/// problem.
std::optional<SweepStart> motion_beside(ContactSystem& system, const CurvePoint& origin,
                                        const Eigen::VectorXd& change, const Scales& scales,
                                        SweepParameter parameter = SweepParameter::frequency);

/// Whether `first` lies in the direction, from the point `origin` of a curve, of that curve's next point
/// farther away.
bool lies_on(const FrequencySweep& curve, const CurvePoint& origin, const CurvePoint& first,
             const Scales& scales);

/// Ends a branch where it meets the curve that it left.
class Arrival {
 public:
  Arrival(const Parent& parent, int special_point, int contacts, Scales scales);

  /// Whether a step of the branch meets the other curve.
  bool operator()(const CurvePoint& before, const CurvePoint& after);
  /// After a branch was lost at `last`: whether that is near the curve that it left.
  bool is_beside(const CurvePoint& last) const;
  /// Takes as the end the bifurcation or grazing point nearest to the last one, within `reach`.
  void note_nearest(const CurvePoint& last, double reach);
  /// Index among the bifurcation and grazing points of the parent; -1 for none.
  int end_point() const { return end_point_; }
  double step() const { return step_; }  ///< length of the last step

 private:
  bool meets_half_period(const CurvePoint& before, const CurvePoint& after);
  bool passes(const CurvePoint& before, const CurvePoint& after, const CurvePoint& point) const;

  Scales scales_;
  int contacts_;
  bool doubled_;
  int started_at_, end_point_ = -1;
  double largest_ = 0.0, step_ = 0.0;
  std::vector<std::pair<int, CurvePoint>> ends_;
};

}  // namespace wavebalance::solvers
