#include "wavebalance/app/compose/compose.hpp"

#include "compose/compose_parts.hpp"
#include "matrices/load_places.hpp"
#include "matrices/loads.hpp"
#include "matrices/structure_files.hpp"
#include "wavebalance/app/scene/contacts.hpp"
#include "wavebalance/solvers/response/forced_response.hpp"
#include "wavebalance/solvers/structure/rigid_modes.hpp"
#include "wavebalance/solvers/time/motion.hpp"
#include "wavebalance/spectral/fourier_basis.hpp"

namespace wavebalance::app {
namespace {

/// Only the static parts of its forces, without mass and damping.
solvers::LinearStructure at_rest(const solvers::LinearStructure& structure) {
  solvers::LinearStructure result = structure;
  result.load.setZero();
  result.damping.setZero();
  result.loss_factor = 0.0;
  result.turning = {};  // it does not follow a load
  if (!structure.is_free()) result.mass.setZero();
  result.forces.clear();
  for (const solvers::PeriodicForce& force : structure.forces)
    if (force.derivative == 0 && force.harmonics.size() > 0 && force.harmonics[0] != 0.0)
      result.forces.push_back({force.shape, force.harmonics.head(1), 0});
  return result;
}

/// One function, which is constant, and one point; for a free structure, whose mean is an additional
/// unknown, three functions, of which the others have no load.
solvers::TimePair pair_at_rest(bool free) {
  solvers::TimePairOptions options;
  options.quadrature_points = free ? 4 : 1;
  const spectral::FourierBasis basis(free ? 3 : 1);
  return {basis, basis, std::move(options)};
}

/// The structure of a scene's matrices under its static loads.
solvers::LinearStructure structure_of_files(const Scene& scene) {
  const auto files = structure_files(scene);
  const Eigen::Index size = files->matrices.stiffness.rows();
  solvers::LinearStructure structure;
  structure.mass = files->matrices.mass;
  structure.damping.resize(size, size);
  structure.stiffness = files->matrices.stiffness;
  structure.load = Eigen::VectorXd::Zero(size);
  structure.contact_directions = contact_directions(scene, *files);
  structure.forces = forces_of(
      scene.forcing,
      {.force = unit_load(scene, *files), .inertia = {}, .files = files.get(), .stiffness_damping = 0.0});
  if (scene.structure.matrices.free)
    structure.rigid_modes = solvers::find_rigid_modes(structure.mass, structure.stiffness);
  append_signals(structure, scene);
  return structure;
}

/// Hz, near the forcing frequency but different: the load may be at a natural frequency.
double frequency_of(const Scene& scene) {
  constexpr double beside = 0.618;
  const double frequency =
      varies_frequency(scene.analysis) ? scene.analysis.frequency_from : scene.forcing.frequency;
  return frequency > 0.0 ? beside * frequency : 1.0;
}

/// Whether contacts that press against each other hold the structure where its equations leave no more than
/// rounding. A balance measures its residual by the motion, which is none there.
bool holds_itself(solvers::CondensedProblem& problem, const solvers::PeriodicResponse& found) {
  constexpr double rounding = 1e-13;  // of the displacements by each force separately
  Eigen::VectorXd moved;
  problem.apply(found.contact_force, moved);
  const double left = (found.displacement - problem.linear_response() + moved).norm();
  const Eigen::VectorXd forces =
      solvers::by_contact(found.contact_force, problem.contacts()).rowwise().norm();
  return left <= rounding * problem.contact_compliance().dot(forces);
}

std::optional<RestState> state_of(const Scene& scene, const solvers::LinearStructure& structure) {
  const bool mode = scene.analysis.type == AnalysisType::nonlinear_mode && !names_friction(scene.contact);
  if (mode || scene.contact.law == no_law) return std::nullopt;
  try {
    solvers::CondensedProblem problem(pair_at_rest(structure.is_free()), at_rest(structure),
                                      Eigen::VectorXcd::Ones(1));
    problem.set_frequency(frequency_of(scene));  // at rest, of springs that hold a free structure
    solvers::ForcedResponseOptions options;
    options.form = scene.contact.form;
    const auto found = solvers::forced_response(problem, make_laws(scene), options);
    const auto mean = [&](const Eigen::VectorXd& samples) -> Eigen::VectorXd {
      return solvers::by_contact(samples, structure.contacts()).rowwise().mean();
    };
    const bool holds = found.converged() || holds_itself(problem, found);
    return RestState{holds, holds ? "converged" : std::string(to_string(found.status)),
                     mean(found.displacement), mean(found.contact_force)};
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

}  // namespace

std::optional<RestState> rest_state(const Scene& scene, const StructureModel& model) {
  return state_of(scene, model.structure);
}

std::optional<RestState> rest_state(const Scene& scene) { return state_of(scene, structure_of_files(scene)); }

}  // namespace wavebalance::app
