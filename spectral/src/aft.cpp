#include "wavebalance/spectral/aft.hpp"

#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <string>

namespace wavebalance::spectral {
namespace {

int validated_harmonics(int harmonics, int points) {
  if (harmonics < 0)
    throw std::invalid_argument("Aft: harmonics is " + std::to_string(harmonics) + "; it must be at least 0");
  if (points > 2 * static_cast<long long>(harmonics)) return harmonics;
  throw std::invalid_argument(
      "Aft: points is " + std::to_string(points) + "; " + std::to_string(harmonics) +
      " harmonics need at least 2H+1 = " + std::to_string(2 * static_cast<long long>(harmonics) + 1));
}

Eigen::VectorXd sample(const PointwiseLaw& law, const Eigen::VectorXd& displacement) {
  Eigen::VectorXd values(displacement.size());
  const auto size = static_cast<std::size_t>(values.size());
  law({displacement.data(), size}, {values.data(), size});
  return values;
}

// u(t + shift) in place of u(t).
Eigen::VectorXd advance(const Eigen::VectorXd& coefficients, double shift) {
  Eigen::VectorXcd complex = to_complex(coefficients);
  for (Eigen::Index n = 1; n < complex.size(); ++n)
    complex[n] *= std::polar(1.0, 2.0 * std::numbers::pi * static_cast<double>(n) * shift);
  return to_real(complex);
}

double root_mean_square(const Eigen::VectorXd& coefficients) {
  return std::sqrt(0.5 * (coefficients.squaredNorm() + coefficients[0] * coefficients[0]));
}

// Means over the samples of k(t) cos 2 pi n t and of k(t) sin 2 pi n t, n = 0..N/2, periodic in n.
class TangentMeans {
 public:
  explicit TangentMeans(const Eigen::VectorXd& tangent)
      : points_(static_cast<int>(tangent.size())), spectrum_(points_ / 2 + 1) {
    const auto size = static_cast<std::size_t>(points_);
    RealFft(points_).forward({tangent.data(), size}, {spectrum_.data(), size / 2 + 1});
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

// The block of harmonics n >= m > 0: rows {cos n, sin n}, columns {cos m, sin m}; products of the functions
// as sums.
Eigen::Matrix2d block(const TangentMeans& mean, int n, int m) {
  Eigen::Matrix2d result;
  result << mean.cosine(n - m) + mean.cosine(n + m), mean.sine(n + m) - mean.sine(n - m),
      mean.sine(n + m) + mean.sine(n - m), mean.cosine(n - m) - mean.cosine(n + m);
  return result;
}

}  // namespace

Aft::Aft(int harmonics, int points)
    : harmonics_(validated_harmonics(harmonics, points)), transform_(2 * harmonics + 1, points) {}

Eigen::VectorXd Aft::displacement(const Eigen::Ref<const Eigen::VectorXd>& coefficients) {
  return transform_.inverse(coefficients);
}

AftForce Aft::force(const Eigen::Ref<const Eigen::VectorXd>& coefficients, const PointwiseLaw& force) {
  AftForce result;
  result.samples = sample(force, transform_.inverse(coefficients));
  result.coefficients = transform_.forward(result.samples);
  return result;
}

Eigen::MatrixXd Aft::jacobian(const Eigen::Ref<const Eigen::VectorXd>& coefficients,
                              const PointwiseLaw& tangent) {
  const TangentMeans mean(sample(tangent, transform_.inverse(coefficients)));
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
      advance(this->force(advance(coefficients, half_step), force).coefficients, -half_step);
  const double difference = root_mean_square(0.5 * (sums - between));
  const double scale = root_mean_square(0.5 * (sums + between));
  return difference == 0.0 ? 0.0 : difference / scale;
}

}  // namespace wavebalance::spectral
