#pragma once
#include <Eigen/Core>

namespace wavebalance::solvers {

/// One period of a motion at the uniform times l T / points, l = 0..points-1, where T is the period. A row is
/// a contact, whose displacement counts towards its obstacle, or a degree of freedom of a structure. A
/// harmonic load is largest at l = 0.
struct Motion {
  Eigen::MatrixXd displacement;  ///< rows x points, m
  Eigen::MatrixXd velocity;      ///< rows x points, m/s; empty where none is known
  Eigen::MatrixXd force;         ///< rows x points, N: contact forces; empty where none is known

  int rows() const { return static_cast<int>(displacement.rows()); }
  int points() const { return static_cast<int>(displacement.cols()); }
  bool empty() const { return displacement.size() == 0; }
  /// The motion of contact c, 1 x points each. 0 <= c < rows(); of an empty motion an empty one.
  Motion contact(int c) const;
};

/// Contact-major samples (all of the first contact, then all of the second, ...) as contacts x points.
Eigen::MatrixXd by_contact(const Eigen::VectorXd& samples, int contacts);

/// The samples of each row nearest to `points` uniform times, the later one where two are equally near. The
/// samples are uniform over the period. rows x points. O(rows points).
Eigen::MatrixXd nearest_samples(const Eigen::MatrixXd& samples, int points);

}  // namespace wavebalance::solvers
