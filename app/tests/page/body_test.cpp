#include "wavebalance/app/page/body.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace wavebalance::app {
namespace {

/// A shell of 10 m by 4 m with a beam at its corner, of which the last point moves by `largest` m. Point 1
/// belongs to nothing.
MovingBody plate(double largest) {
  MovingBody body;
  body.label = "mode 1";
  body.points.resize(3, 5);
  body.points << 0, 5, 10, 10, 0, 0, 5, 0, 4, 4, 0, 5, 0, 0, 0;
  body.surface = {{0, 2, 3}, {3, 4}};
  body.frames.assign(2, Eigen::Matrix3Xd::Zero(3, 5));
  body.frames[0].col(4) << 0.0, 0.0, largest;
  return body;
}

TEST(MovingBodies, HaveThePointsThatAreSeenAlone) {
  const std::string script = body_script("motion", plate(0.5));
  const auto begin = script.find("] = ") + 4;
  const auto data = nlohmann::json::parse(script.substr(begin, script.rfind(';') - begin));
  EXPECT_EQ(data["label"], "mode 1");
  EXPECT_EQ(data["triangles"], (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(data["segments"], (std::vector<int>{2, 3}));
  ASSERT_EQ(data["points"].size(), 12u);
  EXPECT_NEAR(data["points"][3].get<int>() * data["length"].get<double>(), 10.0, 1e-3);
  EXPECT_NEAR(data["frames"][0][11].get<int>() * data["unit"].get<double>(), 0.5, 1e-3);
  EXPECT_EQ(data["frames"][1][11], 0);
}

TEST(MovingBodies, AreDrawnLargerByARoundNumberWhereTheyMoveLittle) {
  EXPECT_EQ(exaggeration(plate(0.0)), 1.0);
  EXPECT_EQ(exaggeration(plate(0.6)), 1.0);  // 1 m is a tenth of the body
  EXPECT_EQ(exaggeration(plate(0.4)), 2.0);
  EXPECT_EQ(exaggeration(plate(0.19)), 5.0);
  EXPECT_EQ(exaggeration(plate(0.011)), 50.0);
  EXPECT_EQ(exaggeration(plate(0.0009)), 1000.0);
}

}  // namespace
}  // namespace wavebalance::app
