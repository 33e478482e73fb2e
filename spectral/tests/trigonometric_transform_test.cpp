#include "wavebalance/spectral/trigonometric_transform.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace wavebalance::spectral {
namespace {

using std::numbers::pi;
constexpr double eps = std::numeric_limits<double>::epsilon();

// d^order u/dt^order at t of the sum with the given coefficients; derivatives by shifting the phase.
double series(const Eigen::VectorXd& coefficients, Nyquist nyquist, double t, int order) {
  const auto wave = [&](Eigen::Index n, double phase) {
    const double speed = 2 * pi * static_cast<double>(n);
    return std::pow(speed, order) * std::cos(speed * t + phase + order * pi / 2);
  };
  double sum = order == 0 ? coefficients[0] : 0.0;
  for (Eigen::Index i = 1; i < coefficients.size(); ++i) {
    const bool last_of_even = i + 1 == coefficients.size() && i % 2 == 1;
    const bool sine = i % 2 == 0 || (last_of_even && nyquist == Nyquist::sine);
    sum += coefficients[i] * wave((i + 1) / 2, sine ? -pi / 2 : 0.0);
  }
  return sum;
}

Eigen::VectorXd coefficients_of(int functions) {
  Eigen::VectorXd coefficients(functions);
  for (int i = 0; i < functions; ++i) coefficients[i] = std::cos(3.0 * i + 1.0);
  return coefficients;
}

template <class Check>
void for_each_size(Check check) {
  for (const Nyquist nyquist : {Nyquist::cosine, Nyquist::sine})
    for (int functions : {1, 2, 3, 4, 7, 8, 20})
      for (int extra : {0, 1, 2, 9, 33}) {
        if (extra == 0 && functions % 2 == 0 && nyquist == Nyquist::sine) continue;
        SCOPED_TRACE(testing::Message() << functions << " functions, " << functions + extra << " points");
        check(functions, functions + extra, nyquist);
      }
}

TEST(TrigonometricTransform, SamplesEveryDerivativeOfATrigonometricPolynomialExactly) {
  for_each_size([](int functions, int points, Nyquist nyquist) {
    const Eigen::VectorXd coefficients = coefficients_of(functions);
    TrigonometricTransform transform(functions, points, nyquist);
    for (int order : {0, 1, 2, 3, 6}) {
      const Eigen::VectorXd found = transform.inverse(coefficients, order);
      const double tolerance = 32 * eps * functions * std::pow(pi * functions, order);
      for (int l = 0; l < points; ++l)
        EXPECT_NEAR(found[l], series(coefficients, nyquist, double(l) / points, order), tolerance);
    }
  });
}

TEST(TrigonometricTransform, ForwardUndoesInverse) {
  for_each_size([](int functions, int points, Nyquist nyquist) {
    const Eigen::VectorXd coefficients = coefficients_of(functions);
    TrigonometricTransform transform(functions, points, nyquist);
    const Eigen::VectorXd back = transform.forward(transform.inverse(coefficients));
    EXPECT_LE((back - coefficients).cwiseAbs().maxCoeff(), 16 * eps * functions);
  });
}

TEST(TrigonometricTransform, ForwardDifferentiatesInTheSpace) {
  for_each_size([](int functions, int points, Nyquist nyquist) {
    if (functions % 2 == 0) return;  // an odd derivative of the Nyquist function leaves the space
    const Eigen::VectorXd coefficients = coefficients_of(functions);
    TrigonometricTransform transform(functions, points, nyquist);
    const Eigen::VectorXd twice = transform.forward(transform.inverse(coefficients, 1), 1);
    const Eigen::VectorXd second = transform.forward(transform.inverse(coefficients), 2);
    EXPECT_LE((twice - second).cwiseAbs().maxCoeff(), 64 * eps * functions * std::pow(pi * functions, 2));
  });
}

TEST(TrigonometricTransform, KeepsEvenAndDropsOddDerivativesOfTheNyquistFunction) {
  for (const Nyquist nyquist : {Nyquist::cosine, Nyquist::sine}) {
    TrigonometricTransform transform(4, 9, nyquist);
    const Eigen::VectorXd samples = transform.inverse(Eigen::Vector4d(0, 0, 0, 1));
    EXPECT_NEAR(transform.forward(samples, 2)[3], -16 * pi * pi, 1e3 * eps * 16 * pi * pi);
    EXPECT_LE(transform.forward(samples, 1).cwiseAbs().maxCoeff(), 1e3 * eps);
  }
}

TEST(TrigonometricTransform, AgreesWithTheGeneratorOfTheBasis) {
  for (int functions : {3, 6, 8}) {
    const int points = 4 * functions;
    const Eigen::VectorXd g = FourierBasis(functions).samples(points, 2);
    TrigonometricTransform fine(functions, points);
    TrigonometricTransform nodal(functions, functions);
    const Eigen::VectorXd through_nodes = fine.inverse(nodal.forward(Eigen::VectorXd::Unit(functions, 0)), 2);
    EXPECT_LE((through_nodes - g).cwiseAbs().maxCoeff(), 64 * eps * g.cwiseAbs().maxCoeff());
  }
}

TEST(ComplexCoefficients, AreThoseOfThePeriodMean) {
  const Eigen::VectorXd real = coefficients_of(5);
  const Eigen::VectorXcd complex = to_complex(real);
  const int points = 16;
  for (int n = 0; n <= 2; ++n) {
    std::complex<double> mean = 0.0;
    for (int l = 0; l < points; ++l)
      mean += series(real, Nyquist::cosine, double(l) / points, 0) *
              std::polar(1.0 / points, -2 * pi * n * l / points);
    EXPECT_LE(std::abs(mean - complex[n]), 16 * eps);
  }
  EXPECT_EQ(to_real(complex), real);
}

TEST(TrigonometricTransform, RejectsWhatItCannotDo) {
  EXPECT_THROW(TrigonometricTransform(0, 4), std::invalid_argument);
  EXPECT_THROW(TrigonometricTransform(5, 4), std::invalid_argument);
  EXPECT_THROW(TrigonometricTransform(4, 4, Nyquist::sine), std::invalid_argument);
  TrigonometricTransform transform(4, 4);
  EXPECT_THROW(transform.inverse(Eigen::VectorXd::Zero(5)), std::invalid_argument);
  EXPECT_THROW(transform.forward(Eigen::VectorXd::Zero(3)), std::invalid_argument);
  EXPECT_THROW(transform.inverse(Eigen::VectorXd::Zero(4), -1), std::invalid_argument);
  EXPECT_THROW(to_complex(Eigen::VectorXd::Zero(4)), std::invalid_argument);
  EXPECT_THROW(to_real(Eigen::VectorXcd()), std::invalid_argument);
}

}  // namespace
}  // namespace wavebalance::spectral
