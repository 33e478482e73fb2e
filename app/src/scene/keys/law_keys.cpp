#include "scene/keys/law_keys.hpp"

#include "scene/scene_key_builder.hpp"
#include "scene/spelling.hpp"

namespace wavebalance::app {
namespace {

using contact::LawEntry;
using contact::LawParameter;

Bounds bounds_of(const contact::LawRange& range) { return {range.lower, range.upper, range.lower_excluded}; }

void add(std::vector<SharedParameter>& all, const LawEntry& law, const LawParameter& parameter) {
  const auto known =
      std::ranges::find_if(all, [&](const SharedParameter& one) { return one.first.name == parameter.name; });
  if (known == all.end()) {
    all.push_back({parameter, {law.name}, std::string(parameter.help)});
    return;
  }
  if (!(known->first.range == parameter.range)) known->first.range = {};  // the law refuses the rest
  known->laws.push_back(law.name);
  if (known->help.find(parameter.help) == std::string::npos)
    known->help += "; " + std::string(parameter.help);
}

std::vector<SharedParameter> all_parameters() {
  std::vector<SharedParameter> all;
  for (const LawEntry& law : contact::law_catalogue())
    for (const LawParameter& parameter : law.parameters)
      if (parameter.name != "tangents") add(all, law, parameter);  // a scene defines it by its directions
  std::stable_partition(all.begin(), all.end(),
                        [](const SharedParameter& one) { return one.first.name != "gap"; });
  return all;
}

SceneValue empty_of(LawParameter::Kind kind) {
  if (kind == LawParameter::Kind::number) return 0.0;
  if (kind == LawParameter::Kind::list) return std::vector<double>();
  return std::string();
}

}  // namespace

std::span<const SharedParameter> law_parameters() {
  static const std::vector<SharedParameter> all = all_parameters();
  return all;
}

SceneKey key_of_parameter(std::string_view section, const SharedParameter& parameter) {
  SceneKey key;
  key.section = section;
  key.name = parameter.first.name;
  key.unit = parameter.first.unit;
  key.help = parameter.help;
  key.laws = parameter.laws;
  key.bounds = bounds_of(parameter.first.range);
  key.length = parameter.first.length;
  if (parameter.first.kind == LawParameter::Kind::list) key.form = SceneKey::Form::list;
  if (parameter.first.kind == LawParameter::Kind::file) key.type = SceneKey::Type::path;
  if (parameter.first.fallback) optional(key);
  if (parameter.first.may_lack) none_by_default()(key);
  if (!parameter.first.same_as.empty())
    derived(parameter.first.same_as, [](const Scene&) { return std::string(); })(key);
  return key;
}

SceneValue value_in(const contact::LawValues& values, const LawParameter& parameter) {
  if (const auto found = values.find(parameter.name); found != values.end())
    return std::visit([](const auto& value) { return SceneValue(value); }, found->second);
  if (parameter.fallback) return *parameter.fallback;
  return parameter.required() ? empty_of(parameter.kind) : SceneValue(std::string());
}

void set_value(contact::LawValues& values, const LawParameter& parameter, const SceneValue& value) {
  const std::string name(parameter.name);
  values.erase(name);
  const auto* text = std::get_if<std::string>(&value);
  if (text != nullptr && text->empty()) return;
  const auto* number = std::get_if<double>(&value);
  if (number != nullptr && parameter.fallback == *number) return;
  if (number != nullptr) values.emplace(name, *number);
  if (const auto* list = std::get_if<std::vector<double>>(&value)) values.emplace(name, *list);
  if (text != nullptr) values.emplace(name, *text);
}

SceneKey key_of_law(SceneKey key, std::string_view law) {
  const contact::LawEntry& entry = contact::law_entry(law);
  if (key.full_name() == "contact.law") key.help = entry.force;
  const LawParameter* parameter = entry.find(key.name);
  if (key.laws.empty() || parameter == nullptr) return key;
  key.help = parameter->help;
  key.bounds = bounds_of(parameter->range);
  key.belongs = {};
  return key;
}

std::vector<std::string_view> law_names(bool (*wanted)(const LawEntry&)) {
  std::vector<std::string_view> names;
  for (const LawEntry& law : contact::law_catalogue())
    if (wanted(law)) names.push_back(law.name);
  return names;
}

std::vector<std::string_view> laws_of_modes() {
  return law_names([](const LawEntry& law) { return law.name != no_law; });
}

std::string parameter_names(std::string_view law) {
  std::vector<std::string> names;
  for (const LawParameter& one : contact::law_entry(law).parameters)
    if (one.name != "tangents") names.emplace_back(one.name);
  return names.empty() ? "none" : joined(names);
}

std::string forces_text() {
  std::string text;
  for (const LawEntry& law : contact::law_catalogue())
    text += (text.empty() ? "" : "; ") + std::string(law.name) + ", " + std::string(law.force);
  return text;
}

}  // namespace wavebalance::app
