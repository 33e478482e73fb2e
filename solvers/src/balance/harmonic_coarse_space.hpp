#pragma once
#include <Eigen/Core>
#include <complex>
#include <memory>
#include <vector>

#include "wavebalance/solvers/balance/contact_operator.hpp"
#include "wavebalance/solvers/balance/period_law.hpp"
#include "wavebalance/spectral/fft.hpp"

namespace wavebalance::solvers {

/// How many unknowns a coarse space has. At most `largest`; of these at least `smallest`, and all without
/// which a part of D K of norm `remainder` or more would be left out at one harmonic n, where the slopes D of
/// the forces are `slope` + n `velocity_slope`, N/m.
struct CoarseSize {
  Eigen::Index smallest = 0;
  Eigen::Index largest = 0;
  double remainder = 0.0;
  double slope = 1.0;
  double velocity_slope = 0.0;

  double slope_at(int n) const { return slope + n * velocity_slope; }
  bool operator==(const CoarseSize&) const = default;
};

/// Where the compliance is large: on few harmonics n, and at each of them along few directions of the C
/// contacts, because neighbours move together. With W the orthonormal synthesis of the harmonics of all
/// contacts (mean, cosines, sines) and q_n an orthonormal basis (C x r_n, complex) of the directions kept at
/// n, K is nearly U V,
///   U = W diag(q_n),   V = diag(q_n^* H(n)) W^T,
/// H(n) the C x C response of the harmonic. The q_n are columns of H(n), chosen by pivoting and
/// orthonormalised [G. H. Golub, C. F. Van Loan, Matrix Computations, 2013, section 5.4.2]; one contact has
/// q_n = 1. Owns a plan and buffers: one object per thread.
class HarmonicCoarseSpace {
 public:
  /// Reads the responses of the harmonics n < N/2 of K. O(C^2 (M + sum r_n)).
  void set(ContactOperator& contact, int harmonics, const CoarseSize& wanted);

  Eigen::Index size() const { return size_; }  ///< r_0 + 2 (r_1 + r_2 + ...)

  /// V f, of samples f. O(C N log N + C size()).
  void respond(const Eigen::VectorXd& samples, Eigen::VectorXd& coefficients);
  /// U^T v, of samples v. O(C N log N + C size()).
  void analyse(const Eigen::VectorXd& samples, Eigen::VectorXd& coefficients);
  /// U g. O(C N log N + C size()).
  void synthesise(const Eigen::VectorXd& coefficients, Eigen::VectorXd& samples);
  /// I + V D U in the leading block of `matrix`, D the slopes by the displacement and the velocity of the
  /// same sample at a frequency in Hz, those by a harmonic's velocity as of its exact derivative. O(C N log N
  /// + C size()^2).
  void fill(const PeriodSlopes& slopes, double frequency, Eigen::MatrixXd& matrix);

 private:
  using Complex = std::complex<double>;
  /// A direction kept at harmonic n and the place of its coefficients.
  struct Direction {
    int n = 0;
    Eigen::Index start = 0;
  };

  void keep(int n, const Eigen::MatrixXcd& basis, const Eigen::MatrixXcd& response);
  void transform(const Eigen::VectorXd& samples);
  void gather(const Eigen::VectorXd& samples, const Eigen::MatrixXcd& along, Eigen::VectorXd& coefficients);
  Eigen::MatrixXcd harmonics_of(const Eigen::VectorXd& samples);
  void set_products(int m);
  void fill_rows(Eigen::Index first, Eigen::Index count, Eigen::MatrixXd& matrix);

  Eigen::Index contacts_ = 0, size_ = 0;
  int points_ = 0;
  std::vector<Direction> directions_;   // by harmonic
  Eigen::MatrixXcd basis_, responses_;  // C x directions: of each harmonic q_n and H(n)^* q_n
  std::unique_ptr<spectral::RealFft> fft_;
  Eigen::MatrixXcd spectra_;  // N/2 + 1 x C, of samples
  int largest_sum_ = 0;       // K
  // C x 2 K + 1, Fourier coefficients from -K on of the slopes by displacement and, times 2 pi f, by
  // velocity; the latter empty where there are none.
  Eigen::MatrixXcd tangent_, damping_;
  Eigen::MatrixXcd forwards_, backwards_;  // C x directions, work of fill()
};

}  // namespace wavebalance::solvers
