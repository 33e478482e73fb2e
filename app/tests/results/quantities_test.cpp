#include <gtest/gtest.h>

#include <string_view>
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

}  // namespace
}  // namespace wavebalance::app
