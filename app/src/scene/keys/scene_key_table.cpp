#include "scene/keys/key_tables.hpp"

namespace wavebalance::app {
namespace {

std::vector<SceneKey> make_keys() {
  std::vector<SceneKey> keys;
  add_structure_keys(keys);
  add_contact_keys(keys);
  add_forcing_keys(keys);
  add_time_keys(keys);
  add_analysis_keys(keys);
  add_plot_keys(keys);
  return keys;
}

}  // namespace

std::span<const SceneKey> scene_keys() {
  static const std::vector<SceneKey> keys = make_keys();
  return keys;
}

}  // namespace wavebalance::app
