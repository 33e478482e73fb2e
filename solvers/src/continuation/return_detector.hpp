#pragma once
#include <optional>
#include <vector>

#include "wavebalance/solvers/continuation/arc_length.hpp"

namespace wavebalance::solvers {

/// Recognises that a curve returns to an earlier point of itself. It keeps the first point and one near each
/// number of points 2^n. A cycle of points entered at any point is noticed before its points have doubled
/// twice [R. P. Brent, BIT 20 (1980) 176-184], with a memory of log2(points) states.
///
/// A return is a point at scaled distance at most `same` from a kept one, with a tangent within max_angle
/// of the tangent there, after the curve has been farther away than `away`. It is the last point, or the
/// point where the last step meets the plane through the kept point perpendicular to its tangent.
class ReturnDetector {
 public:
  struct KeptPoint {
    CurvePoint point;
    int count = 0;  ///< points of the curve up to this one
    bool left = false;
  };

  explicit ReturnDetector(const ArcLengthOptions& options) : options_(options) {}

  /// The curve has reached its point of number `count`, from 1. It is kept where that is due. O(samples).
  void add(const CurvePoint& point, int count);
  /// The index of the kept point that the last step of the curve has returned to. O(samples) per kept point,
  /// and some points of the curve where the step ends near one.
  std::optional<std::size_t> returned_to(ArcLength& curve);
  /// Forgets the points kept after the one of this index, from where the curve is followed again.
  void forget_after(std::size_t index);
  /// Forgets those kept that have a higher number than `count`.
  void forget_points_after(int count);
  const KeptPoint& operator[](std::size_t index) const { return kept_[index]; }

 private:
  double inner(const Eigen::VectorXd& u, double p, const Eigen::VectorXd& v, double q) const;
  double distance(const CurvePoint& a, const CurvePoint& b) const;
  double cosine(const CurvePoint& a, const CurvePoint& b) const;  // of the angle between their tangents
  double beyond(const CurvePoint& point, const CurvePoint& kept) const;
  bool is_same(const CurvePoint& point, const CurvePoint& kept) const;
  bool meets(ArcLength& curve, const CurvePoint& kept) const;

  ArcLengthOptions options_;
  std::vector<KeptPoint> kept_;
};

}  // namespace wavebalance::solvers
