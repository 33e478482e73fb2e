// One object for all questions about a structure with its contacts: the answers of the functions that it
// calls, in any order.
#include "wavebalance/solvers/problem/contact_problem.hpp"
#include "dense_algebra.hpp"
#include "linalg/dense.hpp"
#include "support/impact_scenes.hpp"
#include "support/oscillator.hpp"
#include "support/refusal.hpp"
#include "support/rigid_law.hpp"
#include "support/small_problems.hpp"
#include "support/solved.hpp"
#include "testing.hpp"
#include "wavebalance/contact/rigid_law.hpp"
#include "wavebalance/solvers/response/motion_periods.hpp"
#include "wavebalance/solvers/response/response_motion.hpp"
#include "wavebalance/solvers/structure/massless_contacts.hpp"

namespace wavebalance::solvers {
namespace {

const testing::LinearContact elastic_stop{10.0, 0.1};
const LinearStructure impacting_oscillator = testing::unit_oscillator(0.1, 0.8);

ContactProblem stopped(int periods = 1) {
  return {testing::fourier_pair(62 * periods + 1, 256 * periods), impacting_oscillator, elastic_stop,
          periods};
}

TEST(ContactProblem, RespondsAsTheFunctionOfItsParts) {
  ContactProblem problem = stopped();
  const PeriodicResponse response = problem.respond(0.2);
  CondensedProblem parts = testing::fourier_problem(impacting_oscillator, 63, 256, 0.2);
  const PeriodicResponse expected = forced_response(parts, elastic_stop, {});
  ASSERT_TRUE(response.converged());
  EXPECT_EQ(response.displacement, expected.displacement);
  EXPECT_EQ(problem.motion(response, 64).force, contact_motion(parts, expected, elastic_stop, 64).force);
}

TEST(ContactProblem, AnswersQuestionsInAnyOrder) {
  ContactProblem problem = stopped();
  const PeriodicResponse low = problem.respond(0.15);
  const Motion motion = problem.motion(low, 64), structure = problem.structure_motion(low, 64);
  const MotionStability stability = problem.stability(low);
  const PeriodicResponse high = problem.respond(0.3);
  FrequencySweepOptions sweep = testing::between(0.1, 0.6);
  problem.amplitude_sweep(0.2, sweep);
  EXPECT_EQ(problem.motion(low, 64).force, motion.force);
  EXPECT_EQ(problem.structure_motion(low, 64).displacement, structure.displacement);
  EXPECT_EQ(problem.stability(low).leading, stability.leading);
  EXPECT_EQ(problem.respond(0.3).displacement, high.displacement);
}

TEST(ContactProblem, FindsTheSameIntervalsFromTheSettledMotionAsFromABalance) {
  ContactProblem problem = stopped();
  const auto balance = problem.exact_near(problem.respond(0.2), {.tolerance = 1e-11});
  const auto settled = problem.exact_near(0.2, problem.settle(0.2), {.tolerance = 1e-11});
  ASSERT_TRUE(balance && settled);
  ASSERT_TRUE(balance->motion.converged() && settled->converged());
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(100, 0.0, 0.99);
  const Eigen::MatrixXd expected = balance->motion.displacement(times);
  EXPECT_LT((settled->displacement(times) - expected).norm(), 1e-9 * expected.norm());
  const ExactStructureMotion whole = problem.structure_motion(0.2, *settled, 100);
  EXPECT_LT((whole.motion.displacement - expected).norm(), 2e-9 * expected.norm());
  EXPECT_EQ(problem.stability(0.2, *settled).status, "stable");
  EXPECT_EQ(problem.stability(0.2, ExactSolution{}).status, "not_found");
}

TEST(ContactProblem, FollowsACurveWhosePointsAreItsResponses) {
  ContactProblem problem = stopped();
  FrequencySweepOptions options = testing::between(0.1, 0.3);
  const FrequencySweep curve = problem.sweep(options);
  ASSERT_EQ(curve.status, SweepStatus::reached_end);
  for (std::size_t i = 0; i < curve.points.size(); i += 7) {
    const PeriodicResponse response =
        problem.response(curve, curve.points[i].frequency, curve.points[i].unknown);
    EXPECT_LE(response.residual, 1e-9);
    EXPECT_EQ(response.frequency, curve.points[i].frequency);
  }
  const std::vector<PeriodicResponse> at = problem.responses_at(curve, 0.2);
  ASSERT_EQ(at.size(), 1u);
  EXPECT_LE((at[0].displacement - problem.respond(0.2).displacement).norm(),
            1e-8 * at[0].displacement.norm());
  const CurveStability stability = problem.stability(curve);
  EXPECT_EQ(stability.points.size(), curve.points.size());
}

TEST(ContactProblem, TellsAmplitudesInTheUnitOfItsLoad) {
  CondensedProblem parts = testing::fourier_problem(impacting_oscillator, 31, 128);
  parts.set_load_unit(0.8, "N");
  ContactProblem newtons(std::move(parts), elastic_stop);
  FrequencySweepOptions options = testing::between(0.05, 0.8);
  std::string_view unit;
  options.observer = [&](const Progress& progress) {
    if (progress.phase == "amplitude sweep") unit = progress.measure;
    return true;
  };
  const FrequencySweep curve = newtons.amplitude_sweep(0.12, options);
  ASSERT_EQ(curve.status, SweepStatus::reached_end);
  EXPECT_EQ(unit, "N");
  EXPECT_NEAR(curve.points.front().load_scale, 0.05, 1e-12);
  EXPECT_NEAR(curve.points.back().load_scale, 0.8, 1e-9);
  const PeriodicResponse full = newtons.respond(0.12);
  EXPECT_EQ(full.load_scale, 0.8);
  EXPECT_NEAR(curve.points.back().max_displacement, newtons.motion(full, 1024).displacement.maxCoeff(), 1e-7);
}

// The lowest frequencies and the static deflections stay, and a rigid obstacle then has a motion.
TEST(ContactProblem, TakesARigidObstacleAtContactsWithoutMass) {
  std::mt19937 generator(8);
  const LinearStructure chain = testing::random_chain(6, generator);
  const auto modes = detail::symmetric_eigen(Eigen::MatrixXd(chain.stiffness), Eigen::MatrixXd(chain.mass));
  const MasslessContacts massless = with_massless_contacts(
      chain, chain.size() - chain.contacts(), modes.value().values.cwiseSqrt(), modes.value().vectors);
  ContactProblem open(testing::fourier_pair(63, 256), chain, {});
  const double free = open.respond(0.06).displacement.maxCoeff(), gap = 0.5 * free;
  double coarse = 0.0;  // how far the obstacle is passed at the points, an error of the discretisation
  for (const int functions : {63, 255}) {
    ContactProblem problem(testing::fourier_pair(functions, 4 * functions), massless.structure,
                           testing::Rigid{gap});
    const PeriodicResponse response = problem.respond(0.06);
    ASSERT_TRUE(response.converged());
    EXPECT_GT(response.contact_force.maxCoeff(), 0.0);
    const double passed = response.displacement.maxCoeff() - gap;
    EXPECT_LT(passed, 0.2 * gap);
    if (functions > 63) {
      EXPECT_LT(passed, 0.5 * coarse);
    }
    coarse = passed;
  }
  const Eigen::VectorXd push = chain.contact_directions.transpose() * Eigen::VectorXd::Ones(1);
  const Eigen::VectorXd reduced_push =
      massless.structure.contact_directions.transpose() * Eigen::VectorXd::Ones(1);
  const Eigen::VectorXd whole = oracle::solve(Eigen::MatrixXd(chain.stiffness), push);
  const Eigen::VectorXd recovered =
      massless.recovery * oracle::solve(Eigen::MatrixXd(massless.structure.stiffness), reduced_push);
  EXPECT_LE((whole - recovered).norm(), 1e-10 * whole.norm());
}

TEST(ContactProblem, RefusesWhatIsIllPosed) {
  EXPECT_NE(testing::refusal([] {
              ContactProblem(testing::fourier_pair(7, 32), impacting_oscillator, testing::Rigid{0.1});
            }).find("a rigid law needs contacts without mass"),
            std::string::npos);
  EXPECT_THROW(ContactProblem(testing::fourier_pair(7, 32), impacting_oscillator,
                              ContactLaws({AnyContactLaw(), AnyContactLaw()})),
               std::invalid_argument);
  EXPECT_THROW(stopped(0), std::invalid_argument);
  CondensedProblem parts = testing::fourier_problem(impacting_oscillator, 7, 32);
  EXPECT_THROW(parts.set_load_unit(0.0, "N"), std::invalid_argument);
}

TEST(ContactProblem, WithRestitutionHasImpactsAndNothingElse) {
  const testing::ImpactScene scene = testing::impact_oscillator(0.1, 1.0, 0.8, 1.0);
  const LinearStructure structure = scene.structure();
  ContactProblem problem(testing::fourier_pair(7, 32), structure, contact::RigidLaw(1.0, 0.8));
  const ImpactResponse found = problem.impacts(scene.frequency());
  ASSERT_TRUE(found.motion.converged());
  EXPECT_NEAR(found.motion.impacts.front().velocity_before, 1.69573294, 1e-8);
  EXPECT_THROW(problem.respond(scene.frequency()), std::invalid_argument);
  EXPECT_THROW(problem.settle(scene.frequency()), std::invalid_argument);
  EXPECT_THROW(ContactProblem(testing::fourier_pair(7, 32), structure, contact::RigidLaw(1.0)),
               std::invalid_argument);
}

}  // namespace
}  // namespace wavebalance::solvers
