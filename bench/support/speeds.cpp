#include "speeds.hpp"

#include <algorithm>
#include <sstream>

namespace wavebalance::bench {
namespace {

constexpr auto name_column = "benchmark", speed_column = "speed";

double loss(const std::string& name, const Speeds& before, const Speeds& now) {
  return before.at(name) / now.at(name);
}

}  // namespace

Speeds speeds_of(const app::Table& table) {
  const std::vector<std::string> names = table.texts(name_column);
  const std::vector<double> values = table.numbers(speed_column);
  Speeds speeds;
  for (std::size_t i = 0; i < names.size(); ++i) speeds[names[i]] = values[i];
  return speeds;
}

app::Table table_of(const Speeds& speeds) {
  app::Table table({name_column, speed_column});
  for (const auto& [name, speed] : speeds) table.append_row({name, speed});
  return table;
}

SpeedComparison compare_speeds(const Speeds& before, const Speeds& now, double noise) {
  SpeedComparison result;
  for (const auto& [name, speed] : before) {
    if (!now.contains(name)) {
      result.missing.push_back(name);
      continue;
    }
    ++result.compared;
    if (speed > noise * now.at(name)) result.fell.push_back(name);
  }
  std::stable_sort(result.fell.begin(), result.fell.end(), [&](const std::string& a, const std::string& b) {
    return loss(a, before, now) > loss(b, before, now);
  });
  return result;
}

std::string report(const Speeds& before, const Speeds& now, double noise) {
  const SpeedComparison found = compare_speeds(before, now, noise);
  std::ostringstream text;
  text.precision(3);
  text << found.compared << " benchmarks compared with the last release, " << found.fell.size()
       << " slower by more than a factor of " << noise << "\n";
  for (const std::string& name : found.fell)
    text << "  " << name << ": " << loss(name, before, now) << " times the time\n";
  for (const std::string& name : found.missing) text << "  " << name << ": not in this run\n";
  return text.str();
}

}  // namespace wavebalance::bench
