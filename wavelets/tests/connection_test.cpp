#include "wavebalance/wavelets/connection.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <thread>
#include <vector>

#include "constants.hpp"
#include "wavebalance/wavelets/bspline.hpp"

namespace wavebalance::wavelets {
namespace {

std::vector<ScalingFunction> families() {
  std::vector<ScalingFunction> all{ScalingFunction::haar(), ScalingFunction::orthonormal_bspline()};
  for (const int length : {4, 6, 10, 20, 40}) all.push_back(ScalingFunction::daubechies(length));
  return all;
}

TEST(ConnectionCoefficients, OfOrderZeroAreDelta) {
  for (int length = 2; length <= 40; length += 2) {
    const auto phi = ScalingFunction::daubechies(length);
    const auto r = connection_coefficients(phi, phi, 0);
    for (int l = r.first; l <= r.last(); ++l)
      EXPECT_NEAR(r(l), l == 0 ? 1.0 : 0.0, 4 * eps) << phi.name() << l;
  }
  const auto spline = ScalingFunction::orthonormal_bspline();
  const auto r = connection_coefficients(spline, spline, 0);
  for (int l = r.first; l <= r.last(); ++l)
    EXPECT_NEAR(r(l), l == 0 ? 1.0 : 0.0, 128 * eps) << "spline " << l;
}

TEST(ConnectionCoefficients, OfAFunctionWithItselfHaveTheParityOfTheDerivative) {
  for (const auto& phi : families())
    for (int d = 0; d <= 8; ++d) {
      if (!connection_exists(phi, phi, d)) continue;
      const auto r = connection_coefficients(phi, phi, d);
      const double scale = r.values.cwiseAbs().maxCoeff();
      for (int l = 0; l <= r.last(); ++l)
        EXPECT_NEAR(r(-l), (d % 2 == 0 ? 1 : -1) * r(l), 512 * eps * scale) << phi.name() << " d = " << d;
    }
}

TEST(ConnectionCoefficients, ExchangingTheFunctionsMovesTheDerivative) {  // integration by parts
  for (const auto& a : families())
    for (const auto& b : families())
      for (int d = 0; d <= 3; ++d) {
        if (!connection_exists(a, b, d)) continue;
        const auto one = connection_coefficients(a, b, d), other = connection_coefficients(b, a, d);
        const double scale = one.values.cwiseAbs().maxCoeff();
        for (int l = one.first; l <= one.last(); ++l)
          EXPECT_NEAR(one(l), (d % 2 == 0 ? 1 : -1) * other(-l), 512 * eps * scale)
              << a.name() << ", " << b.name();
      }
}

double mean(const ScalingFunction& phi) {  // \int x phi(x) dx
  double sum = 0.0;
  for (Eigen::Index l = 0; l < phi.filter().size(); ++l)
    sum += 0.5 * static_cast<double>(l) * phi.filter()[l];
  for (Eigen::Index k = 0; k < phi.coefficients().size(); ++k)
    sum += phi.coefficients()[k] * static_cast<double>(phi.first_coefficient() + k);
  return sum;
}

// sum_l l^k r_d[l] = (-1)^d k!/(k-d)! \int y^{k-d} C(y) dy, with C the correlation, whose mean is the
// difference of the two means. k = d + 1 is imposed nowhere in the computation.
TEST(ConnectionCoefficients, HaveTheMomentsOfADerivative) {
  for (const auto& trial : families())
    for (const auto& weight : families())
      for (int d = 0; d <= 3; ++d) {
        const int reproduced = static_cast<int>(trial.filter().size() + weight.filter().size());
        if (!connection_exists(trial, weight, d) || reproduced / 2 <= d + 1) continue;
        const auto r = connection_coefficients(trial, weight, d);
        for (int power = 0; power <= d + 1; ++power) {
          double moment = 0.0, scale = 0.0;
          for (int l = r.first; l <= r.last(); ++l) {
            moment += std::pow(l, power) * r(l);
            scale += std::abs(std::pow(l, power) * r(l));
          }
          const double sign = d % 2 == 0 ? 1 : -1;
          double expected = power == d ? sign * std::tgamma(d + 1.0) : 0.0;
          if (power == d + 1) expected = sign * std::tgamma(d + 2.0) * (mean(trial) - mean(weight));
          EXPECT_NEAR(moment, expected, 512 * eps * (1 + scale))
              << trial.name() << ", " << weight.name() << " d = " << d << " power " << power;
        }
      }
}

TEST(ConnectionCoefficients,
     WithHaarAreDifferencesOfValues) {  // \int_l^{l+1} phi^(d) = phi^(d-1)(l+1) - phi^(d-1)(l)
  const auto haar = ScalingFunction::haar();
  for (const auto& phi : {ScalingFunction::daubechies(4), ScalingFunction::daubechies(8),
                          ScalingFunction::daubechies(20), ScalingFunction::orthonormal_bspline()})
    for (int d = 1; d <= phi.pointwise_derivatives() + 1; ++d) {
      if (!connection_exists(phi, haar, d)) continue;
      const auto r = connection_coefficients(phi, haar, d);
      const Eigen::VectorXd values = phi.values(0, d - 1);
      const auto at = [&](int k) {
        const int n = k - phi.support_begin();
        return n < 0 || n >= values.size() ? 0.0 : values[n];
      };
      for (int l = r.first; l <= r.last(); ++l)
        EXPECT_NEAR(r(l), at(l + 1) - at(l), 512 * eps * values.cwiseAbs().maxCoeff())
            << phi.name() << " d = " << d;
    }
}

// Exact integration of the polynomial pieces, degree at most 6, with four Gauss points per cell.
TEST(ConnectionCoefficients, OfSplinesAreTheIntegralsOfTheirPieces) {
  const auto phi = ScalingFunction::orthonormal_bspline();
  const std::array nodes{0.069431844202973712, 0.33000947820757187, 0.66999052179242813, 0.93056815579702629};
  const std::array weights{0.17392742256872693, 0.32607257743127307, 0.32607257743127307,
                           0.17392742256872693};
  const int cells = phi.support_end() - phi.support_begin();
  const auto table = [&](double fraction, int d) {  // phi^(d)(support_begin + n + fraction)
    Eigen::VectorXd values = Eigen::VectorXd::Zero(cells);
    const Eigen::VectorXd piece = bspline_values(3, fraction, d);
    for (int k = 0; k < phi.coefficients().size(); ++k) values.segment(k, 4) += phi.coefficients()[k] * piece;
    return values;
  };
  for (int d = 0; d <= 3; ++d) {
    const auto r = connection_coefficients(phi, phi, d);
    for (int l = 0; l < 20; ++l) {
      double integral = 0.0;
      for (std::size_t i = 0; i < nodes.size(); ++i)
        integral += weights[i] * table(nodes[i], 0).head(cells - l).dot(table(nodes[i], d).tail(cells - l));
      EXPECT_NEAR(r(l), integral, 128 * eps * (1 + r.values.cwiseAbs().maxCoeff()))
          << "d = " << d << " l = " << l;
    }
  }
}

TEST(Admissibility, FollowsTheSumOfTheSobolevExponents) {
  const auto haar = ScalingFunction::haar(), spline = ScalingFunction::orthonormal_bspline(),
             db4 = ScalingFunction::daubechies(4), db6 = ScalingFunction::daubechies(6);
  EXPECT_TRUE(connection_exists(haar, spline, 2));
  EXPECT_TRUE(connection_exists(db6, db6, 2));
  EXPECT_TRUE(connection_exists(db4, db4, 1));
  EXPECT_TRUE(connection_exists(spline, spline, 6));
  EXPECT_FALSE(connection_exists(spline, spline, 7));
  EXPECT_FALSE(connection_exists(haar, haar, 1));
  EXPECT_FALSE(connection_exists(haar, db6, 2));
  EXPECT_FALSE(connection_exists(db4, db4, 2));
}

TEST(Admissibility, ErrorCarriesTheTwoExponents) {
  const auto db4 = ScalingFunction::daubechies(4);
  try {
    connection_coefficients(db4, db4, 2);
    FAIL();
  } catch (const InadmissiblePairError& error) {
    EXPECT_NEAR(error.trial_exponent(), 1.0, 4 * eps);
    EXPECT_NEAR(error.weight_exponent(), 1.0, 4 * eps);
    EXPECT_EQ(error.derivative(), 2);
    EXPECT_NE(std::string(error.what()).find("1.000000 and 1.000000 is 2.000000; it must be above 2"),
              std::string::npos)
        << error.what();
  }
  const PeriodicBasis haar(ScalingFunction::haar(), 3);
  EXPECT_THROW(periodic_inner_products(haar, haar, 1), InadmissiblePairError);
  EXPECT_THROW(connection_coefficients(db4, db4, -1), std::invalid_argument);
  EXPECT_THROW(connection_coefficients(db4, db4, 13), std::invalid_argument);
}

// a[m] = sum_n conj(p^(n)) q^(n) (2 pi i n)^d exp(2 pi i n m / M), with the tail of the sum in the tolerance.
TEST(PeriodicInnerProducts, AreTheFourierSums) {
  const auto spline = ScalingFunction::orthonormal_bspline(), haar = ScalingFunction::haar(),
             db20 = ScalingFunction::daubechies(20), db40 = ScalingFunction::daubechies(40);
  const struct {
    ScalingFunction trial, weight;
    int derivative;
    double tolerance;
  } cases[] = {{spline, spline, 2, 1e-10}, {db20, db20, 2, 1e-10},   {db40, db40, 2, 1e-12},
               {db40, spline, 3, 1e-12},   {db20, spline, 1, 1e-12}, {haar, spline, 1, 1e-7},
               {haar, spline, 2, 1e-5}};
  for (const auto& c : cases)
    for (const int level : {0, 1, 3, 5}) {
      const PeriodicBasis trial(c.trial, level), weight(c.weight, level);
      const Eigen::VectorXd a = periodic_inner_products(trial, weight, c.derivative);
      const int period = trial.functions();
      Eigen::VectorXcd sum = Eigen::VectorXcd::Zero(period);
      for (int n = -64 * period; n <= 64 * period; ++n) {
        const std::complex<double> factor =
            std::pow(std::complex<double>(0, 2 * std::numbers::pi * n), c.derivative);
        const std::complex<double> term =
            std::conj(weight.fourier_coefficient(n)) * trial.fourier_coefficient(n) * factor;
        for (int m = 0; m < period; ++m)
          sum[m] +=
              term * std::polar(1.0, 2 * std::numbers::pi * std::remainder(double(n) * m / period, 1.0));
      }
      const double scale = std::pow(period, c.derivative - 1);
      EXPECT_LT((a - sum).cwiseAbs().maxCoeff(), 4 * c.tolerance * scale)
          << c.trial.name() << ", " << c.weight.name() << " d = " << c.derivative << " level " << level;
    }
}

TEST(PeriodicInnerProducts, OfOneConstantAreItsMeanSquare) {
  for (const auto& phi : families()) {
    const PeriodicBasis basis(phi, 0);
    EXPECT_NEAR(periodic_inner_products(basis, basis, 0)[0], 1.0, 512 * eps) << phi.name();
    if (connection_exists(phi, phi, 2)) {
      EXPECT_NEAR(periodic_inner_products(basis, basis, 2)[0], 0.0, 512 * eps) << phi.name();
    }
  }
}

// Coefficients that depend only on the families are computed once, by the first thread that needs them.
TEST(PeriodicInnerProducts, AreTheSameFromEveryThread) {
  std::vector<Eigen::VectorXd> columns(8);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < columns.size(); ++i)
    threads.emplace_back([&column = columns[i], length = i < 4 ? 14 : 22] {
      const PeriodicBasis basis(ScalingFunction::daubechies(length), 6);
      column = periodic_inner_products(basis, basis, 2) + basis.samples(64, 1);
    });
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < columns.size(); ++i) EXPECT_EQ(columns[i], columns[i < 4 ? 0 : 4]) << i;
  EXPECT_NE(columns[0], columns[4]);
}

TEST(PeriodicInnerProducts, RejectDifferentNumbersOfFunctions) {
  const auto phi = ScalingFunction::daubechies(6);
  EXPECT_THROW(periodic_inner_products(PeriodicBasis(phi, 3), PeriodicBasis(phi, 4), 1),
               std::invalid_argument);
}

}  // namespace
}  // namespace wavebalance::wavelets
