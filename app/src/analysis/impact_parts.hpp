#pragma once
#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/app/scene/scene.hpp"
#include "wavebalance/solvers/impacts/impact_motion.hpp"
#include "wavebalance/solvers/problem/contact_problem.hpp"
#include "wavebalance/solvers/time/motion.hpp"

namespace wavebalance::app {

/// What a scene with impacts has to ask: its pair, which takes no part, is a small one of its own.
solvers::ContactProblem impacts_problem(const Scene& scene, const StructureModel& model);

/// The contacts at analysis.output_points points of the motion's period, with the forces of those that stay
/// closed.
solvers::Motion contacts_of(const solvers::ImpactMotion& motion, int points);

}  // namespace wavebalance::app
