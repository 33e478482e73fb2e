// What tests of motions along a curve share: the oscillator with a stop, and files of its record.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "support/stop_scene.hpp"
#include "temporary_folder.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"
#include "wavebalance/app/files/table.hpp"
#include "wavebalance/app/results/record.hpp"

namespace wavebalance::app {

inline Scene stop_with(const std::vector<std::string>& overrides) {
  return parse_scene(stop_scene, "stop.toml", overrides);
}

/// The same from 0.05 to 0.5 N at 0.18 Hz.
inline std::string over_amplitude(const std::string& scene) {
  const auto begin = scene.find("type = \"frequency_sweep\"");
  return scene.substr(0, begin) + "type = \"amplitude_sweep\"\namplitude_from = 0.05\namplitude_to = 0.5\n";
}

inline Scene load_with(const std::vector<std::string>& overrides) {
  return parse_scene(over_amplitude(stop_scene), "load.toml", overrides);
}

inline const RecordFile* file_of(const Record& record, const std::string& name) {
  const auto found = std::find_if(record.files.begin(), record.files.end(),
                                  [&](const RecordFile& file) { return file.name == name; });
  return found == record.files.end() ? nullptr : &*found;
}

inline StartMotion start_of(const Record& record, const std::string& name) {
  const TemporaryFolder folder;
  const RecordFile* file = file_of(record, name);
  return file == nullptr ? StartMotion{} : read_start_motion(folder.write(name, file->contents));
}

}  // namespace wavebalance::app
