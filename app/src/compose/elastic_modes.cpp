#include "wavebalance/app/compose/elastic_modes.hpp"

#include "wavebalance/app/compose/compose.hpp"

namespace wavebalance::app {

bool is_elastic_mode(const Scene& scene) {
  const ContactLawType law = scene.contact.law;
  return scene.analysis.type == AnalysisType::nonlinear_mode &&
         (law == ContactLawType::exponential || law == ContactLawType::linear ||
          (law == ContactLawType::rigid && redistributes_mass(scene)));
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

}  // namespace wavebalance::app
