#include "matrices/structure_inputs.hpp"

#include <fmt/format.h>

#include "matrices/structure_files.hpp"

namespace wavebalance::app {
namespace {

constexpr std::string_view key_of_stiffness = "structure.stiffness";
constexpr std::string_view key_of_map = "structure.dof_map";

/// Result of `reader` for a file.
template <class Read>
auto read(const std::string& path, std::string_view key, Read reader) {
  try {
    return reader(std::filesystem::path(path));
  } catch (const fem::MatrixFileError& error) {
    throw StructureFault(key, error.what());
  }
}

fem::NamedMatrix read_matrix(const std::string& path, std::string_view key) {
  return read(path, key, [](const auto& file) { return fem::read_named_matrix(file); });
}

/// Names both files, as one of them may belong to another mesh.
void require_size(const Eigen::SparseMatrix<double>& matrix, std::string_view key, const std::string& path,
                  Eigen::Index size, const std::string& stiffness_path) {
  if (matrix.rows() == size && matrix.cols() == size && size > 0) return;
  const std::string expected =
      key == key_of_stiffness
          ? "a square one that is not empty"
          : fmt::format("{0} x {0}, the size of structure.stiffness in {1}", size, stiffness_path);
  throw StructureFault(key, fmt::format("the matrix in {} is {} x {}; expected {}", path, matrix.rows(),
                                        matrix.cols(), expected));
}

}  // namespace

StructureInputs::StructureInputs(std::string stiffness_path, const std::string& map_path)
    : path_(std::move(stiffness_path)) {
  fem::NamedMatrix stiffness = read_matrix(path_, key_of_stiffness);
  const Eigen::Index own_rows = stiffness.matrix.rows();
  require_size(stiffness.matrix, key_of_stiffness, path_, own_rows, path_);
  if (!map_path.empty())
    map_ = read(map_path, key_of_map, [](const auto& file) { return fem::read_dof_map(file); });
  if (map_ && !stiffness.rows && map_->rows() != own_rows)
    throw StructureFault(key_of_map,
                         fmt::format("{} names {} rows; expected {}, the rows of structure.stiffness in {}",
                                     map_path, map_->rows(), own_rows, path_));
  if (!map_) map_ = stiffness.rows;
  stiffness_ = in_rows(stiffness, path_, key_of_stiffness);
}

Eigen::SparseMatrix<double> StructureInputs::in_rows(const fem::NamedMatrix& given, const std::string& path,
                                                     std::string_view key) const {
  if (!given.rows) return given.matrix;
  if (!map_)
    throw StructureFault(
        key, fmt::format("{} names its rows by nodes and structure.stiffness in {} does not; expected "
                         "structure.dof_map too, which names the rows of the stiffness",
                         path, path_));
  try {
    return fem::placed(given, *map_);
  } catch (const fem::MatrixFileError& error) {
    throw StructureFault(
        key, fmt::format("{}: {}; the rows follow structure.dof_map, or else structure.stiffness", path,
                         error.what()));
  }
}

Eigen::SparseMatrix<double> StructureInputs::matrix(const std::string& path, std::string_view key) const {
  Eigen::SparseMatrix<double> matrix = in_rows(read_matrix(path, key), path, key);
  require_size(matrix, key, path, stiffness_.rows(), path_);
  return matrix;
}

Eigen::VectorXd StructureInputs::load(const std::string& path, std::string_view key) const {
  const fem::NamedMatrix given = read(path, key, [](const auto& file) { return fem::read_load(file); });
  const Eigen::VectorXd load(in_rows(given, path, key).col(0));
  if (load.size() == stiffness_.rows()) return load;
  throw StructureFault(
      key, fmt::format(
               "the vector in {} has {} entries; expected {}, one for each row of structure.stiffness in {}",
               path, load.size(), stiffness_.rows(), path_));
}

std::optional<fem::DofMap> map_of_rows(const std::string& map_path, const std::string& stiffness_path) {
  if (!map_path.empty()) return fem::read_dof_map(map_path);
  return fem::read_named_matrix(stiffness_path).rows;
}

}  // namespace wavebalance::app
