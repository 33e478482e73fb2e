#pragma once
#include <vector>

#include "wavebalance/app/scene/scene.hpp"

namespace wavebalance::app {

/// Forcing frequencies in [from, to], Hz, at which the discretisation in time has a resonance of its own.
/// With an even number M of functions the symbol of the first derivative vanishes at k = M/2 for the Fourier
/// and for all Galerkin pairs: the alternating coefficient is not damped, and its dynamic stiffness
/// lambda_2 f^2 M + lambda_0 K is singular where -lambda_2 f^2 / lambda_0 meets the square of a natural
/// frequency (rad/s). Contact excites it slightly; a response near such a frequency is an artefact. Empty for
/// odd M and for pairs that damp this coefficient. O(n^3), n degrees of freedom.
std::vector<double> nyquist_resonances(const Scene& scene, double from, double to);

}  // namespace wavebalance::app
