#include "wavebalance/solvers/time/record_statistics.hpp"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_fft_real.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>
#include <span>
#include <stdexcept>
#include <string>

namespace wavebalance::solvers {
namespace {

constexpr std::size_t batches = 20, least_values = 2 * batches;

double mean_of(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}

double largest_of(std::span<const double> values) { return *std::max_element(values.begin(), values.end()); }

// A value of each batch; the first values, which do not fill one more, are left out.
std::vector<double> by_batch(const std::vector<double>& values, double (*of_batch)(std::span<const double>)) {
  if (values.size() < least_values)
    throw std::invalid_argument("batch_mean: there are " + std::to_string(values.size()) +
                                " values; expected at least " + std::to_string(least_values));
  const std::size_t length = values.size() / batches, first = values.size() - batches * length;
  std::vector<double> result;
  for (std::size_t b = 0; b < batches; ++b)
    result.push_back(of_batch(std::span(values).subspan(first + b * length, length)));
  return result;
}

double deviation_of(const std::vector<double>& values) {
  const double mean = mean_of(values);
  double sum = 0.0;
  for (const double value : values) sum += (value - mean) * (value - mean);
  return std::sqrt(sum / double(values.size() - 1));
}

// Periodograms of segments of one length under a window.
class Periodograms {
 public:
  explicit Periodograms(std::size_t length)
      : window_(length),
        table_(gsl_fft_real_wavetable_alloc(length), gsl_fft_real_wavetable_free),
        space_(gsl_fft_real_workspace_alloc(length), gsl_fft_real_workspace_free) {
    for (std::size_t k = 0; k < length; ++k)
      window_[k] = 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * double(k) / double(length));
  }

  /// Sum of the squares of the window.
  double power() const { return std::inner_product(window_.begin(), window_.end(), window_.begin(), 0.0); }
  /// Squares of the moduli at the frequencies 1 to `lines` over the length.
  Eigen::RowVectorXd operator()(std::span<const double> segment, double mean, Eigen::Index lines) {
    std::vector<double> values(segment.begin(), segment.end());
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = window_[k] * (values[k] - mean);
    gsl_fft_real_transform(values.data(), 1, values.size(), table_.get(), space_.get());
    Eigen::RowVectorXd squares(lines);
    for (Eigen::Index k = 1; k <= lines; ++k) {  // as re_0, re_1, im_1, re_2, ...
      const double real = values[std::size_t(2 * k - 1)], imaginary = values[std::size_t(2 * k)];
      squares[k - 1] = real * real + imaginary * imaginary;
    }
    return squares;
  }

 private:
  std::vector<double> window_;
  std::unique_ptr<gsl_fft_real_wavetable, void (*)(gsl_fft_real_wavetable*)> table_;
  std::unique_ptr<gsl_fft_real_workspace, void (*)(gsl_fft_real_workspace*)> space_;
};

}  // namespace

Estimate batch_mean(const std::vector<double>& values) {
  static const double quantile = gsl_cdf_tdist_Pinv(0.975, double(batches - 1));
  const double deviation = deviation_of(by_batch(values, mean_of));
  return {mean_of(values), quantile * deviation / std::sqrt(double(batches))};
}

double batch_correlation(const std::vector<double>& values) {
  const std::vector<double> means = by_batch(values, mean_of);
  const double mean = mean_of(means);
  double with_next = 0.0, with_itself = 0.0;
  for (std::size_t b = 0; b < means.size(); ++b) {
    with_itself += (means[b] - mean) * (means[b] - mean);
    if (b > 0) with_next += (means[b] - mean) * (means[b - 1] - mean);
  }
  return with_itself > 0.0 ? with_next / with_itself : 0.0;
}

Estimate largest_of_record(const std::vector<double>& values) {
  return {largest_of(values), deviation_of(by_batch(values, largest_of))};
}

Estimate root_of(const Estimate& square) {
  const double value = std::sqrt(std::max(0.0, square.value));
  return {value, value > 0.0 ? 0.5 * square.error / value : 0.0};
}

PowerSpectrum power_spectrum(const std::vector<std::vector<double>>& series, int periods, double frequency) {
  constexpr int side_by_side = 8, most_harmonics = 20;
  PowerSpectrum result;
  const int periods_of_one = std::max(1, periods / side_by_side);
  const std::size_t points = series.front().size() / std::size_t(periods),
                    length = std::size_t(periods_of_one) * points,
                    step = std::max<std::size_t>(1, length / 2);
  const auto lines =
      Eigen::Index(std::min<std::size_t>((length - 1) / 2, std::size_t(most_harmonics * periods_of_one)));
  Periodograms periodogram(length);
  result.frequency = Eigen::VectorXd::LinSpaced(lines, 1.0, double(lines)) * (frequency / periods_of_one);
  result.density.setZero(Eigen::Index(series.size()), lines);
  result.segment_periods = periods_of_one;
  const double scale = 2.0 / (periodogram.power() * frequency * double(points));
  for (std::size_t i = 0; i < series.size(); ++i) {
    const double mean = mean_of(series[i]);
    result.segments = 0;
    for (std::size_t first = 0; first + length <= series[i].size(); first += step, ++result.segments)
      result.density.row(Eigen::Index(i)) +=
          scale * periodogram(std::span(series[i]).subspan(first, length), mean, lines);
  }
  result.density /= std::max(1, result.segments);
  return result;
}

}  // namespace wavebalance::solvers
