#pragma once
#include <Eigen/Core>

namespace wavebalance::solvers {

/// A factor that varies with the frequency of a load: through its values by cubics that are monotone
/// between places and have a continuous slope, which curves over the frequency need [M. Steffen, Astron.
/// Astrophys. 239, 1990]; by a line for two places, and constant beyond the places.
struct FrequencyFactor {
  Eigen::VectorXd frequencies = {};  ///< Hz, ascending; empty: the factor is 1
  Eigen::VectorXd values = {};       ///< one each

  double at(double frequency) const;     ///< O(places)
  double slope(double frequency) const;  ///< by the frequency, 1/Hz; 0 beyond the places
  bool operator==(const FrequencyFactor& other) const;
};

/// A force shape h(t) on a structure, with h the d-th time derivative of
///
///   Re sum_m harmonics[m] exp(2 pi i m f t),  m = 0, 1, ..., H,
///
/// so that harmonics[0] is its static part, the modulus of harmonics[m] an amplitude and its argument a phase
/// ahead of a cosine. A support that moves by x_b(t) exerts -K_b x_b - C_b x_b' - M_b x_b'': three forces of
/// d = 0, 1 and 2, which grow with the frequency as they must.
struct PeriodicForce {
  Eigen::VectorXd shape;       ///< n, N s^d per unit of the series
  Eigen::VectorXcd harmonics;  ///< H + 1 complex amplitudes
  int derivative = 0;          ///< d, 0 or more
  FrequencyFactor factor = {};

  /// The complex amplitudes of h at a frequency f (Hz), factor(f) harmonics[m] (2 pi i m f)^d; real for m =
  /// 0.
  Eigen::VectorXcd amplitudes(double frequency) const;
};

/// The value of Re sum_m amplitudes[m] exp(2 pi i m s) at s periods. O(H).
double series_value(const Eigen::VectorXcd& amplitudes, double periods);

/// How often a series repeats within its period: the greatest common divisor of its harmonics above 0, 1
/// without any.
int repeats_within_period(const Eigen::VectorXcd& harmonics);

/// The series over `times` times the period: harmonic m becomes harmonic times m.
Eigen::VectorXcd over_periods(const Eigen::VectorXcd& harmonics, int times);

}  // namespace wavebalance::solvers
