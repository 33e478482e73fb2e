#include "wavebalance/solvers/structure/contact_mass.hpp"

#include <map>

#include "linalg/dense.hpp"
#include "linalg/index.hpp"

namespace wavebalance::solvers {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

// The directions of contacts, without the columns in which all of them are zero.
struct TouchedPart {
  std::vector<int> columns;    // degrees of freedom
  Eigen::MatrixXd directions;  // contacts x columns
};

TouchedPart touched_part(const LinearStructure& structure, const std::vector<int>& contacts) {
  std::map<int, Eigen::VectorXd> columns;
  for (std::size_t i = 0; i < contacts.size(); ++i)
    for (ContactDirections::InnerIterator entry(structure.contact_directions, contacts[i]); entry; ++entry) {
      const Eigen::VectorXd zero = Eigen::VectorXd::Zero(Index(contacts.size()));
      columns.try_emplace(static_cast<int>(entry.col()), zero).first->second[Index(i)] = entry.value();
    }
  TouchedPart part;
  part.directions.resize(Index(contacts.size()), Index(columns.size()));
  for (const auto& [column, values] : columns) {
    part.directions.col(Index(part.columns.size())) = values;
    part.columns.push_back(column);
  }
  return part;
}

// The rank of `rows`, whose entries are small compared with `size` where they are rounding.
Index rank_of(const Eigen::MatrixXd& rows, double size) {
  constexpr double negligible = 1e-12;
  const auto gram = detail::symmetric_eigen(detail::product_transposed(rows, rows));
  return gram ? (gram->values.array() > negligible * size).count() : 0;
}

bool has_mass(const Sparse& mass, int column) {
  for (Sparse::InnerIterator entry(mass, column); entry; ++entry)
    if (entry.value() != 0.0) return true;
  return false;
}

// Columns that the mass maps to zero; none of a matrix too large for its eigenvectors.
Eigen::MatrixXd null_vectors(const Sparse& mass) {
  constexpr Index most = 400;
  constexpr double negligible = 1e-12;
  if (mass.rows() > most) return Eigen::MatrixXd(mass.rows(), 0);
  const auto eigen = detail::symmetric_eigen(Eigen::MatrixXd(mass));
  if (!eigen) return Eigen::MatrixXd(mass.rows(), 0);
  const double largest = eigen->values.cwiseAbs().maxCoeff();
  return eigen->vectors.leftCols((eigen->values.array() <= negligible * largest).count());
}

}  // namespace

bool contacts_are_massless(const LinearStructure& structure, const std::vector<int>& contacts) {
  if (contacts.empty()) return true;
  const TouchedPart part = touched_part(structure, contacts);
  const double size = part.directions.squaredNorm();
  const Index rank = rank_of(part.directions, size);
  Eigen::MatrixXd without_mass = part.directions;
  for (std::size_t i = 0; i < part.columns.size(); ++i)
    if (has_mass(structure.mass, part.columns[i])) without_mass.col(Index(i)).setZero();
  if (rank_of(without_mass, size) == rank) return true;
  const Eigen::MatrixXd moved = null_vectors(structure.mass)(part.columns, Eigen::all);
  return rank_of(detail::product(part.directions, moved), size) == rank;
}

Eigen::VectorXd compliance_beside_masses(const LinearStructure& structure) {
  std::vector<int> massless;
  for (int i = 0; i < structure.size(); ++i)
    if (!has_mass(structure.mass, i)) massless.push_back(i);
  Eigen::VectorXd compliance = Eigen::VectorXd::Zero(structure.contacts());
  if (massless.empty()) return compliance;
  const Eigen::MatrixXd rows = Eigen::MatrixXd(structure.contact_directions)(Eigen::all, massless);
  const auto count = static_cast<Index>(massless.size());
  std::vector<Index> place(static_cast<std::size_t>(structure.size()), -1);
  for (Index i = 0; i < count; ++i)
    place[static_cast<std::size_t>(massless[static_cast<std::size_t>(i)])] = i;
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(count, count);
  for (Index i = 0; i < count; ++i)
    for (Sparse::InnerIterator entry(structure.stiffness, massless[static_cast<std::size_t>(i)]); entry;
         ++entry)
      if (const Index row = place[static_cast<std::size_t>(entry.row())]; row >= 0)
        stiffness(row, i) = entry.value();
  const detail::Lu<double> held(stiffness);
  if (held.is_singular()) return compliance;
  return rows.cwiseProduct(held.solve(Eigen::MatrixXd(rows.transpose())).transpose()).rowwise().sum();
}

}  // namespace wavebalance::solvers
