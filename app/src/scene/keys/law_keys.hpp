#pragma once

#include "wavebalance/app/scene/scene_keys.hpp"
#include "wavebalance/contact/catalogue.hpp"

/// The keys of contact laws, made from contact::law_catalogue().
namespace wavebalance::app {

/// A parameter with the laws that have one of this name.
struct SharedParameter {
  contact::LawParameter first;         ///< of the first law that has it, with any range where theirs differ
  std::vector<std::string_view> laws;  ///< in the order of the catalogue
  std::string help;                    ///< what it is in each of them
};

/// Every name once, in the order of the catalogue, the gap last.
std::span<const SharedParameter> law_parameters();

/// The key of a parameter in `section`, without its place in a scene.
SceneKey key_of_parameter(std::string_view section, const SharedParameter& parameter);

/// The value of a key: the default where there is none, empty if it equals another parameter.
SceneValue value_in(const contact::LawValues& values, const contact::LawParameter& parameter);
/// Sets it, or leaves it out where it is the default.
void set_value(contact::LawValues& values, const contact::LawParameter& parameter, const SceneValue& value);

/// The key for a single law: its help and range there.
SceneKey key_of_law(SceneKey key, std::string_view law);

/// `"linear", "rigid"`: the names of laws for which `wanted` is true.
std::vector<std::string_view> law_names(bool (*wanted)(const contact::LawEntry&));

/// Laws that a nonlinear mode supports: they act only beyond their gap and conserve energy.
std::vector<std::string_view> laws_of_modes();

/// "stiffness, gap" or "none": the parameters of a law.
std::string parameter_names(std::string_view law);

/// "linear, stiffness (u - gap) beyond the gap; ...": the forces of all laws.
std::string forces_text();

}  // namespace wavebalance::app
