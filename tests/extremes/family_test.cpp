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
    const CheckResult result = check_residuals(item, scenes);
    EXPECT_TRUE(led_to_what_it_must(item, result))
        << input << "\nmust be " << to_string(item.must) << ": " << item.named << "\nis "
        << to_string(result.outcome) << ": " << result.text << "\nmotion " << result.residuals.motion
        << ", complementarity " << result.residuals.complementarity;
  }
}

std::string identifier(const ::testing::TestParamInfo<std::string>& group) {
  std::string name = group.param;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(All, Extremes, ::testing::ValuesIn(groups()), identifier);

TEST(FamilyRow, OfASolvedInputHoldsOnlyWithoutAViolatedCondition) {
  const Case solved{"group", "bar.toml", {}, Outcome::solved, ""};
  EXPECT_TRUE(led_to_what_it_must(solved, {Outcome::solved, "", {}, 0.0}));
  EXPECT_FALSE(led_to_what_it_must(solved, {Outcome::solved, "samples that are not finite", {}, 0.0}));
  EXPECT_FALSE(led_to_what_it_must(solved, {Outcome::not_converged, "", {}, 0.0}));
  EXPECT_FALSE(led_to_what_it_must(solved, {Outcome::wrong, "", {}, 0.0}));
}

TEST(FamilyRow, OfAnErrorNeedsTheWordsThatTheErrorMustHold) {
  const Case error{"group", "bar.toml", {}, Outcome::error, "contact.gap"};
  EXPECT_TRUE(led_to_what_it_must(error, {Outcome::error, "contact.gap = 1: ...", {}, 0.0}));
  EXPECT_FALSE(led_to_what_it_must(error, {Outcome::error, "something else", {}, 0.0}));
  const Case nameless{"group", "bar.toml", {}, Outcome::error, ""};
  EXPECT_THROW(led_to_what_it_must(nameless, {Outcome::error, "anything", {}, 0.0}), std::invalid_argument);
}

TEST(FamilyRow, ThatMayBeSolvedHoldsEitherWayButNeverWithAWrongMotion) {
  const Case either{"group", "bar.toml", {}, Outcome::not_converged, "stalled", true};
  EXPECT_TRUE(led_to_what_it_must(either, {Outcome::solved, "", {}, 0.0}));
  EXPECT_TRUE(led_to_what_it_must(either, {Outcome::not_converged, "stalled", {}, 0.0}));
  EXPECT_FALSE(led_to_what_it_must(either, {Outcome::not_converged, "singular", {}, 0.0}));
  EXPECT_FALSE(led_to_what_it_must(either, {Outcome::wrong, "", {}, 0.0}));
}

TEST(Units, DoNotChangeTheMotion) { EXPECT_LE(difference_between_units(scenes), 1e-9); }

}  // namespace
