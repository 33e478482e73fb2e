#include "speeds.hpp"

#include <gtest/gtest.h>

namespace wavebalance::bench {
namespace {

const Speeds release{{"point", 10.0}, {"sweep", 4.0}, {"mode", 2.0}, {"pair", 1.0}};

TEST(Speeds, NameWhatFellByMoreThanTheNoiseTheLargestLossFirst) {
  const Speeds now{{"point", 5.0}, {"sweep", 3.9}, {"mode", 0.5}, {"pair", 3.0}};
  const SpeedComparison found = compare_speeds(release, now, 1.3);
  EXPECT_EQ(found.fell, (std::vector<std::string>{"mode", "point"}));
  EXPECT_EQ(found.compared, 4u);
  EXPECT_TRUE(found.missing.empty());
}

TEST(Speeds, ThatAreEqualHaveNotFallen) {
  EXPECT_TRUE(compare_speeds(release, release, 1.0).fell.empty());
}

TEST(Speeds, OfARunWithoutABenchmarkNameIt) {
  const SpeedComparison found = compare_speeds(release, {{"point", 10.0}, {"new", 1.0}}, 1.3);
  EXPECT_EQ(found.missing, (std::vector<std::string>{"mode", "pair", "sweep"}));
  EXPECT_EQ(found.compared, 1u);
}

TEST(Speeds, AreReportedWithTheFactorOfEachLoss) {
  const std::string text = report(release, {{"point", 5.0}, {"sweep", 4.0}, {"mode", 2.0}}, 1.3);
  EXPECT_NE(text.find("3 benchmarks compared with the last release, 1 slower"), std::string::npos) << text;
  EXPECT_NE(text.find("point: 2 times the time"), std::string::npos) << text;
  EXPECT_NE(text.find("pair: not in this run"), std::string::npos) << text;
}

TEST(Speeds, ReadBackFromTheirTable) { EXPECT_EQ(speeds_of(table_of(release)), release); }

}  // namespace
}  // namespace wavebalance::bench
