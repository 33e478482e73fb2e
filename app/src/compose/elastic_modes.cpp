#include "wavebalance/app/compose/compose.hpp"

namespace wavebalance::app {

bool is_damped_mode(const Scene& scene) {
  return scene.analysis.type == AnalysisType::nonlinear_mode && takes_energy(scene.contact);
}

bool is_elastic_mode(const Scene& scene) {
  const std::string& law = scene.contact.law;
  return !is_damped_mode(scene) && scene.analysis.type == AnalysisType::nonlinear_mode && law != no_law &&
         (!is_rigid(law) || redistributes_mass(scene));
}

Time mode_time(const Scene& scene) {
  if (!scene.time.trial.empty()) return scene.time;
  Time time = scene.time;
  time.trial = time.weight = "fourier";
  time.functions = 2 * scene.analysis.harmonics + 1;
  time.quadrature_points = scene.analysis.samples;
  return time;
}

solvers::ElasticMode make_elastic_mode(const Scene& scene, const solvers::ModalModel& model) {
  solvers::ElasticModeOptions options;
  options.mode = scene.analysis.mode;
  options.cosine_only = scene.analysis.cosine_only;
  return {model, make_pair(mode_time(scene)), make_laws(scene), options};
}

solvers::DampedMode make_damped_mode(const Scene& scene, const StructureModel& model) {
  return {model.structure, make_pair(mode_time(scene)), make_laws(scene), scene.analysis.mode};
}

}  // namespace wavebalance::app
