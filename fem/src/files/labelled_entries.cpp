#include "entries.hpp"

#include <algorithm>
#include <numeric>

namespace wavebalance::fem::detail {

int LabelledEntries::place(const NodeDof& dof) {
  constexpr std::int64_t directions = 8;  // more than there are
  const auto [found, is_new] =
      places_.emplace(directions * dof.node + dof.direction, static_cast<int>(dofs_.size()));
  if (is_new) dofs_.push_back(dof);
  return found->second;
}

void LabelledEntries::add(int row, int column, double value) {
  if (value != 0.0) entries_.emplace_back(row, column, value);
}

LabelledEntries::Order LabelledEntries::ascending() const {
  std::vector<int> places(dofs_.size());
  std::iota(places.begin(), places.end(), 0);
  const auto dof = [&](int place) { return dofs_[static_cast<std::size_t>(place)]; };
  std::ranges::sort(places, [&](int a, int b) { return dof(a) < dof(b); });
  Order order{{}, std::vector<int>(dofs_.size())};
  for (const int place : places) {
    order.rows[static_cast<std::size_t>(place)] = static_cast<int>(order.dofs.size());
    order.dofs.push_back(dof(place));
  }
  return order;
}

NamedMatrix LabelledEntries::square(std::string name, bool symmetric, const std::string& file) const {
  const Order order = ascending();
  MatrixEntries entries;
  entries.reserve(entries_.size());
  for (const auto& entry : entries_)
    entries.emplace_back(order.rows[static_cast<std::size_t>(entry.row())],
                         order.rows[static_cast<std::size_t>(entry.col())], entry.value());
  const int size = static_cast<int>(order.dofs.size());
  const auto name_of = [&](int row) { return to_string(order.dofs[static_cast<std::size_t>(row)]); };
  auto matrix = matrix_of(std::move(entries), size, size, symmetric, file, [&](int row, int column) {
    return "(" + name_of(row) + ", " + name_of(column) + ")" + (name.empty() ? "" : " of " + name);
  });
  return {std::move(name), std::move(matrix), DofMap(order.dofs), false};
}

NamedMatrix LabelledEntries::loads(std::string name, int columns, const std::string& file) const {
  const Order order = ascending();
  MatrixEntries entries;
  for (const auto& entry : entries_)
    entries.emplace_back(order.rows[static_cast<std::size_t>(entry.row())], entry.col(), entry.value());
  auto matrix = matrix_of(std::move(entries), static_cast<int>(order.dofs.size()), columns, false, file,
                          [&](int row, int column) {
                            return "(" + to_string(order.dofs[static_cast<std::size_t>(row)]) + ", column " +
                                   std::to_string(column + 1) + ")" + (name.empty() ? "" : " of " + name);
                          });
  return {std::move(name), std::move(matrix), DofMap(order.dofs), true};
}

}  // namespace wavebalance::fem::detail
