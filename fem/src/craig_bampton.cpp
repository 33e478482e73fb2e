#include "wavebalance/fem/craig_bampton.hpp"

#include "dense.hpp"
#include "require.hpp"
#include "shift_invert.hpp"
#include "sparse_product.hpp"
#include "wavebalance/fem/assembly.hpp"
#include "wavebalance/fem/check_structure.hpp"

namespace wavebalance::fem {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Directions = Eigen::SparseMatrix<double, Eigen::RowMajor>;

void require_matrix(const Sparse& matrix, const char* name, Eigen::Index size) {
  detail::require_square(matrix, "craig_bampton", name, size);
  detail::require_symmetric(matrix, "craig_bampton", name);
}

void validate(const Matrices& matrices, std::span<const int> boundary, const CraigBamptonOptions& options) {
  const Eigen::Index size = matrices.stiffness.rows();
  require_matrix(matrices.stiffness, "stiffness", size);
  require_matrix(matrices.mass, "mass", size);
  if (matrices.damping.size() > 0) require_matrix(matrices.damping, "damping", size);
  check_unknowns(boundary, static_cast<int>(size), "craig_bampton: boundary");
  const Eigen::Index interior = size - static_cast<Eigen::Index>(boundary.size());
  detail::require(interior >= 1, "craig_bampton", "boundary holds all unknowns; it must leave at least 1");
  detail::require_value(options.modes >= 0 && options.modes <= interior, "craig_bampton", "modes",
                        options.modes, "in 0.." + std::to_string(interior));
  detail::require_value(options.solver.shift == 0.0, "craig_bampton", "solver.shift", options.solver.shift,
                        "0");
}

// The block of the interior, and the columns of the boundary with interior rows.
struct Partition {
  Sparse interior;
  Eigen::MatrixXd coupling;
};

Partition partition(const Sparse& matrix, const FreeDofs& dofs, std::span<const int> boundary) {
  Partition parts{Sparse(dofs.count(), dofs.count()),
                  Eigen::MatrixXd::Zero(dofs.count(), static_cast<Eigen::Index>(boundary.size()))};
  parts.interior.reserve(matrix.nonZeros());
  for (int column = 0; column < dofs.count(); ++column) {
    parts.interior.startVec(column);
    for (Sparse::InnerIterator entry(matrix, dofs.free()[static_cast<std::size_t>(column)]); entry; ++entry) {
      const int row = dofs.unknown(static_cast<int>(entry.row()));
      if (row >= 0) parts.interior.insertBack(row, column) = entry.value();
    }
  }
  parts.interior.finalize();
  for (std::size_t column = 0; column < boundary.size(); ++column)
    for (Sparse::InnerIterator entry(matrix, boundary[column]); entry; ++entry) {
      const int row = dofs.unknown(static_cast<int>(entry.row()));
      if (row >= 0) parts.coupling(row, static_cast<Eigen::Index>(column)) = entry.value();
    }
  return parts;
}

/// A share of the whole progress, for a part of the work; empty if there is no observer.
Observer part_of(const Observer& observer, double first, double last) {
  if (!observer) return {};
  return [&observer, first, last](std::string_view phase, double done) {
    return observer(phase, first + (last - first) * done);
  };
}

EigenmodesResult fixed_interface_modes(const detail::SymmetricFactor& factor, const Sparse& stiffness,
                                       const Sparse& mass, const CraigBamptonOptions& options) {
  const Eigen::Index size = stiffness.rows();
  if (options.modes == 0) return {EigenmodesStatus::converged, {}, {}, Eigen::MatrixXd(size, 0), {}};
  const bool dense =
      size <= options.solver.dense_up_to || 2 * static_cast<Eigen::Index>(options.modes) >= size;
  EigenmodesOptions solver = options.solver;
  solver.observer = part_of(options.observer, 0.35, 0.9);
  return dense ? eigenmodes(stiffness, mass, options.modes, solver)
               : detail::sparse_eigenmodes(factor, stiffness, mass, options.modes, solver);
}

/// Constraint modes and fixed-interface modes, both with the rows of the interior.
struct InteriorModes {
  Eigen::MatrixXd constraint;
  EigenmodesResult fixed;
};

// Holds the factor no longer than it is needed.
InteriorModes interior_modes(const Matrices& matrices, const FreeDofs& dofs, std::span<const int> boundary,
                             const CraigBamptonOptions& options) {
  const auto go_on = [&](std::string_view phase, double done) {
    return !options.observer || options.observer(phase, done);
  };
  InteriorModes modes{{}, {EigenmodesStatus::cancelled, {}, {}, {}, {}}};
  Partition stiffness = partition(matrices.stiffness, dofs, boundary);
  if (!go_on("factorising the stiffness", 0.02)) return modes;
  const detail::SymmetricFactor factor(stiffness.interior);
  if (!factor.positive_definite())
    throw std::domain_error(
        "craig_bampton: the stiffness is not positive definite with the boundary held; the structure can "
        "move freely or has an indefinite stiffness");
  if (!go_on("constraint modes", 0.25)) return modes;
  modes.constraint = -factor.solve(stiffness.coupling);
  stiffness.coupling.resize(0, 0);
  if (!go_on("modes", 0.35)) return modes;
  modes.fixed =
      fixed_interface_modes(factor, stiffness.interior, partition(matrices.mass, dofs, {}).interior, options);
  if (modes.fixed.status != EigenmodesStatus::cancelled && !go_on("projecting the matrices", 0.9))
    modes.fixed.status = EigenmodesStatus::cancelled;
  return modes;
}

Eigen::MatrixXd transformation(const FreeDofs& dofs, std::span<const int> boundary,
                               const Eigen::MatrixXd& constraint_modes, const Eigen::MatrixXd& shapes) {
  const auto held = static_cast<Eigen::Index>(boundary.size());
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(dofs.dofs(), held + shapes.cols());
  for (Eigen::Index i = 0; i < held; ++i) result(boundary[static_cast<std::size_t>(i)], i) = 1.0;
  result(dofs.free(), Eigen::seqN(0, held)) = constraint_modes;
  result(dofs.free(), Eigen::seqN(held, shapes.cols())) = shapes;
  return result;
}

// Sets the blocks that are known exactly, which rounding has changed.
void clean(CraigBampton& reduced) {
  const Eigen::Index held = reduced.boundary.size(), modes = reduced.omega.size();
  reduced.stiffness.topRightCorner(held, modes).setZero();
  reduced.stiffness.bottomLeftCorner(modes, held).setZero();
  reduced.stiffness.bottomRightCorner(modes, modes) = reduced.omega.cwiseAbs2().asDiagonal();
  reduced.mass.bottomRightCorner(modes, modes).setIdentity();
}

}  // namespace

