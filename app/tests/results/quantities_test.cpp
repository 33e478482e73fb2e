#include <gtest/gtest.h>

#include <string_view>
#include <utility>

#include "support/bar_scene.hpp"
#include "support/scene_texts.hpp"
#include "support/stop_scene.hpp"
#include "wavebalance/app/results/record.hpp"

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
  const std::string over_amplitude =
      with(stop_scene, "frequency_sweep\"\nfrequency_from = 0.13\nfrequency_to = 0.25",
           "amplitude_sweep\"\namplitude_from = 0.05\namplitude_to = 0.5");
  const std::vector<Record> records{
      analyse(scene_of()),
      analyse(parse_scene(stop_scene, "stop.toml", std::vector<std::string>{"analysis.stability=true"})),
      analyse(parse_scene(over_amplitude, "load.toml")), analyse(scene_of({"analysis.type=time_stepping"}))};
  for (const Record& record : records)
    for (const Entry& one : record.summary) {
      if (!one.scalar()) continue;
      EXPECT_EQ(one.unit, unit_in(one.name)) << one.name;
    }
}

}  // namespace
}  // namespace wavebalance::app
