#include "wavebalance/solvers/structure/massless_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "linalg/dense.hpp"

namespace wavebalance::solvers {
namespace {

[[noreturn]] void refuse(Eigen::Index kept) {
  throw std::invalid_argument(
      "contact.mass = \"redistribute\": the modes beyond the " + std::to_string(kept) +
      " kept do not move all contacts independently; expected fewer contacts or another structure");
}

// Contacts that a flexibility (C x C) moves independently of one another, by pivoted Cholesky factorisation:
// obstacles on both sides of one direction count once.
std::vector<Eigen::Index> independent_contacts(Eigen::MatrixXd flexibility) {
  constexpr double negligible = 1e-12;
  const Eigen::VectorXd sizes = flexibility.diagonal();
  std::vector<Eigen::Index> chosen;
  while (static_cast<Eigen::Index>(chosen.size()) < sizes.size()) {
    Eigen::Index pivot = 0;
    if (!(flexibility.diagonal().cwiseQuotient(sizes).maxCoeff(&pivot) > negligible)) break;
    chosen.push_back(pivot);
    const Eigen::VectorXd column = flexibility.col(pivot) / std::sqrt(flexibility(pivot, pivot));
    flexibility -= column * column.transpose();
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

// Old coordinates from the new ones, modes and displacements of independent contacts: x = Phi q + Psi (u_c -
// S_c Phi q), Psi the residual deflections for unit displacements of these contacts.
Eigen::MatrixXd transformation(const Eigen::VectorXd& omega, const Eigen::MatrixXd& shapes,
                               const ContactDirections& directions, Eigen::Index kept) {
  const Eigen::Index omitted = shapes.cols() - kept;
  const Eigen::MatrixXd low = shapes.leftCols(kept), high = shapes.rightCols(omitted);
  const Eigen::MatrixXd at_contacts = directions * low;
  const Eigen::MatrixXd along = directions * high;
  const Eigen::MatrixXd scaled = along * omega.tail(omitted).cwiseAbs2().cwiseInverse().asDiagonal();
  const Eigen::MatrixXd deflections = high * scaled.transpose();  // n x C, per unit force
  const Eigen::MatrixXd flexibility = directions * deflections;
  const std::vector<Eigen::Index> chosen = independent_contacts(flexibility);
  const auto lower = detail::cholesky(flexibility(chosen, chosen));
  if (!lower) refuse(kept);
  const Eigen::MatrixXd unit = detail::solve_lower(*lower, deflections(Eigen::all, chosen).transpose()),
                        residual = detail::solve_lower_transposed(*lower, unit).transpose();
  Eigen::MatrixXd result(low.rows(), kept + residual.cols());
  result.leftCols(kept) = low - residual * at_contacts(chosen, Eigen::all);
  result.rightCols(residual.cols()) = residual;
  const Eigen::MatrixXd moved_by_modes = directions * result.leftCols(kept);
  constexpr double rounding = 1e-9;
  if (!(moved_by_modes.norm() <= rounding * at_contacts.norm())) refuse(kept);
  return result;
}

Eigen::SparseMatrix<double> transformed(const Eigen::SparseMatrix<double>& matrix,
                                        const Eigen::MatrixXd& transformation) {
  const Eigen::MatrixXd product = transformation.transpose() * (matrix * transformation);
  if (!is_symmetric(matrix)) return product.sparseView();
  return (0.5 * (product + product.transpose())).sparseView();
}

}  // namespace

MasslessContacts with_massless_contacts(LinearStructure structure, int modes, const Eigen::VectorXd& omega,
                                        const Eigen::MatrixXd& shapes) {
  if (modes < 1)
    throw std::invalid_argument(
        "contacts without mass, as a rigid law without restitution and contact.mass = \"redistribute\" need "
        "them: " +
        std::to_string(structure.size()) + " degrees of freedom, " + std::to_string(structure.contacts()) +
        " contacts; expected more degrees of freedom than contacts, a restitution, or another law with mass");
  Eigen::MatrixXd basis = transformation(omega, shapes, structure.contact_directions, modes);
  structure.stiffness = transformed(structure.stiffness, basis);
  structure.damping = transformed(structure.damping, basis);
  for (auto* part : {&structure.turning.gyroscopic, &structure.turning.stiffness})
    if (part->size() > 0) *part = transformed(*part, basis);
  structure.transform_loads(basis);
  Eigen::VectorXd masses = Eigen::VectorXd::Zero(basis.cols());
  masses.head(modes).setOnes();
  structure.mass = Eigen::MatrixXd(masses.asDiagonal()).sparseView();
  // Contacts have no part in the modes but for rounding.
  Eigen::MatrixXd directions = structure.contact_directions * basis;
  directions.leftCols(modes).setZero();
  structure.contact_directions = directions.sparseView(1.0, 1e-12);
  return {std::move(structure), std::move(basis)};
}

}  // namespace wavebalance::solvers
