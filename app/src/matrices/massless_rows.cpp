#include "matrices/massless_rows.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace wavebalance::app {
namespace {

using SparseMatrix = Eigen::SparseMatrix<double>;

constexpr std::size_t most_condensed = 2000;  // of either part; their matrices are dense

/// Rows from 0 without an entry other than zero.
std::vector<int> rows_without_mass(const SparseMatrix& mass) {
  Eigen::VectorXd largest = Eigen::VectorXd::Zero(mass.rows());
  for (int column = 0; column < mass.outerSize(); ++column)
    for (SparseMatrix::InnerIterator entry(mass, column); entry; ++entry)
      largest[entry.row()] = std::max(largest[entry.row()], std::abs(entry.value()));
  std::vector<int> rows;
  for (Eigen::Index row = 0; row < largest.size(); ++row)
    if (largest[row] == 0.0) rows.push_back(static_cast<int>(row));
  return rows;
}

/// The unknowns with and without mass.
struct Parts {
  std::vector<int> with, without;
};

Parts parts_of(const SparseMatrix& mass) {
  Parts parts{{}, rows_without_mass(mass)};
  for (int row = 0; row < mass.rows(); ++row)
    if (!std::ranges::binary_search(parts.without, row)) parts.with.push_back(row);
  return parts;
}

/// [A_a; A_b]^T [I; T] of a matrix with the rows of all unknowns: its part of those with mass, and what the
/// others pass on.
SparseMatrix condensed_rows(const SparseMatrix& matrix, const Parts& parts, const Eigen::MatrixXd& follow,
                            const std::vector<int>& columns) {
  const Eigen::MatrixXd of_without(matrix_part(matrix, parts.without, columns));
  const Eigen::MatrixXd sum =
      Eigen::MatrixXd(matrix_part(matrix, parts.with, columns)) + follow.transpose() * of_without;
  return sum.sparseView();
}

/// [I; T]^T A [I; T] of a symmetric A.
SparseMatrix condensed(const SparseMatrix& matrix, const Parts& parts, const Eigen::MatrixXd& follow) {
  const Eigen::MatrixXd ab(matrix_part(matrix, parts.with, parts.without));
  const Eigen::MatrixXd bb(matrix_part(matrix, parts.without, parts.without));
  const Eigen::MatrixXd across = ab * follow;
  const Eigen::MatrixXd sum = Eigen::MatrixXd(matrix_part(matrix, parts.with, parts.with)) + across +
                              across.transpose() + follow.transpose() * (bb * follow);
  return Eigen::MatrixXd(0.5 * (sum + sum.transpose())).sparseView();
}

/// Whether a damping acts on the rows without mass as they follow the others.
bool resists(const SparseMatrix& damping, const Parts& parts, const Eigen::MatrixXd& follow) {
  if (damping.size() == 0) return false;
  const Eigen::MatrixXd ba(matrix_part(damping, parts.without, parts.with));
  const Eigen::MatrixXd bb(matrix_part(damping, parts.without, parts.without));
  constexpr double rounding = 1e-9;
  return (ba + bb * follow).norm() > rounding * (ba.norm() + (bb * follow).norm());
}

std::vector<int> all_columns(const SparseMatrix& matrix) {
  std::vector<int> columns(static_cast<std::size_t>(matrix.cols()));
  for (std::size_t i = 0; i < columns.size(); ++i) columns[i] = static_cast<int>(i);
  return columns;
}

std::vector<int> chosen(const std::vector<int>& values, const std::vector<int>& places) {
  std::vector<int> result;
  for (const int place : places) result.push_back(values[std::size_t(place)]);
  return result;
}

}  // namespace

SparseMatrix matrix_part(const SparseMatrix& matrix, const std::vector<int>& rows,
                         const std::vector<int>& columns) {
  std::vector<int> place(static_cast<std::size_t>(matrix.rows()), -1);
  for (std::size_t i = 0; i < rows.size(); ++i) place[std::size_t(rows[i])] = static_cast<int>(i);
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t j = 0; j < columns.size(); ++j)
    for (SparseMatrix::InnerIterator entry(matrix, columns[j]); entry; ++entry)
      if (const int row = place[std::size_t(entry.row())]; row >= 0)
        entries.emplace_back(row, static_cast<int>(j), entry.value());
  SparseMatrix result(std::ssize(rows), std::ssize(columns));
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

void condense_massless_rows(StructureFiles& files) {
  if (files.unsymmetric || files.free) return;
  const Parts parts = parts_of(files.matrices.mass);
  if (parts.without.empty() || parts.with.empty()) return;
  if (files.turns_along_curve && files.spin_stiffness.size() > 0)
    throw StructureFault(
        "structure.mass",
        "there are rows without mass, which follow the others by a stiffness that "
        "structure.spin_stiffness changes along the sweep; expected a consistent mass matrix, or "
        "structure.spin_speed > 0");
  if (std::max(parts.with.size(), parts.without.size()) > most_condensed) return;
  const fem::Matrices& whole = files.matrices;
  if (!solvers::is_symmetric(whole.stiffness) ||
      (whole.damping.size() > 0 && !solvers::is_symmetric(whole.damping)))
    return;
  const Eigen::LLT<Eigen::MatrixXd> held{
      Eigen::MatrixXd(matrix_part(whole.stiffness, parts.without, parts.without))};
  if (held.info() != Eigen::Success) return;
  const Eigen::MatrixXd follow =
      -held.solve(Eigen::MatrixXd(matrix_part(whole.stiffness, parts.without, parts.with)));
  if (!follow.allFinite() || resists(whole.damping, parts, follow)) return;
  for (const auto member : {&fem::Matrices::mass, &fem::Matrices::damping, &fem::Matrices::stiffness}) {
    SparseMatrix &matrix = files.matrices.*member, &coupling = files.coupling.*member;
    if (coupling.size() > 0) coupling = condensed_rows(coupling, parts, follow, all_columns(coupling));
    if (matrix.size() > 0 && member == &fem::Matrices::mass)
      matrix = matrix_part(matrix, parts.with, parts.with);
    else if (matrix.size() > 0)
      matrix = condensed(matrix, parts, follow);
  }
  if (files.spin_stiffness.size() > 0) files.spin_stiffness = condensed(files.spin_stiffness, parts, follow);
  files.massless = chosen(files.rows, parts.without);
  files.rows = chosen(files.rows, parts.with);
  files.followers = follow;
}

std::string advice_on_massless_rows(const SparseMatrix& mass) {
  constexpr std::size_t shown = 5;
  std::vector<int> rows = rows_without_mass(mass);
  if (rows.empty()) return "";
  for (int& row : rows) ++row;
  return fmt::format(
      ". {} row{} no mass: {}{}. They are condensed statically if their stiffness is definite and undamped, at "
      "most {} rows are of either kind, and neither structure.unsymmetric nor structure.free is set; otherwise "
      "expected a consistent mass matrix",
      rows.size(), rows.size() == 1 ? " has" : "s have",
      fmt::join(std::span(rows).first(std::min(shown, rows.size())), ", "),
      rows.size() > shown ? ", ..." : "", most_condensed);
}

}  // namespace wavebalance::app
