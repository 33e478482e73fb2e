#pragma once
#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/app/scene/scene.hpp"
#include "wavebalance/solvers/impacts/impact_motion.hpp"
#include "wavebalance/solvers/problem/contact_problem.hpp"
#include "wavebalance/solvers/time/motion.hpp"

namespace wavebalance::app {

/// What a scene with impacts has to ask: its pair, which takes no part, is a small one of its own.
solvers::ContactProblem impacts_problem(const Scene& scene, const StructureModel& model);

/// The same where the scene names no pair, else the scene's.
solvers::ContactProblem exact_problem(const Scene& scene, const StructureModel& model);

/// The contacts at so many points of the motion's period; between impacts alone there are no forces.
solvers::Motion contacts_of(const solvers::ImpactMotion& motion, int points);
solvers::Motion contacts_of(const solvers::PhaseMotion& motion, int points);

}  // namespace wavebalance::app
