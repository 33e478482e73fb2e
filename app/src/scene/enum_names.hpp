#pragma once

#include "wavebalance/app/scene/scene.hpp"

namespace wavebalance::app {

template <class Enum>
using NamedValue = std::pair<Enum, std::string_view>;

/// The values of an enumeration with their names in scenes and results, in the order of the help.
template <class Enum>
inline constexpr std::array<NamedValue<Enum>, 0> enum_names{};
template <>
inline constexpr std::array<NamedValue<StructureType>, 3> enum_names<StructureType>{
    {{StructureType::bar, "bar"}, {StructureType::blade, "blade"}, {StructureType::matrices, "matrices"}}};
template <>
inline constexpr std::array<NamedValue<SolidElement>, 3> enum_names<SolidElement>{
    {{SolidElement::hexahedron20, "hexahedron20"},
     {SolidElement::hexahedron20_reduced, "hexahedron20_reduced"},
     {SolidElement::hexahedron8, "hexahedron8"}}};
template <>
inline constexpr std::array<NamedValue<Direction>, 3> enum_names<Direction>{
    {{Direction::x, "x"}, {Direction::y, "y"}, {Direction::z, "z"}}};
template <>
inline constexpr std::array<NamedValue<TipPlace>, 3> enum_names<TipPlace>{
    {{TipPlace::leading_edge, "leading_edge"},
     {TipPlace::mid_chord, "mid_chord"},
     {TipPlace::trailing_edge, "trailing_edge"}}};
template <>
inline constexpr std::array<NamedValue<ContactForm>, 3> enum_names<ContactForm>{
    {{ContactForm::automatic, "automatic"},
     {ContactForm::displacement, "displacement"},
     {ContactForm::force, "force"}}};
template <>
inline constexpr std::array<NamedValue<ContactMass>, 3> enum_names<ContactMass>{
    {{ContactMass::automatic, "automatic"},
     {ContactMass::keep, "keep"},
     {ContactMass::redistribute, "redistribute"}}};
template <>
inline constexpr std::array<NamedValue<ObstacleSide>, 3> enum_names<ObstacleSide>{
    {{ObstacleSide::positive, "positive"},
     {ObstacleSide::negative, "negative"},
     {ObstacleSide::both, "both"}}};
template <>
inline constexpr std::array<NamedValue<Formulation>, 3> enum_names<Formulation>{
    {{Formulation::strong, "strong"},
     {Formulation::weak, "weak"},
     {Formulation::distributional, "distributional"}}};
template <>
inline constexpr std::array<NamedValue<InnerProducts>, 2> enum_names<InnerProducts>{
    {{InnerProducts::quadrature, "quadrature"}, {InnerProducts::exact, "exact"}}};
template <>
inline constexpr std::array<NamedValue<NyquistCoefficient>, 2> enum_names<NyquistCoefficient>{
    {{NyquistCoefficient::drop, "drop"}, {NyquistCoefficient::keep, "keep"}}};
template <>
inline constexpr std::array<NamedValue<LoadKind>, 4> enum_names<LoadKind>{
    {{LoadKind::force, "force"},
     {LoadKind::base_displacement, "base_displacement"},
     {LoadKind::base_acceleration, "base_acceleration"},
     {LoadKind::unbalance, "unbalance"}}};
template <>
inline constexpr auto enum_names<AnalysisType> = [] {
  std::array<NamedValue<AnalysisType>, analysis_kinds.size()> names{};
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = {analysis_kinds[i].type, analysis_kinds[i].name};
  return names;
}();
template <>
inline constexpr std::array<NamedValue<TimeMethod>, 2> enum_names<TimeMethod>{
    {{TimeMethod::balance, "balance"}, {TimeMethod::exact, "exact"}}};

template <class Enum>
constexpr std::string_view enum_name(Enum value) {
  for (const auto& [known, name] : enum_names<Enum>)
    if (known == value) return name;
  throw std::invalid_argument("enum_name: the value " + std::to_string(static_cast<int>(value)) +
                              " has no name");
}

template <class Enum>
Enum enum_value(std::string_view name) {
  for (const auto& [value, known] : enum_names<Enum>)
    if (known == name) return value;
  throw std::invalid_argument("enum_value: unknown name \"" + std::string(name) + "\"");
}

template <class Enum>
std::vector<std::string_view> enum_choices() {
  std::vector<std::string_view> names;
  for (const auto& [value, name] : enum_names<Enum>) names.push_back(name);
  return names;
}

}  // namespace wavebalance::app
