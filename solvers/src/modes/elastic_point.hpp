#pragma once
#include "modes/mode_equations.hpp"
#include "wavebalance/solvers/modes/elastic_mode.hpp"

namespace wavebalance::solvers {

/// The point of the state that the equations were last evaluated at. O(R r + C N).
ModePoint elastic_point(const ModeEquations& equations, int iterations);

/// The harmonic k >= 2 of a mode with the largest share of the kinetic energies, r x (K + 1).
InternalResonance strongest_resonance(const Eigen::MatrixXd& kinetic);

/// Whether a motion of frequency `driven` (rad/s) in the harmonic of a resonance is on it.
bool is_resonant(const InternalResonance& resonance, const ModalModel& model, double driven);

/// J, of the linear mode at grazing: the unit of energy ratios.
double grazing_energy(const ModeProblem& problem);

/// The linear mode at an energy ratio, without force.
ModePoint linear_point(const ModeProblem& problem, double energy_ratio);

}  // namespace wavebalance::solvers
