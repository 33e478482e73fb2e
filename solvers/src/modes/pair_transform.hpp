#pragma once
#include <Eigen/Core>
#include <vector>

#include "wavebalance/solvers/time/time_pair.hpp"

namespace wavebalance::solvers {

/// A pair of bases as real matrices between the coefficients of one contact and its N samples. The R rows are
/// the real and imaginary parts of the spectrum over translates: Re a(0), then Re a(k), Im a(k) for k = 1..K.
/// The Nyquist coefficient of an even number of functions is left out of both spaces.
///
/// Free motions have no damping, so that symbol(2) / symbol(0) must be real:
/// symbol(2) f^2 + symbol(0) omega_j^2 = symbol(0) (omega_j^2 - inertia[k] omega^2), omega = 2 pi f. Two
/// Fourier bases have inertia[k] = k^2.
struct PairTransform {
  std::vector<int> order;       ///< R, k of each row
  std::vector<int> real_rows;   ///< K + 1, the row of Re a(k)
  Eigen::MatrixXd synthesis;    ///< N x R, samples from coefficients
  Eigen::MatrixXd projection;   ///< R x N, coefficients in the trial functions from samples of a force
  Eigen::VectorXd inertia;      ///< K + 1; empty where free motions have damping
  Eigen::VectorXd mean_square;  ///< R, of the samples that a unit coefficient has
  Eigen::MatrixXcd harmonics;   ///< H + 1 x K + 1: harmonics n = 0..H of a motion from its spectrum
  Eigen::MatrixXcd conjugated;  ///< H + 1 x K + 1, the same for the conjugate spectrum

  int rows() const { return static_cast<int>(order.size()); }
  int highest() const { return static_cast<int>(real_rows.size()) - 1; }  ///< K
  bool has_sines() const { return rows() > highest() + 1; }

  /// The complex spectrum (K + 1) of R coefficients.
  Eigen::VectorXcd spectrum(const Eigen::VectorXd& coefficients) const;
};

/// `cosine_only` leaves the imaginary parts out: motions that are even in time. Throws std::invalid_argument
/// for a pair that damps a free motion, for one without a first harmonic, and for cosine_only with a basis
/// that is not Fourier. O(N^2 log N).
PairTransform make_pair_transform(const TimePair& pair, bool cosine_only);

/// A pair for free motions with damping, of any symbols: symbol(1) f / symbol(0) = first[k] omega and
/// symbol(2) f^2 / symbol(0) = second[k] omega^2. Two Fourier bases have i k and -k^2.
struct DampedTransform {
  PairTransform pair;
  Eigen::VectorXcd first, second;  ///< K + 1
  Eigen::MatrixXd rate;  ///< N x R, samples of the derivative by omega t; empty where there is none at points
};

/// Throws as make_pair_transform(), but for no damping.
DampedTransform make_damped_transform(const TimePair& pair);

}  // namespace wavebalance::solvers
