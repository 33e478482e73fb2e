// The force form: the resolvents of laws, and responses to rigid and stiff laws with them.

#include <Eigen/Geometry>
#include <numeric>
#include <utility>

#include "support/oscillator.hpp"
#include "support/refusal.hpp"
#include "support/rigid_law.hpp"
#include "support/small_problems.hpp"
#include "support/solved.hpp"
#include "testing.hpp"
#include "wavebalance/solvers/balance/contact_form.hpp"
#include "wavebalance/solvers/balance/resolvent_law.hpp"
#include "wavebalance/solvers/structure/contact_mass.hpp"
#include "wavebalance/solvers/time/translate_spectrum.hpp"

namespace wavebalance::solvers {
namespace {

using testing::Rigid;

// Stops on both sides, and a cubic spring.
struct TwoSided {
  double stiffness = 1e6, start = 1e-3;
  double force(double u) const {
    return u > start ? stiffness * (u - start) : u < -start ? stiffness * (u + start) : 0.0;
  }
  double tangent(double u) const { return std::abs(u) >= start ? stiffness : 0.0; }
  double potential(double u) const {
    return 0.5 * stiffness * std::pow(std::max(std::abs(u) - start, 0.0), 2);
  }
  double gap() const { return start; }
};
// It does not declare that it acts on both sides.
struct Cubic {
  double stiffness = 1e11, begin = 0.0;

