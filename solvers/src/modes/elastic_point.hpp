#pragma once
#include "modes/mode_equations.hpp"
#include "wavebalance/solvers/modes/elastic_mode.hpp"

namespace wavebalance::solvers {

/// The point of the state that the equations were last evaluated at. O(R r + C N).
ModePoint elastic_point(const ModeEquations& equations, const ElasticModeOptions& options, int iterations);

/// J, of the linear mode at grazing: the unit of energy ratios.
double grazing_energy(const ModeProblem& problem);

/// The linear mode at an energy ratio, without force.
ModePoint linear_point(const ModeProblem& problem, double energy_ratio);

}  // namespace wavebalance::solvers
