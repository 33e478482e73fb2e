#pragma once
#include <optional>
#include <vector>

#include "wavebalance/solvers/continuation/arc_length.hpp"

namespace wavebalance::solvers {

/// Points of a curve by which its return to an earlier point of itself is recognised: its first point, and
/// one near each number of points 2^n. A cycle of points entered at any point is noticed before its points
/// have doubled twice [R. P. Brent, BIT 20 (1980) 176-184], with a memory of log2(points) states.
///
/// A return is a point at scaled distance at most `same` from a milestone, with a tangent within max_angle of
/// that of the milestone, after the curve has been farther away than `away`: the last point itself, or that
/// where the last step meets the plane through the milestone perpendicular to its tangent.
class Milestones {
 public:
  struct Milestone {
    CurvePoint point;
    int count = 0;  ///< points of the curve up to this one
    bool left = false;
  };

  explicit Milestones(const ArcLengthOptions& options) : options_(options) {}

  /// The curve has reached its point of number `count`, from 1. It is kept where that is due. O(samples).
  void pass(const CurvePoint& point, int count);
  /// The index of the milestone that the last step of the curve has returned to. O(samples) per milestone,
  /// and some points of the curve where the step ends near one.
  std::optional<std::size_t> returned(ArcLength& curve);
  /// Forgets the milestones after the one of this index, from where the curve is followed again.
  void resume(std::size_t index);
  const Milestone& operator[](std::size_t index) const { return milestones_[index]; }

 private:
  double inner(const Eigen::VectorXd& u, double p, const Eigen::VectorXd& v, double q) const;
  double distance(const CurvePoint& a, const CurvePoint& b) const;
  double beyond(const CurvePoint& point, const CurvePoint& milestone) const;
  bool is_same(const CurvePoint& point, const CurvePoint& milestone) const;
  bool meets(ArcLength& curve, const CurvePoint& milestone) const;

  ArcLengthOptions options_;
  std::vector<Milestone> milestones_;
};

}  // namespace wavebalance::solvers
