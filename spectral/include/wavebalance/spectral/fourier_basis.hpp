#pragma once
#include <Eigen/Core>
#include <complex>
#include <limits>

namespace wavebalance::spectral {

/// The Nyquist function that an even number M of Fourier functions ends with.
enum class Nyquist {
  cosine,  ///< cos(M pi t), the order {1, cos 2 pi t, sin 2 pi t, ...} of [JL14, Fig. 2] cut after M
           ///< functions
  sine     ///< sin(M pi t): with Haar weights and even derivatives the inner products of cos(M pi t) vanish
};

/// The Fourier space span{1, cos 2 pi t, sin 2 pi t, cos 4 pi t, ...} of M functions on the circle [0, 1), as
/// the M translates g(t - j/M), j = 0..M-1, of one generator
///
///     g(t) = 1/M [1 + 2 sum_{0 < n < M/2} cos 2 pi n t  (+ cos M pi t or sin M pi t when M is even)].
///
/// With Nyquist::cosine, and for every odd M, g is the cardinal function g(j/M) = delta_{j0}: a function of
/// the space is the sum of its samples u(j/M) times the translates. The translates sum to 1.
class FourierBasis {
 public:
  /// Throws std::invalid_argument if functions < 1.
  explicit FourierBasis(int functions, Nyquist nyquist = Nyquist::cosine);

  int functions() const { return functions_; }  ///< M
  Nyquist nyquist() const { return nyquist_; }  ///< without effect for odd M

  /// d^derivative g/dt^derivative at t = l/points, l = 0..points-1, for any points >= 1: where points < M,
  /// the aliased harmonics are added. O(M derivative + points log points). Throws std::invalid_argument if
  /// points < 1, derivative < 0 or (M pi)^derivative is too large for a double.
  Eigen::VectorXd samples(int points, int derivative = 0) const;

  /// Integral over the period of g(t) exp(-2 pi i harmonic t): 1/M below M/2; 1/(2M) (cosine) or -+i/(2M)
  /// (sine) at +-M/2; zero above. O(1).
  std::complex<double> fourier_coefficient(int harmonic) const;

  double sobolev_exponent() const { return std::numeric_limits<double>::infinity(); }
  /// g is analytic: a number above any order that is of use.
  int pointwise_derivatives() const { return 1'000'000; }
  bool band_limited() const { return true; }

 private:
  int functions_;
  Nyquist nyquist_;
};

}  // namespace wavebalance::spectral
