#include "support/held_motion.hpp"
#include "support/oscillator.hpp"
#include "support/rigid_law.hpp"
#include "support/small_problems.hpp"
#include "support/solved.hpp"
#include "testing.hpp"

// Laws from ordinary stops to those whose penetration is below the rounding of displacements.
namespace wavebalance::solvers {
namespace {

using testing::LinearContact;

// Three masses of 2 kg between springs of 1e6 N/m, 1 % modal damping; the last two touch.
LinearStructure three_masses(double load) {
  const Eigen::Matrix3d stiffness{{2e6, -1e6, 0.0}, {-1e6, 2e6, -1e6}, {0.0, -1e6, 1e6}};
  const Eigen::Matrix3d mass = 2.0 * Eigen::Matrix3d::Identity();
  LinearStructure chain{mass.sparseView(), Eigen::Matrix3d(4.0 * mass + 1e-5 * stiffness).sparseView(),
                        stiffness.sparseView(), Eigen::Vector3d(0.0, 0.0, load), contact_rows({1, 2}, 3)};
  return chain;
}

CondensedProblem chain_problem(double load = 100.0) {
  return testing::fourier_problem(three_masses(load), 31, 128, 50.0);
}

CondensedProblem problem_of(const LinearStructure& bar, int functions, int points) {
  return testing::fourier_problem(bar, functions, points, testing::jl14_case_1.frequency_hz);
}

CondensedProblem bar_problem(int functions = 63, int points = 256) {
  return problem_of(testing::jl14_case_1.structure(), functions, points);
}

// The balance, and the law to rounding.
template <class Law>
void expect_solution(CondensedProblem& problem, const Law& law, const PeriodicResponse& response) {
  ASSERT_TRUE(response.converged()) << to_string(response.status) << " " << response.residual;
  Eigen::VectorXd product;
  problem.apply(response.contact_force, product);
  const Eigen::VectorXd motion = problem.linear_response() - product;
  const double size = problem.linear_response().cwiseAbs().maxCoeff() + product.cwiseAbs().maxCoeff();
  EXPECT_LE((response.displacement - motion).cwiseAbs().maxCoeff(), 1e-10 * size);
  const Eigen::VectorXd held = testing::held_motion(problem, response);
  const double largest = response.contact_force.maxCoeff(), near = 1e-9 * size;
  EXPECT_GT(largest, 0.0);
  for (int l = 0; l < problem.samples(); ++l) {
    EXPECT_GE(response.contact_force[l], law.force(held[l] - near) - 1e-9 * largest) << l;
    EXPECT_LE(response.contact_force[l], law.force(held[l] + near) + 1e-9 * largest) << l;
  }
}

TEST(StiffContact, OfTwoContactsIsSolvedFromOrdinaryStopsToNearlyRigidOnes) {
  for (const double gap : {1e-4, -1e-4})
    for (const double stiffness : {1e7, 1e9, 1e12, 1e18}) {
      SCOPED_TRACE(::testing::Message() << "stiffness " << stiffness << ", gap " << gap);
      CondensedProblem problem = chain_problem();
      const LinearContact law{stiffness, gap};
      expect_solution(problem, law, forced_response(problem, law, {}));
    }
}

TEST(StiffContact, OfTheBarIsSolvedByLinearAndExponentialLawsAlike) {
  for (const double stiffness : {1e9, 1e12, 1e15, 1e18}) {
    SCOPED_TRACE(stiffness);
    CondensedProblem problem = bar_problem();
    const LinearContact linear{stiffness, 1e-3};
    expect_solution(problem, linear, forced_response(problem, linear, {}));
    for (const double exponent : {50.0, 1e3}) {
      const testing::ExponentialLaw exponential{stiffness / exponent, exponent, 1e-3};
      expect_solution(problem, exponential, forced_response(problem, exponential, {}));
    }
  }
}

TEST(StiffContact, TakesTheForceFormBeyondTenThousandTimesTheStructure) {
  CondensedProblem problem = bar_problem();
  const double structure = 70e9 * 25e-4;  // N/m
  EXPECT_EQ(forced_response(problem, LinearContact{0.5e4 * structure, 1e-3}, {}).series_flexibility.size(),
            0);
  const PeriodicResponse stiff = forced_response(problem, LinearContact{2e4 * structure, 1e-3}, {});
  EXPECT_EQ(stiff.series_flexibility.size(), 1);
  ForcedResponseOptions options;
  options.form = ContactForm::displacement;
  EXPECT_EQ(forced_response(problem, LinearContact{2e4 * structure, 1e-3}, options).series_flexibility.size(),
            0);
}

// Load, gap and motion of a stop that is linear in contact scale together.
TEST(StiffContact, ScalesWithLoadAndGapUpToTheLargestNumbers) {
  for (const double stiffness : {1e7, 1e9}) {
    CondensedProblem plain = chain_problem();
    const PeriodicResponse expected = testing::solved_response(plain, LinearContact{stiffness, 1e-4});
    for (const int power : {-900, 900}) {
      const double scale = std::ldexp(1.0, power);
      CondensedProblem problem = chain_problem(100.0 * scale);
      const PeriodicResponse response =
          testing::solved_response(problem, LinearContact{stiffness, 1e-4 * scale});
      EXPECT_TRUE((response.displacement / scale).isApprox(expected.displacement, 1e-9)) << power;
    }
  }
}

TEST(StiffContact, AgainstAnExponentialLawIsSolvedAtAnyLoad) {
  for (const double scale : {1e15, 1e145, 1e295}) {
    SCOPED_TRACE(scale);
    LinearStructure bar = testing::jl14_case_1.structure();
    bar.load *= scale;
    CondensedProblem problem = testing::fourier_problem(bar, 63, 256, 150.0);
    const PeriodicResponse response = testing::solved_response(problem, testing::jl14_case_1.law);
    EXPECT_TRUE(response.displacement.allFinite() && response.contact_force.allFinite());
    // Beside such a load the law is rigid and the gap nothing.
    const double size = problem.linear_response().maxCoeff();
    EXPECT_LE(response.displacement.maxCoeff(), 1e-2 * size);
    EXPECT_GT(response.contact_force.mean(), 0.04 * bar.load.maxCoeff());
  }
}

TEST(StiffContact, OfALawWithoutASlopeAtItsGapIsSolvedByNewton) {
  struct Rubber {
    double force(double u) const { return u > 1e-3 ? 3e13 * (u - 1e-3) * (u - 1e-3) : 0.0; }
    double tangent(double u) const { return u > 1e-3 ? 6e13 * (u - 1e-3) : 0.0; }
    double potential(double u) const { return u > 1e-3 ? 1e13 * std::pow(u - 1e-3, 3) : 0.0; }
    double gap() const { return 1e-3; }
  };
  CondensedProblem problem = bar_problem();
  const PeriodicResponse response = forced_response(problem, Rubber{}, {});
  EXPECT_EQ(response.strategy, Strategy::newton);
  expect_solution(problem, Rubber{}, response);
}

}  // namespace
}  // namespace wavebalance::solvers
