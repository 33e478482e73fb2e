#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>

#include "family.hpp"

namespace {

using namespace wavebalance::extremes;

const std::filesystem::path scenes = EXTREMES_SCENES;

std::vector<std::string> groups() {
  std::vector<std::string> names;
  for (const Case& item : family(scenes))
    if (std::find(names.begin(), names.end(), item.group) == names.end()) names.push_back(item.group);
  return names;
}

class Extremes : public ::testing::TestWithParam<std::string> {};

TEST_P(Extremes, SolveWithCheckedResidualsOrSayWhatIsWrong) {
  for (const Case& item : family(scenes)) {
    if (item.group != GetParam()) continue;
    std::string input = item.scene;
    for (const auto& one : item.overrides) input += " --set " + one;
    const Verdict verdict = judge(item, scenes);
    EXPECT_EQ(to_string(verdict.outcome), to_string(item.must))
        << input << "\n"
        << verdict.text << "\nmotion " << verdict.residuals.motion << ", complementarity "
        << verdict.residuals.complementarity;
    EXPECT_NE(verdict.text.find(item.named), std::string::npos) << input << "\n" << verdict.text;
    EXPECT_LE(verdict.seconds, most_seconds) << input;
  }
}

std::string identifier(const ::testing::TestParamInfo<std::string>& group) {
  std::string name = group.param;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(All, Extremes, ::testing::ValuesIn(groups()), identifier);

TEST(Units, DoNotChangeTheMotion) { EXPECT_LE(difference_between_units(scenes), 1e-9); }

}  // namespace
