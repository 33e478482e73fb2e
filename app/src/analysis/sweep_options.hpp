#pragma once
#include "wavebalance/app/scene/scene.hpp"
#include "wavebalance/solvers/stability/curve_stability.hpp"

namespace wavebalance::app {

/// The curve of a scene, in frequencies of a problem of analysis.subharmonic periods of the load.
solvers::FrequencySweepOptions sweep_options(const Scene& scene);

/// What is 1 in the solver: a period of the problem, or of an amplitude sweep the amplitude of the scene.
double sweep_unit(const Scene& scene);

/// Multiplies every frequency of a curve, of its stability.
void scale_frequencies(solvers::FrequencySweep& curve, double factor);
/// The same of load scales and, in a sweep over them, of brackets and the values of unknowns.
void scale_loads(solvers::FrequencySweep& curve, double factor);
void scale_loads(solvers::CurveStability& stability, double factor);
/// Progress in the unit of an amplitude, `factor` times the load scale.
solvers::Observer of_amplitude(const solvers::Observer& observer, double factor, std::string_view unit);
void scale_frequencies(solvers::CurveStability& stability, double factor);

/// `observer`, to be called with frequencies of a problem of so many periods of the load.
solvers::Observer of_load(const solvers::Observer& observer, int periods);

}  // namespace wavebalance::app
