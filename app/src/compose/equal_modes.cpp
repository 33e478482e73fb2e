#include "compose/equal_modes.hpp"

#include <cmath>

#include "wavebalance/fem/eigenmodes.hpp"

namespace wavebalance::app {
namespace {

/// Turns the modes from `begin` to `end` by the eigenvectors of G = (S Phi)^T S Phi, the largest first: the
/// modes of v = omega^2 (G + d) v in ascending order, for any d that makes G + d definite.
void turn(StructureModes& modes, Eigen::Index begin, Eigen::Index end) {
  const Eigen::Index count = end - begin;
  const Eigen::MatrixXd contacts = modes.model.contact_shapes.middleCols(begin, count);
  Eigen::MatrixXd squares = contacts.transpose() * contacts;
  const double largest = squares.trace();
  if (!(largest > 0.0)) return;
  squares.diagonal().array() += largest;
  Eigen::SparseMatrix<double> identity(count, count);
  identity.setIdentity();
  const auto found = fem::eigenmodes(identity, squares.sparseView(), static_cast<int>(count));
  if (found.status != fem::EigenmodesStatus::converged) return;
  const Eigen::MatrixXd turned = found.shapes * found.omega.cwiseInverse().asDiagonal();
  const Eigen::VectorXd frequencies = modes.model.omega_squared.segment(begin, count);
  modes.shapes.middleCols(begin, count) *= turned;
  modes.model.contact_shapes.middleCols(begin, count) = contacts * turned;
  modes.model.omega_squared.segment(begin, count) = turned.cwiseAbs2().transpose() * frequencies;
}

}  // namespace

void separate_equal_modes(StructureModes& modes) {
  const Eigen::VectorXd omega = modes.model.omega_squared.cwiseSqrt();
  const Eigen::Index last = omega.size() - modes.model.springs;
  for (Eigen::Index begin = 0; begin < last;) {
    Eigen::Index end = begin + 1;
    while (end < last && omega[end] - omega[begin] <= equal_frequencies * omega[end]) ++end;
    if (end > begin + 1) turn(modes, begin, end);
    begin = end;
  }
}

}  // namespace wavebalance::app
