#pragma once
#include <vector>

#include "wavebalance/app/scene/scene.hpp"

namespace wavebalance::jl14 {

/// Forcing frequencies in [from, to], Hz, at which the discretisation in time adds a resonance. With an
/// even number M of functions the symbols of all derivatives are real at k = M/2, for every pair of real
/// bases. In Galerkin pairs and with Fourier functions on both sides the symbol of the first derivative
/// vanishes. In the others (Haar:Fourier, Daubechies 6:Fourier) it does not, since a basis that is not
/// symmetric about its translates shifts the alternating function relative to the other basis. Being real
/// it adds the damping matrix to the stiffness, which moves the resonance and does not limit it. The
/// dynamic stiffness of the alternating coefficient is singular where
///   lambda_2 f^2 + lambda_1 f c + lambda_0 omega^2 = 0
/// for a mode of natural frequency omega (rad/s) and modal damping c (kg/s over the modal mass of 1 kg; what
/// damping couples modes is left out). Contact excites the coefficient slightly; a response near such a
/// frequency is an artefact. Empty for odd M and where the scene drops the coefficient. Ascending. O(n^3), n
/// degrees of freedom.
std::vector<double> nyquist_resonances(const app::Scene& scene, double from, double to);

}  // namespace wavebalance::jl14
