#pragma once
#include <string>
#include <vector>

#include "ll10.hpp"
#include "modes/mode_augmented_lagrangian.hpp"
#include "wavebalance/contact/multipliers.hpp"

namespace wavebalance::ll10 {

/// In units omega_1 = gap = 1, where the inner Newton iterations are well scaled.
inline constexpr double first_penalty = 300.0;
/// The scene's mode with this many harmonics, and the outer iteration of Algorithm 3 from first_penalty.
LagrangianModeOptions lagrangian_options(const app::Scene& scene, int harmonics);
contact::MultiplierUpdate lagrangian_strategy(const LagrangianMode& mode);

/// LL10's equations as printed (h without n^2, omega^2 = r) by Algorithm 2, from grazing to the scene's
/// largest energy in analysis.points points, uniform. Ends at the first that is not accepted, which is kept.
/// O(points (n N)^3).
std::vector<LagrangianPoint> published_branch(const app::ModeStudy& study);

/// |omega / omega_exact - 1| at the energies of the accepted points of a curve with energy ratios in 1.2..10.
struct Distance {
  double median = 0.0;
  double largest = 0.0;
  int points = 0;
};
Distance exact_distance(const app::ModeStudy& study, const app::Backbone& curve);

/// The rod's mode with the mass matrix of eq. (28), with a half-lumped one, and as published.
struct RodCurves {
  const app::ModeStudy& study;
  app::Backbone backbone;
  const app::ModeStudy& remedy;
  app::Backbone remedy_backbone;
  std::vector<LagrangianPoint> published;
};

/// The point of a backbone at an energy ratio. Throws report::NotConverged when there is none.
solvers::ModePoint accepted_at(const app::ModeStudy& study, const app::Backbone& curve, double energy_ratio);

/// Rows formulation, energy_ratio, frequency_ratio, rayleigh_frequency_ratio: published (frequency is the
/// root of r, points that were reached) and consistent (accepted points), both from the linear mode on.
Table backbones_table(const app::ModeStudy& study, const app::Backbone& curve,
                      const std::vector<LagrangianPoint>& published);

/// Rows formulation, energy_ratio, frequency_ratio, rayleigh_frequency_ratio: published (frequency is the
/// root of r), consistent and consistent_half_lumped (accepted points) and exact, the linear branch below
/// contact included.
Table backbones_table(const RodCurves& curves);

}  // namespace wavebalance::ll10
