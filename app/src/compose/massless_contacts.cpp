#include "compose/massless_contacts.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>

#include "wavebalance/fem/eigenmodes.hpp"

namespace wavebalance::app {
namespace {

/// Old coordinates from the new ones, modes and contact displacements: x = Phi q + Psi (u_c - Phi_c q), Psi
/// the residual deflections for unit displacements of the contacts.
Eigen::MatrixXd transformation(const fem::EigenmodesResult& modes, const std::vector<int>& contact_dofs,
                               Eigen::Index kept) {
  const Eigen::Index omitted = modes.shapes.cols() - kept;
  const Eigen::MatrixXd high = modes.shapes.rightCols(omitted);
  const Eigen::MatrixXd scaled =
      high(contact_dofs, Eigen::all) * modes.omega.tail(omitted).cwiseAbs2().cwiseInverse().asDiagonal();
  const Eigen::MatrixXd deflections = high * scaled.transpose();  // n x C, per unit force
  const Eigen::LLT<Eigen::MatrixXd> flexibility(deflections(contact_dofs, Eigen::all));
  if (flexibility.info() != Eigen::Success || !(flexibility.rcond() > 1e-12))
    throw std::invalid_argument(
        "contact.mass = \"redistribute\": the modes beyond the " + std::to_string(kept) +
        " kept do not move all contacts independently; expected fewer contacts or another structure");
  const Eigen::MatrixXd residual = flexibility.solve(deflections.transpose()).transpose();
  Eigen::MatrixXd result(modes.shapes.rows(), kept + residual.cols());
  result.leftCols(kept) =
      modes.shapes.leftCols(kept) - residual * modes.shapes.leftCols(kept)(contact_dofs, Eigen::all);
  result.rightCols(residual.cols()) = residual;
  return result;
}

Eigen::SparseMatrix<double> transformed(const Eigen::SparseMatrix<double>& matrix,
                                        const Eigen::MatrixXd& transformation) {
  const Eigen::MatrixXd product = transformation.transpose() * (matrix * transformation);
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
  const Eigen::VectorXd before = fem::eigenmodes(from.stiffness, from.mass, count).omega;
  const Eigen::VectorXd after = fem::eigenmodes(to.stiffness, to.mass, count).omega;
  return ((after - before).cwiseAbs().array() / before.array()).maxCoeff();
}

void make_contacts_massless(StructureModel& model, int modes) {
  solvers::LinearStructure& structure = model.structure;
  const int contacts = structure.contacts();
  if (modes < 1)
    throw std::invalid_argument("contact.mass = \"redistribute\": " + std::to_string(structure.size()) +
                                " degrees of freedom, " + std::to_string(contacts) +
                                " contacts; expected more degrees of freedom than contacts");
  const auto all = fem::eigenmodes(structure.stiffness, structure.mass, structure.size());
  if (all.status != fem::EigenmodesStatus::converged)
    throw std::runtime_error("contact.mass = \"redistribute\": the eigenvalue solver did not find all modes");
  const Eigen::MatrixXd basis = transformation(all, structure.contact_dofs, modes);
  structure.stiffness = transformed(structure.stiffness, basis);
  structure.damping = transformed(structure.damping, basis);
  structure.load = (basis.transpose() * structure.load).eval();
  Eigen::VectorXd masses = Eigen::VectorXd::Zero(basis.cols());
  masses.head(modes).setOnes();
  structure.mass = Eigen::MatrixXd(masses.asDiagonal()).sparseView();
  std::iota(structure.contact_dofs.begin(), structure.contact_dofs.end(), modes);
  model.recovery = model.reduced() ? Eigen::MatrixXd(model.recovery * basis) : basis;
}

}  // namespace wavebalance::app
