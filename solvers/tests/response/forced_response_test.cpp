#include "wavebalance/solvers/response/forced_response.hpp"

#include "support/held_motion.hpp"
#include "support/small_problems.hpp"
#include "support/solved.hpp"
#include "testing.hpp"
#include "wavebalance/solvers/response/response_motion.hpp"
#include "wavebalance/solvers/time/translate_spectrum.hpp"

namespace wavebalance::solvers {
namespace {

// A law of a user's own: an elastic stop.
struct Stop {
  double force(double u) const { return u > 1e-3 ? 2e8 * (u - 1e-3) : 0.0; }
  double tangent(double u) const { return u >= 1e-3 ? 2e8 : 0.0; }
  double potential(double u) const { return u > 1e-3 ? 1e8 * (u - 1e-3) * (u - 1e-3) : 0.0; }
  double gap() const { return 1e-3; }
};

CondensedProblem case_1(int functions, int points) {
  return testing::fourier_problem(testing::jl14_case_1.structure(), functions, points,
                                  testing::jl14_case_1.frequency_hz);
}

TEST(ForcedResponse, TakesALawOfTheUsersOwn) {
  CondensedProblem problem = case_1(63, 256);
  const PeriodicResponse response = testing::solved_response(problem, Stop{});
  EXPECT_GT(response.displacement.maxCoeff(), 1e-3);
  for (int l = 0; l < 256; ++l)
    EXPECT_DOUBLE_EQ(response.contact_force[l], Stop{}.force(response.displacement[l]));
  EXPECT_GT(response.contact_force.maxCoeff(), 0.0);
}

TEST(ForcedResponse, EveryRecordedFieldBelongsToTheSolution) {
  CondensedProblem problem = case_1(63, 256);
  const testing::ExponentialLaw law = testing::jl14_case_1.law;
  const PeriodicResponse response = testing::solved_response(problem, law);
  EXPECT_EQ(response.frequency, 150.0);
  EXPECT_LE(response.residual, 1e-11);
  EXPECT_EQ(response.residual_history.back(), response.residual);
  EXPECT_EQ(static_cast<int>(response.residual_history.size()), response.iterations + 1);
  TrialEvaluator evaluate(problem.pair().trial(), 256, 0);
  EXPECT_LE((evaluate(response.coefficients) - response.displacement).norm(),
            1e-11 * response.displacement.norm());
  for (int l = 0; l < 256; ++l) {
    EXPECT_GE(response.contact_force[l], 0.0);
    EXPECT_EQ(response.contact_force[l] > 0.0, response.displacement[l] > law.start);
  }
}

// A stiff law magnifies a residual that is small compared with the motion: at a tolerance of 1e-4 the force
// that makes the motion could be any other than the law's force at that motion.
TEST(ForcedResponse, TheForceOfAConvergedMotionIsThatOfItsLaw) {
  for (const double stiffening : {1.0, 1e2, 1e4}) {
    CondensedProblem problem = case_1(63, 256);
    testing::ExponentialLaw law = testing::jl14_case_1.law;
    law.constant *= stiffening;
    ForcedResponseOptions options;
    options.newton.tolerance = 1e-4;
    const PeriodicResponse response = testing::solved_response(problem, law, options);
    Eigen::VectorXd product;
    problem.apply(response.contact_force, product);
    const Eigen::VectorXd& free = problem.linear_response();
    const Eigen::VectorXd motion = free - product;
    EXPECT_LE((motion - response.displacement).norm(), 1e-4 * (free.norm() + product.norm())) << stiffening;
    const Eigen::VectorXd held = testing::held_motion(problem, response);
    const Eigen::VectorXd law_force = held.unaryExpr([&](double u) { return law.force(u); });
    // Newton's bound of 1e-6 is on the force times the share that it has in the motion.
    const double share = product.norm() / (response.displacement.norm() + free.norm());
    EXPECT_LE((law_force - response.contact_force).cwiseAbs().maxCoeff(),
              2e-6 / share * response.contact_force.maxCoeff())
        << stiffening;
  }
}

TEST(ForcedResponse, StartedAtTheSolutionStays) {
  CondensedProblem problem = case_1(63, 256);
  const testing::ExponentialLaw law = testing::jl14_case_1.law;
  const PeriodicResponse first = forced_response(problem, law, {});
  const PeriodicResponse again = testing::solved_response(problem, law, {}, first.displacement);
  EXPECT_LE(again.iterations, 1);
}

TEST(ForcedResponse, ContractsQuadraticallyOnceTheActiveSetStands) {
  CondensedProblem problem = case_1(63, 256);
  const PeriodicResponse response = forced_response(problem, testing::jl14_case_1.law, {});
  const auto& history = response.residual_history;
  ASSERT_GE(history.size(), 3u);
  const double last = history[history.size() - 1], before = history[history.size() - 2];
  EXPECT_LT(last, 10.0 * before * before + 1e-15);
}

TEST(ForcedResponse, SaysWhenIterationsRanOut) {
  CondensedProblem problem = case_1(63, 256);
  ForcedResponseOptions options;
  options.newton.max_iterations = 1;
  options.fallbacks = false;
  const PeriodicResponse response = forced_response(problem, testing::jl14_case_1.law, options);
  EXPECT_EQ(response.status, SolveStatus::iteration_limit);
  EXPECT_FALSE(response.converged());
  EXPECT_EQ(response.iterations, 1);
  EXPECT_GT(response.residual, 1e-11);
}

CondensedProblem stiff_haar_problem() {
  CondensedProblem problem(testing::make_pair(testing::HaarBasis{8}, spectral::FourierBasis(8), 256),
                           testing::jl14_case_2.structure(), testing::cosine_load());
  problem.set_frequency(1275.0);
  return problem;
}

TEST(ForcedResponse, ContinuationInTheGapFindsWhatNewtonDoesNot) {
  CondensedProblem problem = stiff_haar_problem();
  ForcedResponseOptions options;
  options.fallbacks = false;
  const PeriodicResponse plain = forced_response(problem, testing::jl14_case_2.law, options);
  EXPECT_EQ(plain.status, SolveStatus::stalled);
  EXPECT_EQ(plain.strategy, Strategy::none);
  const PeriodicResponse found = testing::solved_response(problem, testing::jl14_case_2.law);
  EXPECT_EQ(found.strategy, Strategy::gap_continuation);
}

TEST(ForcedResponse, TellsItsObserverWhatTheValuesAre) {
  CondensedProblem problem = stiff_haar_problem();
  int newton = 0, continuation = 0;
  ForcedResponseOptions options;
  options.observer = [&](const Progress& progress) {
    const bool newton_step = progress.phase == "Newton";
    EXPECT_EQ(progress.measure, newton_step ? "relative residual" : "fraction of the residual");
    EXPECT_GE(progress.value, 0.0);
    return ++(newton_step ? newton : continuation) > 0;
  };
  ASSERT_TRUE(forced_response(problem, testing::jl14_case_2.law, options).converged());
  EXPECT_GT(newton, 3);
  EXPECT_GT(continuation, 3);
}

TEST(ForcedResponse, IsCancelledByItsObserverInNewtonAndInContinuation) {
  CondensedProblem problem = stiff_haar_problem();
  for (const std::string_view phase : {"Newton", "continuation"}) {
    int steps = 0;
    ForcedResponseOptions options;
    options.observer = [&](const Progress& progress) { return progress.phase != phase || ++steps < 3; };
    const PeriodicResponse stopped = forced_response(problem, testing::jl14_case_2.law, options);
    EXPECT_EQ(stopped.status, SolveStatus::cancelled) << phase;
    EXPECT_EQ(steps, 3) << phase;
  }
}

// A stop whose author divides zero by zero beyond it.
struct Undefined : Stop {
  double force(double u) const { return u > 1e-3 ? nan : 0.0; }
};

TEST(ForcedResponse, NamesTheContactAndTheDisplacementWhereALawReturnsNoNumber) {
  CondensedProblem problem = case_1(15, 64);
  try {
    forced_response(problem, AnyContactLaw(Undefined{}), {});
    FAIL() << "nothing thrown";
  } catch (const std::invalid_argument& error) {
    const std::string text = error.what();
    EXPECT_EQ(text.find("the law of contact 1 returned nan as its force at u = 0.0"), 0u) << text;
    EXPECT_NE(text.find(" m; it must return a number"), std::string::npos) << text;
  }
  const Eigen::VectorXd below = Eigen::VectorXd::Constant(4, 0.5e-3);
  EXPECT_NO_THROW(ContactLaws(AnyContactLaw(Undefined{})).require_numbers(2, below));
}

TEST(ForcedResponse, SaysWhenItsOperationsAreUsedUp) {
  CondensedProblem problem = stiff_haar_problem();
  ForcedResponseOptions options;
  options.newton.max_operations = 1.0;
  options.continuation.max_points = 1;
  options.settling.max_size = 0;  // no settling
  EXPECT_EQ(forced_response(problem, testing::jl14_case_2.law, options).status, SolveStatus::effort_limit);
}

TEST(ForcedResponse, RefusesOptionsOutOfRange) {
  CondensedProblem problem = case_1(7, 32);
  std::vector<ForcedResponseOptions> wrong(6);
  wrong[5].max_fallback_operations = 0.0;
  wrong[0].newton.max_iterations = -1;
  wrong[1].newton.tolerance = 0.0;
  wrong[2].newton.min_step = -1.0;
  wrong[3].continuation.max_operations = 0.0;
  wrong[4].continuation.max_points = 0;
  for (const ForcedResponseOptions& options : wrong)
    EXPECT_THROW(forced_response(problem, Stop{}, options), std::invalid_argument);
}

TEST(ForcedResponse, RefusesAGuessOfAnotherLengthAndAProblemWithoutFrequency) {
  CondensedProblem problem = case_1(7, 32);
  EXPECT_THROW(forced_response(problem, Stop{}, {}, Eigen::VectorXd::Zero(31)), std::invalid_argument);
  CondensedProblem fresh = testing::fourier_problem(testing::jl14_bar(3, 1e-4), 7, 32);
  EXPECT_THROW(forced_response(fresh, Stop{}, {}), std::invalid_argument);
  for (const double frequency : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()})
    EXPECT_THROW(problem.set_frequency(frequency), std::invalid_argument);
}

}  // namespace
}  // namespace wavebalance::solvers
