#include "wavebalance/app/compose/massless_contacts.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "compose/symmetric_part.hpp"
#include "wavebalance/fem/eigenmodes.hpp"

namespace wavebalance::app {
namespace {

/// Contacts that a flexibility (C x C) moves independently of one another, by pivoted Cholesky factorisation:
/// obstacles on both sides of one direction count once.
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

/// Old coordinates from the new ones, modes and displacements of independent contacts: x = Phi q + Psi (u_c -
/// S_c Phi q), Psi the residual deflections for unit displacements of these contacts.
Eigen::MatrixXd transformation(const fem::EigenmodesResult& modes,
                               const solvers::ContactDirections& directions, Eigen::Index kept) {
  const Eigen::Index omitted = modes.shapes.cols() - kept;
  const Eigen::MatrixXd low = modes.shapes.leftCols(kept), high = modes.shapes.rightCols(omitted);
  const Eigen::MatrixXd at_contacts = directions * low;
  const Eigen::MatrixXd along = directions * high;
  const Eigen::MatrixXd scaled = along * modes.omega.tail(omitted).cwiseAbs2().cwiseInverse().asDiagonal();
  const Eigen::MatrixXd deflections = high * scaled.transpose();  // n x C, per unit force
  const Eigen::MatrixXd flexibility = directions * deflections;
  const std::vector<Eigen::Index> chosen = independent_contacts(flexibility);
  const Eigen::MatrixXd residual = Eigen::LLT<Eigen::MatrixXd>(flexibility(chosen, chosen))
                                       .solve(deflections(Eigen::all, chosen).transpose())
                                       .transpose();
  Eigen::MatrixXd result(low.rows(), kept + residual.cols());
  result.leftCols(kept) = low - residual * at_contacts(chosen, Eigen::all);
  result.rightCols(residual.cols()) = residual;
  const Eigen::MatrixXd moved_by_modes = directions * result.leftCols(kept);
  constexpr double rounding = 1e-9;
  if (!(moved_by_modes.norm() <= rounding * at_contacts.norm()))
    throw std::invalid_argument(
        "contact.mass = \"redistribute\": the modes beyond the " + std::to_string(kept) +
        " kept do not move all contacts independently; expected fewer contacts or another structure");
  return result;
}

Eigen::SparseMatrix<double> transformed(const Eigen::SparseMatrix<double>& matrix,
                                        const Eigen::MatrixXd& transformation) {
  const Eigen::MatrixXd product = transformation.transpose() * (matrix * transformation);
  if (!solvers::is_symmetric(matrix)) return product.sparseView();
  return (0.5 * (product + product.transpose())).sparseView();
}

}  // namespace

double frequency_change(const solvers::LinearStructure& from, const solvers::LinearStructure& to) {
  constexpr int first = 10, most = 1000;
  const auto moving = [](const solvers::LinearStructure& structure) {
    const Eigen::VectorXd masses = structure.mass.diagonal();
    return static_cast<int>((masses.array() != 0.0).count());
  };
  if (from.size() > most) return std::numeric_limits<double>::quiet_NaN();
  const int count = std::min({first, moving(from), moving(to)});
  const Eigen::VectorXd before = fem::eigenmodes(symmetric_part(from.stiffness), from.mass, count).omega;
  const Eigen::VectorXd after = fem::eigenmodes(symmetric_part(to.stiffness), to.mass, count).omega;
  return ((after - before).cwiseAbs().array() / before.array()).maxCoeff();
}

void make_contacts_massless(StructureModel& model, int modes) {
  solvers::LinearStructure& structure = model.structure;
  const int contacts = structure.contacts();
  if (modes < 1)
    throw std::invalid_argument("contact.mass = \"redistribute\": " + std::to_string(structure.size()) +
                                " degrees of freedom, " + std::to_string(contacts) +
                                " contacts; expected more degrees of freedom than contacts");
  const auto all = fem::eigenmodes(symmetric_part(structure.stiffness), structure.mass, structure.size());
  if (all.status != fem::EigenmodesStatus::converged)
    throw std::runtime_error("contact.mass = \"redistribute\": the eigenvalue solver did not find all modes");
  const Eigen::MatrixXd basis = transformation(all, structure.contact_directions, modes);
  structure.stiffness = transformed(structure.stiffness, basis);
  structure.damping = transformed(structure.damping, basis);
  structure.transform_loads(basis);
  Eigen::VectorXd masses = Eigen::VectorXd::Zero(basis.cols());
  masses.head(modes).setOnes();
  structure.mass = Eigen::MatrixXd(masses.asDiagonal()).sparseView();
  // Contacts have no part in the modes but for rounding.
  Eigen::MatrixXd directions = structure.contact_directions * basis;
  directions.leftCols(modes).setZero();
  structure.contact_directions = directions.sparseView(1.0, 1e-12);
  model.recovery = model.reduced() ? Eigen::MatrixXd(model.recovery * basis) : basis;
}

}  // namespace wavebalance::app
