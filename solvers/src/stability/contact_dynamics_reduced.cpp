#include "stability/contact_dynamics_reduced.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <vector>

#include "linalg/dense.hpp"
#include "linalg/index.hpp"
#include "linalg/sparse.hpp"

namespace wavebalance::solvers {
namespace {

// Appends what `block` adds to the K-orthonormal columns of `basis`, orthogonalised twice, up to the columns
// of `basis` in all; returns how many columns there are then.
Index append_orthonormal(const Eigen::SparseMatrix<double>& stiffness, const Eigen::MatrixXd& block,
                         Eigen::MatrixXd& basis, Index count) {
  for (Index column = 0; column < block.cols() && count < basis.cols(); ++column) {
    Eigen::VectorXd vector = block.col(column);
    const double before = std::sqrt(vector.dot(stiffness * vector));
    for (int pass = 0; pass < 2; ++pass) {
      const Eigen::VectorXd parts = basis.leftCols(count).transpose() * (stiffness * vector);
      vector -= basis.leftCols(count) * parts;
    }
    const double after = std::sqrt(std::max(0.0, vector.dot(stiffness * vector)));
    if (!(after > 1e-12 * before)) continue;
    basis.col(count++) = vector / after;
  }
  return count;
}

LinearStructure projected(const LinearStructure& structure, const Eigen::MatrixXd& basis) {
  const auto project = [&](const Eigen::SparseMatrix<double>& matrix) -> Eigen::SparseMatrix<double> {
    return detail::transposed_product(basis, matrix * basis).sparseView();
  };
  LinearStructure result{
      project(structure.mass),
      project(structure.damping),
      structure.symmetric()
          ? Eigen::MatrixXd(Eigen::MatrixXd::Identity(basis.cols(), basis.cols())).sparseView()
          : project(structure.stiffness),
      basis.transpose() * structure.load,
      {}};
  const Eigen::MatrixXd directions = structure.contact_directions * basis;
  result.contact_directions = directions.sparseView();
  return result;
}

Eigen::MatrixXd beside(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  Eigen::MatrixXd both(a.rows(), a.cols() + b.cols());
  both << a, b;
  return both;
}

}  // namespace

LinearStructure krylov_reduction(const LinearStructure& structure, int vectors) {
  const bool symmetric = structure.symmetric();
  Eigen::SparseMatrix<double> metric = structure.stiffness;
  if (!symmetric) metric = 0.5 * (metric + Eigen::SparseMatrix<double>(metric.transpose()));
  const detail::PositiveFactor factor(metric);
  if (!factor.exists())
    throw std::invalid_argument("ContactDynamics: stiffness (" + std::to_string(structure.size()) +
                                " degrees of freedom) is not positive definite; a structure that is reduced "
                                "must be held, or max_size must be at least its size");
  std::optional<detail::SparseLu> lu;  // not singular, since its symmetric part is definite
  if (!symmetric) lu.emplace(structure.stiffness);
  Eigen::MatrixXd basis(structure.size(), std::min<Index>(vectors, structure.size()));
  const Eigen::MatrixXd forces = structure.contact_directions.transpose();
  Eigen::MatrixXd block =
      symmetric ? factor.solve(forces) : beside(lu->solve(forces), lu->solve_transposed(forces));
  Index count = append_orthonormal(metric, block, basis, 0), start = 0;
  while (count < basis.cols() && count > start) {
    const Eigen::MatrixXd last = basis.middleCols(start, count - start), inertia = structure.mass * last;
    block = symmetric ? factor.solve(inertia)
                      : beside(lu->solve(inertia), lu->solve(Eigen::MatrixXd(structure.damping * last)));
    start = count;
    count = append_orthonormal(metric, block, basis, count);
  }
  return projected(structure, basis.leftCols(count));
}

StaticCondensation without_massless(const LinearStructure& structure) {
  const Eigen::MatrixXd mass(structure.mass), damping(structure.damping), stiffness(structure.stiffness);
  std::vector<int> kept, removed;
  for (int i = 0; i < structure.size(); ++i)
    (mass.row(i).isZero(0.0) && damping.row(i).isZero(0.0) && damping.col(i).isZero(0.0) ? removed : kept)
        .push_back(i);
  StaticCondensation result{structure, Eigen::MatrixXd(structure.contact_directions),
                            Eigen::MatrixXd::Zero(structure.contacts(), structure.contacts())};
  if (removed.empty()) return result;
  const detail::Lu<double> held(stiffness(removed, removed));
  if (held.is_singular(1e-14))
    throw std::invalid_argument("ContactDynamics: " + std::to_string(removed.size()) +
                                " degrees of freedom have neither mass nor damping and are not held by a "
                                "stiffness; each must be");
  const Eigen::MatrixXd directions(structure.contact_directions);
  const Eigen::MatrixXd on_removed = directions(Eigen::all, removed);
  const Eigen::MatrixXd coupling = held.solve(Eigen::MatrixXd(stiffness(removed, kept)));
  result.compliance = detail::product(on_removed, held.solve(Eigen::MatrixXd(on_removed.transpose())));
  LinearStructure& rest = result.structure;
  rest.forces.clear();  // perturbations of a motion do not depend on its load
  rest.mass = Eigen::MatrixXd(mass(kept, kept)).sparseView();
  rest.damping = Eigen::MatrixXd(damping(kept, kept)).sparseView();
  rest.stiffness = Eigen::MatrixXd(stiffness(kept, kept) -
                                   detail::product(Eigen::MatrixXd(stiffness(kept, removed)), coupling))
                       .sparseView();
  rest.load = Eigen::VectorXd(structure.load(kept));
  const Eigen::MatrixXd seen = directions(Eigen::all, kept) - detail::product(on_removed, coupling);
  rest.contact_directions = seen.sparseView();
  const Eigen::MatrixXd force_coupling =
      held.solve_transposed(Eigen::MatrixXd(stiffness(kept, removed).transpose()));
  result.left_directions = directions(Eigen::all, kept) - detail::product(on_removed, force_coupling);
  return result;
}

}  // namespace wavebalance::solvers
