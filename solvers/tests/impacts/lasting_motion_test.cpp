// Contacts that stay closed after impacts without rebound.

#include "collocation/exact_solution_parts.hpp"
#include "flow/flow_start.hpp"
#include "linalg/dense.hpp"
#include "support/impact_scenes.hpp"
#include "testing.hpp"
#include "wavebalance/solvers/impacts/impact_response.hpp"

namespace wavebalance::solvers {
namespace {

using testing::ImpactScene, testing::lumped_bar, testing::Obstacle;

TEST(LastingContactTest, HasTheMultipliersOfDifferencesOfItsMotions) {
  const ImpactScene scene = lumped_bar(6, 0.0, 0.02, 0.5, 0.0, 0.7);
  const ContactDynamics dynamics(scene.structure());
  const ImpactResponse found = impact_response(scene.problem(dynamics));
  ASSERT_TRUE(found.motion.converged()) << to_string(found.motion.status);
  const PeriodStart start = *found.motion.parts->start;
  ContactFlow flow(
      detail::begun_at({dynamics, ContactLaws(Obstacle{0.5, 0.0}), scene.problem(dynamics).linear_motion,
                        scene.problem(dynamics).frequency},
                       start.begin),
      {.tolerance = 1e-12});
  constexpr double change = 1e-6;
  const auto after = [&](Eigen::VectorXd state) {
    flow.start(state, start.contacts);
    EXPECT_EQ(flow.advance_period(), FlowStatus::converged);
    return flow.state();
  };
  Eigen::MatrixXd monodromy(start.state.size(), start.state.size());
  for (Eigen::Index i = 0; i < start.state.size(); ++i) {
    const Eigen::VectorXd step = change * Eigen::VectorXd::Unit(start.state.size(), i);
    monodromy.col(i) = (after(start.state + step) - after(start.state - step)) / (2.0 * change);
  }
  Eigen::VectorXcd expected = detail::eigenvalues(monodromy);
  std::ranges::stable_sort(
      expected, [](std::complex<double> a, std::complex<double> b) { return std::abs(a) > std::abs(b); });
  for (Eigen::Index i = 0; i < 3; ++i)
    EXPECT_NEAR(std::abs(expected[i]), std::abs(found.multipliers[i]), 1e-6);
}

}  // namespace
}  // namespace wavebalance::solvers
