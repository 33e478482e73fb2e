#pragma once
#include <string>
#include <vector>

#include "wavebalance/app/compose/other_analysis.hpp"
#include "wavebalance/app/scene/scene.hpp"

namespace wavebalance::app {

/// A way on for a scene that was not solved: in words, and as the change of keys that the words name. Words
/// that name no key have an empty change.
struct NextStep {
  std::string text;
  SceneChange change;
};

/// What to try where the scene's analysis ended with `status`, the most promising first, each a change that
/// the scene's own rules accept; empty if nothing is known.
std::vector<NextStep> next_steps(const Scene& scene, const std::string& status);

/// The statuses for which there are steps at all; for tests, which ask for each of them.
std::vector<std::string> statuses_with_next_steps(AnalysisType type);

}  // namespace wavebalance::app
