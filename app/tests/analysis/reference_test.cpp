// The two cases of Jones & Legrand 2014 from their scene files against independently computed figures.
#include <gtest/gtest.h>

#include <algorithm>

#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/analysis/sweep.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"

namespace {

using namespace wavebalance::app;

Scene jones_legrand(const std::string& name, std::vector<std::string> overrides = {}) {
  return load_scene(std::string(WAVEBALANCE_SCENES) + "/jones_legrand_2014/" + name + ".toml", overrides);
}

struct Reference {
  const char* scene;
  double max, max_abs, rms, force_ratio, contact_fraction;
};

class CaseOfJonesLegrand : public testing::TestWithParam<Reference> {};

TEST_P(CaseOfJonesLegrand, ShootingMeetsTheReference) {
  const Reference& expected = GetParam();
  const Scene scene = jones_legrand(expected.scene, {"analysis.output_points=65536"});
  const Response response = phases_response(scene);
  ASSERT_TRUE(response.converged) << response.status;
  const Eigen::VectorXd u = response.displacement();
  // The listed values have seven digits.
  EXPECT_NEAR(u.maxCoeff(), expected.max, 1e-6 * expected.max);
  EXPECT_NEAR(u.cwiseAbs().maxCoeff(), expected.max_abs, 1e-6 * expected.max_abs);
  EXPECT_NEAR(rms(u), expected.rms, 1e-6 * expected.rms);
  EXPECT_NEAR(response.force().maxCoeff() / 250e3, expected.force_ratio, 2e-4 * expected.force_ratio);
  // The reference counted samples; a grid of 4096 points resolves the fraction to one of them.
  EXPECT_NEAR(contact_fraction(response.contacts), expected.contact_fraction, 1.0 / 4096);
}

INSTANTIATE_TEST_SUITE_P(
    Cases, CaseOfJonesLegrand,
    testing::Values(Reference{"case1", 1.014506e-3, 1.438608e-3, 0.9316321e-3, 0.2902, 0.2396},
                    Reference{"case2", 15.20671e-3, 16.26369e-3, 11.47116e-3, 5.694, 0.1069}),
    [](const auto& one) { return std::string(one.param.scene); });

TEST(SweepOfJonesLegrand, TurnsWhereTheReferenceTurns) {
  const Sweep sweep =
      frequency_sweep(jones_legrand("case2_sweep", {"time.functions=63", "time.quadrature_points=1024"}));
  ASSERT_TRUE(sweep.converged()) << to_string(sweep.curve.status);
  ASSERT_EQ(sweep.curve.turning_points.size(), 2u);
  EXPECT_NEAR(sweep.curve.turning_points[0].frequency, 1337.748, 0.1);
  EXPECT_NEAR(sweep.curve.turning_points[1].frequency, 1315.067, 0.1);
}

}  // namespace
