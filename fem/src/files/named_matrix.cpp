#include "wavebalance/fem/named_matrix.hpp"

#include <algorithm>

#include "entries.hpp"
#include "formats.hpp"
#include "text_parts.hpp"
#include "wavebalance/fem/matrix_market.hpp"

namespace wavebalance::fem {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// For a file that names neither it nor its rows.
NamedMatrix plain(Sparse matrix) {
  const bool load = matrix.rows() != matrix.cols();
  return {"", std::move(matrix), {}, load};
}

using detail::MatrixPart;

std::vector<NamedMatrix> read_format(MatrixFormat format, std::istream& input, const std::string& name,
                                     std::string_view wanted, MatrixPart part) {
  switch (format) {
    case MatrixFormat::matrix_market:
      return {plain(read_matrix_market(input, name))};
    case MatrixFormat::calculix:
      return {plain(read_calculix_matrix(input, name))};
    case MatrixFormat::harwell_boeing:
      return detail::read_harwell_boeing_parts(input, name, part);
    case MatrixFormat::abaqus:
      return read_abaqus_matrix(input, name);
    case MatrixFormat::substructure:
      return read_substructure(input, name);
    case MatrixFormat::dmig:
      return read_dmig(input, name, wanted);
    case MatrixFormat::output4:
      return read_output4(input, name, wanted);
  }
  return {};
}

/// Content of a file; with a name the others have only names.
std::vector<NamedMatrix> read_all(const MatrixPlace& place, MatrixPart part) {
  const detail::FoundFormat found = detail::found_format(place.file);
  return detail::read_as(found, [&] {
    return detail::from_file(place.file, [&](std::istream& input, const std::string& name) {
      return read_format(found.format, input, name, place.name, part);
    });
  });
}

std::string names_of(const std::vector<NamedMatrix>& matrices) {
  std::string text;
  for (const NamedMatrix& one : matrices)
    text += (text.empty() ? "" : ", ") + (one.name.empty() ? "one without a name" : one.name);
  return text;
}

bool has_name(const NamedMatrix& one, std::string_view name) {
  return detail::lower(one.name) == detail::lower(name);
}

void require_name(const std::vector<NamedMatrix>& all, const MatrixPlace& place) {
  const auto count =
      std::ranges::count_if(all, [&](const NamedMatrix& one) { return has_name(one, place.name); });
  if (count == 1) return;
  throw MatrixFileError(place.file.string() + ": there " + (count == 0 ? "is no" : "are several") +
                        " matrices of the name \"" + place.name + "\"; the file holds " + names_of(all));
}

/// The one that a place names, or the only one of this kind.
NamedMatrix chosen(std::vector<NamedMatrix> all, const MatrixPlace& place, bool load) {
  if (!place.name.empty()) {
    require_name(all, place);
    return std::move(
        *std::ranges::find_if(all, [&](const NamedMatrix& one) { return has_name(one, place.name); }));
  }
  if (all.size() == 1) return std::move(all.front());
  const auto fits = [&](const NamedMatrix& one) { return one.load == load; };
  const auto found = std::ranges::find_if(all, fits);
  if (std::ranges::count_if(all, fits) == 1) return std::move(*found);
  const std::string example = found != all.end() ? found->name : all.front().name;
  throw MatrixFileError(place.file.string() + ": the file holds " + names_of(all) +
                        "; expected the name of one behind it, as \"" + place.file.filename().string() + "#" +
                        example + "\"");
}

}  // namespace

MatrixPlace matrix_place(const std::filesystem::path& path) {
  const std::string text = path.string();
  const std::size_t sign = text.rfind('#');
  std::error_code ignored;
  if (sign == std::string::npos || std::filesystem::exists(path, ignored)) return {path, "", 0};
  MatrixPlace place{text.substr(0, sign), text.substr(sign + 1), 0};
  const std::size_t colon = place.name.rfind(':');
  if (colon == std::string::npos) return place;
  const std::string column = place.name.substr(colon + 1);
  const auto [end, error] = std::from_chars(column.data(), column.data() + column.size(), place.column);
  if (error != std::errc() || end != column.data() + column.size() || place.column < 1)
    throw MatrixFileError(text + ": the column is \"" + column + "\"; it must be a whole number from 1 on");
  place.name.erase(colon);
  return place;
}

std::vector<NamedMatrix> read_matrices(const std::filesystem::path& path) {
  const MatrixPlace place = matrix_place(path);
  std::vector<NamedMatrix> all = read_all(place, MatrixPart::all);
  if (place.name.empty()) return all;
  std::vector<NamedMatrix> one;
  one.push_back(chosen(std::move(all), place, false));
  return one;
}

NamedMatrix read_named_matrix(const std::filesystem::path& path) {
  const MatrixPlace place = matrix_place(path);
  return chosen(read_all(place, MatrixPart::matrix), place, false);
}

NamedMatrix read_load(const std::filesystem::path& path) {
  const MatrixPlace place = matrix_place(path);
  NamedMatrix load = chosen(read_all(place, MatrixPart::load), place, true);
  const std::string what = load.name.empty() ? "the file" : load.name;
  if (!load.load && load.matrix.cols() != 1)
    throw MatrixFileError(place.file.string() + ": " + what +
                          " holds a matrix; expected a vector: one column, or a right-hand side");
  if (place.column > load.matrix.cols() || (place.column == 0 && load.matrix.cols() > 1))
    throw MatrixFileError(place.file.string() + ": " + what + " has " + std::to_string(load.matrix.cols()) +
                          " columns; expected one of them, as \"" + place.file.filename().string() + "#" +
                          load.name + ":1\"");
  if (load.matrix.cols() > 1) load.matrix = Sparse(load.matrix.col(place.column - 1));
  return load;
}

Sparse read_matrix(const std::filesystem::path& file) { return read_named_matrix(file).matrix; }

Eigen::VectorXd read_vector(const std::filesystem::path& file) {
  return Eigen::VectorXd(read_load(file).matrix.col(0));
}

Sparse placed(const NamedMatrix& given, const DofMap& map) {
  const DofMap& own = *given.rows;
  std::vector<int> rows(static_cast<std::size_t>(own.rows()));
  for (int row = 0; row < own.rows(); ++row)
    rows[static_cast<std::size_t>(row)] = map.copies(own.dof(row)) == 1 ? map.row(own.dof(row)) : -1;
  const auto row_of = [&](Eigen::Index row) {
    const int found = rows[static_cast<std::size_t>(row)];
    if (found >= 0) return found;
    const NodeDof& dof = own.dof(static_cast<int>(row));
    throw MatrixFileError((given.name.empty() ? "the matrix" : given.name) + " has an entry at " +
                          to_string(dof) + ", which the rows have " + std::to_string(map.copies(dof)) +
                          " times; expected once");
  };
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(given.matrix.nonZeros()));
  for (int column = 0; column < given.matrix.outerSize(); ++column)
    for (Sparse::InnerIterator entry(given.matrix, column); entry; ++entry)
      entries.emplace_back(row_of(entry.row()), given.load ? column : row_of(column), entry.value());
  Sparse result(map.rows(), given.load ? given.matrix.cols() : map.rows());
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

std::vector<int> held_rows(const Sparse& stiffness) {
  std::vector<int> rows;
  const Eigen::VectorXd diagonal = stiffness.diagonal();
  for (Eigen::Index row = 0; row < diagonal.size(); ++row)
    if (diagonal[row] >= detail::held_diagonal) rows.push_back(static_cast<int>(row));
  return rows;
}

}  // namespace wavebalance::fem
