#pragma once
#include <Eigen/Core>
#include <memory>

#include "wavebalance/solvers/time/time_basis.hpp"

namespace wavebalance::spectral {
class RealFft;
}

namespace wavebalance::solvers {

/// The two index maps between a spectrum over M translates (k = 0..M/2 stored) and a spectrum over N samples
/// (n = 0..N/2 stored) of real data: n belongs to k = n mod M. N is a multiple of M, or the factor that
/// multiplies the spectrum over samples vanishes above M/2.
struct AliasMap {
  int functions;  ///< M
  int points;     ///< N

  /// out[n] = factor[n] c(n mod M), n = 0..N/2. O(N).
  void replicate(const Eigen::VectorXcd& factor, const Eigen::Ref<const Eigen::VectorXcd>& translates,
                 Eigen::VectorXcd& out) const;
  /// out[k] = sum over n = k mod M, both signs of n, of conj(factor[n]) samples[n], k = 0..M/2. O(N).
  void fold(const Eigen::VectorXcd& factor, const Eigen::VectorXcd& samples, Eigen::VectorXcd& out) const;
};

/// (2 pi i n)^derivative, the factor of harmonic n under differentiation, with time scaled to the period.
std::complex<double> derivative_factor(int harmonic, int derivative);

/// DFT of a generator's samples, sum_l g^(d)((l + offset)/points) exp(-2 pi i n l / points), n =
/// 0..points/2, with an offset of 0 or 0.5. For a band-limited basis with fewer functions than points it
/// follows from the Fourier coefficients in O(points); otherwise O(points log points).
Eigen::VectorXcd sampled_spectrum(const AnyTimeBasis& basis, int points, int derivative, double offset = 0.0);

/// Evaluates sum_j a_j g^(d)(t - j/M) at uniform points, repeatedly. Owns an FFT plan and buffers: one object
/// per thread.
class TrialEvaluator {
 public:
  /// `derivative` in time scaled to the period. The points must be a multiple of M or divide M unless the
  /// basis is band-limited; std::invalid_argument otherwise, and when the derivative has no pointwise values.
  TrialEvaluator(const AnyTimeBasis& basis, int points, int derivative);
  TrialEvaluator(TrialEvaluator&&) noexcept;
  TrialEvaluator& operator=(TrialEvaluator&&) noexcept;
  ~TrialEvaluator();

  int points() const { return points_; }
  /// Coefficients as their spectrum over translates (M/2 + 1) to values at l/points. O(N log N).
  Eigen::VectorXd operator()(const Eigen::VectorXcd& coefficients);

 private:
  AliasMap index_;
  int points_;
  int stride_;  // the transform runs on stride * points >= M points
  Eigen::VectorXcd generator_;
  Eigen::VectorXcd spectrum_;
  Eigen::VectorXd values_;
  std::unique_ptr<spectral::RealFft> fft_;
};

/// Spectrum over translates (M/2 + 1) of M real coefficients, and back. O(M log M), plans made on each call.
Eigen::VectorXcd translate_spectrum(const Eigen::VectorXd& coefficients);
Eigen::VectorXd translate_coefficients(const Eigen::VectorXcd& spectrum, int functions);

}  // namespace wavebalance::solvers
