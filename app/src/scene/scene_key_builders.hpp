#pragma once
#include <algorithm>
#include <array>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "scene/enum_names.hpp"
#include "wavebalance/app/scene/scene_keys.hpp"

/// How the table of keys is written down: key<members...>(section, name, unit, help) makes a key of a member
/// of Scene, the other functions wrap it.
namespace wavebalance::app {

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr Bounds positive{0.0, infinity, true};
inline constexpr Bounds not_negative{0.0, infinity, false};

/// A member of a member ... of `object`.
template <class Object>
auto& member_of(Object& object) {
  return object;
}
template <auto First, auto... Rest, class Object>
auto& member_of(Object& object) {
  return member_of<Rest...>(object.*First);
}

template <class>
inline constexpr bool is_list = false;
template <class Number>
inline constexpr bool is_list<std::vector<Number>> = true;
template <class Number, std::size_t Size>
inline constexpr bool is_list<std::array<Number, Size>> = true;

/// The type that SceneValue has for a number of a Scene.
template <class Number>
using Stored = std::conditional_t<std::is_integral_v<Number>, std::int64_t, double>;

template <auto... Path>
SceneValue get_member(const Scene& scene) {
  const auto& member = member_of<Path...>(scene);
  using Field = std::remove_cvref_t<decltype(member)>;
  if constexpr (std::is_enum_v<Field>)
    return enum_name(member);
  else if constexpr (is_list<Field>)
    return std::vector<Stored<typename Field::value_type>>(member.begin(), member.end());
  else if constexpr (std::is_same_v<Field, int>)
    return static_cast<std::int64_t>(member);
  else
    return member;
}

template <auto... Path>
void set_member(Scene& scene, const SceneValue& value) {
  auto& member = member_of<Path...>(scene);
  using Field = std::remove_cvref_t<decltype(member)>;
  if constexpr (std::is_enum_v<Field>) {
    member = enum_value<Field>(std::get<std::string>(value));
  } else if constexpr (is_list<Field>) {
    using Number = typename Field::value_type;
    const auto& list = std::get<std::vector<Stored<Number>>>(value);
    if constexpr (requires { member.resize(0); }) member.resize(list.size());
    std::transform(list.begin(), list.end(), member.begin(),
                   [](auto one) { return static_cast<Number>(one); });
  } else if constexpr (std::is_same_v<Field, int>) {
    member = static_cast<int>(std::get<std::int64_t>(value));
  } else {
    member = std::get<Field>(value);
  }
}

template <class Field>
void describe_list(SceneKey& key) {
  using Number = typename Field::value_type;
  key.type = std::is_integral_v<Number> ? SceneKey::Type::integer : SceneKey::Type::number;
  key.form = SceneKey::Form::list;
  if constexpr (requires { std::tuple_size<Field>::value; })
    key.length = static_cast<int>(std::tuple_size_v<Field>);
}

template <auto... Path>
SceneKey key(std::string_view section, std::string_view name, std::string_view unit, std::string_view help) {
  using Field = std::remove_cvref_t<decltype(member_of<Path...>(std::declval<Scene&>()))>;
  SceneKey result;
  result.section = section;
  result.name = name;
  result.unit = unit;
  result.help = help;
  result.get = &get_member<Path...>;
  result.set = &set_member<Path...>;
  if constexpr (std::is_enum_v<Field>) {
    result.type = SceneKey::Type::text;
    result.choices = enum_choices<Field>();
  } else if constexpr (std::is_same_v<Field, std::string>) {
    result.type = SceneKey::Type::text;
  } else if constexpr (std::is_same_v<Field, bool>) {
    result.type = SceneKey::Type::boolean;
  } else if constexpr (is_list<Field>) {
    describe_list<Field>(result);
  } else {
    result.type = std::is_same_v<Field, int> ? SceneKey::Type::integer : SceneKey::Type::number;
  }
  return result;
}

inline SceneKey bounded(SceneKey key, Bounds bounds) {
  key.bounds = bounds;
  return key;
}

/// The default is the one that the Scene's member is initialised with.
inline SceneKey optional(SceneKey key) {
  key.fallback = SceneKey::Default::value;
  return key;
}

inline SceneKey derived(SceneKey key, std::string_view text, SceneValue (*rule)(const Scene&)) {
  key.fallback = SceneKey::Default::derived;
  key.derived_text = text;
  key.derived = rule;
  return key;
}

/// An error in scenes where `condition` does not hold.
inline SceneKey belonging(SceneKey key, Condition condition) {
  key.belongs = std::move(condition);
  return key;
}

/// Where `condition` holds, the scene has to have it; without one, everywhere.
inline SceneKey needed(SceneKey key, Condition condition) {
  key.needed = std::move(condition);
  return key;
}

/// A text that names a file, relative to the scene's.
inline SceneKey path(SceneKey key) {
  key.type = SceneKey::Type::path;
  return key;
}

inline Condition structure_is(std::vector<std::string_view> types) {
  return {"structure.type", std::move(types)};
}

inline Condition analysis_is(std::vector<std::string_view> types) {
  return {"analysis.type", std::move(types)};
}

/// The parts of the table, each adds its section.
void add_structure_keys(std::vector<SceneKey>& keys);
void add_contact_keys(std::vector<SceneKey>& keys);
void add_forcing_keys(std::vector<SceneKey>& keys);
void add_time_keys(std::vector<SceneKey>& keys);
void add_analysis_keys(std::vector<SceneKey>& keys);

}  // namespace wavebalance::app
