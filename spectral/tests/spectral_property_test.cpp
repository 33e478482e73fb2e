#include <rapidcheck/gtest.h>
#include <Eigen/Geometry>

#include "testing.hpp"
#include "wavebalance/spectral/aft.hpp"
#include "wavebalance/spectral/fourier_basis.hpp"

namespace wavebalance::spectral {
namespace {

Eigen::VectorXd any_vector(int size) {
  Eigen::VectorXd vector(size);
  for (double& value : vector) value = *rc::gen::inRange(-1000, 1001) / 1000.0;
  return vector;
}

Eigen::VectorXcd spectrum_of(const Eigen::VectorXd& samples) {
  RealFft fft(static_cast<int>(samples.size()));
  Eigen::VectorXcd spectrum(fft.harmonics());
  fft.forward({samples.data(), static_cast<std::size_t>(samples.size())},
              {spectrum.data(), static_cast<std::size_t>(spectrum.size())});
  return spectrum;
}

RC_GTEST_PROP(RealFftProperty, Parseval, ()) {
  const int size = *rc::gen::inRange(1, 300);
  const Eigen::VectorXd samples = any_vector(size);
  const Eigen::VectorXcd spectrum = spectrum_of(samples);
  double energy = 2.0 * spectrum.squaredNorm() - std::norm(spectrum[0]);
  if (size % 2 == 0) energy -= std::norm(spectrum[size / 2]);
  RC_ASSERT(std::abs(energy / size - samples.squaredNorm()) <= 32 * eps * size);
}

RC_GTEST_PROP(RealFftProperty, AShiftInTimeTurnsThePhases, ()) {
  const int size = *rc::gen::inRange(1, 300);
  const int shift = *rc::gen::inRange(0, size);
  const Eigen::VectorXd samples = any_vector(size);
  Eigen::VectorXd shifted(size);
  for (int l = 0; l < size; ++l) shifted[(l + shift) % size] = samples[l];
  Eigen::VectorXcd expected = spectrum_of(samples);
  for (Eigen::Index n = 0; n < expected.size(); ++n)
    expected[n] *= std::polar(1.0, -2.0 * std::numbers::pi * static_cast<double>(n * shift % size) / size);
  RC_ASSERT((spectrum_of(shifted) - expected).cwiseAbs().maxCoeff() <= 32 * eps * size);
}

// <u(a), f>/N = <a, W F(f)> with W the mean squares of the functions.
RC_GTEST_PROP(AftProperty, TheSumsAreTheAdjointOfTheSamples, ()) {
  const int harmonics = *rc::gen::inRange(0, 30);
  const int points = 2 * harmonics + 1 + *rc::gen::inRange(0, 60);
  Aft aft(harmonics, points);
  const Eigen::VectorXd coefficients = any_vector(aft.coefficients());
  const Eigen::VectorXd samples = any_vector(points);
  const PointwiseLaw prescribed = [&](std::span<const double>, std::span<double> result) {
    std::copy(samples.begin(), samples.end(), result.begin());
  };
  Eigen::VectorXd weighted = 0.5 * aft.force(coefficients, prescribed).coefficients;
  weighted[0] *= 2.0;
  const double left = aft.displacement(coefficients).dot(samples) / points;
  RC_ASSERT(std::abs(left - coefficients.dot(weighted)) <= 64 * eps * aft.coefficients());
}

RC_GTEST_PROP(AftProperty, AShiftOfTheDisplacementShiftsTheForce, ()) {
  const int harmonics = *rc::gen::inRange(0, 12);
  const int points = 2 * harmonics + 1 + *rc::gen::inRange(0, 40);
  const double angle =
      2.0 * std::numbers::pi * *rc::gen::inRange(0, points) / points;  // a whole number of samples
  const Eigen::VectorXd at = any_vector(2 * harmonics + 1);
  const auto shift = [angle](Eigen::VectorXd coefficients) {
    for (int n = 1; 2 * n < coefficients.size(); ++n)
      coefficients.segment<2>(2 * n - 1) = Eigen::Rotation2D(n * angle) * coefficients.segment<2>(2 * n - 1);
    return coefficients;
  };
  const PointwiseLaw law = [](std::span<const double> u, std::span<double> f) {
    for (std::size_t i = 0; i < u.size(); ++i) f[i] = std::abs(u[i]) + std::max(u[i] - 0.3, 0.0);
  };
  Aft aft(harmonics, points);
  const Eigen::VectorXd expected = shift(aft.force(at, law).coefficients);
  const Eigen::VectorXd found = aft.force(shift(at), law).coefficients;
  RC_ASSERT((found - expected).cwiseAbs().maxCoeff() <= 128 * eps * (1 + harmonics) * (1 + harmonics));
}

RC_GTEST_PROP(FourierBasisProperty, ItsSamplesHoldItsCoefficients, ()) {
  const int functions = *rc::gen::inRange(1, 80);
  const int points = functions + *rc::gen::inRange(1, 40);
  const FourierBasis basis(functions, *rc::gen::element(Nyquist::cosine, Nyquist::sine));
  const Eigen::VectorXcd spectrum = spectrum_of(basis.samples(points, 0));
  for (int n = 0; 2 * n < points; ++n)
    RC_ASSERT(std::abs(spectrum[n] / double(points) - basis.fourier_coefficient(n)) <= 32 * eps);
}

}  // namespace
}  // namespace wavebalance::spectral
