// A frequency that is set is not condensed again, and nothing else is forgotten by that.
#include <gtest/gtest.h>

#include "support/oscillator.hpp"
#include "support/small_problems.hpp"
#include "wavebalance/solvers/balance/contact_operator.hpp"

namespace wavebalance::solvers {
namespace {

CondensedProblem unit_problem(double damping) {
  return testing::fourier_problem(testing::unit_oscillator(damping, 1.0), 7, 16);
}

TEST(RepeatedFrequency, HasTheFreeResponseOfAProblemSetOnce) {
  CondensedProblem once = unit_problem(0.1), twice = unit_problem(0.1);
  twice.set_frequency(0.3);
  twice.set_load_scale(2.0);
  twice.set_frequency(0.3);
  once.set_load_scale(2.0);
  once.set_frequency(0.3);
  EXPECT_EQ(twice.linear_response(), once.linear_response());
  const Eigen::VectorXd force = Eigen::VectorXd::LinSpaced(16, -1.0, 2.0);
  Eigen::VectorXd of_once(16), of_twice(16);
  once.apply(force, of_once);
  twice.apply(force, of_twice);
  EXPECT_EQ(of_twice, of_once);
}

TEST(RepeatedFrequency, IsFollowedByTheOperatorOfAForm) {
  const Eigen::VectorXd form = Eigen::VectorXd::Constant(1, 1e-3),
                        force = Eigen::VectorXd::LinSpaced(16, -1.0, 2.0);
  CondensedProblem problem = unit_problem(0.1);
  problem.set_frequency(0.3);
  ContactOperator followed(problem, form);
  Eigen::VectorXd before, there, back, expected;
  followed.apply(force, before);
  const Eigen::MatrixXd columns = followed.columns();
  problem.set_frequency(0.4);
  followed.apply(force, there);
  ContactOperator(problem, form).apply(force, expected);
  EXPECT_EQ(there, expected);
  EXPECT_NE(followed.columns(), columns);
  problem.set_frequency(0.3);
  followed.apply(force, back);
  EXPECT_EQ(back, before);
  EXPECT_EQ(followed.columns(), columns);
}

TEST(RepeatedFrequency, ThatHasNoCondensationThrowsEachTime) {
  LinearStructure undamped = testing::unit_oscillator(0.0, 1.0);
  undamped.stiffness.coeffRef(0, 0) = 0.0;  // singular at harmonic 0
  CondensedProblem problem = testing::fourier_problem(undamped, 7, 16);
  EXPECT_THROW(problem.set_frequency(0.3), SingularSystem);
  EXPECT_THROW(problem.set_frequency(0.3), SingularSystem);
}

}  // namespace
}  // namespace wavebalance::solvers
