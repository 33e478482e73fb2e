// What the picture of speed against accuracy says of itself. No time is asserted.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "jl14_results.hpp"

namespace wavebalance::jl14 {
namespace {

TEST(Jl14Speed, ASmallerErrorNeverCostsLessAndFourierIsItsOwnMeasure) {
  results().need({"speed"});
  const Table table = results().read("speed.csv");
  std::set<std::string> scenes, bases;
  const auto error = table.numbers("error_asked"), time = table.numbers("seconds"),
             once = table.numbers("seconds_with_plans"), ratio = table.numbers("over_fourier_fourier");
  std::string stair;
  double before = 0.0, asked = 1.0;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const auto text = [&](const char* column) { return std::get<std::string>(table.at(i, column)); };
    scenes.insert(text("scene"));
    bases.insert(text("bases"));
    const std::string one = text("scene") + text("bases") + text("error_of");
    if (one != stair) before = 0.0, asked = 1.0;
    stair = one;
    EXPECT_LT(error[i], asked) << i;
    asked = error[i];
    const double seconds = time[i];
    if (std::isnan(seconds)) {
      before = std::numeric_limits<double>::infinity();
      continue;
    }
    EXPECT_GE(seconds, before) << one << asked;
    before = seconds;
    EXPECT_GE(once[i], seconds) << one << asked;
    if (text("bases") == "Fourier:Fourier") {
      EXPECT_EQ(ratio[i], 1.0) << one << asked;
    }
  }
  EXPECT_EQ(scenes.size(), 4u);
  EXPECT_EQ(bases.size(), 8u);
  EXPECT_EQ(results().record("speed").notes.size(), 5u);
}

TEST(Jl14Speed, APairThatReachesTheLargestErrorAloneIsSeenInItsPanel) {
  results().need({"speed"});
  const std::string text = app::read_file(results().folder() / "speed.figure.js");
  const std::size_t begin = text.find(" = {") + 3;
  const auto panels = nlohmann::json::parse(text.substr(begin, text.rfind(';') - begin))["panels"];
  ASSERT_EQ(panels.size(), 8u);
  for (const auto& panel : panels)
    for (const auto& stair : panel["series"]) {
      const auto& y = stair["y"];
      int seen = 0;
      for (std::size_t i = 0; i + 1 < y.size(); ++i) seen += y[i].is_number() ? 1 : 0;
      EXPECT_TRUE(seen == 0 || y.back().is_number()) << panel["title"] << stair["label"];
    }
}

}  // namespace
}  // namespace wavebalance::jl14
