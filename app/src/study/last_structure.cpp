#include "wavebalance/app/study/study.hpp"

namespace wavebalance::app {
namespace {

/// The scene without what make_model() does not look at: time, frequency, and the numbers of the laws. Gaps
/// are set for each scene.
Scene structure_part(const Scene& scene) {
  Scene part;
  part.structure = scene.structure;
  part.forcing = scene.forcing;
  part.structure.matrices.spin_speed = spin_speed(scene);  // by default the frequency of the load
  part.forcing.frequency = 0.0;
  if (turns_along_curve(scene)) {
    part.structure.matrices.spin_speed = 0.0;
    part.forcing.frequency = scene.forcing.frequency;
  }
  part.analysis.type = scene.analysis.type;
  part.contact.law = scene.contact.law;
  part.contact.mass = scene.contact.mass;
  part.contact.tangent = scene.contact.tangent;
  part.contact.pairs = scene.contact.pairs;
  for (ContactPair& pair : part.contact.pairs) {
    pair.values.clear();
    pair.gap = 0.0;
  }
  return part;
}

}  // namespace

const StructureModel& LastStructure::model_of(const Scene& scene, const solvers::Observer& observer) {
  Scene part = structure_part(scene);
  if (part_ && part == *part_) {
    set_gaps(model_, scene);
    return model_;
  }
  part_.reset();
  model_ = make_model(scene, observer);
  model_.threads = 1;  // other threads solve the next runs
  part_ = std::move(part);
  ++made_;
  return model_;
}

}  // namespace wavebalance::app
