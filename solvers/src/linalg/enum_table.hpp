#pragma once
#include <cstddef>
#include <string_view>

namespace wavebalance::solvers::detail {

template <class Enum>
struct EnumName {
  Enum value;
  std::string_view name;
};

/// The name of `value` in a table with one row per enumerator; "unknown" if there is no such row.
template <class Enum, std::size_t rows>
constexpr std::string_view name_in(const EnumName<Enum> (&table)[rows], Enum value) {
  for (const auto& row : table)
    if (row.value == value) return row.name;
  return "unknown";
}

}  // namespace wavebalance::solvers::detail
