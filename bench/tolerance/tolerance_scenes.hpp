#pragma once
#include <array>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/solvers/response/refinement.hpp"

namespace wavebalance::tolerance {

/// One motion to be solved to a tolerance: a scene of reproduce/scenes/tolerance and what is changed in it.
struct Motion {
  const char* name;
  const char* file;
  std::vector<std::string> changes;

  friend void PrintTo(const Motion& motion, std::ostream* out) { *out << motion.name; }
};

inline const std::vector<Motion>& motions() {
  static const std::vector<Motion> all{
      {"case1", "case1.toml", {}},
      {"case2", "case2.toml", {}},
      {"no_contact", "case1.toml", {"contact.gap=5e-3"}},
      {"linear_soft", "linear_stop.toml", {}},
      {"linear_stiff", "linear_stop.toml", {"contact.stiffness=1e10"}},
      {"small_gap", "case1.toml", {"contact.gap=1e-5"}},
      {"preload", "case1.toml", {"contact.gap=-3e-4"}},
      {"pressed_all_period", "case1.toml", {"contact.gap=-3e-3", "forcing.amplitude=100e3"}},
      {"high_damping",
       "case1.toml",
       {"structure.stiffness_damping=1e-3", "forcing.frequency=600", "contact.gap=2e-4"}},
      {"near_resonance",
       "case2.toml",
       {"structure.stiffness_damping=2e-5", "forcing.frequency=1300", "contact.gap=5e-3"}},
      {"second_mode", "case2.toml", {"forcing.frequency=3830", "contact.gap=1e-3", "contact.exponent=50"}},
      {"near_grazing", "case1.toml", {"contact.gap=1.43e-3"}},
      {"millimetres",
       "case1.toml",
       {"structure.youngs_modulus=70e3", "structure.density=2.7e-9", "structure.area=2500",
        "structure.length=1000", "contact.exponent=0.05", "contact.gap=1"}},
      {"hard_exponent", "case1.toml", {"contact.exponent=2000", "contact.constant=1e6"}},
      {"soft_exponent", "case1.toml", {"contact.exponent=5"}},
      {"massless_tip", "case1.toml", {"structure.massless_tip=true"}},
      {"third_of_resonance", "case1.toml", {"forcing.frequency=420"}},
  };
  return all;
}

/// `motion` with a tolerance, its displacement written down at `points` times. `folder` holds the scene
/// files.
inline app::Scene scene(const Motion& motion, const std::string& folder, double tolerance, int points) {
  std::vector<std::string> changes = motion.changes;
  changes.push_back("analysis.output_points=" + std::to_string(points));
  app::Scene result = app::load_scene(folder + "/tolerance/" + motion.file, changes);
  result.time.tolerance = tolerance;
  return result;
}

/// The refinement of a scene's structure and law. Its own [time] is not read.
inline solvers::RefinementResult refine(const app::Scene& scene, const app::StructureModel& model,
                                        const solvers::AnyContactLaw& law,
                                        const solvers::RefinementOptions& options) {
  const auto make = [&](int functions, int points) {
    app::Scene sized = scene;
    sized.time = {
        .trial = "fourier", .weight = "fourier", .functions = functions, .quadrature_points = points};
    return app::make_problem(sized, model);
  };
  return solvers::response_to_tolerance(make, law, options);
}

/// The displacement by collocation, whose own error is below 1e-10. For a tip without mass by `functions`
/// Fourier functions and eight times as many points.
inline Eigen::VectorXd reference(app::Scene scene, int functions) {
  app::Response response;
  if (scene.structure.massless_tip) {
    scene.time = {.trial = "fourier",
                  .weight = "fourier",
                  .functions = functions,
                  .quadrature_points = 8 * (functions + 1)};
    response = app::weighted_residual_response(scene);
  } else {
    scene.time = {};
    scene.time.tolerance = 1e-11;
    response = app::exact_response(scene);
  }
  if (!response.converged) throw std::runtime_error("the reference has not converged: " + response.status);
  return response.displacement();
}

}  // namespace wavebalance::tolerance
