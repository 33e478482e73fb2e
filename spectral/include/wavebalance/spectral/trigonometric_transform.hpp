#pragma once
#include <Eigen/Core>

#include "wavebalance/spectral/fft.hpp"
#include "wavebalance/spectral/fourier_basis.hpp"

namespace wavebalance::spectral {

/// Between M real Fourier coefficients {mean, cos 1, sin 1, cos 2, sin 2, ...} and N samples at t = l/N of
///
///     u(t) = a_0 + sum_n (a_n cos 2 pi n t + b_n sin 2 pi n t),
///
/// with derivatives in t. Odd M = 2H+1 holds H full harmonics; even M ends with the one Nyquist coefficient
/// that `nyquist` names. O(N log N) a call. Not to be used from two threads at the same time (it owns an FFT
/// plan).
class TrigonometricTransform {
 public:
  /// M = functions >= 1, N = points >= M, and > M for even M with Nyquist::sine, which vanishes at all t =
  /// l/M. Throws std::invalid_argument otherwise.
  TrigonometricTransform(int functions, int points, Nyquist nyquist = Nyquist::cosine);

  int functions() const { return functions_; }  ///< M
  int points() const { return fft_.size(); }    ///< N

  /// N samples of d^derivative u/dt^derivative from M coefficients; exact. Throws std::invalid_argument on a
  /// wrong length or a negative derivative.
  Eigen::VectorXd inverse(const Eigen::Ref<const Eigen::VectorXd>& coefficients, int derivative = 0);

  /// M coefficients of d^derivative u/dt^derivative from N samples of u: those of the trigonometric
  /// interpolant, cut to the M functions (least squares where N > M). The odd derivatives of a Nyquist
  /// function leave the space and are dropped. Throws as inverse does.
  Eigen::VectorXd forward(const Eigen::Ref<const Eigen::VectorXd>& samples, int derivative = 0);

 private:
  int functions_;
  Nyquist nyquist_;
  RealFft fft_;
  Eigen::VectorXcd spectrum_;
};

/// One-sided complex coefficients c_n, n = 0..H, u = c_0 + 2 Re sum_n c_n exp(2 pi i n t), of the 2H+1 real
/// ones: c_0 = a_0, c_n = (a_n - i b_n)/2. Throws std::invalid_argument if the number is even.
Eigen::VectorXcd to_complex(const Eigen::Ref<const Eigen::VectorXd>& real);
/// The inverse of to_complex; the imaginary part of c_0 is taken as zero. Throws std::invalid_argument if
/// empty.
Eigen::VectorXd to_real(const Eigen::Ref<const Eigen::VectorXcd>& complex);

}  // namespace wavebalance::spectral
