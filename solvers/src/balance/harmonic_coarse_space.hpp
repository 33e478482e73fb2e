#pragma once
#include <Eigen/Core>
#include <complex>
#include <functional>
#include <memory>

#include "wavebalance/spectral/fft.hpp"

namespace wavebalance::solvers {

/// The products that an iterative solver needs of the compliance K between the samples of C contacts, N each,
/// contact-major.
struct ComplianceOperator {
  int contacts = 1;
  int points = 0;
  /// K f and K^T v.
  std::function<void(const Eigen::VectorXd&, Eigen::VectorXd&)> apply, apply_transposed;
  /// C x C, m/N: the part exp(2 pi i n t) of the displacements that forces exp(2 pi i n t) cause, n >= 0.
  std::function<Eigen::MatrixXcd(int n)> response;
};

/// The harmonics |n| <= h of the samples of each contact, where the compliance is large: with W
/// (C N x C (2h + 1)) their orthonormal synthesis (mean, cosines, sines), K is nearly W B W^T plus a part
/// that decays as the harmonics beyond h do, like 1 / n^2. Owns a plan and buffers: one object per thread.
class HarmonicCoarseSpace {
 public:
  /// Reads the responses of the harmonics 0..h of K; h < N/2.
  void set(const ComplianceOperator& compliance, int harmonics);

  int harmonics() const { return harmonics_; }
  Eigen::Index size() const { return contacts_ * size_of_contact(); }  ///< C (2h + 1)

  /// W^T u. O(C N log N).
  void analyse(const Eigen::VectorXd& samples, Eigen::VectorXd& coefficients);
  /// W g. O(C N log N).
  void synthesise(const Eigen::VectorXd& coefficients, Eigen::VectorXd& samples);
  /// B g. O(C^2 h).
  void respond(const Eigen::VectorXd& forces, Eigen::VectorXd& displacements) const;
  /// B^T g.
  void respond_transposed(const Eigen::VectorXd& values, Eigen::VectorXd& result) const;
  /// I + W^T D W B in the leading block of `matrix`, D = diag(tangent). O(C N log N + size()^2).
  void fill(const Eigen::VectorXd& tangent, Eigen::MatrixXd& matrix);

 private:
  Eigen::Index size_of_contact() const { return 2 * harmonics_ + 1; }
  void fill_contact(const Eigen::VectorXd& tangent, Eigen::Index contact, Eigen::MatrixXd& gram);

  Eigen::Index contacts_ = 0;
  int points_ = 0;
  int harmonics_ = 0;
  Eigen::MatrixXcd responses_;  // C^2 x (h + 1), column-major blocks
  std::unique_ptr<spectral::RealFft> fft_;
  Eigen::VectorXcd spectrum_;
  Eigen::MatrixXd gram_;
};

}  // namespace wavebalance::solvers
