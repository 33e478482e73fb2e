#pragma once
#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/app/scene/scene.hpp"
#include "wavebalance/solvers/modes/damped_mode.hpp"
#include "wavebalance/solvers/modes/elastic_mode.hpp"

namespace wavebalance::app {

/// Whether the scene is a nonlinear mode with friction, which dissipates energy.
bool is_damped_mode(const Scene& scene);

/// Whether the scene is a nonlinear mode with a contact law instead of a rigid obstacle.
bool is_elastic_mode(const Scene& scene);

/// The discretisation of an elastic mode: the scene's own if it names a trial basis, else 2 harmonics + 1
/// Fourier functions on analysis.samples points.
Time mode_time(const Scene& scene);

/// The scene's elastic mode on these modes. Throws std::invalid_argument for a pair of bases that damps a
/// free motion, and for scenes that load_scene() would have rejected.
solvers::ElasticMode make_elastic_mode(const Scene& scene, const solvers::ModalModel& model);

/// The scene's damped mode. Throws as solvers::DampedMode does.
solvers::DampedMode make_damped_mode(const Scene& scene, const StructureModel& model);

}  // namespace wavebalance::app
