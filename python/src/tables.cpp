#include "scenes.hpp"

#include <pybind11/stl.h>

#include "arrays.hpp"

namespace wavebalance::python {

namespace py = pybind11;

namespace {

bool has_text(const app::Table& table, std::size_t column) {
  for (std::size_t row = 0; row < table.rows(); ++row)
    if (std::holds_alternative<std::string>(table.row(row)[column])) return true;
  return false;
}

}  // namespace

py::dict columns_of(const app::Table& table) {
  py::dict columns;
  for (std::size_t i = 0; i < table.columns().size(); ++i) {
    const std::string& name = table.columns()[i];
    if (has_text(table, i))
      columns[py::str(name)] = py::cast(table.texts(name));
    else
      columns[py::str(name)] = owned(table.numbers(name));
  }
  return columns;
}

py::dict dictionary_of(const app::Summary& summary) {
  py::dict values;
  for (const app::Entry& entry : summary)
    values[py::str(entry.name)] = std::visit(
        [](const auto& one) -> py::object {
          if constexpr (std::is_same_v<std::decay_t<decltype(one)>, app::Table>)
            return columns_of(one);
          else
            return py::cast(one);
        },
        entry.value);
  return values;
}

}  // namespace wavebalance::python
