#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "bindings.hpp"
#include "wavebalance/fem/named_matrix.hpp"

namespace wavebalance::python {

namespace py = pybind11;

namespace {

/// Content of the files: (role, file, matrix) of each, and the names, nodes and directions of the rows or
/// None.
py::tuple read_matrices(const std::vector<std::string>& names) {
  const std::vector<std::filesystem::path> files(names.begin(), names.end());
  fem::CollectedMatrices all;
  try {
    const py::gil_scoped_release unlocked;
    all = fem::collect_matrices(files);
  } catch (const fem::MatrixFileError& error) {
    throw py::value_error(error.what());
  }
  py::list matrices;
  for (const fem::CollectedMatrix& one : all.matrices)
    matrices.append(py::make_tuple(one.role, one.file.string(), one.matrix));
  if (!all.map) return py::make_tuple(matrices, py::none(), py::none(), py::none());
  std::vector<std::string> rows, directions;
  Eigen::VectorXi nodes(all.map->rows());
  for (int row = 0; row < all.map->rows(); ++row) {
    rows.push_back(all.map->name(row));
    nodes[row] = all.map->dof(row).node;
    directions.emplace_back(fem::direction_name(all.map->dof(row).direction));
  }
  return py::make_tuple(matrices, rows, nodes, directions);
}

}  // namespace

void add_matrices(py::module_& module) { module.def("read_matrices", &read_matrices); }

}  // namespace wavebalance::python
