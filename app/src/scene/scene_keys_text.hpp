#pragma once

#include "wavebalance/app/scene/scene_keys.hpp"

namespace wavebalance::app {

/// As describe_scene_keys(), of the keys, also of pairs and terms, for which `shown` is true; where a
/// contact law is given, its parameters as for this law.
std::string describe_scene_keys(const std::function<bool(const SceneKey&)>& shown, std::string_view law = {},
                                int width = 100);

/// `"a", "b" or "c"`; the twenty Daubechies names are written as one.
std::string alternatives(const std::vector<std::string_view>& values);

}  // namespace wavebalance::app
