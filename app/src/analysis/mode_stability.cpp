#include "analysis/mode_stability.hpp"

namespace wavebalance::app {
namespace {

solvers::ElasticBackbone solved_curve(const Backbone& curve) {
  return {solvers::BackboneStatus::reached_energy, curve.points};
}

}  // namespace

solvers::BackboneStability stability_of(const ModeStudy& study, const Backbone& curve,
                                        const Observer& observer) {
  if (!study.elastic_mode() || !study.scene().analysis.stability) return {};
  solvers::ModeStabilityOptions options;
  options.observer = observer;
  return solvers::backbone_stability(*study.elastic_mode(), solved_curve(curve), options);
}

}  // namespace wavebalance::app
