#include "wavebalance/solvers/structure/periodic_force.hpp"

#include "support/refusal.hpp"
#include "support/small_problems.hpp"
#include "testing.hpp"
#include "wavebalance/solvers/structure/condensation.hpp"

namespace wavebalance::solvers {
namespace {

using Complex = std::complex<double>;

Eigen::VectorXcd some_series() {
  Eigen::VectorXcd series(4);
  series << 2.0, Complex(1.0, -0.5), 0.0, Complex(-0.3, 0.7);
  return series;
}

TEST(PeriodicForce, AmplitudesOfADerivativeAreThoseOfTheDifferenceQuotient) {
  const double frequency = 3.0, h = 1e-6;
  const PeriodicForce force{Eigen::VectorXd::Ones(1), some_series(), 1};
  const Eigen::VectorXcd rates = force.amplitudes(frequency);
  const auto value = [&](double time) { return series_value(some_series(), frequency * time); };
  for (const double t : {0.0, 0.04, 0.21, 0.33})
    EXPECT_NEAR(series_value(rates, frequency * t), (value(t + h) - value(t - h)) / (2.0 * h), 1e-6);
  EXPECT_EQ(rates[0], 0.0);
}

TEST(PeriodicForce, ASeriesOverSeveralPeriodsHasTheSameValues) {
  const Eigen::VectorXcd longer = over_periods(some_series(), 3);
  ASSERT_EQ(longer.size(), 10);
  for (const double s : {0.0, 0.13, 0.7})
    EXPECT_NEAR(series_value(longer, s / 3.0), series_value(some_series(), s), 1e-14);
  EXPECT_EQ(repeats_within_period(longer), 3);
  EXPECT_EQ(repeats_within_period(some_series()), 1);
}

TEST(PeriodicForce, OnesThatDoNotFitAreRefused) {
  std::mt19937 generator(1);
  LinearStructure chain = testing::random_chain(3, generator);
  chain.forces = {{Eigen::VectorXd::Ones(2), some_series()}};
  EXPECT_EQ(testing::refusal([&] { chain.validate(); }),
            "LinearStructure: forces[0] has a shape of 2 entries; the load has 3");
  chain.forces = {{Eigen::VectorXd::Ones(3), some_series(), -1}};
  EXPECT_EQ(testing::refusal([&] { chain.validate(); }),
            "LinearStructure: forces[0] has the derivative -1; it must be at least 0");
}

// Each method must give for every load the result without the other loads.
TEST(Condensation, OfSeveralLoadsIsThatOfEachAlone) {
  std::mt19937 generator(7);
  const LinearStructure chain = testing::random_chain(9, generator);
  LinearStructure driven = chain;
  driven.contact_directions = contact_rows({2, 8}, 9);
  for (int l = 0; l < 3; ++l) driven.forces.push_back({testing::random_vector(9, generator), some_series()});
  const ImpedanceCoefficients factors{Complex(-2.0, 0.3), Complex(0.1, 1.5), 1.0},
      rates{Complex(-1.0, 0.2), Complex(0.0, 1.0), 0.0};
  const Eigen::Vector4cd amplitudes(1.0, Complex(0.0, 2.0), -1.0, Complex(0.5, 0.5));
  for (const auto method : {CondensationMethod::tridiagonal, CondensationMethod::modal,
                            CondensationMethod::dense, CondensationMethod::sparse}) {
    Condensation all(driven, method);
    const CondensedPoint found = all.dynamic_compliance(factors, rates);
    ASSERT_EQ(found.load_response.size(), 8);
    Eigen::VectorXcd sum = all.recover(factors, 0.0, Eigen::Vector2cd(0.3, -0.2));
    for (int l = 0; l < 4; ++l) {
      LinearStructure alone = driven;
      alone.forces.clear();
      if (l > 0) alone.load = driven.forces[std::size_t(l) - 1].shape;
      Condensation one(alone, method);
      const CondensedPoint expected = one.dynamic_compliance(factors, rates);
      EXPECT_EQ(found.load_response.segment<2>(2 * l), expected.load_response) << int(method);
      EXPECT_EQ(found.load_response_slope.segment<2>(2 * l), expected.load_response_slope) << int(method);
      EXPECT_EQ(found.load_response_error.segment<2>(2 * l), expected.load_response_error) << int(method);
      sum += one.recover(factors, amplitudes[l], Eigen::Vector2cd::Zero());
    }
    const Eigen::VectorXcd whole = all.recover(factors, amplitudes, Eigen::Vector2cd(0.3, -0.2));
    EXPECT_LE((whole - sum).norm(), 1e-13 * sum.norm()) << int(method);
  }
}

// A bar with load and contact at its last degree of freedom uses one recursion over k.
TEST(Condensation, OfSeveralLoadsAtTheTipIsThatOfEachAlone) {
  std::mt19937 generator(3);
  LinearStructure chain = testing::random_chain(6, generator);
  chain.contact_directions = contact_rows({5}, 6);
  chain.load = Eigen::VectorXd::Unit(6, 5) * 3.0;
  LinearStructure driven = chain;
  driven.forces = {{Eigen::VectorXd::Unit(6, 5) * -2.0, some_series()}};
  const Eigen::Vector3cd k(Complex(-1.0, 0.1), Complex(-4.0, 0.2), -9.0);
  const StiffnessSpectrum factors{k, k.cwiseSqrt() * 0.1, Eigen::Vector3cd::Ones()};
  CondensedSpectrum one, two;
  Condensation(chain).condense(factors, factors, one);
  Condensation(driven).condense(factors, factors, two);
  ASSERT_EQ(two.load_response.cols(), 2);
  EXPECT_EQ(two.load_response.col(0), one.load_response.col(0));
  EXPECT_LE((two.load_response.col(1) + 2.0 / 3.0 * one.load_response.col(0)).norm(),
            1e-15 * one.load_response.norm());
  EXPECT_LE((two.load_response_slope.col(1) + 2.0 / 3.0 * one.load_response_slope.col(0)).norm(),
            1e-15 * one.load_response_slope.norm());
}

}  // namespace
}  // namespace wavebalance::solvers
