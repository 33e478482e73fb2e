#pragma once
#include <Eigen/Core>
#include <functional>
#include <span>

#include "wavebalance/spectral/fft.hpp"

namespace wavebalance::spectral {

/// A pointwise law of the displacement: fills `result` with the values at each `displacement`; equal lengths.
using PointwiseLaw = std::function<void(std::span<const double> displacement, std::span<double> result)>;

/// A force in time and as its Fourier coefficients.
struct AftForce {
  Eigen::VectorXd samples;       ///< N force values at t = l/N
  Eigen::VectorXd coefficients;  ///< 2H+1 Fourier coefficients {mean, cos 1, sin 1, ...}
};

/// Alternating frequency/time [Cameron & Griffin 1989]: the Fourier coefficients of a force f(u(t)) that is
/// known pointwise in time, and their derivatives with respect to coefficients of u,
///
///     u(t_l) = a_0 + sum_n (a_n cos 2 pi n t_l + b_n sin 2 pi n t_l),   t_l = l/N,
///     F_n = (2/N) sum_l f(u(t_l)) {cos, sin} 2 pi n t_l,   mean with 1/N,   0 <= n <= H.
///
/// The sums are exact for a polynomial force of degree p when N > (p+1) H; other forces alias, see
/// aliasing(). All coefficients are real. Not to be used from two threads at the same time (it owns an FFT
/// plan).
class Aft {
 public:
  /// harmonics: H >= 0; points: N >= 2H+1. Throws std::invalid_argument otherwise.
  Aft(int harmonics, int points);

  int harmonics() const { return harmonics_; }  ///< H
  int points() const { return fft_.size(); }    ///< N
  int coefficients() const { return 2 * harmonics_ + 1; }

  /// N samples of the displacement with the given 2H+1 coefficients. O(N log N). This and all functions below
  /// throw std::invalid_argument for another number of coefficients.
  Eigen::VectorXd displacement(const Eigen::Ref<const Eigen::VectorXd>& coefficients);

  /// Force samples and coefficients. O(N log N).
  AftForce force(const Eigen::Ref<const Eigen::VectorXd>& coefficients, const PointwiseLaw& force);

  /// (2H+1) x (2H+1) derivative of the force coefficients with respect to the displacement coefficients, from
  /// the samples of the tangent df/du: the exact Jacobian of the sums above. Its entries are sums and
  /// differences of coefficients of the tangent at n - m and n + m (Toeplitz plus Hankel). O(N log N + H^2).
  Eigen::MatrixXd jacobian(const Eigen::Ref<const Eigen::VectorXd>& coefficients,
                           const PointwiseLaw& tangent);

  /// Aliasing estimate |F_N - F_2N| / |F_2N| with F_2N the same sums over 2N points and |.| the root mean
  /// square over the period; 0 when both vanish. It evaluates the force a second time, at t = (l + 1/2)/N.
  /// O(N log N).
  double aliasing(const Eigen::Ref<const Eigen::VectorXd>& coefficients, const PointwiseLaw& force);

 private:
  Eigen::VectorXd samples_at(const Eigen::Ref<const Eigen::VectorXd>& coefficients, double shift);
  Eigen::VectorXd coefficients_of(const Eigen::VectorXd& samples, double shift);

  int harmonics_;
  RealFft fft_;
  Eigen::VectorXcd spectrum_;
};

}  // namespace wavebalance::spectral
