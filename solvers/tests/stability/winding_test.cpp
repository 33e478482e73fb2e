#include "stability/winding.hpp"

#include "support/stability_cases.hpp"
#include "testing.hpp"
#include "wavebalance/solvers/stability/monodromy.hpp"

namespace wavebalance::solvers {
namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

int own_poles(const ContactDynamics& dynamics) {
  int count = 0;
  for (const ContactPole& pole : dynamics.poles())
    if (pole.exponent.real() > 0.0) count += pole.exponent.imag() == 0.0 ? 1 : 2;
  return count;
}

// The quick way against the plain one, which follows the argument of the determinant itself.
TEST(Winding, OfThePolynomialCountsAsThatOfTheDeterminantDoes) {
  std::mt19937 generator(4);
  int compared = 0, unstable = 0, cheaper = 0;
  for (int i = 0; i < 60; ++i) {
    const testing::RandomStiffness random(generator, 1 + i % 4);
    const ContactDynamics dynamics(random.structure);
    const Truncation truncation{24, {}};
    FloquetDeterminant plain(dynamics, random.stiffness, random.frequency, truncation);
    FloquetDeterminant quick(dynamics, random.stiffness, random.frequency, truncation);
    const auto slow = determinant_change(plain, 10000);
    const auto fast = polynomial_change(quick, 10000);
    ASSERT_TRUE(slow);
    ASSERT_TRUE(fast) << i;
    const double expected = own_poles(dynamics) - *slow / pi, found = fast->own - fast->change / pi;
    EXPECT_NEAR(found, std::round(found), 1e-6);
    const Eigen::ArrayXd moduli = monodromy(dynamics, random.stiffness, random.frequency).cwiseAbs().array();
    if (((moduli - 1.0).abs() < 3e-3).any()) continue;
    EXPECT_EQ(std::lround(found), std::lround(expected)) << i;
    ++compared;
    unstable += std::lround(found) > 0 ? 1 : 0;
    cheaper += quick.evaluations() < plain.evaluations() ? 1 : 0;
  }
  EXPECT_GT(compared, 40);
  EXPECT_GT(unstable, 2);
  EXPECT_GT(cheaper, 20);
}

TEST(Winding, OfThePolynomialTakesNoMoreThanTheEvaluationsAllowed) {
  std::mt19937 generator(4);
  const testing::RandomStiffness random(generator, 2);
  const ContactDynamics dynamics(random.structure);
  FloquetDeterminant determinant(dynamics, random.stiffness, random.frequency, {24, {}});
  EXPECT_FALSE(polynomial_change(determinant, 5));
  EXPECT_EQ(determinant.evaluations(), 0);
}

// prod (1 - mu_j exp(-i nu)), followed over nu = 0..pi.
double change_of(const std::vector<Complex>& multipliers, int points) {
  const auto at = [&](double nu) {
    FloquetDeterminant::Value value;
    for (const Complex mu : multipliers) {
      const Complex part = mu * std::polar(1.0, -nu);
      value.log += std::log(1.0 - part);
      value.derivative += part / (1.0 - part);
    }
    return value;
  };
  std::vector<double> steps;
  for (int i = 0; i <= points; ++i) steps.push_back(pi * i / points);
  return argument_change(at, steps, 100000).value_or(1e300);
}

TEST(Winding, CountsMultipliersBesideTheCircle) {
  const Complex outside = std::polar(1.0 + 1e-6, 1.1), inside = std::polar(1.0 - 1e-6, 1.1);
  EXPECT_NEAR(change_of({outside, std::conj(outside)}, 4), -2.0 * pi, 1e-9);
  EXPECT_NEAR(change_of({inside, std::conj(inside)}, 4), 0.0, 1e-9);
  EXPECT_NEAR(change_of({outside, std::conj(outside), outside, std::conj(outside)}, 4), -4.0 * pi, 1e-9);
  EXPECT_NEAR(change_of({outside, std::conj(outside), inside, std::conj(inside)}, 4), -2.0 * pi, 1e-9);
  EXPECT_NEAR(change_of({1.5, -1.2, 0.3}, 4), -2.0 * pi, 1e-9);
}

}  // namespace
}  // namespace wavebalance::solvers
