#pragma once
#include <Eigen/Core>

namespace wavebalance::wavelets {

/// Fast periodic wavelet transform of an orthonormal filter, at any length of signal and filter (a filter
/// longer than the signal wraps). With h = p/sqrt(2) and g_l = (-1)^l h_{L-1-l}, one level maps s of length n
/// to
///     s'[k] = sum_l h_l s[(2k + l) mod n],   d'[k] = sum_l g_l s[(2k + l) mod n],   k = 0..n/2-1,
/// an orthogonal matrix, so the inverse is its transpose [Mallat 2009, section 7.3]. The signal holds the
/// coefficients of sqrt(M) g(t - j/M); coefficients of the unscaled translates of PeriodicBasis are those
/// times sqrt(M). Holds the filter only; may be shared between threads.
class FastWaveletTransform {
 public:
  /// `filter` has even length and sum 2 [JL14, eq. (32)]. Throws std::invalid_argument when it is not
  /// orthonormal, sum_l p_l p_{l+2k} = 2 delta_k, to an absolute error of 1e-10.
  explicit FastWaveletTransform(const Eigen::VectorXd& filter);

  /// Coefficients in the order [s_levels | d_levels | .. | d_1], as long as the signal. Less than
  /// 4 L M operations for any number of levels. Throws std::invalid_argument unless levels >= 0 and 2^levels
  /// divides the length of the signal (M >= 1).
  Eigen::VectorXd analysis(const Eigen::VectorXd& signal, int levels) const;
  /// The inverse of analysis, and its transpose. Same cost and errors.
  Eigen::VectorXd synthesis(const Eigen::VectorXd& coefficients, int levels) const;

 private:
  Eigen::VectorXd low_pass_;   // h
  Eigen::VectorXd high_pass_;  // g
};

}  // namespace wavebalance::wavelets
