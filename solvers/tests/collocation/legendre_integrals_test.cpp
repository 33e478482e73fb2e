#include "collocation/cell_waves.hpp"

#include "linalg/gauss_rule.hpp"
#include "testing.hpp"

namespace wavebalance::solvers::detail {
namespace {

using Complex = std::complex<double>;

// By Gauss nodes on [-1, x], the more the faster the exponential.
Eigen::MatrixXcd by_quadrature(Complex z, const Eigen::VectorXd& points, Eigen::Index count) {
  const QuadratureRule rule = gauss_rule(static_cast<int>(40 + count + 2.0 * std::abs(z)));
  Eigen::MatrixXcd result = Eigen::MatrixXcd::Zero(points.size(), count);
  for (Eigen::Index i = 0; i < points.size(); ++i) {
    const double reach = points[i] + 1.0;
    const Eigen::MatrixXd values = legendre_values(reach * rule.points.array() - 1.0, count);
    for (Eigen::Index p = 0; p < rule.points.size(); ++p)
      result.row(i) +=
          (reach * rule.weights[p] * std::exp(z * reach * (1.0 - rule.points[p]))) * values.row(p);
  }
  return result;
}

TEST(ExponentialIntegrals, AreThoseOfAQuadratureAtEveryRateAndDegree) {
  const Eigen::VectorXd points{{-0.98, -0.5, 0.1, 0.77, 1.0}};
  for (const Eigen::Index count : {4, 8, 12, 24, 40})
    for (const double size : {1e-8, 0.1, 0.7, 1.7320508075688772, 3.0, 7.0, 12.0, 25.0, 40.0, 80.0})
      for (const double degrees : {90.0, 92.0, 100.0, 107.0, 120.0, 150.0, 180.0}) {
        const double angle = degrees * std::numbers::pi / 180.0;
        const Complex z(std::min(0.0, size * std::cos(angle)), size * std::sin(angle));
        ExponentialIntegrals<std::complex<double>> integrals(points, count);
        integrals.compute(z);
        const Eigen::MatrixXcd exact = by_quadrature(z, points, count);
        EXPECT_LT((integrals.values() - exact).cwiseAbs().maxCoeff(), 2e-12 * exact.cwiseAbs().maxCoeff())
            << count << " functions, z = " << z;
      }
}

class CellWavesOfNodes : public ::testing::TestWithParam<Eigen::Index> {};

TEST_P(CellWavesOfNodes, OfSlowAndFastPolesAreTheIntegralsOfEach) {
  const Eigen::Index count = GetParam();
  const LegendreNodes nodes(count);
  Eigen::VectorXd points(count + 1);
  points << nodes.points, 1.0;
  for (const std::complex<double> z : {std::complex<double>(0.0, 0.0),
                                       {-1e-9, 1e-7},
                                       {-0.3, 2.0},
                                       {-1e-3, 31.0},
                                       {-1e-3, 33.0},
                                       {-63.0, 5.0},
                                       {-65.0, 0.0},
                                       {-77.0, 0.0},
                                       {-77.0, 9.0},
                                       {-20.0, 0.0},
                                       {-900.0, 0.0}}) {
    const CellWaves waves(Eigen::VectorXcd::Constant(1, z), count);
    const WavesAtNodes at_nodes(waves, nodes);
    EXPECT_EQ(waves.slow().size(), std::abs(z.imag()) < 32.0 && z.real() > -64.0 ? 1u : 0u);
    EXPECT_EQ(waves.slow().size() + waves.fast().size() + waves.far().size(), 1u);
    ExponentialIntegrals<std::complex<double>> each(points, count);
    each.compute(z);
    const Eigen::MatrixXcd expected = each.values();
    const Eigen::VectorXcd one = Eigen::VectorXcd::Ones(1);
    const Eigen::MatrixXd real = at_nodes.up_to(one, 0, count),
                          imag = at_nodes.up_to(std::complex<double>(0.0, -1.0) * one, 0, count);
    EXPECT_LT((real - expected.topRows(count).real()).cwiseAbs().maxCoeff(), 100 * eps);
    EXPECT_LT((imag - expected.topRows(count).imag()).cwiseAbs().maxCoeff(), 100 * eps);
    EXPECT_LT((waves.at_end().row(0) - expected.row(count)).cwiseAbs().maxCoeff(), 100 * eps);
    EXPECT_LT((at_nodes.values().col(0) - each.decay().head(count)).cwiseAbs().maxCoeff(), 100 * eps);
    EXPECT_LT(std::abs(waves.decay()[0] - std::exp(2.0 * z)), 100 * eps);
  }
}

INSTANTIATE_TEST_SUITE_P(Few, CellWavesOfNodes, ::testing::Values(12));
INSTANTIATE_TEST_SUITE_P(Many, CellWavesOfNodes, ::testing::Values(24));

// With 24 nodes the recurrence for integrals is not followed upwards at a rate of 77; polynomials are there.
TEST(FarPoles, BeginBelowTheRatesAtWhichTheRecurrenceOfIntegralsIsStable) {
  EXPECT_FALSE(follows_upwards(-77.0, 24));
  EXPECT_EQ(CellWaves(Eigen::VectorXcd::Constant(1, -77.0), 24).far().size(), 1u);
  EXPECT_EQ(CellWaves(Eigen::VectorXcd::Constant(1, -77.0), 32).fast().size(), 1u);
}

TEST(FarPoles, MakeOfAForceTheSumOfWhatTheyMakeOfItsCoefficients) {
  constexpr Eigen::Index count = 9;
  const FarPoles poles(Eigen::VectorXcd{{-300.0, Complex(-40.0, 120.0)}}, count);
  const Eigen::VectorXd force = Eigen::VectorXd::LinSpaced(count, 1.0, -2.0);
  const Eigen::VectorXcd left{{2.0, Complex(0.5, -1.5)}}, seen{{-1.0, Complex(0.7, 0.2)}};
  const FarPoles::Series made = poles.solve(left.real() * force.transpose(), left.imag() * force.transpose());
  const Eigen::VectorXd series = made.real.transpose() * seen.real() - made.imag.transpose() * seen.imag(),
                        expected = poles.polynomials(seen.cwiseProduct(left)) * force;
  EXPECT_LT((series - expected).norm(), 100 * eps * expected.norm());
  const Eigen::VectorXcd begins = left.cwiseProduct(poles.at_begin() * force);
  EXPECT_LT((made.at_begin - begins).norm(), 100 * eps * begins.norm());
}

TEST(ExponentialIntegrals, OfAFastDecayAreTheFunctionOverTheRate) {
  const Eigen::VectorXd points{{-0.5, 0.3, 0.9}};
  ExponentialIntegrals<std::complex<double>> integrals(points, 8);
  integrals.compute(-1e9);
  EXPECT_LT((1e9 * integrals.values() - legendre_values(points, 8).cast<Complex>()).cwiseAbs().maxCoeff(),
            1e-7);
}

// GSL tabulates some numbers of nodes; others it computes to 1e-10.
TEST(GaussRule, IntegratesPolynomialsToRoundingWithAnyNumberOfNodes) {
  for (const int count : {1, 2, 7, 20, 24, 33, 60, 101, 180}) {
    const QuadratureRule rule = gauss_rule(count);
    EXPECT_NEAR(rule.weights.sum(), 1.0, 1e-14 * count);
    const int degree = 2 * count - 1;
    const double integral = rule.weights.dot(Eigen::VectorXd(rule.points.array().pow(degree)));
    EXPECT_NEAR(integral * (degree + 1), 1.0, 1e-14 * count * count) << count;
  }
}

}  // namespace
}  // namespace wavebalance::solvers::detail
