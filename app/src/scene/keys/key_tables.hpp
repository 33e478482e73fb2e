#pragma once

#include "scene/scene_key_builder.hpp"

/// The tables of keys, one per section of a scene file, one file each.
namespace wavebalance::app {

inline constexpr auto structure_part = [](auto& scene) -> auto& { return scene.structure; };
inline constexpr auto matrices_part = [](auto& scene) -> auto& { return scene.structure.matrices; };
inline constexpr auto blade_part = [](auto& scene) -> auto& { return scene.structure.blade; };
inline constexpr auto contact_part = [](auto& scene) -> auto& { return scene.contact; };
inline constexpr auto forcing_part = [](auto& scene) -> auto& { return scene.forcing; };
inline constexpr auto time_part = [](auto& scene) -> auto& { return scene.time; };
inline constexpr auto analysis_part = [](auto& scene) -> auto& { return scene.analysis; };
inline constexpr auto plot_part = [](auto& scene) -> auto& { return scene.plot; };

inline Condition structure_is(std::vector<std::string_view> types) {
  return {"structure.type", std::move(types)};
}
inline Condition law_is(std::vector<std::string_view> laws) { return {"contact.law", std::move(laws)}; }
inline Condition analysis_is(std::vector<std::string_view> types) {
  return {"analysis.type", std::move(types)};
}
/// One of the analyses with this property, a member or a function.
template <class Property>
Condition analysis_where(const Property& property) {
  std::vector<std::string_view> names;
  for (const AnalysisKind& kind : analysis_kinds)
    if (std::invoke(property, kind)) names.push_back(kind.name);
  return analysis_is(std::move(names));
}
inline Condition of_sweeps() { return analysis_is({"frequency_sweep", "amplitude_sweep"}); }
inline Condition of_responses() {
  return analysis_is({"forced_response", "frequency_sweep", "amplitude_sweep"});
}
/// Not of exact periodic solutions or with impacts, which have no functions.
inline Condition by_balance() { return Condition("time.method", {"balance"}).unless("contact.restitution"); }

/// Each appends the keys of its section.
void add_structure_keys(std::vector<SceneKey>& keys);
void add_contact_keys(std::vector<SceneKey>& keys);
void add_forcing_keys(std::vector<SceneKey>& keys);
void add_time_keys(std::vector<SceneKey>& keys);
void add_analysis_keys(std::vector<SceneKey>& keys);
void add_plot_keys(std::vector<SceneKey>& keys);

}  // namespace wavebalance::app
