#pragma once
#include <algorithm>
#include <type_traits>

#include "scene/enum_names.hpp"
#include "wavebalance/app/scene/scene_keys.hpp"

/// How the table of keys is written. A Section makes the key of a member of Scene from its name, unit, help
/// and properties:
///
///     contact(&Contact::stiffness, "stiffness", "N/m", "slope of the linear law", positive,
///             only_with(law_is({"linear"})));
///
/// Type and form follow from the member. A key is required unless it is `optional` or `derived`.
namespace wavebalance::app {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

template <class>
inline constexpr bool is_list_of = false;
template <class Number>
inline constexpr bool is_list_of<std::vector<Number>> = true;
template <class Number, std::size_t Size>
inline constexpr bool is_list_of<std::array<Number, Size>> = true;

/// The entries of analysis.motion_at, and what they mean.
inline std::vector<NumberOrText> entries_of(const MotionAt& at) {
  std::vector<NumberOrText> entries(at.places.begin(), at.places.end());
  if (at.special) entries.insert(entries.begin(), "special");
  if (at.peak) entries.insert(entries.begin(), "peak");
  return entries;
}
inline MotionAt motion_at(const std::vector<NumberOrText>& entries) {
  MotionAt at;
  for (const NumberOrText& entry : entries) {
    const auto* place = std::get_if<double>(&entry);
    const auto known = std::ranges::find(at.places, place ? *place : 0.0);
    if (place == nullptr)
      (std::get<std::string>(entry) == "peak" ? at.peak : at.special) = true;
    else if (known == at.places.end())
      at.places.push_back(*place);
  }
  return at;
}

/// The type that SceneValue has for a number of a Scene.
template <class Number>
using Stored = std::conditional_t<std::is_integral_v<Number>, std::int64_t, double>;

template <class Field>
SceneValue value_of(const Field& field) {
  if constexpr (std::is_same_v<Field, MotionAt>)
    return entries_of(field);
  else if constexpr (std::is_same_v<Field, std::vector<std::string>>)
    return std::vector<NumberOrText>(field.begin(), field.end());
  else if constexpr (std::is_enum_v<Field>)
    return std::string(enum_name(field));
  else if constexpr (is_list_of<Field>)
    return std::vector<Stored<typename Field::value_type>>(field.begin(), field.end());
  else if constexpr (std::is_same_v<Field, int>)
    return std::int64_t{field};
  else
    return field;
}

template <class Field>
void assign(Field& field, const SceneValue& value) {
  if constexpr (std::is_same_v<Field, MotionAt>) {
    field = motion_at(std::get<std::vector<NumberOrText>>(value));
  } else if constexpr (std::is_same_v<Field, std::vector<std::string>>) {
    field.clear();
    for (const NumberOrText& one : std::get<std::vector<NumberOrText>>(value))
      field.push_back(std::get<std::string>(one));
  } else if constexpr (std::is_enum_v<Field>) {
    field = enum_value<Field>(std::get<std::string>(value));
  } else if constexpr (is_list_of<Field>) {
    using Number = typename Field::value_type;
    const auto& list = std::get<std::vector<Stored<Number>>>(value);
    if constexpr (requires { field.resize(0); }) field.resize(list.size());
    std::transform(list.begin(), list.end(), field.begin(),
                   [](auto one) { return static_cast<Number>(one); });
  } else if constexpr (std::is_same_v<Field, int>) {
    field = static_cast<int>(std::get<std::int64_t>(value));
  } else {
    field = std::get<Field>(value);
  }
}

template <class Number>
void describe_number(SceneKey& key) {
  if (!std::is_integral_v<Number>) return;
  key.type = SceneKey::Type::integer;
  key.bounds = {-std::numeric_limits<int>::max(), std::numeric_limits<int>::max()};
}

template <class Field>
void describe(SceneKey& key) {
  if constexpr (std::is_same_v<Field, bool>) {
    key.type = SceneKey::Type::boolean;
  } else if constexpr (std::is_same_v<Field, MotionAt>) {
    key.form = SceneKey::Form::mixed;
    key.choices = {"peak", "special"};
  } else if constexpr (std::is_same_v<Field, std::vector<std::string>>) {
    key.type = SceneKey::Type::text;
    key.form = SceneKey::Form::mixed;
  } else if constexpr (std::is_arithmetic_v<Field>) {
    describe_number<Field>(key);
  } else if constexpr (is_list_of<Field>) {
    describe_number<typename Field::value_type>(key);
    key.form = SceneKey::Form::list;
    if constexpr (requires { std::tuple_size<Field>::value; })
      key.length = static_cast<int>(std::tuple_size_v<Field>);
  } else {
    key.type = SceneKey::Type::text;
    if constexpr (std::is_enum_v<Field>) key.choices = enum_choices<Field>();
  }
}

/// Range or condition of a key; a Section applies it to the key that it makes.
using Property = std::function<void(SceneKey&)>;

inline Property within(double lower, double upper) {
  return [=](SceneKey& key) { key.bounds = {lower, upper, false}; };
}
/// Greater than `lower`, at most `upper`.
inline Property above(double lower, double upper = infinity) {
  return [=](SceneKey& key) { key.bounds = {lower, upper, true}; };
}
inline void positive(SceneKey& key) { key.bounds = {0.0, infinity, true}; }
inline void not_negative(SceneKey& key) { key.bounds = {0.0, infinity, false}; }

/// A list of so many entries.
inline Property exactly(int length) {
  return [=](SceneKey& key) { key.length = length; };
}

inline Property one_of(std::vector<std::string_view> texts) {
  return [=](SceneKey& key) { key.choices = texts; };
}

/// A text that names a file, relative to the scene's.
inline void path(SceneKey& key) { key.type = SceneKey::Type::path; }

/// One value for all or a list, which `get` and `set` keep in two members.
inline Property single_or_list(SceneValue (*get)(const Scene&), void (*set)(Scene&, const SceneValue&)) {
  return [=](SceneKey& key) {
    key.form = SceneKey::Form::single_or_list;
    key.get = get;
    key.set = set;
  };
}

/// Degrees of freedom, which structure.dof_map may name.
inline void named_dofs(SceneKey& key) { key.dofs = true; }

/// Entries of [[contact.pairs]] may each have their own.
inline void or_in_pairs(SceneKey& key) { key.in_pairs = true; }

/// The default is the value that the member is initialised with.
inline void optional(SceneKey& key) { key.fallback = SceneKey::Default::value; }

/// The default follows from other keys by `rule`, which `text` describes.
inline Property derived(std::string_view text, std::function<SceneValue(const Scene&)> rule) {
  return [=](SceneKey& key) {
    key.fallback = SceneKey::Default::derived;
    key.derived_text = text;
    key.derived = rule;
  };
}
inline Property derived(std::string_view text, double value) {
  return derived(text, [=](const Scene&) { return value; });
}

/// A text, a list of integers or none that is left out where it is not given.
inline Property none_by_default(SceneValue nothing = std::string()) {
  return derived("none", [=](const Scene&) { return nothing; });
}

/// An error in scenes where `condition` does not hold.
inline Property only_with(Condition condition) {
  return [=](SceneKey& key) { key.belongs = std::move(key.belongs) && condition; };
}

/// Where `condition` holds the scene has to have the key; without one, everywhere.
inline Property required_with(Condition condition) {
  return [=](SceneKey& key) { key.needed = condition; };
}

/// Makes the keys of the members of one part of a Scene; `part(scene)` is a reference to it.
template <class Part>
class Section {
 public:
  /// Its keys are errors in scenes where `condition` does not hold.
  Section(std::vector<SceneKey>& keys, std::string_view name, Part part, Condition condition = {})
      : keys_(keys), name_(name), part_(part), condition_(std::move(condition)) {}

  template <class Owner, class Field, class... Properties>
  void operator()(Field Owner::*member, std::string_view name, std::string_view unit, std::string_view help,
                  const Properties&... properties) const {
    SceneKey key;
    key.section = name_;
    key.name = name;
    key.unit = unit;
    key.help = help;
    key.belongs = condition_;
    key.get = [part = part_, member](const Scene& scene) { return value_of(part(scene).*member); };
    key.set = [part = part_, member](Scene& scene, const SceneValue& value) {
      assign(part(scene).*member, value);
    };
    describe<Field>(key);
    (properties(key), ...);
    keys_.push_back(std::move(key));
  }

 private:
  std::vector<SceneKey>& keys_;
  std::string_view name_;
  Part part_;
  Condition condition_;
};

}  // namespace wavebalance::app
