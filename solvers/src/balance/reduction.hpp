#pragma once
#include <Eigen/Core>

namespace wavebalance::solvers {

/// The border of J in [J b; c^T d]; only J if there is no column.
struct Border {
  Eigen::VectorXd column, row;  ///< b and c
  double corner = 0.0;          ///< d

  bool exists() const { return column.size() > 0; }
};

/// J = I + K D as the identity plus a product of few numbers, K D = E R: R maps a motion of samples() to
/// count() numbers, and E maps these to a motion. Then x = J^-1 r is r - E z with (I + R E) z = R r, and
/// the determinants of J and I + R E are the same.
class Reduction {
 public:
  virtual ~Reduction() = default;

  virtual Eigen::Index count() const = 0;
  /// I + R E into the leading block of `matrix`.
  virtual void fill(Eigen::MatrixXd& matrix) = 0;
  /// R r.
  virtual Eigen::VectorXd read(const Eigen::VectorXd& motion) = 0;
  /// E z.
  virtual Eigen::VectorXd motion(const Eigen::VectorXd& values) = 0;
  /// E^T c.
  virtual Eigen::VectorXd motion_transposed(const Eigen::VectorXd& row) = 0;
};

}  // namespace wavebalance::solvers
