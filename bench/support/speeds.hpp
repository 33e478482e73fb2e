#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "wavebalance/app/files/table.hpp"

namespace wavebalance::bench {

/// The speed of each benchmark of a run: the time of the run's yardstick over the benchmark's time. The
/// yardstick calls libraries only, so that the speeds of two runs can be compared, also on two machines.
using Speeds = std::map<std::string, double>;

/// A table of columns benchmark and speed. Throws std::out_of_range for a column that is missing.
Speeds speeds_of(const app::Table& table);
app::Table table_of(const Speeds& speeds);

/// Two runs of the same benchmarks.
struct SpeedComparison {
  std::vector<std::string> fell;     ///< slower by more than the noise, the largest loss first
  std::vector<std::string> missing;  ///< only in the first run
  std::size_t compared = 0;          ///< in both
};

/// A benchmark fell if its speed was more than `noise` times as high before.
SpeedComparison compare_speeds(const Speeds& before, const Speeds& now, double noise);

/// Text for the terminal: how many were compared, which fell and by how much, which are missing.
std::string report(const Speeds& before, const Speeds& now, double noise);

}  // namespace wavebalance::bench
