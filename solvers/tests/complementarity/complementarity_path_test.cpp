#include "complementarity/complementarity_path.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "complementarity/lcp_homotopy.hpp"
#include "support/small_problems.hpp"

namespace wavebalance::solvers {
namespace {

using End = ComplementarityPath::End;

CondensedProblem small_problem(int contacts, int functions, int points) {
  std::mt19937 generator(4);
  LinearStructure chain = testing::random_chain(5, generator);
  chain.contact_dofs = std::vector<int>{4, 1};
  chain.contact_dofs.resize(static_cast<std::size_t>(contacts));
  CondensedProblem problem(testing::fourier_pair(functions, points), chain, testing::cosine_load());
  problem.set_frequency(0.05);
  return problem;
}

// How far force and distance are from complementary, over their largest.
double violation(CondensedProblem& problem, const Obstacles& obstacles, const Eigen::VectorXd& force) {
  Eigen::VectorXd distance;
  problem.apply(force, distance);
  distance += obstacles.gap_without_force + obstacles.flexibility.cwiseProduct(force);
  const double largest_force = force.cwiseAbs().maxCoeff(),
               largest_distance = obstacles.gap_without_force.cwiseAbs().maxCoeff();
  const double signs = std::max(-force.minCoeff() / largest_force, -distance.minCoeff() / largest_distance);
  return std::max(signs,
                  force.cwiseProduct(distance).cwiseAbs().maxCoeff() / (largest_force * largest_distance));
}

// Every solution of the complementarity problem, by all active sets.
std::vector<Eigen::VectorXd> all_solutions(CondensedProblem& problem, const Obstacles& obstacles) {
  const Eigen::MatrixXd matrix =
      testing::compliance_matrix(problem) + Eigen::MatrixXd(obstacles.flexibility.asDiagonal());
  const auto samples = static_cast<int>(obstacles.gap_without_force.size());
  std::vector<Eigen::VectorXd> found;
  for (unsigned set = 0; set < 1u << samples; ++set) {
    std::vector<int> active;
    for (int l = 0; l < samples; ++l)
      if ((set >> l & 1u) != 0) active.push_back(l);
    Eigen::VectorXd force = Eigen::VectorXd::Zero(samples);
    if (!active.empty())
      force(active) =
          -Eigen::MatrixXd(matrix(active, active)).partialPivLu().solve(obstacles.gap_without_force(active));
    if (force.minCoeff() >= 0.0 && (obstacles.gap_without_force + matrix * force).minCoeff() >= -1e-12)
      found.push_back(force);
  }
  return found;
}

class SmallObstacles : public ::testing::TestWithParam<double> {};

TEST_P(SmallObstacles, ThePathEndsAtOneOfTheSolutionsOfAllActiveSets) {
  int with_contact = 0;
  for (const int contacts : {1, 2}) {
    CondensedProblem problem = small_problem(contacts, 5, contacts == 1 ? 12 : 6);
    const Eigen::VectorXd& free = problem.contact_free_response();
    const double size = free.cwiseAbs().maxCoeff(), stiffness = GetParam();
    const double compliance = problem.columns().cwiseAbs().maxCoeff();
    for (const double gap : {0.7, 0.2, 0.0, -0.3, -2.0}) {
      const Obstacles obstacles{Eigen::VectorXd::Constant(free.size(), gap * size) - free,
                                Eigen::VectorXd::Constant(free.size(), compliance / stiffness)};
      LcpHomotopy path(problem, {}, {});
      const std::vector<Eigen::VectorXd> solutions = all_solutions(problem, obstacles);
      ASSERT_EQ(path.solve(obstacles), !solutions.empty()) << gap;
      double nearest = std::numeric_limits<double>::infinity();
      for (const auto& solution : solutions)
        nearest = std::min(nearest, (path.force() - solution).norm() / (1.0 + solution.norm()));
      EXPECT_LE(nearest, 1e-9) << contacts << " contacts, gap " << gap << " of " << solutions.size();
      with_contact += path.force().maxCoeff() > 0.0 ? 1 : 0;
    }
  }
  EXPECT_GE(with_contact, 8);
}

INSTANTIATE_TEST_SUITE_P(Stiffness, SmallObstacles, ::testing::Values(0.1, 1.0, 30.0, 1e4));

TEST(ComplementarityPath, FollowsObstaclesToOtherPlacesAndStiffnesses) {
  CondensedProblem problem = small_problem(2, 15, 32);
  const Eigen::VectorXd& free = problem.contact_free_response();
  const double size = free.cwiseAbs().maxCoeff(), compliance = problem.columns().cwiseAbs().maxCoeff();
  const auto obstacles = [&](double gap, double stiffness) -> Obstacles {
    return {Eigen::VectorXd::Constant(64, gap * size) - free,
            Eigen::VectorXd::Constant(64, compliance / stiffness)};
  };
  ComplementarityPath path(problem);
  ASSERT_EQ(path.lower(obstacles(0.4, 1.0), Eigen::VectorXd::Ones(64)), End::reached);
  EXPECT_LE(violation(problem, obstacles(0.4, 1.0), path.force()), 1e-13);
  for (const auto& [gap, stiffness] :
       {std::pair{0.4, 3.0}, {-0.1, 3.0}, {0.5, 0.5}, {2.0, 0.5}, {0.1, 1.0}}) {
    ASSERT_EQ(path.follow(obstacles(gap, stiffness)), End::reached) << gap << " " << stiffness;
    EXPECT_TRUE(gap > 1.0 ? path.force().isZero(0.0)
                          : violation(problem, obstacles(gap, stiffness), path.force()) <= 1e-13)
        << gap << " " << stiffness;
  }
}

TEST(ComplementarityPath, EndsAtItsLimitsWithTheirStatus) {
  CondensedProblem problem = small_problem(1, 15, 64);
  const Eigen::VectorXd& free = problem.contact_free_response();
  const Obstacles obstacles{Eigen::VectorXd::Constant(64, 0.2 * free.maxCoeff()) - free,
                            Eigen::VectorXd::Constant(64, problem.columns().maxCoeff())};
  const Eigen::VectorXd even = Eigen::VectorXd::Ones(64);
  ComplementarityPath path(problem);
  path.set_max_segment(3);
  EXPECT_EQ(path.lower(obstacles, even), End::effort_limit);
  path.set_max_segment(1000);
  int told = 0;
  path.set_observer([&](double z) {
    EXPECT_TRUE(z >= 0.0 && std::isfinite(z));
    return ++told < 4;
  });
  EXPECT_EQ(path.lower(obstacles, even), End::cancelled);
  EXPECT_EQ(told, 4);
  path.set_observer({});
  path.limit_operations(1.0);
  EXPECT_EQ(path.lower(obstacles, even), End::effort_limit);
  EXPECT_FALSE(path.has_operations_left());
  const Obstacles away{Eigen::VectorXd::Constant(64, 2.0 * free.maxCoeff()) - free, obstacles.flexibility};
  EXPECT_EQ(path.lower(away, even), End::reached);
  EXPECT_TRUE(path.force().isZero(0.0));
}

}  // namespace
}  // namespace wavebalance::solvers
