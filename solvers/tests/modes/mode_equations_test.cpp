#include "modes/mode_equations.hpp"

#include "support/duffing_spring.hpp"
#include "support/small_problems.hpp"
#include "testing.hpp"

namespace wavebalance::solvers {
namespace {

TEST(ModeEquations, JacobianIsTheDerivativeOfTheResidual) {
  ModeProblem problem;
  problem.model = {Eigen::Vector3d(1.0, 5.0, 11.0), Eigen::MatrixXd{{0.8, -0.5, 0.3}, {0.4, 0.9, -0.2}},
                   Eigen::Vector2d(1.0, 1.5)};
  problem.transform = make_pair_transform(testing::fourier_pair(7, 32), false);
  problem.laws = testing::DuffingSpring{.cubic = 0.3, .start = 0.0};
  problem.amplitude = 1.3;
  problem.unit = 0.7;
  for (const bool force_form : {false, true}) {
    problem.flexibility = force_form ? Eigen::VectorXd(Eigen::Vector2d(0.02, 0.03)) : Eigen::VectorXd();
    ModeEquations equations(problem);
    std::mt19937 generator(12);
    Eigen::VectorXd y = testing::random_vector(problem.size(), generator);
    y[y.size() - 1] = 1.17;
    equations.evaluate(y);
    const Eigen::MatrixXd jacobian = equations.jacobian();
    const double step = 1e-6;
    for (Eigen::Index i = 0; i < y.size(); ++i) {
      Eigen::VectorXd moved = y;
      moved[i] += step;
      equations.evaluate(moved);
      const Eigen::VectorXd up = equations.residual();
      moved[i] -= 2.0 * step;
      equations.evaluate(moved);
      const Eigen::VectorXd slope = (up - equations.residual()) / (2.0 * step);
      EXPECT_LT((slope - jacobian.col(i)).norm(), 1e-7 * jacobian.norm()) << i;
    }
  }
}

}  // namespace
}  // namespace wavebalance::solvers
