#pragma once
#include <vector>

#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/fem/matrices.hpp"

namespace wavebalance::app {

/// Loads and contacts of a structure before its reduction: see solvers::LinearStructure.
struct Loads {
  Eigen::VectorXd load;
  std::vector<solvers::PeriodicForce> forces;
};

/// Coordinates that a reduction keeps in addition to its modes.
struct Kept {
  std::vector<int> boundary;
  Eigen::SparseMatrix<double> merging = {};  ///< merging() of coordinates of several unknowns, or 0 x 0
};

/// Sets the structure of a model from matrices, reduced to the boundary and so many modes. Modes and static
/// deflections follow from the symmetric parts of the matrices. Their skew parts, gyroscopic and
/// circulatory forces, are projected on them.
void reduce(StructureModel& model, const fem::Matrices& matrices, const Loads& loads,
            const solvers::ContactDirections& directions, const Kept& kept, int kept_modes,
            const solvers::Observer& observer, const solvers::TurningParts& turning = {});

}  // namespace wavebalance::app
