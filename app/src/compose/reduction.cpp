#include "compose/compose_parts.hpp"

#include "matrices/boundary.hpp"
#include "matrices/symmetric_part.hpp"
#include "wavebalance/fem/check_structure.hpp"
#include "wavebalance/fem/craig_bampton.hpp"

namespace wavebalance::app {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// Shows the phases of a reduction with their per cent; how much of the analysis it is, is not known yet.
fem::Observer reduction_observer(const solvers::Observer& observer) {
  if (!observer) return {};
  return [&observer](std::string_view phase, double done) {
    const std::string text = "reducing the structure, " + std::string(phase);
    if (observer({.phase = text, .value = 100.0 * done, .measure = "%"})) return true;
    throw ReductionCancelled();
  };
}

[[noreturn]] void fail_too_many_modes(int kept_modes) {
  throw std::invalid_argument("structure.kept_modes = " + std::to_string(kept_modes) +
                              ": the mass is semidefinite, and not all of these modes have mass beside the "
                              "degrees of freedom in contact and under load; expected fewer");
}

/// A semidefinite mass has as many modes as its rank; the boundary uses some of them.
fem::CraigBampton craig_bampton_of(const fem::Matrices& matrices, const std::vector<int>& boundary,
                                   const fem::CraigBamptonOptions& options) {
  fem::CraigBampton reduced;
  try {
    reduced = fem::craig_bampton(matrices, boundary, options);
  } catch (const std::domain_error& error) {
    if (std::string_view(error.what()).find("rank of mass") == std::string_view::npos) throw;
    fail_too_many_modes(options.modes);
  }
  if (reduced.status != fem::EigenmodesStatus::converged) return reduced;
  try {
    fem::check_structure({reduced.mass.sparseView(), {}, reduced.stiffness.sparseView()},
                         {.allow_free = true});
  } catch (const fem::StructureFault& fault) {
    if (fault.matrix() == fem::StructureMatrix::mass) fail_too_many_modes(options.modes);
  }
  return reduced;
}

/// With the displacements of the structure itself.
fem::CraigBampton reduction(const fem::Matrices& matrices, const Kept& kept,
                            const fem::CraigBamptonOptions& options) {
  if (kept.merging.size() == 0) return craig_bampton_of(matrices, kept.boundary, options);
  fem::CraigBampton reduced = craig_bampton_of(merged(matrices, kept.merging), kept.boundary, options);
  if (reduced.status == fem::EigenmodesStatus::converged)
    reduced.transformation = kept.merging * reduced.transformation;
  return reduced;
}

solvers::TurningParts projected(solvers::TurningParts turning, const Eigen::MatrixXd& transformation) {
  for (Sparse* part : {&turning.gyroscopic, &turning.stiffness})
    if (part->size() > 0)
      *part = Eigen::MatrixXd(transformation.transpose() * (*part * transformation)).sparseView();
  return turning;
}

}  // namespace

void reduce(StructureModel& model, const fem::Matrices& matrices, const Loads& loads,
            const solvers::ContactDirections& directions, const Kept& kept, int kept_modes,
            const solvers::Observer& observer, const solvers::TurningParts& turning) {
  const std::optional<fem::Matrices> parts = symmetric_parts(matrices);
  fem::CraigBampton reduced =
      reduction(parts ? *parts : matrices, kept,
                {.modes = kept_modes, .solver = {}, .observer = reduction_observer(observer)});
  if (reduced.status != fem::EigenmodesStatus::converged)
    throw std::runtime_error("structure.kept_modes = " + std::to_string(kept_modes) +
                             ": the eigenvalue solver did not find them all");
  model.structure.mass = reduced.mass.sparseView();
  model.structure.damping = reduced.damping.sparseView();
  model.structure.stiffness = reduced.stiffness.sparseView();
  model.structure.damping += projected_skew_part(matrices.damping, reduced.transformation);
  model.structure.stiffness += projected_skew_part(matrices.stiffness, reduced.transformation);
  model.structure.turning = projected(turning, reduced.transformation);
  model.structure.load = reduced.project_load(loads.load);
  model.structure.forces = loads.forces;
  for (solvers::PeriodicForce& force : model.structure.forces)
    force.shape = reduced.project_load(force.shape);
  model.structure.contact_directions =
      reduced.project_directions(kept.merging.size() == 0 ? directions : merged(directions, kept.merging));
  model.recovery = std::move(reduced.transformation);
}

}  // namespace wavebalance::app
