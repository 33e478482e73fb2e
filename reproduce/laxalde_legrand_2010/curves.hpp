#pragma once
#include <string>
#include <vector>

#include "ll10.hpp"
#include "wavebalance/solvers/modes/mode_augmented_lagrangian.hpp"

namespace wavebalance::ll10 {

/// Largest relative difference of omega between the condensed solver and the consistent augmented Lagrangian
/// (Algorithm 1) started from it, over those of `energies` that both reach.
struct Agreement {
  double largest = 0.0;
  int points = 0;
};
Agreement lagrangian_agreement(const app::ModeStudy& study, const app::Backbone& curve,
                               const std::vector<double>& energies);

/// |omega / omega_exact - 1| at the energies of the accepted points of a curve with energy ratios in 1.2..10.
struct Distance {
  double median = 0.0;
  double largest = 0.0;
  int points = 0;
};
Distance exact_distance(const app::ModeStudy& study, const app::Backbone& curve);

/// Rows formulation, energy_ratio, frequency_ratio, rayleigh_frequency_ratio: published (frequency is the
/// root of r), consistent (accepted points) and exact, the linear branch below contact included.
Table backbones_table(const app::ModeStudy& study, const app::Backbone& curve,
                      const std::vector<solvers::LagrangianPoint>& published);

}  // namespace wavebalance::ll10
