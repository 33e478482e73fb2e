#pragma once
#include <Eigen/Core>
#include <array>
#include <complex>
#include <functional>
#include <stdexcept>
#include <string>

#include "wavebalance/solvers/time/time_basis.hpp"

namespace wavebalance::solvers {

/// Place of the two time derivatives of the inertia term: on the trial functions [JL14, eq. (14)], one on
/// each side [JL14, eq. (15)], or on the weighting functions [JL14, eq. (16)].
enum class Formulation { strong, weak, distributional };

/// How A_d[i, j] = <p_i, d^d q_j / dt^d> is computed: with the same uniform points as the contact force (what
/// the paper does), or exactly.
enum class InnerProducts { quadrature, exact };

/// Treatment of the coefficient over translates k = M/2 of an even M, the alternating one. Its symbols are
/// real for every pair of real generators, also for the first derivative, so that C enters its dynamic
/// stiffness as a spring does and damps nothing: a lightly damped structure resonates where a natural
/// frequency meets M/2 times the forcing frequency, or near it. Dropped, the coefficient is in neither the
/// trial nor the weight space; two Fourier bases of M functions then equal bases of M - 1. An odd M has
/// none. Which Nyquist function a Fourier basis ends with, cosine or sine, is spectral::Nyquist: without
/// effect where the coefficient is dropped.
enum class NyquistCoefficient { keep, drop };

/// A trial and a weighting basis that cannot be paired: s_p + s_q > 2 does not hold, or a derivative that the
/// formulation samples has no pointwise values.
class InadmissiblePair : public std::domain_error {
  using std::domain_error::domain_error;
};

/// The result of admissibility(); `reason` is empty when the pair is admissible.
struct Admissibility {
  bool admissible = true;
  std::string reason;
};

/// How the inner products of a pair are formed.
struct TimePairOptions {
  Formulation formulation = Formulation::distributional;
  InnerProducts inner_products = InnerProducts::quadrature;
  /// N, uniform points t_l = (l + sample_offset)/N for the contact force, and for A_d when inner_products is
  /// quadrature.
  int quadrature_points = 256;
  /// 0, the left ends of N equal intervals, or 0.5, their middles. The functions stay where they are.
  double sample_offset = 0.0;
  /// Exact inner products of two bases of which neither is band-limited (wavelet with wavelet): the first
  /// column a_d[m] = <p_i, d^d q_j / dt^d>, m = i - j mod M, of the circulant A_d for d = 0, 1, 2. With a
  /// band-limited basis on either side the pair sums its Fourier series itself and this is not called.
  std::function<Eigen::VectorXd(int derivative)> exact_column = {};
  /// Whether an even number of functions keeps its coefficient without damping, as the papers do.
  NyquistCoefficient nyquist = NyquistCoefficient::drop;
};

/// Whether the duality pairing of the bases exists: the Sobolev exponents satisfy s_p + s_q > 2, and with
/// sampled inner products every derivative of the formulation has pointwise values.
Admissibility admissibility(const AnyTimeBasis& trial, const AnyTimeBasis& weight, Formulation formulation,
                            InnerProducts inner_products);

/// A pair of trial functions q_j(t) = g(t - j/M) and weighting functions p_i(t) = h(t - i/M) as its
/// symbol.
///
/// Every A_d is circulant, so that a discrete Fourier transform over the M translates splits the weighted
/// residual of M u'' + C u' + K u = f into M independent systems
///   (symbol(2)[k] f^2 M + symbol(1)[k] f C + symbol(0)[k] K) a(k) = load(k) - contact(k),  k = 0..M-1,
/// f the frequency in Hz (time is scaled to the period, JL14 (14)-(16) with M / T^2 and C / T). Real data
/// make k and M - k conjugate: spectra over translates are stored for k = 0..M/2.
///
/// Immutable after construction; may be shared between threads.
class TimePair {
 public:
  /// Throws InadmissiblePair, or std::invalid_argument when the sizes of the bases differ, when the points
  /// are fewer than the functions, when they are not a multiple of M although a basis is not band-limited,
  /// for a sample_offset other than 0 and 0.5, and where a Nyquist coefficient that is kept has no inner
  /// product of degree 0 at the middles: of M = N Fourier functions, and of Haar functions with the cosine.
  /// O(N log N).
  TimePair(AnyTimeBasis trial, AnyTimeBasis weight, TimePairOptions options);

  int functions() const { return functions_; }  ///< M
  int points() const { return points_; }        ///< N
  /// The time of the first sample in periods, sample_offset / N.
  double first_sample() const { return options_.sample_offset / points_; }
  int spectrum_size() const { return functions_ / 2 + 1; }  ///< stored values of a spectrum over translates
  /// Whether k = M/2 is out of both spaces: an even M whose Nyquist coefficient is dropped.
  bool drops_nyquist() const { return options_.nyquist == NyquistCoefficient::drop && functions_ % 2 == 0; }
  /// The values k = 0..solved_size()-1 of a spectrum that are solved for; a dropped one is zero.
  int solved_size() const { return spectrum_size() - (drops_nyquist() ? 1 : 0); }
  const AnyTimeBasis& trial() const { return trial_; }
  const AnyTimeBasis& weight() const { return weight_; }
  Formulation formulation() const { return options_.formulation; }
  InnerProducts inner_products() const { return options_.inner_products; }

  /// lambda_d(k), k = 0..M/2, of A_d for d = 0, 1, 2, including a dropped coefficient; the unit is 1, time
  /// scaled to the period.
  const Eigen::VectorXcd& symbol(int derivative) const {
    return symbols_[static_cast<std::size_t>(derivative)];
  }

  /// DFT of the sampled generators: sum_l g(t_l) exp(-2 pi i n l / N), n = 0..N/2.
  const Eigen::VectorXcd& trial_spectrum() const { return trial_spectrum_; }
  const Eigen::VectorXcd& weight_spectrum() const { return weight_spectrum_; }

  /// The smallest r such that a shift of the force samples by r points shifts the displacement samples alike:
  /// 1 when both bases are band-limited and M is odd or its Nyquist coefficient dropped, else N / gcd(N, M).
  int shift_period() const;

  /// Spectrum over translates (M/2 + 1) of the coefficients to spectrum over samples (N/2 + 1) of the
  /// displacement: U[n] = trial_spectrum()[n] a(n mod M). O(N).
  void spread(const Eigen::VectorXcd& coefficients, Eigen::VectorXcd& sample_spectrum) const;
  /// Spectrum over samples (N/2 + 1) of a force to the spectrum over translates (M/2 + 1) of <p_i, force>,
  /// computed with the N points. O(N).
  void project(const Eigen::VectorXcd& sample_spectrum, Eigen::VectorXcd& projection) const;

  /// Spectrum over translates (M/2 + 1) of <p_i, Re sum_n harmonics[n] exp(2 pi i n t)>, sampled or exact as
  /// the pair's inner products are. O(N) or O(harmonics).
  Eigen::VectorXcd load(const Eigen::VectorXcd& harmonics) const;

 private:
  void require_sizes() const;
  void require_sampled_nyquist() const;
  Eigen::VectorXcd sampled_symbol(int derivative) const;
  Eigen::VectorXcd exact_symbol(int derivative) const;

  AnyTimeBasis trial_;
  AnyTimeBasis weight_;
  TimePairOptions options_;
  int functions_;
  int points_;
  std::array<Eigen::VectorXcd, 3> symbols_;
  Eigen::VectorXcd trial_spectrum_;
  Eigen::VectorXcd weight_spectrum_;
};

}  // namespace wavebalance::solvers
