#pragma once
#include <Eigen/Core>
#include <memory>

#include "wavebalance/solvers/time/time_pair.hpp"

namespace wavebalance::spectral {
class RealFft;
}

namespace wavebalance::solvers {

/// The velocities f V u at the samples of motions u of a pair: V maps the samples to the coefficients of
/// the trial functions, by least squares where there are more samples than functions, and these to the
/// samples of the derivative in scaled time. It is exact for the motions u_0 - K f of a balance, whose
/// samples are sums of trial functions. Owns a plan: one object per thread.
class RateMap {
 public:
  /// Throws std::invalid_argument for trial functions without a pointwise derivative.
  explicit RateMap(const TimePair& pair);
  ~RateMap();

  /// `samples` contact-major, m; the result in m/s for a frequency in Hz. O(C N log N).
  void apply(const Eigen::VectorXd& samples, double frequency, Eigen::VectorXd& velocity);
  /// Its transpose: V^T times values at the samples, times the frequency.
  void apply_transposed(const Eigen::VectorXd& values, double frequency, Eigen::VectorXd& samples);

 private:
  void map(const Eigen::VectorXd& in, const Eigen::VectorXcd& analysis, const Eigen::VectorXcd& synthesis,
           double frequency, Eigen::VectorXd& out);

  int functions_, points_;
  Eigen::VectorXcd trial_, rate_;  // spectra over samples of the generator and its derivative
  Eigen::VectorXd inverse_;        // over translates, of sum |trial|^2
  Eigen::VectorXcd spectrum_, translates_;
  std::unique_ptr<spectral::RealFft> fft_;
};

}  // namespace wavebalance::solvers
