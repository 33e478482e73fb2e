#pragma once
#include <Eigen/Core>
#include <memory>

#include "wavebalance/solvers/time/time_pair.hpp"

namespace wavebalance::spectral {
class RealFft;
}

namespace wavebalance::solvers {

/// The velocities f V u at the samples of motions u of a pair: V takes the samples to the coefficients of the
/// trial functions, by least squares where there are more samples than functions, and these to the samples of
/// the derivative in scaled time. It is exact for the motions u_0 - K f of a balance, whose samples are sums
/// of trial functions. Owns a plan: one object per thread.
class VelocityMap {
 public:
  /// Throws std::invalid_argument for trial functions without a pointwise derivative.
  explicit VelocityMap(const TimePair& pair);
  ~VelocityMap();

  /// `samples` contact-major, m; the result in m/s for a frequency in Hz. O(C N log N).
  void apply(const Eigen::VectorXd& samples, double frequency, Eigen::VectorXd& velocity);

  /// The number of trial functions.
  int functions() const { return functions_; }
  /// The coefficients of such a motion, C M and contact-major, and the samples of coefficients, m. O(C N log
  /// N).
  Eigen::VectorXd coefficients(const Eigen::VectorXd& samples);
  Eigen::VectorXd motion(const Eigen::VectorXd& coefficients);

 private:
  // The spectrum over translates of the coefficients of one contact.
  void analyse(const Eigen::VectorXd& samples, int contact);

  int functions_, points_;
  Eigen::VectorXcd trial_, rate_;  // spectra over samples of the generator and its derivative
  Eigen::VectorXd inverse_;        // over translates, of sum |trial|^2
  Eigen::VectorXcd spectrum_, translates_;
  std::unique_ptr<spectral::RealFft> fft_;
};

}  // namespace wavebalance::solvers
