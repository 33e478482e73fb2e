#include "structure/modal_form.hpp"

#include <cmath>
#include <limits>
#include <random>

#include "linalg/dense.hpp"

namespace wavebalance::solvers {
namespace {

// The norm of shapes^T A shapes - diag(diagonal) from its products with random signs, whose mean square it
// is. O(n^2).
double diagonal_error(const Eigen::MatrixXd& shapes, const Eigen::SparseMatrix<double>& matrix,
                      const Eigen::VectorXd& diagonal) {
  constexpr int samples = 8;
  std::minstd_rand generator(1);
  const Eigen::MatrixXd signs = Eigen::MatrixXd::NullaryExpr(
      shapes.cols(), samples, [&] { return generator() > generator.max() / 2 ? 1.0 : -1.0; });
  const Eigen::MatrixXd form = detail::transposed_product(shapes, matrix * detail::product(shapes, signs));
  return (form - diagonal.asDiagonal() * signs).norm() / std::sqrt(double(samples));
}

// L L^T of a matrix that is positive definite to working precision: no pivot is rounding of its entry.
std::optional<Eigen::MatrixXd> definite_factor(const Eigen::MatrixXd& matrix) {
  auto factor = detail::cholesky(matrix);
  if (!factor) return std::nullopt;
  const double rounding = 100.0 * double(matrix.rows()) * std::numeric_limits<double>::epsilon();
  const Eigen::ArrayXd pivots = factor->diagonal().array().square();
  if (!(pivots > rounding * matrix.diagonal().array()).all()) return std::nullopt;
  return factor;
}

// Modes of numerator x = ratio denominator x, normalised by the denominator.
bool solve_modes(const Eigen::MatrixXd& numerator, const Eigen::MatrixXd& denominator,
                 Eigen::MatrixXd& shapes, Eigen::VectorXd& ratios) {
  const auto factor = definite_factor(denominator);
  if (!factor) return false;
  const Eigen::MatrixXd scaled = detail::solve_lower(*factor, numerator);
  const auto modes = detail::symmetric_eigen(detail::solve_lower(*factor, scaled.transpose()));
  if (!modes) return false;
  shapes = detail::solve_lower_transposed(*factor, modes->vectors);
  ratios = modes->values;
  return true;
}

}  // namespace

// If K is positive definite the ratios M/K are computed rather than K/M. The lowest modes are then the
// accurate ones, and a contact without mass is a mode like any other.
std::optional<ModalForm> modal_form(const LinearStructure& structure) {
  if (!structure.symmetric()) return std::nullopt;
  const Eigen::MatrixXd mass(structure.mass), stiffness(structure.stiffness);
  ModalForm modes;
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(structure.size());
  if (solve_modes(mass, stiffness, modes.shapes, modes.mass)) {
    modes.stiffness = ones;
  } else if (solve_modes(stiffness, mass, modes.shapes, modes.stiffness)) {
    modes.mass = ones;
  } else {
    return std::nullopt;
  }
  const Eigen::MatrixXd damping = detail::transposed_product(modes.shapes, structure.damping * modes.shapes);
  modes.damping = damping.diagonal();
  Eigen::MatrixXd coupling = damping;
  coupling.diagonal().setZero();
  // A modal damping matrix is computed from modes that are accurate to eps times the spread of their
  // eigenvalues.
  constexpr double tolerance = 1e-8;
  if (coupling.cwiseAbs().maxCoeff() > tolerance * modes.damping.cwiseAbs().maxCoeff()) return std::nullopt;
  modes.errors = {diagonal_error(modes.shapes, structure.mass, modes.mass), coupling.norm(),
                  diagonal_error(modes.shapes, structure.stiffness, modes.stiffness)};
  return modes;
}

}  // namespace wavebalance::solvers
