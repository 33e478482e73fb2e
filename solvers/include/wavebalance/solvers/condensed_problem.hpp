#pragma once
#include <Eigen/Core>
#include <memory>

#include "wavebalance/solvers/condensation.hpp"
#include "wavebalance/solvers/time_pair.hpp"

namespace wavebalance::solvers {

/// The periodic problem of one contact degree of freedom at one frequency, written for the displacement
/// samples u (N values at t_l = l/N):
///
///   u = u0 - K f_c(u),
///
/// u0 the contact-free response and K (N x N, rank M) the dynamic compliance between force and displacement
/// samples: DFT, weighting, compliance e^T Z(k)^-1 e, trial functions, inverse DFT. K is never formed; a
/// product takes O(N log N), and a shift by shift_period() samples maps its columns onto each other.
///
/// Owns plans and buffers: one object a thread.
class CondensedProblem {
 public:
  /// `load_harmonics[n]`: complex amplitude h_n of the load's time function Re sum h_n exp(2 pi i n t), which
  /// scales structure.load; {0, 1} is the cosine of JL14.
  CondensedProblem(TimePair pair, const LinearStructure& structure, Eigen::VectorXcd load_harmonics);
  CondensedProblem(CondensedProblem&&) noexcept;
  CondensedProblem& operator=(CondensedProblem&&) noexcept;
  ~CondensedProblem();

  const TimePair& pair() const { return pair_; }
  int points() const { return pair_.points(); }

  /// Condenses at a frequency (Hz, > 0). Throws std::invalid_argument or SingularSystem. O(n M + N log N).
  void set_frequency(double frequency_hz);
  double frequency() const { return frequency_; }

  /// u0, m, N values, and its derivative by frequency, m/Hz.
  const Eigen::VectorXd& free_response() const { return free_response_; }
  const Eigen::VectorXd& free_response_slope();

  /// K f. `force` in N at the N points; the result in m. O(N log N).
  void apply(const Eigen::VectorXd& force, Eigen::VectorXd& displacement);
  /// (dK / d frequency) f, m/Hz.
  void apply_slope(const Eigen::VectorXd& force, Eigen::VectorXd& slope);
  /// K^T v.
  void apply_transposed(const Eigen::VectorXd& values, Eigen::VectorXd& result);

  /// The first shift_period() columns of K, N x shift_period(); entry (l, m) of K is
  /// columns(l - shift_period() * j mod N, m mod shift_period()), j = m / shift_period(). Made on first use
  /// after set_frequency. O(shift_period() N log N).
  const Eigen::MatrixXd& columns();

  /// Spectrum over translates (M/2 + 1) of the coefficients that belong to force samples:
  /// a(k) = compliance-free response - compliance * <p, f>. O(N log N).
  Eigen::VectorXcd coefficients(const Eigen::VectorXd& force);

  /// Spectra over translates of the coefficients of all n degrees of freedom, n x (M/2 + 1), for force
  /// samples at the contact. O(n M).
  Eigen::MatrixXcd full_coefficients(const Eigen::VectorXd& force);

 private:
  StiffnessFactors factors(int k) const;
  void apply_kernel(const Eigen::VectorXd& in, const Eigen::VectorXcd& analysis,
                    const Eigen::VectorXcd& kernel, const Eigen::VectorXcd& synthesis, Eigen::VectorXd& out);

  TimePair pair_;
  Condensation condensation_;
  Eigen::VectorXcd load_;  // projected load, spectrum over translates
  double frequency_ = 0.0;
  StiffnessSpectrum factors_, rates_;
  CondensedSpectrum condensed_;  // load responses times the projected load
  Eigen::VectorXd free_response_, free_response_slope_;
  bool slope_is_current_ = false;
  Eigen::MatrixXd columns_;
  bool columns_are_current_ = false;
  struct Work;
  std::unique_ptr<Work> work_;
};

}  // namespace wavebalance::solvers
