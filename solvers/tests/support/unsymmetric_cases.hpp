#pragma once
#include <cmath>
#include <complex>
#include <random>

#include "dense_algebra.hpp"
#include "support/condensation_cases.hpp"
#include "support/small_problems.hpp"

namespace wavebalance::solvers::testing {

/// A random chain with gyroscopic and circulatory couplings of all its degrees of freedom.
inline LinearStructure unsymmetric_chain(int size, double gyroscopic, double circulatory,
                                         std::mt19937& generator) {
  std::normal_distribution<double> normal;
  const auto skew = [&](double scale) -> Eigen::MatrixXd {
    const Eigen::MatrixXd random =
        Eigen::MatrixXd::NullaryExpr(size, size, [&] { return scale * normal(generator); });
    return random - random.transpose();
  };
  LinearStructure chain = random_chain(size, generator);
  chain.damping = Eigen::MatrixXd(Eigen::MatrixXd(chain.damping) + skew(gyroscopic)).sparseView();
  chain.stiffness = Eigen::MatrixXd(Eigen::MatrixXd(chain.stiffness) + skew(circulatory)).sparseView();
  return chain;
}

/// A disc of unit mass on a shaft, x and y in its plane: x'' + c x' + g y' + k x + p y = load cos, y'' + c y'
/// - g x' + k y - p x = 0, with a stop in x. In z = x + i y: z'' + (c - i g) z' + (k - i p) z = load cos.
struct Rotor {
  double stiffness = 1.0;    ///< k, 1/s^2
  double damping = 0.05;     ///< c, 1/s
  double gyroscopic = 0.4;   ///< g, 1/s
  double circulatory = 0.0;  ///< p, 1/s^2, as damping in the turning shaft makes it

  LinearStructure structure() const {
    const Eigen::Matrix2d skew{{0.0, 1.0}, {-1.0, 0.0}}, unit = Eigen::Matrix2d::Identity();
    return testing::structure(unit, damping * unit + gyroscopic * skew, stiffness * unit + circulatory * skew,
                              Eigen::Vector2d(1.0, 0.0), contact_rows({0}, 2));
  }
  /// x(t) without contact: forward and backward whirl.
  double response(double omega, double time) const {
    using Complex = std::complex<double>;
    const Complex i(0.0, 1.0);
    const auto whirl = [&](double rate) {
      return 0.5 * std::exp(i * rate * time) /
             (stiffness - i * circulatory - rate * rate + i * rate * (damping - i * gyroscopic));
    };
    return std::real(whirl(omega) + whirl(-omega));
  }
};

/// The matrix A of (x, v)' = A (x, v) without load, with stiffnesses D at the contacts.
inline Eigen::MatrixXd state_matrix(const LinearStructure& structure, const Eigen::VectorXd& contact) {
  const int n = structure.size();
  const Eigen::MatrixXd rows(structure.contact_directions);
  const Eigen::MatrixXd stiffness =
      Eigen::MatrixXd(structure.stiffness) + rows.transpose() * contact.asDiagonal() * rows;
  const Eigen::MatrixXd inertia(structure.mass), damping(structure.damping);
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  matrix.topRightCorner(n, n).setIdentity();
  matrix.bottomLeftCorner(n, n) = -oracle::solve(inertia, stiffness);
  matrix.bottomRightCorner(n, n) = -oracle::solve(inertia, damping);
  return matrix;
}

}  // namespace wavebalance::solvers::testing
