#include "wavebalance/solvers/period/first_order_system.hpp"

#include "support/jl14_bar.hpp"
#include "testing.hpp"

namespace wavebalance::solvers {
namespace {

using testing::jl14_bar;
using testing::jl14_case_1;

// In contact and out of it.
TEST(FirstOrderSystem, JacobianIsThatOfDifferences) {
  const LinearStructure bar = jl14_bar(4, 1e-4);
  const FirstOrderSystem system(bar, jl14_case_1.law, jl14_case_1.frequency_hz);
  for (const double depth : {-4e-4, 1e-5, 2e-3}) {
    Eigen::Vector4d displacement(1e-3, -7e-4, 3e-4, jl14_case_1.law.start + depth);
    const Eigen::VectorXd state = system.state(displacement, Eigen::Vector4d(0.4, -0.2, 0.7, 1.3));
    const auto rate = [&](Eigen::VectorXd at) {
      Eigen::VectorXd result(8);
      system.derivative(0.37, {at.data(), 8}, {result.data(), 8});
      return result;
    };
    Eigen::VectorXd by_time(8);
    Eigen::Matrix<double, 8, 8, Eigen::RowMajor> by_state;
    system.jacobian(0.37, {state.data(), 8}, {by_state.data(), 64}, {by_time.data(), 8});
    for (int i = 0; i < 8; ++i) {
      const Eigen::VectorXd step = 1e-6 * Eigen::VectorXd::Unit(8, i);
      const Eigen::VectorXd difference = (rate(state + step) - rate(state - step)) / 2e-6;
      EXPECT_LT((by_state.col(i) - difference).norm(), 1e-6 * by_state.norm()) << depth << ' ' << i;
    }
  }
}

TEST(FirstOrderSystem, TimeDerivativeIsThatOfTheLoad) {
  const FirstOrderSystem system(jl14_bar(3, 1e-4), jl14_case_1.law, jl14_case_1.frequency_hz);
  const Eigen::VectorXd state = Eigen::VectorXd::LinSpaced(6, -0.3, 0.4);
  Eigen::VectorXd before(6), after(6), by_time(6);
  Eigen::MatrixXd by_state(6, 6);
  const double step = 1e-5, periods = 0.37;
  system.derivative(periods - step, {state.data(), 6}, {before.data(), 6});
  system.derivative(periods + step, {state.data(), 6}, {after.data(), 6});
  system.jacobian(periods, {state.data(), 6}, {by_state.data(), 36}, {by_time.data(), 6});
  const Eigen::VectorXd difference = (after - before) / (2.0 * step);
  EXPECT_LT((by_time - difference).norm(), 1e-7 * by_time.norm());  // O(step^2) and cancellation
  EXPECT_GT(by_time.norm(), 0.0);
}

TEST(FirstOrderSystem, JacobianOnTheKinkTakesTheSlopeInContact) {
  const LinearStructure bar = jl14_bar(2, 1e-4);
  const FirstOrderSystem system(bar, jl14_case_1.law, jl14_case_1.frequency_hz);
  const auto jacobian = [&](double tip) {
    const Eigen::VectorXd state = system.state(Eigen::Vector2d(0.0, tip), Eigen::Vector2d::Zero());
    Eigen::VectorXd by_time(4);
    Eigen::MatrixXd by_state(4, 4);
    system.jacobian(0.0, {state.data(), 4}, {by_state.data(), 16}, {by_time.data(), 4});
    return by_state;
  };
  const Eigen::MatrixXd inside = jacobian(jl14_case_1.law.start + 1e-12),
                        outside = jacobian(jl14_case_1.law.start - 1e-12);
  const double jump = (inside - outside).norm();
  EXPECT_GT(jump, 0.0);
  EXPECT_LT((inside - jacobian(jl14_case_1.law.start + 1e-15)).norm(), 1e-9 * jump);
}

TEST(FirstOrderSystem, RejectsBadInput) {
  const LinearStructure bar = jl14_bar(3, 1e-4);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {0.0, -1.0, nan, std::numeric_limits<double>::infinity()})
    EXPECT_THROW(FirstOrderSystem(bar, jl14_case_1.law, bad), std::invalid_argument) << bad;
  LinearStructure massless = bar;
  massless.mass.coeffRef(1, 1) = 0.0;
  EXPECT_THROW(FirstOrderSystem(massless, jl14_case_1.law, jl14_case_1.frequency_hz), std::invalid_argument);
  LinearStructure misfit = bar;
  misfit.load = Eigen::VectorXd::Zero(2);
  EXPECT_THROW(FirstOrderSystem(misfit, jl14_case_1.law, jl14_case_1.frequency_hz), std::invalid_argument);
}

}  // namespace
}  // namespace wavebalance::solvers
