#pragma once
#include "wavebalance/app/analysis/sweep.hpp"
#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/solvers/exact/exact_curve.hpp"
#include "wavebalance/solvers/problem/contact_problem.hpp"

namespace wavebalance::app {

/// A curve of the scene whose motions are exact, as a sweep: Sweep::exact_motions are set.
Sweep sweep_of(const solvers::ExactCurve& curve, const Scene& scene, const solvers::ContactProblem& problem);

/// The problem of a scene with exact motions. It has the scene's pair, or a small unused one if the scene
/// names none or has impacts only.
solvers::ContactProblem exact_problem(const Scene& scene, const StructureModel& model);

/// The contacts at so many points of the motion's period; with impacts only there are no forces.
solvers::Motion contacts_of(const solvers::ExactSolution& motion, int points);

}  // namespace wavebalance::app
