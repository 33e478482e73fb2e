#include <gtest/gtest.h>

#include "tolerance_scenes.hpp"
#include "wavebalance/app/analysis/measures.hpp"

namespace wavebalance::tolerance {
namespace {

// README.md claims a true error of at most 0.34 times the tolerance for these motions.
constexpr double largest_share = 0.4;

class Tolerance : public testing::TestWithParam<Motion> {};

// The finer tolerances are for `make bench`, where the cost is measured too.
TEST_P(Tolerance, IsMetByTheTrueErrorWhichTheEstimateExceeds) {
  const Motion& motion = GetParam();
  const Eigen::VectorXd exact = reference(scene(motion, WAVEBALANCE_SCENES, 1.0, 2048), 511);
  for (const double tolerance : {1e-1, 1e-2, 1e-3, 1e-4}) {
    const app::Response response =
        app::weighted_residual_response(scene(motion, WAVEBALANCE_SCENES, tolerance, 2048));
    ASSERT_TRUE(response.refinement.has_value());
    ASSERT_TRUE(response.converged) << response.status << " at " << tolerance;
    EXPECT_LE(response.refinement->estimated_error, tolerance);
    const double error = app::relative_rms_error(response.displacement(), exact);
    EXPECT_LE(error, largest_share * tolerance) << "estimated " << response.refinement->estimated_error;
    // The reference of the motion without shooting is good to 4e-6.
    EXPECT_LE(error, response.refinement->estimated_error + 5e-6) << "at tolerance " << tolerance;
  }
}

INSTANTIATE_TEST_SUITE_P(Motions, Tolerance, testing::ValuesIn(motions()),
                         [](const testing::TestParamInfo<Motion>& one) {
                           return std::string(one.param.name);
                         });

TEST(Tolerance, IsMetWhereOneOrTwoPointsOfTheFirstProblemsTouch) {
  const Motion grazing{"grazing",
                       "linear_stop.toml",
                       {"structure.stiffness_damping=1.1725e-5", "forcing.frequency=389.954",
                        "contact.gap=1.52607e-3", "contact.stiffness=6.11416e10"}};
  const Eigen::VectorXd exact = reference(scene(grazing, WAVEBALANCE_SCENES, 1.0, 2048), 511);
  for (const double tolerance : {1e-2, 1e-3, 1e-4}) {
    const app::Response response =
        app::weighted_residual_response(scene(grazing, WAVEBALANCE_SCENES, tolerance, 2048));
    ASSERT_TRUE(response.converged) << response.status;
    EXPECT_LE(app::relative_rms_error(response.displacement(), exact), tolerance);
  }
}

TEST(Tolerance, IsMetWithPairsOfTheUsersOwn) {
  Motion motion = motions().front();
  const Eigen::VectorXd exact = reference(scene(motion, WAVEBALANCE_SCENES, 1.0, 2048), 511);
  for (const auto& [trial, weight, tolerance] : {std::tuple{"bspline", "bspline", 1e-4},
                                                 {"daubechies6", "daubechies6", 1e-3},
                                                 {"haar", "fourier", 3e-2}}) {
    motion.changes = {std::string("time.trial=") + trial, std::string("time.weight=") + weight};
    const app::Response response =
        app::weighted_residual_response(scene(motion, WAVEBALANCE_SCENES, tolerance, 2048));
    ASSERT_TRUE(response.converged) << trial << ":" << weight << " " << response.status;
    EXPECT_EQ(response.refinement->trial, trial);
    const double error = app::relative_rms_error(response.displacement(), exact);
    EXPECT_LE(error, tolerance) << trial << ":" << weight;
  }
}

}  // namespace
}  // namespace wavebalance::tolerance
