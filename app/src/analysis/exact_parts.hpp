#pragma once
#include "wavebalance/app/analysis/sweep.hpp"
#include "wavebalance/solvers/exact/exact_curve.hpp"
#include "wavebalance/solvers/problem/contact_problem.hpp"

namespace wavebalance::app {

/// A curve of the scene that was followed by phases, as a sweep: Sweep::exact_motions are set.
Sweep sweep_of(const solvers::ExactCurve& curve, const Scene& scene, const solvers::ContactProblem& problem);

}  // namespace wavebalance::app
