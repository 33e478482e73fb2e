#pragma once

namespace wavebalance::app {

/// Scenes to start from; STEM stands for the stem of their files.
extern const char* const bar_starter;
extern const char* const matrices_starter;
extern const char* const blade_starter;
/// A study of STEM_scene.toml.
extern const char* const study_starter;

}  // namespace wavebalance::app
