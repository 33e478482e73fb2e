#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <cstdint>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "wavebalance/app/matrices/moved_mesh.hpp"
#include "wavebalance/app/scene/contacts.hpp"
#include "wavebalance/app/scene/scene.hpp"
#include "wavebalance/fem/blade.hpp"
#include "wavebalance/fem/mesh.hpp"
#include "wavebalance/solvers/linalg/progress.hpp"
#include "wavebalance/solvers/problem/structure_dynamics.hpp"
#include "wavebalance/solvers/structure/linear_structure.hpp"

namespace wavebalance::app {

/// A scene's structure, composed once: the structure that is solved, and the way back to the whole structure.
/// Immutable once it is used.
struct StructureModel {
  /// Reduced if the scene has kept_modes. The load is the force's amplitude.
  solvers::LinearStructure structure;
  /// G and K_s of a structure that turns; `structure` has them too where they follow the frequency.
  solvers::TurningParts turning;
  /// 2 x r: how coordinates move the plane of a rotor, x and y in the sense in which its unbalance turns, or
  /// a ring's; 0 x 0 without.
  Eigen::MatrixXd plane;
  Eigen::VectorXd gaps;               ///< m, one per contact
  std::vector<std::string> warnings;  ///< doubtful properties of the structure, one sentence each
  int unknowns = 0;                   ///< degrees of freedom before the reduction
  double reduction_seconds = 0.0;     ///< assembly, rotation and reduction; 0 for a bar
  /// Largest relative change of the first ten natural frequencies without contact by the redistribution of
  /// the contacts' mass; NaN where there was none, or beyond 1000 degrees of freedom.
  double frequency_change = std::numeric_limits<double>::quiet_NaN();
  /// unknowns x r: displacements from the coordinates of the reduced structure; 0 x 0: they are equal.
  Eigen::MatrixXd recovery;
  std::shared_ptr<const fem::Blade> blade;  ///< its mesh; null for other structures
  std::shared_ptr<const MovedMesh> mesh;    ///< of structure.mesh; null without
  /// Threads that condense its problems, as in CondensedProblem::set_threads().
  int threads = 0;
  /// The dynamics of `structure`, for all runs that share the model.
  std::shared_ptr<solvers::StructureDynamics> dynamics = std::make_shared<solvers::StructureDynamics>();

  int contacts() const { return structure.contacts(); }
  int size() const { return structure.size(); }
  bool reduced() const { return recovery.size() > 0; }
  /// Null where the structure has no modes to compute.
  const solvers::ContactDynamics* contact_dynamics() const { return dynamics->of(structure).get(); }
  /// unknowns x points: displacements (or velocities) of the whole structure from reduced ones, r x points.
  /// Throws std::invalid_argument if the rows do not fit. O(unknowns r points).
  Eigen::MatrixXd recover(const Eigen::MatrixXd& coordinates) const;
};

/// The observer of make_model() has stopped it.
class ReductionCancelled : public std::runtime_error {
 public:
  ReductionCancelled() : std::runtime_error("the reduction of the structure was cancelled") {}
};

/// The scene's bar, blade or matrices with their damping, reduced if it has kept_modes. A blade rotates
/// about its axis, which stiffens it. Throws std::invalid_argument for scenes that load_scene() would have
/// rejected (blades: also inverted elements), std::domain_error if the structure can move
/// freely, std::runtime_error if the kept modes are not found.
/// The observer is called between the steps of a reduction, a single factorisation being one of them, and
/// stops it by ReductionCancelled.
StructureModel make_model(const Scene& scene, const solvers::Observer& observer = {});

/// Gives a model the gaps of a scene. Throws std::invalid_argument if there are not as many as contacts.
void set_gaps(StructureModel& model, const Scene& scene);

/// Degrees of freedom of the scene's structure, and of the reduced one that is solved. Files of matrices are
/// read unless load_scene() has read them.
std::int64_t structure_dofs(const Scene& scene);
int reduced_size(const Scene& scene);

/// Degrees of freedom of a blade's mesh, its root held. O(1).
std::int64_t blade_unknowns(const BladeStructure& blade);

/// The blade that a scene describes, its mesh clamped at the root.
fem::BladeOptions blade_options(const Structure& structure);

}  // namespace wavebalance::app
