#include "entries.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <tuple>

#include "wavebalance/fem/matrix_file.hpp"

namespace wavebalance::fem::detail {
namespace {

/// An entry, of a symmetric matrix moved to the lower triangle.
struct Placed {
  int row, column;
  bool above;  ///< it was given above the diagonal of a symmetric matrix
  double value;

  bool at(const Placed& other) const { return row == other.row && column == other.column; }
};

std::vector<Placed> placed(const MatrixEntries& entries, bool symmetric) {
  std::vector<Placed> all;
  all.reserve(entries.size());
  for (const auto& entry : entries) {
    const bool above = symmetric && entry.row() < entry.col();
    all.push_back(
        {above ? entry.col() : entry.row(), above ? entry.row() : entry.col(), above, entry.value()});
  }
  std::ranges::sort(all, [](const Placed& a, const Placed& b) {
    return std::tie(a.column, a.row, a.above) < std::tie(b.column, b.row, b.above);
  });
  return all;
}

std::string text_of(double value) {
  std::array<char, 32> digits;
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr};
}

/// The file, and what it calls its entries.
struct Names {
  const std::string& file;
  const EntryName& entry;
};

[[noreturn]] void fail_twice(const Placed& first, const Placed& second, const Names& names) {
  const bool above = first.above;
  throw MatrixFileError(names.file + ": the entry " +
                        names.entry(above ? first.column : first.row, above ? first.row : first.column) +
                        " is given twice, as " + text_of(first.value) + " and " + text_of(second.value));
}

[[noreturn]] void fail_asymmetric(const Placed& entry, double below, double above, const Names& names) {
  throw MatrixFileError(names.file + ": the entry " + names.entry(entry.row, entry.column) + " is " +
                        text_of(below) + " and " + names.entry(entry.column, entry.row) + " is " +
                        text_of(above) + "; a symmetric file holds one triangle, or two that agree");
}

double largest(const std::vector<Placed>& entries) {
  double most = 0.0;
  for (const Placed& one : entries)
    if (std::abs(one.value) < held_diagonal) most = std::max(most, std::abs(one.value));
  return most;
}

/// The value of one place, which may be given on either side of the diagonal.
double agreed(std::span<const Placed> given, double rounding, const Names& names) {
  const Placed& first = given.front();
  if (given.size() == 1) return first.value;
  for (std::size_t i = 1; i < given.size(); ++i)
    if (given[i - 1].above == given[i].above) fail_twice(given[i - 1], given[i], names);
  const double other = given[1].value;
  if (!(std::abs(first.value - other) <= rounding)) fail_asymmetric(first, first.value, other, names);
  return first.value + 0.5 * (other - first.value);
}

/// The lower triangle of a symmetric matrix of which one triangle is given, or both. Both must agree to the
/// tolerance within which a matrix counts as symmetric, and then hold all entries.
MatrixEntries lower_triangle(const MatrixEntries& entries, const Names& names) {
  constexpr double symmetry_tolerance = 1e-10;  // of the largest entry, as check_structure() has it
  const std::vector<Placed> all = placed(entries, true);
  const double rounding = symmetry_tolerance * largest(all);
  MatrixEntries lower;
  const Placed* single = nullptr;
  for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
    const Placed& first = all[begin];
    while (end < all.size() && all[end].at(first)) ++end;
    lower.emplace_back(first.row, first.column, agreed({&first, end - begin}, rounding, names));
    const bool matters = first.row != first.column && std::abs(first.value) > rounding;
    if (end - begin == 1 && matters) single = &first;
  }
  const bool both = lower.size() < all.size();
  if (both && single != nullptr)
    fail_asymmetric(*single, single->above ? 0.0 : single->value, single->above ? single->value : 0.0, names);
  return lower;
}

void reject_repeats(const MatrixEntries& entries, const Names& names) {
  const std::vector<Placed> all = placed(entries, false);
  const auto twice =
      std::adjacent_find(all.begin(), all.end(), [](const Placed& a, const Placed& b) { return a.at(b); });
  if (twice != all.end()) fail_twice(*twice, *std::next(twice), names);
}

}  // namespace

std::string place_text(int row, int column) {
  return "(" + std::to_string(row + 1) + ", " + std::to_string(column + 1) + ")";
}

Eigen::SparseMatrix<double> matrix_of(MatrixEntries entries, int rows, int columns, bool symmetric,
                                      const std::string& name, const EntryName& entry_name) {
  const Names names{name, entry_name};
  if (!symmetric) reject_repeats(entries, names);
  if (symmetric) {
    entries = lower_triangle(entries, names);
    const std::size_t stored = entries.size();
    entries.reserve(2 * stored);
    for (std::size_t i = 0; i < stored; ++i)
      if (entries[i].row() != entries[i].col())
        entries.emplace_back(entries[i].col(), entries[i].row(), entries[i].value());
  }
  Eigen::SparseMatrix<double> matrix(rows, columns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

bool ends_within_a_row(const MatrixEntries& entries) {
  std::unordered_map<int, bool> has_diagonal;
  for (const auto& entry : entries) {
    bool& has = has_diagonal[entry.row()];
    has = has || entry.row() == entry.col();
  }
  const auto without = std::ranges::count(has_diagonal, false, [](const auto& row) { return row.second; });
  return has_diagonal.size() > 1 && without == 1 && !has_diagonal[entries.back().row()];
}

}  // namespace wavebalance::fem::detail
