#pragma once
#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <utility>

#include "tolerance_scenes.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/scene/scene.hpp"
#include "wavebalance/solvers/response/refinement.hpp"

namespace wavebalance::tolerance {

/// Numbers that are the same with every standard library.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : bits_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * std::ldexp(static_cast<double>(bits_() >> 11), -53);
  }
  double logarithmic(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }

 private:
  std::mt19937_64 bits_;
};

/// The largest displacement of the tip without contact, m.
inline double free_amplitude(const app::Scene& scene) {
  app::Scene linear = scene;
  linear.time = {.trial = "fourier", .weight = "fourier", .functions = 3, .quadrature_points = 64};
  return app::make_problem(linear).linear_response().maxCoeff();
}

/// A bar driven at 40 to 4000 Hz, damped by 1e-5 to 1e-3 s, against a linear or an exponential stop. The gap
/// is -0.3 to 1 times the amplitude without contact, in one motion of four close to grazing (to 1e-4 of it).
inline app::Scene random_scene(std::uint64_t seed) {
  Dice dice(seed);
  app::Scene scene;
  scene.structure = {.youngs_modulus = 70e9, .density = 2700.0, .area = 25e-4, .length = 1.0, .elements = 25};
  scene.structure.stiffness_damping = dice.logarithmic(1e-5, 1e-3);
  scene.forcing = {.amplitude = 250e3, .frequency = dice.logarithmic(40.0, 4000.0)};
  const double amplitude = free_amplitude(scene);
  const bool grazing = dice.uniform(0.0, 1.0) < 0.25;
  scene.contact.gap = amplitude * (grazing ? 1.0 - dice.logarithmic(1e-4, 1e-1) : dice.uniform(-0.3, 1.0));
  if (dice.uniform(0.0, 1.0) < 0.5) {
    scene.contact.law = "linear";
    scene.contact.values["stiffness"] = dice.logarithmic(1e7, 1e11);
  } else {
    scene.contact.law = "exponential";
    scene.contact.values["exponent"] = dice.logarithmic(0.05, 5.0) / amplitude;
    scene.contact.values["constant"] = dice.logarithmic(1e7, 1e11) / scene.contact.number("exponent");
  }
  return scene;
}

/// A scene without a time basis, its structure and its law.
struct RandomMotion {
  explicit RandomMotion(std::uint64_t seed)
      : scene(random_scene(seed)), model(app::make_model(scene)), law(app::make_law(scene.contact)) {}

  /// Stops when the observer returns false.
  solvers::RefinementResult refine(double tolerance, solvers::Observer observer = {}) const {
    solvers::RefinementOptions options;
    options.tolerance = tolerance;
    options.observer = std::move(observer);
    return tolerance::refine(scene, model, law, options);
  }

  app::Scene scene;
  app::StructureModel model;
  solvers::AnyContactLaw law;
};

}  // namespace wavebalance::tolerance
