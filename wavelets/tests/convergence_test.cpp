#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <string>

#include "wavebalance/wavelets/periodic_basis.hpp"

namespace wavebalance::wavelets {
namespace {

struct Family {
  ScalingFunction function;
  int order;  // of approximation: the zeros of the transform at the nonzero multiples of 2 pi
};

class ConvergenceOrder : public ::testing::TestWithParam<int> {
 protected:
  static Family family() {
    const int index = GetParam();
    if (index == 0) return {ScalingFunction::orthonormal_bspline(), 4};
    return {ScalingFunction::daubechies(2 * index), index};
  }
};

// Aliasing adds g^(n + kP), which is of order (n / P)^N.
TEST_P(ConvergenceOrder, OfTheDiscreteFourierTransformIsTheApproximationOrder) {
  const auto [function, order] = family();
  const PeriodicBasis basis(function, 3);
  constexpr int harmonic = 3;
  const auto error = [&](int points) {
    const Eigen::VectorXd g = basis.samples(points, 0);
    std::complex<double> sum = 0.0;
    for (int l = 0; l < points; ++l)
      sum += g[l] * std::polar(1.0 / points, -2 * std::numbers::pi * harmonic * l / points);
    return std::abs(sum - basis.fourier_coefficient(harmonic));
  };
  const int points = 64;
  const double observed = std::log2(error(points) / error(2 * points));
  EXPECT_GT(observed, order - 0.1) << function.name();
  // Ten coefficients have a leading constant so small, 3.5e-4, that these points still see the next order.
  EXPECT_LT(observed, order + (order == 5 ? 1.0 : 0.1)) << function.name();
}

// exp(2 pi i t) minus its orthogonal projection on the M translates: 1 - |phi^(2 pi / M)|^2 in square.
TEST_P(ConvergenceOrder, OfTheProjectionIsTheApproximationOrder) {
  const auto [function, order] = family();
  const auto error = [&function = function](int level) {
    const PeriodicBasis basis(function, level);
    const double captured = std::norm(basis.fourier_coefficient(1) * static_cast<double>(basis.functions()));
    return std::sqrt(1.0 - captured);
  };
  EXPECT_NEAR(std::log2(error(4) / error(5)), order, 0.1) << function.name();
}

INSTANTIATE_TEST_SUITE_P(Families, ConvergenceOrder, ::testing::Range(0, 6), [](const auto& family) {
  return family.param == 0 ? std::string("bspline") : "daubechies" + std::to_string(2 * family.param);
});

}  // namespace
}  // namespace wavebalance::wavelets
