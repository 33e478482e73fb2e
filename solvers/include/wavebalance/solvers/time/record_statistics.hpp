#pragma once
#include <Eigen/Core>
#include <vector>

namespace wavebalance::solvers {

/// A mean over time and half the width of its 95 % confidence interval; not a number where it is not known.
struct Estimate {
  double value = 0.0;
  double error = 0.0;
};

/// The mean of values that follow each other in time, and its error from the means of 20 batches of them, t s
/// / sqrt(20), with s the standard deviation of these means and t = 2.09 the 97.5 % quantile of Student's
/// distribution with 19 degrees of freedom [B. Schmeiser, Oper. Res. 30, 1982, doi:10.1287/opre.30.3.556]. It
/// holds where batches are longer than the memory of the motion. Throws std::invalid_argument for fewer than
/// 40 values.
Estimate batch_mean(const std::vector<double>& values);
/// The correlation of each such batch mean with the next one: near 0 where batches are long enough.
double batch_correlation(const std::vector<double>& values);
/// The largest of the values, which grows with their number, and the standard deviation of the largest of
/// each batch. Throws as batch_mean().
Estimate largest_of_record(const std::vector<double>& values);
/// The root of a mean of squares.
Estimate root_of(const Estimate& square);

/// One-sided power spectral density: its sum over the frequencies times their distance is the variance.
struct PowerSpectrum {
  Eigen::VectorXd frequency;     ///< Hz, up to 20 times the forcing frequency
  Eigen::MatrixXd density;       ///< series x frequencies, unit^2/Hz
  int segments = 0;              ///< that are averaged
  double segment_periods = 0.0;  ///< periods of the load in each
};

/// The spectrum of series of uniform samples over `periods` periods of a load of `frequency` (Hz), by the
/// mean of the periodograms of half-overlapping segments of an eighth of them under the window of Hann [P.
/// D. Welch, IEEE Trans. Audio Electroacoust. 15, 1967, doi:10.1109/TAU.1967.1161901]. Means are subtracted
/// before.
PowerSpectrum power_spectrum(const std::vector<std::vector<double>>& series, int periods, double frequency);

}  // namespace wavebalance::solvers
