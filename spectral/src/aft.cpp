#include "wavebalance/spectral/aft.hpp"

#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>

#include "require.hpp"

namespace wavebalance::spectral {
namespace {

int checked_harmonics(int harmonics, int points) {
  detail::require_at_least("Aft: harmonics", harmonics, 0);
  detail::require_at_least("Aft: points", points, 2 * static_cast<long long>(harmonics) + 1);
  return harmonics;
}

template <class Vector>
auto as_span(Vector& vector) {
  return std::span(vector.data(), static_cast<std::size_t>(vector.size()));
}

std::complex<double> phase(Eigen::Index harmonic, double shift) {
  return std::polar(1.0, 2.0 * std::numbers::pi * static_cast<double>(harmonic) * shift);
}

Eigen::VectorXd sample(const PointwiseLaw& law, const Eigen::VectorXd& displacement) {
  Eigen::VectorXd values(displacement.size());
  law(as_span(displacement), as_span(values));
  return values;
}

double root_mean_square(const Eigen::VectorXd& coefficients) {
  return std::sqrt(0.5 * (coefficients.squaredNorm() + coefficients[0] * coefficients[0]));
}

// Means over the samples of k(t) cos 2 pi n t and of k(t) sin 2 pi n t, 0 <= n < N.
class TangentMeans {
 public:
  explicit TangentMeans(const Eigen::VectorXd& tangent)
      : points_(static_cast<int>(tangent.size())), spectrum_(points_ / 2 + 1) {
    RealFft(points_).forward(as_span(tangent), as_span(spectrum_));
    spectrum_ /= points_;
  }
  double cosine(int n) const {
    return 2 * n <= points_ ? spectrum_[n].real() : spectrum_[points_ - n].real();
  }
  double sine(int n) const { return 2 * n <= points_ ? -spectrum_[n].imag() : spectrum_[points_ - n].imag(); }

 private:
  int points_;
  Eigen::VectorXcd spectrum_;
};

// The block of harmonics n >= m > 0, with rows {cos n, sin n} and columns {cos m, sin m}. Products of two
// functions are written as sums of functions of n - m and n + m.
Eigen::Matrix2d block(const TangentMeans& mean, int n, int m) {
  Eigen::Matrix2d result;
  result << mean.cosine(n - m) + mean.cosine(n + m), mean.sine(n + m) - mean.sine(n - m),
      mean.sine(n + m) + mean.sine(n - m), mean.cosine(n - m) - mean.cosine(n + m);
  return result;
}

}  // namespace

Aft::Aft(int harmonics, int points)
    : harmonics_(checked_harmonics(harmonics, points)), fft_(points), spectrum_(fft_.harmonics()) {}

// u(t_l + shift)
Eigen::VectorXd Aft::samples_at(const Eigen::Ref<const Eigen::VectorXd>& coefficients, double shift) {
  detail::require_length("Aft: coefficients", coefficients.size(), this->coefficients());
  spectrum_.setZero();
  spectrum_[0] = coefficients[0];
  for (Eigen::Index n = 1; n <= harmonics_; ++n)
    spectrum_[n] = std::complex(0.5 * coefficients[2 * n - 1], -0.5 * coefficients[2 * n]) * phase(n, shift);
  Eigen::VectorXd samples(points());
  fft_.inverse(as_span(spectrum_), as_span(samples));
  return samples;
}

// The sums over samples that were taken at t_l + shift.
Eigen::VectorXd Aft::coefficients_of(const Eigen::VectorXd& samples, double shift) {
  fft_.forward(as_span(samples), as_span(spectrum_));
  Eigen::VectorXd result(coefficients());
  result[0] = spectrum_[0].real() / points();
  for (Eigen::Index n = 1; n <= harmonics_; ++n) {
    const std::complex<double> value = 2.0 / points() * spectrum_[n] * phase(n, -shift);
    result[2 * n - 1] = value.real();
    result[2 * n] = -value.imag();
  }
  return result;
}

Eigen::VectorXd Aft::displacement(const Eigen::Ref<const Eigen::VectorXd>& coefficients) {
  return samples_at(coefficients, 0.0);
}

AftForce Aft::force(const Eigen::Ref<const Eigen::VectorXd>& coefficients, const PointwiseLaw& force) {
  AftForce result;
  result.samples = sample(force, samples_at(coefficients, 0.0));
  result.coefficients = coefficients_of(result.samples, 0.0);
  return result;
}

Eigen::MatrixXd Aft::jacobian(const Eigen::Ref<const Eigen::VectorXd>& coefficients,
                              const PointwiseLaw& tangent) {
  const TangentMeans mean(sample(tangent, samples_at(coefficients, 0.0)));
  Eigen::MatrixXd result(this->coefficients(), this->coefficients());
  result(0, 0) = mean.cosine(0);
  for (int n = 1; n <= harmonics_; ++n) {
    const Eigen::Vector2d edge(mean.cosine(n), mean.sine(n));
    result.block<2, 1>(2 * n - 1, 0) = 2.0 * edge;
    result.block<1, 2>(0, 2 * n - 1) = edge.transpose();
    for (int m = 1; m <= n; ++m) {
      const Eigen::Matrix2d entries = block(mean, n, m);
      result.block<2, 2>(2 * n - 1, 2 * m - 1) = entries;
      result.block<2, 2>(2 * m - 1, 2 * n - 1) = entries.transpose();
    }
  }
  return result;
}

double Aft::aliasing(const Eigen::Ref<const Eigen::VectorXd>& coefficients, const PointwiseLaw& force) {
  const double half_step = 0.5 / points();
  const Eigen::VectorXd sums = this->force(coefficients, force).coefficients;
  const Eigen::VectorXd between =
      coefficients_of(sample(force, samples_at(coefficients, half_step)), half_step);
  const double difference = root_mean_square(0.5 * (sums - between));
  const double scale = root_mean_square(0.5 * (sums + between));
  return difference == 0.0 ? 0.0 : difference / scale;
}

}  // namespace wavebalance::spectral
