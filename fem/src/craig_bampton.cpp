#include "wavebalance/fem/craig_bampton.hpp"

#include <stdexcept>
#include <string>
#include <vector>

#include "shift_invert.hpp"
#include "wavebalance/fem/assembly.hpp"

namespace wavebalance::fem {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

void require(bool valid, const std::string& message) {
  if (!valid) throw std::invalid_argument("craig_bampton: " + message);
}

void require_matrix(const Sparse& matrix, const char* name, Eigen::Index size) {
  require(matrix.rows() == size && matrix.cols() == size,
          std::string(name) + " is " + std::to_string(matrix.rows()) + " x " + std::to_string(matrix.cols()) +
              "; it must be " + std::to_string(size) + " x " + std::to_string(size));
  detail::require_symmetric(matrix, "craig_bampton", name);
}

void validate(const Matrices& matrices, std::span<const int> boundary, const CraigBamptonOptions& options) {
  const Eigen::Index size = matrices.stiffness.rows();
  require_matrix(matrices.stiffness, "stiffness", size);
  require_matrix(matrices.mass, "mass", size);
  if (matrices.damping.size() > 0) require_matrix(matrices.damping, "damping", size);
  std::vector<bool> seen(static_cast<std::size_t>(size), false);
  for (int unknown : boundary) {
    require(unknown >= 0 && unknown < size,
            "boundary has " + std::to_string(unknown) + "; it must be in 0.." + std::to_string(size - 1));
    require(!seen[static_cast<std::size_t>(unknown)], "boundary has " + std::to_string(unknown) + " twice");
    seen[static_cast<std::size_t>(unknown)] = true;
  }
  const Eigen::Index interior = size - static_cast<Eigen::Index>(boundary.size());
  require(interior >= 1, "boundary holds every unknown; nothing is left to reduce");
  require(options.modes >= 0 && options.modes <= interior,
          "modes is " + std::to_string(options.modes) + "; it must be in 0.." + std::to_string(interior));
  require(options.solver.shift == 0.0, "solver.shift must be 0");
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

EigenmodesResult fixed_interface_modes(const detail::SymmetricFactor& factor, const Sparse& stiffness,
                                       const Sparse& mass, const CraigBamptonOptions& options) {
  const Eigen::Index size = stiffness.rows();
  if (options.modes == 0) return {EigenmodesStatus::converged, {}, {}, Eigen::MatrixXd(size, 0), {}};
  const bool dense =
      size <= options.solver.dense_up_to || 2 * static_cast<Eigen::Index>(options.modes) >= size;
  return dense ? eigenmodes(stiffness, mass, options.modes, options.solver)
               : detail::sparse_eigenmodes(factor, stiffness, mass, options.modes, options.solver);
}

Eigen::MatrixXd transformation(const FreeDofs& dofs, std::span<const int> boundary,
                               const Eigen::MatrixXd& constraint_modes, const Eigen::MatrixXd& shapes) {
  const auto held = static_cast<Eigen::Index>(boundary.size());
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(dofs.dofs(), held + shapes.cols());
  for (Eigen::Index i = 0; i < held; ++i) result(boundary[static_cast<std::size_t>(i)], i) = 1.0;
  for (int i = 0; i < dofs.count(); ++i) {
    const int row = dofs.free()[static_cast<std::size_t>(i)];
    result.row(row).head(held) = constraint_modes.row(i);
    result.row(row).tail(shapes.cols()) = shapes.row(i);
  }
  return result;
}

// The blocks that are known exactly replace what rounding made of them.
void clean(CraigBampton& reduced) {
  const Eigen::Index held = reduced.boundary.size(), modes = reduced.omega.size();
  reduced.stiffness.topRightCorner(held, modes).setZero();
  reduced.stiffness.bottomLeftCorner(modes, held).setZero();
  reduced.stiffness.bottomRightCorner(modes, modes) = reduced.omega.cwiseAbs2().asDiagonal();
  reduced.mass.bottomRightCorner(modes, modes).setIdentity();
}

}  // namespace

Eigen::MatrixXd CraigBampton::project(const Sparse& matrix) const {
  require(matrix.rows() == transformation.rows() && matrix.cols() == transformation.rows(),
          "the matrix to project is " + std::to_string(matrix.rows()) + " x " +
              std::to_string(matrix.cols()) + "; the structure has " + std::to_string(transformation.rows()) +
              " unknowns");
  const Eigen::MatrixXd projected = transformation.transpose() * (matrix * transformation);
  return (projected + projected.transpose()) / 2.0;
}

Eigen::VectorXd CraigBampton::project_load(const Eigen::VectorXd& load) const {
  require(load.size() == transformation.rows(), "the load has size " + std::to_string(load.size()) +
                                                    "; the structure has " +
                                                    std::to_string(transformation.rows()) + " unknowns");
  return transformation.transpose() * load;
}

Eigen::VectorXd CraigBampton::recover(const Eigen::VectorXd& coordinates) const {
  require(coordinates.size() == transformation.cols(), "there are " + std::to_string(coordinates.size()) +
                                                           " coordinates; there must be " +
                                                           std::to_string(transformation.cols()));
  return transformation * coordinates;
}

CraigBampton craig_bampton(const Matrices& matrices, std::span<const int> boundary,
                           const CraigBamptonOptions& options) {
  validate(matrices, boundary, options);
  const FreeDofs dofs(static_cast<int>(matrices.stiffness.rows()), boundary);
  const Partition stiffness = partition(matrices.stiffness, dofs, boundary);
  const detail::SymmetricFactor factor(stiffness.interior);
  if (!factor.positive_definite())
    throw std::domain_error(
        "craig_bampton: the stiffness is not positive definite with the boundary held; the structure can "
        "move freely or has an indefinite stiffness");
  const EigenmodesResult modes =
      fixed_interface_modes(factor, stiffness.interior, partition(matrices.mass, dofs, {}).interior, options);
  CraigBampton reduced;
  reduced.status = modes.status;
  reduced.boundary =
      Eigen::Map<const Eigen::VectorXi>(boundary.data(), static_cast<Eigen::Index>(boundary.size()));
  reduced.omega = modes.omega;
  reduced.transformation = transformation(dofs, boundary, -factor.solve(stiffness.coupling), modes.shapes);
  reduced.stiffness = reduced.project(matrices.stiffness);
  reduced.mass = reduced.project(matrices.mass);
  const Eigen::Index size = reduced.stiffness.rows();
  reduced.damping = matrices.damping.size() > 0 ? reduced.project(matrices.damping)
                                                : Eigen::MatrixXd(Eigen::MatrixXd::Zero(size, size));
  clean(reduced);
  return reduced;
}

}  // namespace wavebalance::fem
