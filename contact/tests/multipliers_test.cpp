#include "wavebalance/contact/multipliers.hpp"

#include "quadratic_program.hpp"
#include "testing.hpp"

namespace wavebalance::contact {
namespace {

using Array = std::vector<double>;

Array copy(std::span<const double> values) { return {values.begin(), values.end()}; }

// A chain fixed at one end, under loads, with obstacles at all nodes: nodes 1, 3 and 4 of 6 in contact.
QuadraticProgram chain() {
  const int n = 6;
  Eigen::MatrixXd stiffness = 2.0 * Eigen::MatrixXd::Identity(n, n);
  stiffness.diagonal(1).setConstant(-1.0);
  stiffness.diagonal(-1).setConstant(-1.0);
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(n, -1.0, 2.0);
  const Eigen::VectorXd lambda = (Eigen::VectorXd(n) << 0, 0.75, 0, 2.5, 0.01, 0).finished();
  const Eigen::MatrixXd equality = Eigen::MatrixXd::Ones(1, n);
  const Eigen::VectorXd mu = Eigen::VectorXd::Constant(1, 0.5);
  return QuadraticProgram::with_solution(stiffness, Eigen::MatrixXd::Identity(n, n), equality, x, lambda, mu,
                                         0.3);
}

TEST(PowellMeasure, IsTheLargestViolationOrMultiplierOfAnOpenConstraint) {
  EXPECT_EQ(powell_measure(Array{-1.0, 0.25, -0.5}, Array{0.0, 0.1, 0.0}), 0.25);     // penetration
  EXPECT_EQ(powell_measure(Array{-1.0, 0.25, -0.5}, Array{0.5, 0.1, 0.0}), 0.5);      // open, yet theta > 0
  EXPECT_EQ(powell_measure(Array{-0.125, 0.0, -0.5}, Array{0.75, 3.0, 0.0}), 0.125);  // closed by g
  EXPECT_EQ(powell_measure(Array{-1.0, 0.0}, Array{0.0, 3.0}), 0.0);                  // complementary
  EXPECT_EQ(powell_measure(Array{-0.5, 0.25}), 0.5);
  EXPECT_EQ(powell_measure(Array{}), 0.0);
  EXPECT_TRUE(std::isnan(powell_measure(Array{nan, 1.0}, Array{1.0, 1.0})));
  EXPECT_TRUE(std::isnan(powell_measure(Array{1.0, nan})));
  EXPECT_THROW(powell_measure(Array{1.0}, Array{1.0, 2.0}), std::invalid_argument);
}

TEST(MultiplierTerms, AreThePublishedFunctionalAndItsDerivatives) {
  MultiplierUpdate outer({2.0, 4.0, 8.0}, {3.0, 5.0});
  outer.restart(Array{1.0, 1.0, 0.0}, Array{6.0, -5.0});  // theta 0.5, 0.25, 0; theta_e 2, -1
  const Array g{-1.0, 0.5, 0.0}, h{1.0, 4.0};
  EXPECT_EQ(outer.inequality_term(g), 0.5 * 4.0 * 0.75 * 0.75);
  EXPECT_EQ(outer.equality_term(h), 0.5 * (3.0 * 9.0 + 5.0 * 9.0));
  Array force(3), tangent(3), pull(2);
  outer.inequality_force(g, force, tangent);
  outer.equality_force(h, pull);
  EXPECT_EQ(force, (Array{0.0, 3.0, 0.0}));
  EXPECT_EQ(tangent, (Array{0.0, 4.0, 8.0}));
  EXPECT_EQ(pull, (Array{9.0, 15.0}));
}

// By hand, alpha = 4 and beta = 10: improved by alpha, improved by less, not improved.
TEST(MultiplierUpdate, FollowsTheCorrectedAlgorithm) {
  MultiplierUpdate outer({1.0, 1.0, 1.0}, {2.0});
  MultiplierStep step = outer.update(Array{0.5, 0.25, -1.0}, Array{-8.0});
  EXPECT_EQ(step.inequality, MultiplierAction::multipliers_updated);  // anything improves on infinity
  EXPECT_EQ(step.equality, MultiplierAction::multipliers_updated);
  EXPECT_EQ(step.inequality_measure, 0.5);
  EXPECT_EQ(step.equality_measure, 8.0);
  EXPECT_EQ(copy(outer.inequality_shifts()), (Array{0.5, 0.25, 0.0}));
  EXPECT_EQ(copy(outer.equality_shifts()), (Array{-8.0}));

  // From 0.5 to 0.25 > 0.5/4: theta grows by max(g, -theta), then kappa of those above 0.125 and theta /
  // beta.
  step = outer.update(Array{0.25, -1.0, 0.0625}, Array{1.0});
  EXPECT_EQ(step.inequality, MultiplierAction::multipliers_and_penalties_updated);
  EXPECT_EQ(step.equality, MultiplierAction::multipliers_updated);  // 8 to 1
  EXPECT_EQ(copy(outer.inequality_penalties()), (Array{10.0, 10.0, 1.0}));
  EXPECT_NEAR(outer.inequality_shifts()[0], 0.075, 4 * eps);
  EXPECT_EQ(outer.inequality_shifts()[1], 0.0);
  EXPECT_EQ(outer.inequality_shifts()[2], 0.0625);
  EXPECT_EQ(copy(outer.equality_penalties()), (Array{2.0}));

  // No better than 0.25: multipliers stay, kappa of those above 0.25/4 grows.
  const Array multipliers = outer.inequality_multipliers();
  step = outer.update(Array{0.5, 0.01, 0.0625}, Array{-1.0});
  EXPECT_EQ(step.inequality, MultiplierAction::penalties_increased);
  EXPECT_EQ(step.equality, MultiplierAction::penalties_increased);
  EXPECT_EQ(copy(outer.inequality_penalties()), (Array{100.0, 10.0, 10.0}));
  EXPECT_EQ(copy(outer.equality_penalties()), (Array{20.0}));
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(outer.inequality_multipliers()[i], multipliers[i], 8 * eps);
  EXPECT_NEAR(outer.equality_multipliers()[0], -14.0, 64 * eps);

  // 0.3 is compared with 0.25, the last that improved, not with the 0.5 after it.
  step = outer.update(Array{0.3, -1.0, -1.0}, Array{0.0});
  EXPECT_EQ(step.inequality, MultiplierAction::penalties_increased);
  EXPECT_EQ(step.equality, MultiplierAction::satisfied);
  EXPECT_FALSE(step.converged());
}

TEST(MultiplierUpdate, LeavesWhatIsSatisfiedAlone) {
  MultiplierUpdate outer({1.0, 1.0}, {1.0});
  outer.restart(Array{3.0, 0.0}, Array{-2.0});
  const MultiplierStep step = outer.update(Array{0.0, -5.0}, Array{1e-11});
  EXPECT_TRUE(step.converged());
  EXPECT_FALSE(step.stalled());
  EXPECT_EQ(outer.inequality_multipliers(), (Array{3.0, 0.0}));
  EXPECT_EQ(outer.equality_multipliers(), (Array{-2.0}));
  EXPECT_TRUE(MultiplierUpdate({}).update({}).converged());
}

TEST(MultiplierUpdate, ReportsThatItStallsAtTheLargestPenalty) {
  MultiplierOptions options;
  options.largest_growth = 50.0;
  MultiplierUpdate outer({2.0, 3.0}, {}, options);
  const Array stuck{0.5, -1.0};  // a constraint that cannot be met
  EXPECT_EQ(outer.update(stuck).inequality, MultiplierAction::multipliers_updated);
  EXPECT_EQ(outer.update(stuck).inequality, MultiplierAction::penalties_increased);
  EXPECT_EQ(outer.update(stuck).inequality, MultiplierAction::penalties_increased);
  EXPECT_EQ(copy(outer.inequality_penalties()), (Array{100.0, 3.0}));
  const MultiplierStep step = outer.update(stuck);
  EXPECT_EQ(step.inequality, MultiplierAction::stalled);
  EXPECT_TRUE(step.stalled());
  EXPECT_NEAR(outer.inequality_multipliers()[0], 1.0, 8 * eps);
}

TEST(MultiplierUpdate, IsDoneAtOnceWhenStartedFromTheSolution) {
  const QuadraticProgram program = chain();
  MultiplierUpdate outer(Array(6, 10.0), {10.0});
  outer.restart(Array{0, 0.75, 0, 2.5, 0.01, 0}, Array{0.5});
  EXPECT_EQ(solve(program, outer).steps.size(), 1u);
}

// With penalties as they are, the outer iteration is a proximal ascent on the dual: its value, the minimum of
// the augmented Lagrangian less 1/2 sum kappa theta^2, rises to the minimum of the program.
TEST(MultiplierUpdate, RaisesTheDualValueToThePrimalMinimum) {
  const QuadraticProgram program = chain();
  MultiplierOptions options;
  options.largest_growth = 1.0;
  MultiplierUpdate outer(Array(6, 5.0), {5.0}, options);
  const double minimum = program.value(Eigen::VectorXd::LinSpaced(6, -1.0, 2.0));
  Eigen::VectorXd x = Eigen::VectorXd::Zero(6);
  double previous = -infinity;
  for (int j = 0; j < 100; ++j) {
    ASSERT_TRUE(program.solve_inner(x, outer));
    double dual = program.augmented_value(x, outer);
    for (int i = 0; i < 6; ++i)
      dual -= 0.5 * outer.inequality_penalties()[i] * std::pow(outer.inequality_shifts()[i], 2);
    dual -= 0.5 * outer.equality_penalties()[0] * std::pow(outer.equality_shifts()[0], 2);
    EXPECT_GE(dual, previous - 1e-12);
    EXPECT_LE(dual, minimum + 1e-12);
    previous = dual;
    const MultiplierStep step = outer.update(as_span(program.g(x)), as_span(program.h(x)));
    if (step.converged() || step.stalled()) break;
  }
  EXPECT_NEAR(previous, minimum, 1e-9);
}

TEST(MultiplierUpdate, BeginsANewProblemWithTheMultipliersOfTheLast) {
  MultiplierUpdate outer({4.0}, {2.0});
  outer.update(Array{0.5}, Array{0.25});
  outer.restart();
  EXPECT_EQ(outer.inequality_multipliers(), (Array{2.0}));
  EXPECT_EQ(outer.equality_multipliers(), (Array{0.5}));
  const MultiplierStep step =
      outer.update(Array{7.0}, Array{9.0});  // worse than before, but of a new problem
  EXPECT_EQ(step.inequality, MultiplierAction::multipliers_updated);
  EXPECT_EQ(step.equality, MultiplierAction::multipliers_updated);
}

TEST(MultiplierUpdate, RejectsBadConstraintsAndStaysAsItWas) {
  MultiplierUpdate outer({1.0, 1.0}, {1.0});
  outer.restart(Array{1.0, 2.0}, Array{3.0});
  for (double bad : {nan, infinity, -infinity}) {
    EXPECT_THROW(outer.update(Array{0.5, bad}, Array{1.0}), std::invalid_argument);
    EXPECT_THROW(outer.update(Array{0.5, 0.5}, Array{bad}), std::invalid_argument);
    EXPECT_THROW(outer.restart(Array{1.0, bad}, Array{1.0}), std::invalid_argument);
    EXPECT_THROW(outer.restart(Array{1.0, 1.0}, Array{bad}), std::invalid_argument);
  }
  EXPECT_THROW(outer.update(Array{0.5}, Array{1.0}), std::invalid_argument);
  EXPECT_THROW(outer.update(Array{0.5, 0.5}), std::invalid_argument);
  EXPECT_THROW(outer.restart(Array{1.0, -1.0}, Array{1.0}), std::invalid_argument);
  EXPECT_THROW(outer.restart(Array{1.0, 1.0}), std::invalid_argument);
  EXPECT_EQ(outer.inequality_multipliers(), (Array{1.0, 2.0}));
  EXPECT_EQ(outer.equality_multipliers(), (Array{3.0}));
  try {
    outer.update(Array{0.5, nan}, Array{1.0});
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "MultiplierUpdate: g[1] is nan; it must be finite");
  }
}

TEST(MultiplierUpdate, RejectsBadOptionsPenaltiesAndLengths) {
  for (double bad : {0.0, -1.0, nan, infinity}) {
    EXPECT_THROW(MultiplierUpdate({1.0, bad}), std::invalid_argument);
    EXPECT_THROW(MultiplierUpdate({1.0}, {bad}), std::invalid_argument);
    for (auto member : {&MultiplierOptions::improvement, &MultiplierOptions::growth,
                        &MultiplierOptions::inequality_tolerance, &MultiplierOptions::equality_tolerance,
                        &MultiplierOptions::largest_growth}) {
      MultiplierOptions options;
      options.*member = bad;
      EXPECT_THROW(MultiplierUpdate({1.0}, {}, options), std::invalid_argument);
    }
  }
  MultiplierOptions options;
  options.growth = 1.0;
  EXPECT_THROW(options.validate(), std::invalid_argument);
  const MultiplierUpdate outer({1.0, 1.0}, {1.0});
  Array one(1), two(2), other(2);
  EXPECT_THROW(outer.inequality_term(one), std::invalid_argument);
  EXPECT_THROW(outer.inequality_force(one, two, other), std::invalid_argument);
  EXPECT_THROW(outer.inequality_force(two, one, other), std::invalid_argument);
  EXPECT_THROW(outer.inequality_force(two, other, one), std::invalid_argument);
  EXPECT_THROW(outer.equality_term(two), std::invalid_argument);
  EXPECT_THROW(outer.equality_force(one, two), std::invalid_argument);
}

}  // namespace
}  // namespace wavebalance::contact
