#pragma once
#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "wavebalance/app/scene/scene.hpp"

namespace wavebalance::app {

/// The names of an enumeration's values in a scene file, in the order of its enumerators.
template <class Enum>
inline constexpr std::array<std::string_view, 0> enum_names{};
template <>
inline constexpr std::array<std::string_view, 3> enum_names<StructureType>{"bar", "blade", "matrices"};
template <>
inline constexpr std::array<std::string_view, 3> enum_names<BladeElement>{
    "hexahedron20", "hexahedron20_reduced", "hexahedron8"};
template <>
inline constexpr std::array<std::string_view, 3> enum_names<Direction>{"x", "y", "z"};
template <>
inline constexpr std::array<std::string_view, 3> enum_names<TipPlace>{"leading_edge", "mid_chord",
                                                                      "trailing_edge"};
template <>
inline constexpr std::array<std::string_view, 4> enum_names<ContactLawType>{"none", "exponential", "linear",
                                                                            "rigid"};
template <>
inline constexpr std::array<std::string_view, 3> enum_names<Formulation>{"strong", "weak", "distributional"};
template <>
inline constexpr std::array<std::string_view, 2> enum_names<InnerProducts>{"quadrature", "exact"};
template <>
inline constexpr std::array<std::string_view, 2> enum_names<ModeFormulation>{"consistent", "published"};
template <>
inline constexpr std::array<std::string_view, 4> enum_names<AnalysisType>{
    "forced_response", "frequency_sweep", "time_stepping", "nonlinear_mode"};

template <class Enum>
std::string enum_name(Enum value) {
  return std::string(enum_names<Enum>.at(static_cast<std::size_t>(value)));
}

template <class Enum>
Enum enum_value(std::string_view name) {
  for (std::size_t i = 0; i < enum_names<Enum>.size(); ++i)
    if (enum_names<Enum>[i] == name) return static_cast<Enum>(i);
  throw std::invalid_argument("enum_value: unknown name \"" + std::string(name) + "\"");
}

template <class Enum>
std::vector<std::string_view> enum_choices() {
  return {enum_names<Enum>.begin(), enum_names<Enum>.end()};
}

}  // namespace wavebalance::app
