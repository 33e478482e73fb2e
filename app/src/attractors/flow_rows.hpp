#pragma once
#include <string>
#include <vector>

#include "wavebalance/app/attractors/recorded_motion.hpp"
#include "wavebalance/app/compose/outputs.hpp"
#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/solvers/balance/condensed_problem.hpp"
#include "wavebalance/solvers/collocation/collocation_motion.hpp"

namespace wavebalance::app {

/// A scene's structure as it is integrated from event to event: behind the directions of its contacts those
/// of those analysis.outputs that are displacements, along which no law acts, so that their motion is as
/// exact as that of the contacts.
class FlowRows {
 public:
  /// Throws as make_problem() and ContactDynamics do.
  FlowRows(const Scene& scene, const StructureModel& model);

  /// Null where the structure has no modes to compute.
  const solvers::ContactDynamics* dynamics() const { return model_.contact_dynamics(); }
  /// What each row is, and its unit.
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
