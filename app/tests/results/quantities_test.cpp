#include "results/quantities.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <utility>

#include "support/bar_scene.hpp"
#include "support/curve_record.hpp"

namespace wavebalance::app {
namespace {

/// Units as they end the names of files and columns.
std::string_view unit_in(std::string_view name) {
  constexpr std::pair<std::string_view, std::string_view> ends[] = {
      {"_m", "m"}, {"_N", "N"}, {"_J", "J"}, {"_Hz", "Hz"}, {"_m_per_s2", "m/s^2"}, {"_seconds", "s"}};
  for (const auto& [end, unit] : ends)
    if (name.ends_with(end)) return unit;
  return "";
}

TEST(Quantities, EntriesOfRecordsCarryTheUnitThatTheirNamesSay) {
  const std::vector<Record> records{analyse(scene_of()), analyse(stop_with({"analysis.stability=true"})),
                                    analyse(load_with({})),
                                    analyse(scene_of({"analysis.type=time_stepping"}))};
  for (const Record& record : records)
    for (const Entry& one : record.summary) {
      if (!one.scalar()) continue;
      EXPECT_EQ(one.unit, unit_in(one.name)) << one.name;
    }
}

TEST(Quantities, WhatIsMeasuredOfAMotionIsAResultAndItsEffortIsNot) {
  const Record record = analyse(scene_of());
  const auto kind_of = [&](const Quantity& quantity) {
    return find_entry(record.summary, quantity.name)->kind;
  };
  EXPECT_EQ(kind_of(quantities::max_displacement), EntryKind::result);
  EXPECT_EQ(kind_of(quantities::contact_fraction), EntryKind::result);
  EXPECT_EQ(kind_of(quantities::residual), EntryKind::diagnostic);
  EXPECT_EQ(kind_of(quantities::frequency), EntryKind::setting);
  EXPECT_EQ(kind_of(quantities::wall_seconds), EntryKind::heading);
}

TEST(Quantities, WhatARecordHasWordsForIsFoundByItsColumn) {
  const auto file = std::filesystem::path(WAVEBALANCE_SCENES) / "friction" / "slider.toml";
  const std::vector<Record> records{
      analyse(load_scene(file, std::vector<std::string>{"contact.wear_coefficient=1e-14"})),
      analyse(load_with({}))};
  for (const Record& record : records)
    for (const Entry& one : record.summary) {
      if (one.words.empty()) continue;
      const Quantity* found = quantities::find_in_words(one.name);
      ASSERT_NE(found, nullptr) << one.name;
      EXPECT_EQ(found->words, one.words);
    }
  EXPECT_NE(find_entry(records[0].summary, quantities::wear.name), nullptr);
}

TEST(Quantities, AColumnHasItsWordsAndItsUnit) {
  const Quantity* force = quantities::find_in_words("max_contact_force_N");
  ASSERT_NE(force, nullptr);
  EXPECT_EQ(force->words, "max contact force");
  EXPECT_EQ(force->unit, "N");
  EXPECT_EQ(quantities::find_in_words("residual"), nullptr);
}

}  // namespace
}  // namespace wavebalance::app
