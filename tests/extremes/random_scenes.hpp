#pragma once
#include <cstdint>
#include <string>

#include "wavebalance/app/scene/scene.hpp"

/// The text of a scene drawn from `seed`, often with something wrong in it.
struct RandomText {
  std::string text;
  bool invalid = false;  ///< a value of the wrong type or out of range, or an unknown key, was put in
};

RandomText random_text(std::uint64_t seed);

/// A scene of bounded cost, drawn from `seed`, with numbers of any size; may break a rule of the loader.
wavebalance::app::Scene random_scene(std::uint64_t seed);
