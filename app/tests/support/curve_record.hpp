// What tests of motions along a curve share: the oscillator with a stop, and files of its record.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "period_oracle/shooting.hpp"
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

/// A response at 0.18 Hz, not a sweep.
inline Scene response_with(std::vector<std::string> overrides = {}) {
  Scene scene = stop_with(overrides);
  scene.analysis.type = AnalysisType::forced_response;
  return scene;
}

inline const RecordFile* file_of(const Record& record, const std::string& name) {
  const auto found = std::find_if(record.files.begin(), record.files.end(),
                                  [&](const RecordFile& file) { return file.name == name; });
  return found == record.files.end() ? nullptr : &*found;
}

/// A file of a record, read as any reader of CSV files does.
inline Table table_of(const Record& record, const std::string& name) {
  const TemporaryFolder folder;
  const RecordFile* file = file_of(record, name);
  if (file == nullptr) {
    ADD_FAILURE() << "no file " << name;
    return {};
  }
  return read_csv(folder.write(name, file->contents));
}

inline StartMotion start_of(const Record& record, const std::string& name) {
  const TemporaryFolder folder;
  const RecordFile* file = file_of(record, name);
  return file == nullptr ? StartMotion{} : read_start_motion(folder.write(name, file->contents));
}

/// The motion of all contacts of a forced response.
inline StartMotion start_of(const Record& response) {
  const TemporaryFolder folder;
  return read_start_motion(folder.write("contacts.csv", csv_text(response.contacts)));
}

/// Shooting at 0.18 Hz from the state with which a motion's file begins, without settling.
inline auto shot_from(const Scene& scene, const StructureModel& model, const Table& motion) {
  oracle::ShootingOptions options;
  options.settling_periods = 0;
  options.initial_displacement = Eigen::VectorXd::Constant(1, motion.numbers("displacement_m")[0]);
  options.initial_velocity = Eigen::VectorXd::Constant(1, motion.numbers("velocity_m_per_s")[0]);
  return oracle::shoot(model.structure, make_law(scene.contact), 0.18, options);
}

inline double largest(const Table& table) {
  const auto u = table.numbers("displacement_m");
  return u.empty() ? 0.0 : *std::max_element(u.begin(), u.end());
}

}  // namespace wavebalance::app
