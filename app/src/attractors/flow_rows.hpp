#pragma once

#include "wavebalance/app/attractors/recorded_motion.hpp"
#include "wavebalance/app/compose/outputs.hpp"
#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/solvers/balance/condensed_problem.hpp"
#include "wavebalance/solvers/collocation/collocation_motion.hpp"

namespace wavebalance::app {

/// A scene's structure for the integration from event to event. After its contact degrees of freedom come
/// the displacements of analysis.outputs, on which no law acts, so that their motion is equally exact.
class FlowRows {
 public:
  /// Throws as make_problem() and ContactDynamics do.
  FlowRows(const Scene& scene, const StructureModel& model);

  /// Null where the structure has no modes to compute.
  const solvers::ContactDynamics* dynamics() const { return model_.contact_dynamics(); }
  /// Name and unit of each row.
  const std::vector<MotionPlace>& places() const { return places_; }
  int contacts() const { return contacts_; }  ///< rows of contacts, which are the first
  bool has_outputs() const { return contacts_ < int(places_.size()); }

  /// The problem at a frequency (Hz) or, in a scene over the amplitude, at an amplitude of the load.
  solvers::ExactProblem at(double value);
  /// At the scene's own load and frequency.
  solvers::ExactProblem here();

 private:
  bool over_amplitude_;
  int contacts_;
  StructureModel model_;
  solvers::ContactLaws laws_;
  std::vector<MotionPlace> places_;
  solvers::CondensedProblem problem_;
};

}  // namespace wavebalance::app