Eigen::MatrixXd CraigBampton::project(const Sparse& matrix) const {
  detail::require_square(matrix, "CraigBampton::project", "matrix", transformation.rows());
  return detail::projection(matrix, transformation);
}

Eigen::VectorXd CraigBampton::project_load(const Eigen::VectorXd& load) const {
  detail::require_count("CraigBampton::project_load", "the size of load", load.size(), transformation.rows());
  return transformation.transpose() * load;
}

Directions CraigBampton::project_directions(const Directions& directions) const {
  detail::require_count("CraigBampton::project_directions", "the number of columns of directions",
                        directions.cols(), transformation.rows());
  std::vector<int> place(static_cast<std::size_t>(directions.cols()), -1);
  for (int i = 0; i < boundary.size(); ++i) place[static_cast<std::size_t>(boundary[i])] = i;
  std::vector<Eigen::Triplet<double>> entries;
  for (int row = 0; row < directions.outerSize(); ++row)
    for (Directions::InnerIterator entry(directions, row); entry; ++entry) {
      if (entry.value() == 0.0) continue;
      const int column = place[static_cast<std::size_t>(entry.col())];
      detail::require_value(column >= 0, "CraigBampton::project_directions", "an unknown that is touched",
                            static_cast<double>(entry.col()), "on the boundary");
      entries.emplace_back(row, column, entry.value());
    }
  Directions projected(directions.rows(), transformation.cols());
  projected.setFromTriplets(entries.begin(), entries.end());
  return projected;
}

std::vector<int> touched_unknowns(const Directions& directions) {
  std::vector<int> touched;
  std::vector<bool> known(static_cast<std::size_t>(directions.cols()), false);
  for (int row = 0; row < directions.outerSize(); ++row)
    for (Directions::InnerIterator entry(directions, row); entry; ++entry) {
      const auto unknown = static_cast<std::size_t>(entry.col());
      if (entry.value() == 0.0 || known[unknown]) continue;
      known[unknown] = true;
      touched.push_back(static_cast<int>(entry.col()));
    }
  return touched;
}

Eigen::VectorXd CraigBampton::recover(const Eigen::VectorXd& coordinates) const {
  detail::require_count("CraigBampton::recover", "the size of coordinates", coordinates.size(),
                        transformation.cols());
  return transformation * coordinates;
}

CraigBampton craig_bampton(const Matrices& matrices, std::span<const int> boundary,
                           const CraigBamptonOptions& options) {
  validate(matrices, boundary, options);
  const FreeDofs dofs(static_cast<int>(matrices.stiffness.rows()), boundary);
  CraigBampton reduced;
  {
    InteriorModes modes = interior_modes(matrices, dofs, boundary, options);
    reduced.status = modes.fixed.status;
    if (reduced.status == EigenmodesStatus::cancelled) return reduced;
    reduced.omega = modes.fixed.omega;
    reduced.transformation = transformation(dofs, boundary, modes.constraint, modes.fixed.shapes);
  }
  reduced.boundary = Eigen::Map<const Eigen::VectorXi>(boundary.data(), std::ssize(boundary));
  reduced.stiffness = reduced.project(matrices.stiffness);
  reduced.mass = reduced.project(matrices.mass);
  const Eigen::Index size = reduced.stiffness.rows();
  reduced.damping = matrices.damping.size() > 0 ? reduced.project(matrices.damping)
                                                : Eigen::MatrixXd(Eigen::MatrixXd::Zero(size, size));
  clean(reduced);
  return reduced;
}

}  // namespace wavebalance::fem
