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

/// Remedies for a scene whose analysis ended with `status`, the most promising first. Each is a change that
/// the rules of scenes accept; empty if none is known.
std::vector<NextStep> next_steps(const Scene& scene, const std::string& status);

/// The statuses for which there are steps at all; for tests of each of them.
std::vector<std::string> statuses_with_next_steps(AnalysisType type);

}  // namespace wavebalance::app
