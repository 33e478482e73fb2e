// Multipliers of contacts whose stiffness changes much within a small part of the period. References come
// from an independent event-driven integration of the variational equations, to 1e-4.

#include "support/oscillator.hpp"
#include "support/small_problems.hpp"
#include "support/solved.hpp"
#include "testing.hpp"
#include "wavebalance/contact/bilinear_law.hpp"
#include "wavebalance/contact/cubic_law.hpp"
#include "wavebalance/contact/table_law.hpp"
#include "wavebalance/solvers/stability/floquet_exponents.hpp"
#include "wavebalance/solvers/stability/monodromy.hpp"

namespace wavebalance::solvers {
namespace {

using Complex = std::complex<double>;

CondensedProblem oscillator_problem(int functions, int points, double load, double frequency) {
  const testing::Oscillator one{.mass = 1.0, .damping = 4.0, .stiffness = 1000.0, .load = load};
  return testing::fourier_problem(one.structure(), functions, points, frequency);
}

Complex upper(Complex multiplier) { return {multiplier.real(), std::abs(multiplier.imag())}; }

struct Multipliers {
  UnstableMultipliers counted;
  Complex determinant, monodromy;  // the largest, Im >= 0
};

Multipliers multipliers_of(CondensedProblem& problem, const ContactLaws& laws) {
  const PeriodicResponse response = testing::solved_response(problem, laws);
  const ContactDynamics dynamics(problem.structure());
  const FloquetExponents exponents = floquet_exponents(dynamics, problem, laws, response);
  EXPECT_EQ(exponents.status, StabilityStatus::converged);
  const Eigen::VectorXcd all =
      monodromy(dynamics, contact_stiffness(problem, laws, response), response.frequency);
  return {unstable_multipliers(dynamics, problem, laws, response),
          exponents.values.empty() ? Complex(nan) : upper(exponents.values.front().multiplier),
          upper(all[0])};
}

// A soft spring of points with a steep rise within 20 micrometres.
contact::TableLaw detent(double rise) { return {{-1e-3, 5e-4, 5.2e-4, 1e-3}, {0.0, 0.0, rise, rise + 0.05}}; }

struct SteepCase {
  double rise, frequency;
  int functions, points, unstable;
  Complex multiplier;
  double tolerance;
};

class SteepTable : public ::testing::TestWithParam<SteepCase> {};

// With 63 functions the motion errs by up to 1e-3 of a millimetre, 5 % of the steep part of the table.
TEST_P(SteepTable, HasTheMultipliersOfAnIntegrationByBothRules) {
  const SteepCase& one = GetParam();
  CondensedProblem problem = oscillator_problem(one.functions, one.points, 1.5, one.frequency);
  const Multipliers found = multipliers_of(problem, detent(one.rise));
  EXPECT_EQ(found.counted.status, StabilityStatus::converged);
  EXPECT_EQ(found.counted.count, one.unstable);
  EXPECT_LT(std::abs(found.determinant - one.multiplier), one.tolerance) << found.determinant;
  EXPECT_LT(std::abs(found.monodromy - one.multiplier), one.tolerance) << found.monodromy;
}

INSTANTIATE_TEST_SUITE_P(Sizes, SteepTable,
                         ::testing::Values(SteepCase{1.0, 4.0, 63, 512, 0, {-0.35192, 0.49399}, 5e-2},
                                           SteepCase{1.0, 4.0, 255, 2048, 0, {-0.35192, 0.49399}, 5e-3},
                                           SteepCase{1.0, 4.0, 511, 4096, 0, {-0.35192, 0.49399}, 5e-3},
                                           SteepCase{4.0, 4.0, 63, 512, 1, -1.2316, 5e-2},
                                           SteepCase{4.0, 4.0, 255, 2048, 1, -1.2316, 5e-3}),
                         [](const auto& one) {
                           return "Rise" + std::to_string(int(one.param.rise)) + "M" +
                                  std::to_string(one.param.functions);
                         });

class SteepTableAtSevenHertz : public ::testing::TestWithParam<int> {};

TEST_P(SteepTableAtSevenHertz, IsStable) {
  CondensedProblem problem = oscillator_problem(GetParam(), 8 * (GetParam() + 1), 1.5, 7.0);
  const Multipliers found = multipliers_of(problem, detent(4.0));
  EXPECT_EQ(found.counted.count, 0);
  EXPECT_NEAR(std::abs(found.determinant), 0.75, 5e-3);
  EXPECT_NEAR(std::abs(found.monodromy), 0.75, 5e-3);
}

INSTANTIATE_TEST_SUITE_P(Functions, SteepTableAtSevenHertz, ::testing::Values(255, 511));

class TableOnTwoMasses : public ::testing::TestWithParam<int> {};

TEST_P(TableOnTwoMasses, HasTheMultipliersOfAnIntegrationByBothRules) {
  const auto symmetric = [](double a, double b, double c) { return Eigen::Matrix2d{{a, b}, {b, c}}; };
  const LinearStructure two =
      testing::structure(symmetric(0.8190002543410969, 0.0, 1.521595798706737),
                         symmetric(3.5038532599198953, -1.5176807966766028, 3.2440277915352596),
                         symmetric(2551.801820511523, -1504.2150945116907, 1504.2150945116907),
                         Eigen::Vector2d(0.0, 2.2502361205473473), contact_rows({1}, 2));
  const contact::TableLaw table({-0.0008181404465311186, 0.00010185318703251331, 0.0002519918485974458,
                                 0.00030512569145783403, 0.00042708888714152913, 0.0005226150492156343},
                                {-0.11351707274897398, 0.0, 0.06309167322965518, 1.0292636183348887,
                                 1.136798231457657, 1.136798231457657});
  CondensedProblem problem = testing::fourier_problem(two, GetParam(), 8 * (GetParam() + 1), 6.42);
  const Multipliers found = multipliers_of(problem, table);
  EXPECT_EQ(found.counted.count, 0);
  const Complex expected(-0.744, 0.364);
  EXPECT_LT(std::abs(found.determinant - expected), 3e-3) << found.determinant;
  EXPECT_LT(std::abs(found.monodromy - expected), 3e-3) << found.monodromy;
}

INSTANTIATE_TEST_SUITE_P(Functions, TableOnTwoMasses, ::testing::Values(255));

class StiffCubicSpring : public ::testing::TestWithParam<int> {};

TEST_P(StiffCubicSpring, HasTheMultipliersOfAnIntegrationByBothRules) {
  CondensedProblem problem = oscillator_problem(GetParam(), 8 * (GetParam() + 1), 10.0, 4.0);
  const Multipliers found = multipliers_of(problem, contact::CubicLaw(1e10));
  EXPECT_EQ(found.counted.count, 1);
  EXPECT_LT(std::abs(found.determinant - 2.7526), 1e-3) << found.determinant;
  EXPECT_LT(std::abs(found.monodromy - 2.7526), 1e-3) << found.monodromy;
}

INSTANTIATE_TEST_SUITE_P(Functions, StiffCubicSpring, ::testing::Values(63, 255));

// The jump of the slope at 0.3 mm, away from the gap, is not said.
struct Undeclared {
  double force(double u) const { return law.force(u); }
  double tangent(double u) const { return law.tangent(u); }
  double potential(double u) const { return law.potential(u); }
  double gap() const { return 0.0; }
  contact::BilinearLaw law{500.0, 2e5, 3e-4};
};

TEST(StiffnessResolution, OfAnUndeclaredJumpHasTheMultipliersOfADeclaredOne) {
  CondensedProblem problem = oscillator_problem(63, 1024, 1.5, 4.0);
  const ContactDynamics dynamics(problem.structure());
  const auto solved = [&](const ContactLaws& laws) {
    const PeriodicResponse response = testing::solved_response(problem, laws);
    const PeriodicStiffness stiffness = contact_stiffness(problem, laws, response);
    return std::pair(unstable_multipliers(dynamics, problem, laws, response),
                     Eigen::VectorXcd(monodromy(dynamics, stiffness, response.frequency)));
  };
  const auto expected = solved(Undeclared{}.law), found = solved(Undeclared{});
  EXPECT_EQ(found.first.status, StabilityStatus::converged);
  EXPECT_EQ(found.first.count, expected.first.count);
  EXPECT_LT(std::abs(upper(found.second[0]) - upper(expected.second[0])), 1e-3) << expected.second[0];
}

// Four thousand jumps in a period.
TEST(StiffnessResolution, GivesNoVerdictWhereHalvedIntervalsDoNotResolveTheStiffness) {
  const ContactDynamics dynamics(testing::unit_oscillator(0.1, 1.0));
  PeriodicStiffness stiffness;
  stiffness.intervals = {{0, 0.1, 0.9}};
  stiffness.tangent = [](int, double time) { return std::sin(two_pi * 2000.37 * time) > 0.0 ? 1.0 : 0.1; };
  StabilityOptions options{.harmonics = 31};
  const UnstableMultipliers counted = unstable_multipliers(dynamics, stiffness, 0.2, options);
  EXPECT_EQ(counted.status, StabilityStatus::too_few_harmonics);
  EXPECT_EQ(counted.count, -1);
  EXPECT_EQ(stability_signs(dynamics, stiffness, 0.2, options).status, StabilityStatus::too_few_harmonics);
}

}  // namespace
}  // namespace wavebalance::solvers
