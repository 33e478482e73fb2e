#pragma once
#include <optional>

#include "wavebalance/app/analysis/start_motion.hpp"
#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/app/scene/scene.hpp"

namespace wavebalance::app {

/// The structure of the last scene, reused by the next ones if it is the same. Runs of a study often differ
/// only in frequency, gap, law or basis, and a reduction takes longer than a response. One per thread.
class LastStructure {
 public:
  /// The model of a scene, as make_model() makes it. The result lives until the next call.
  const StructureModel& model_of(const Scene& scene, const solvers::Observer& observer);
  /// A scene with the same files of matrices, which need not be read again; null at first.
  const Scene* earlier() const { return part_ ? &*part_ : nullptr; }
  /// The last limit cycle that was found, from which the next run of a study may start; empty at first.
  StartMotion cycle;
  /// How many structures were made.
  int made() const { return made_; }

 private:
  std::optional<Scene> part_;  // what the model depends on
  StructureModel model_;
  int made_ = 0;
};

}  // namespace wavebalance::app