  double force(double u) const { return stiffness * u * u * u; }
  double tangent(double u) const { return 3.0 * stiffness * u * u; }
  double potential(double u) const { return 0.25 * stiffness * u * u * u * u; }
  double gap() const { return begin; }
};

TEST(Resolvent, IsTheForceOfTheLawInSeriesWithASpring) {
  const std::vector<AnyContactLaw> laws{testing::LinearContact{1e7, 1e-3}, testing::ExponentialLaw{},
                                        testing::ExponentialLaw{1e8, 1e4, -2e-3}, TwoSided{}, Cubic{}};
  for (std::size_t i = 0; i < laws.size(); ++i)
    for (const double flexibility : {1e-12, 1e-9, 1e-6, 1e-3})
      for (const double v : {-0.2, -3e-3, 0.0, 0.9e-3, 1.1e-3, 2e-3, 0.02, 0.5}) {
        SCOPED_TRACE(::testing::Message() << "law " << i << ", " << flexibility << " m/N, v = " << v);
        const ForceSlope found = laws[i].resolvent(v, flexibility);
        const double u = v - flexibility * found.force;
        // As far as rounding of u decides the force.
        const double rounding =
            1e-15 * (std::abs(v) + std::abs(u)) * (laws[i].tangent(u) + 1.0 / flexibility);
        EXPECT_NEAR(laws[i].force(u), found.force, 1e-9 * std::abs(found.force) + 10.0 * rounding);
        const double tangent = laws[i].tangent(u);
        EXPECT_NEAR(found.tangent, tangent / (1.0 + flexibility * tangent),
                    1e-6 * found.tangent + 1e-6 / flexibility * (rounding > 0.0 ? 1e-3 : 0.0));
      }
}

TEST(Resolvent, OfAResolventLawHasThePotentialOfLawAndSpring) {
  const ResolventLaw law(testing::LinearContact{1e7, 1e-3}, 1e-6);
  const double v = 3e-3, step = 1e-8;
  EXPECT_NEAR((law.potential(v + step) - law.potential(v - step)) / (2.0 * step), law.force(v),
              1e-6 * law.force(v));
  EXPECT_EQ(law.force(0.9e-3), 0.0);
  EXPECT_THROW(ResolventLaw(testing::LinearContact{1e7, 1e-3}, 0.0), std::invalid_argument);
}

TEST(ContactLaw, IsUnilateralUnlessItActsBelowItsGap) {
  EXPECT_TRUE(AnyContactLaw().unilateral());
  EXPECT_TRUE(AnyContactLaw(testing::LinearContact{1e7, 1e-3}).unilateral());
  EXPECT_TRUE(AnyContactLaw(Rigid{1e-3}).unilateral());
  EXPECT_FALSE(AnyContactLaw(TwoSided{}).unilateral());
  EXPECT_FALSE(AnyContactLaw(TwoSided{1e6, -1e-3}).unilateral());
  EXPECT_FALSE(AnyContactLaw(Cubic{}).unilateral());
  EXPECT_TRUE(AnyContactLaw(Rigid{1e-3}).is_rigid());
  EXPECT_FALSE(AnyContactLaw(testing::ExponentialLaw{}).is_rigid());
}

CondensedProblem bar_problem(const testing::Jl14Case& one, TimePair pair) {
  CondensedProblem problem(std::move(pair), testing::massless_tip(one.structure()), testing::cosine_load());
  problem.set_frequency(one.frequency_hz);
  return problem;
}

Eigen::VectorXd tip_motion(CondensedProblem& problem, const PeriodicResponse& response) {
  return TrialEvaluator(problem.pair().trial(), 4096, 0)(response.coefficients.col(0));
}

// Errors over the rms of the motion with 511 functions and 1024 points, itself good to about 3e-4.
TEST(RigidContact, OfTheBarConvergesInDisplacement) {
  const testing::Jl14Case& one = testing::jl14_case_2;
  CondensedProblem fine = bar_problem(one, testing::fourier_pair(511, 1024));
  const PeriodicResponse reference = testing::solved_response(fine, Rigid{one.law.start});
  EXPECT_EQ(reference.strategy, Strategy::newton);
  const Eigen::VectorXd exact = tip_motion(fine, reference);
  for (const auto& [functions, bound] :
       {std::pair{31, 6.1e-3}, std::pair{63, 2.9e-3}, std::pair{127, 7.5e-4}, std::pair{255, 3e-4}}) {
    SCOPED_TRACE(functions);
    CondensedProblem problem = bar_problem(one, testing::fourier_pair(functions, 2 * (functions + 1)));
    const PeriodicResponse response = testing::solved_response(problem, Rigid{one.law.start});
    EXPECT_GT(response.series_flexibility.size(), 0);
    EXPECT_LE(response.iterations, 20);
    EXPECT_GE(response.contact_force.minCoeff(), 0.0);
    EXPECT_LE((tip_motion(problem, response) - exact).norm(), bound * exact.norm());
  }
}

TEST(RigidContact, DependsOnEpsilonByLessThanTheDiscretisation) {
  const testing::Jl14Case& one = testing::jl14_case_2;
  CondensedProblem problem = bar_problem(one, testing::fourier_pair(127, 256));
  const Eigen::VectorXd chosen =
      contact_series_flexibility(problem, Rigid{one.law.start}, ContactForm::automatic);
  std::vector<Eigen::VectorXd> motions;
  for (const double factor : {1.0, 3.0}) {
    ContactSystem system(problem, Rigid{one.law.start}, factor * chosen);
    Eigen::VectorXd unknown = problem.linear_response();
    ASSERT_EQ(newton(system, unknown, {}).status, SolveStatus::converged);
    motions.push_back(problem.displacement(system.force()));
  }
  EXPECT_LE((motions[0] - motions[1]).norm(), 1e-3 * motions[0].norm());
  EXPECT_GT((motions[0] - motions[1]).norm(), 0.0);
}

// With 30 times the stiffness at low harmonics Newton's method converges over short steps only: 454 points.
TEST(RigidContact, IsSweptWithManyFunctionsInFewPoints) {
  CondensedProblem problem =
      testing::fourier_problem(testing::massless_tip(testing::jl14_case_2.structure()), 511, 2048, 1275.0);
  EXPECT_LT(2.0 * problem.high_frequency_compliance()[0], problem.contact_compliance()[0] / 30.0);
  const FrequencySweep sweep = testing::complete_sweep(problem, Rigid{testing::jl14_case_2.law.start},
                                                       testing::between(1280.0, 1400.0));
  EXPECT_LE(sweep.points.size(), 200u);
  ASSERT_EQ(sweep.turning_points.size(), 2u);
  EXPECT_NEAR(sweep.turning_points[0].frequency, 1331.0, 0.2);
  EXPECT_NEAR(sweep.turning_points[1].frequency, 1314.839, 0.02);
}

// Three masses in a row; S selects or combines their displacements.
LinearStructure row_of_masses(const Eigen::Vector3d& masses, const Eigen::MatrixXd& directions) {
  const Eigen::Matrix3d stiffness{{2, -1, 0}, {-1, 2, -1}, {0, -1, 1}};
  return testing::structure(masses.asDiagonal(), 0.1 * stiffness, stiffness, Eigen::Vector3d(1.0, 0.0, 0.0),
                            directions);
}

std::string refusal_of_rigid(const LinearStructure& structure, const ContactLaws& laws) {
  CondensedProblem problem = testing::fourier_problem(structure, 15, 64, 0.1);
  return testing::refusal([&] { forced_response(problem, laws, {}); });
}

TEST(RigidContact, IsRefusedAtContactsWithMass) {
  const Eigen::RowVector3d last(0, 0, 1);
  const std::string refusal = refusal_of_rigid(row_of_masses({1, 1, 1}, last), Rigid{0.1});
  EXPECT_NE(refusal.find("rigid: 0"), std::string::npos) << refusal;
  EXPECT_NE(refusal.find("without a law of impact"), std::string::npos) << refusal;
  EXPECT_EQ(refusal_of_rigid(row_of_masses({1, 1, 0}, last), Rigid{0.1}), "nothing was thrown");
  // Additional elastic stops may have mass.
  const Eigen::MatrixXd two{{1, 0, 0}, {0, 0, 1}};
  const std::vector<AnyContactLaw> mixed{testing::LinearContact{10.0, 0.1}, Rigid{0.1}};
  EXPECT_EQ(refusal_of_rigid(row_of_masses({1, 1, 0}, two), mixed), "nothing was thrown");
  EXPECT_NE(refusal_of_rigid(row_of_masses({0, 1, 1}, two), mixed).find("rigid: 1"), std::string::npos);
}

TEST(RigidContact, HasNoMassWhereTheDirectionsReachWhatMovesWithoutIt) {
  const auto massless = [](const Eigen::Vector3d& masses, const Eigen::MatrixXd& directions) {
    const LinearStructure structure = row_of_masses(masses, directions);
    std::vector<int> all(std::size_t(directions.rows()));
    std::iota(all.begin(), all.end(), 0);
    return contacts_are_massless(structure, all);
  };
  const Eigen::RowVector3d last(0, 0, 1), relative(0, -1, 1);
  EXPECT_TRUE(massless({1, 1, 0}, relative));  // the last one may stop at once
  EXPECT_FALSE(massless({0, 1, 1}, relative));
  EXPECT_TRUE(massless({1, 1, 0}, Eigen::MatrixXd{{0, 0, 1}, {0, 0, -1}}));   // both sides
  EXPECT_FALSE(massless({1, 1, 0}, Eigen::MatrixXd{{0, 0, 1}, {0, -1, 1}}));  // both closed stop the middle
  EXPECT_TRUE(massless({1, 0, 0}, Eigen::MatrixXd{{0, 0, 1}, {0, -1, 1}}));
  // In turned coordinates no row of the mass is zero.
  LinearStructure turned = row_of_masses({1, 1, 0}, last);
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  turned.mass = Eigen::MatrixXd(turn.transpose() * turned.mass * turn).sparseView();
  turned.contact_directions = Eigen::MatrixXd(last * turn).sparseView();
  EXPECT_TRUE(contacts_are_massless(turned, {0}));
  turned.contact_directions = Eigen::MatrixXd(Eigen::RowVector3d(1, 0, 0) * turn).sparseView();
  EXPECT_FALSE(contacts_are_massless(turned, {0}));
}

TEST(ContactForm, RefusesWhatItCannotSolve) {
  CondensedProblem problem = bar_problem(testing::jl14_case_1, testing::fourier_pair(7, 16));
  EXPECT_THROW(contact_series_flexibility(problem, Rigid{1e-3}, ContactForm::displacement),
               std::invalid_argument);
  EXPECT_THROW(contact_series_flexibility(problem, TwoSided{}, ContactForm::force), std::invalid_argument);
  EXPECT_EQ(
      contact_series_flexibility(problem, testing::LinearContact{1e3, 1e-3}, ContactForm::automatic).size(),
      0);
  EXPECT_EQ(contact_series_flexibility(problem, testing::LinearContact{1e3, 1e-3}, ContactForm::force).size(),
            1);
  EXPECT_THROW(ContactOperator(problem, Eigen::VectorXd::Ones(2)), std::invalid_argument);
  EXPECT_THROW(ContactOperator(problem, -Eigen::VectorXd::Ones(1)), std::invalid_argument);
}

// A law that also pushes on the other side was taken for a one-sided one, and its motion called converged.
TEST(TwoSidedContact, ConvergedMotionsFeelBothSides) {
  const double k = 1e5;
  const Eigen::Matrix3d stiffness{{2 * k, -k, 0}, {-k, 2 * k, -k}, {0, -k, k}};
  LinearStructure chain{Eigen::Matrix3d::Identity().sparseView(), 1e-4 * stiffness.sparseView(),
                        stiffness.sparseView(), Eigen::Vector3d(0, 0, 50), contact_rows({2}, 3)};
  CondensedProblem problem = testing::fourier_problem(chain, 63, 256);
  int solved = 0;
  const auto solve = [&](const AnyContactLaw& law, double frequency) {
    problem.set_frequency(frequency);
    const PeriodicResponse response = forced_response(problem, law, {});
    if (!response.converged()) return;
    ++solved;
    Eigen::VectorXd force(problem.samples()), tangent(problem.samples()), product;
    ContactLaws(law).evaluate(1, response.displacement, force, tangent);
    problem.apply(force, product);
    EXPECT_LE((response.displacement - problem.linear_response() + product).norm(),
              1e-9 * (problem.linear_response().norm() + product.norm()));
  };
  const std::vector<AnyContactLaw> laws{TwoSided{}, TwoSided{1e4, 1e-3}, Cubic{}, Cubic{1e11, -1.0},
                                        Cubic{1e11, 1e-3}};
  for (const AnyContactLaw& law : laws)
    for (const double frequency : {10.0, 20.0, 30.0}) solve(law, frequency);
  EXPECT_GE(solved, 13) << "of 15";
  solve(TwoSided{1e6, -1e-3}, 30.0);  // no strategy converges; all of them need a second
}

}  // namespace
}  // namespace wavebalance::solvers
