#include "scene/scene_reader.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <functional>
#include <set>

#include "scene/keys/law_keys.hpp"
#include "scene/pair_reader.hpp"
#include "scene/spelling.hpp"
#include "scene/term_reader.hpp"
#include "wavebalance/app/scene/scene_error.hpp"
#include "wavebalance/app/scene/scene_keys.hpp"

namespace wavebalance::app {
namespace {

[[noreturn]] void fail_missing(const Document& document, const SceneKey& key) {
  const std::string section(key.section);
  const std::string where = document.section_line(section) == 0 ? ", in a section [" + section + "]" : "";
  throw SceneError({document.name, document.section_line(section), "", key.full_name(), "",
                    "missing; expected " + key.expected() + where});
}

/// The keys of an entry of [[contact.pairs]] or [[forcing.terms]]; none for another section.
std::vector<SceneKey> keys_of_tables(std::string_view section) {
  if (is_pair_section(section)) return pair_keys(0);
  return is_term_section(section) ? term_keys(0) : std::vector<SceneKey>();
}

bool is_table_section(std::string_view section) {
  return is_pair_section(section) || is_term_section(section);
}

/// Names of `section`'s keys; of all sections when there is no such section.
std::vector<std::string> known_names(const std::string& section) {
  std::vector<std::string> names;
  for (const SceneKey& key : keys_of_tables(section)) names.emplace_back(key.name);
  for (const SceneKey& key : scene_keys())
    if (key.section == section) names.emplace_back(key.name);
  if (!names.empty()) return names;
  for (const SceneKey& key : scene_keys())
    if (std::find(names.begin(), names.end(), key.section) == names.end()) names.emplace_back(key.section);
  return names;
}

bool is_section(const std::string& name) {
  const auto keys = scene_keys();
  return std::any_of(keys.begin(), keys.end(), [&](const SceneKey& key) { return key.section == name; });
}

/// The error text for an unknown name, with the nearest known name as a suggestion, written by `shown`.
std::string unknown_text(const std::string& name, const std::vector<std::string>& known,
                         const std::function<std::string(const std::string&)>& shown) {
  const std::string close = closest(name, known);
  return close.empty() ? "; known are " + joined(known) : "; did you mean " + shown(close) + "?";
}

std::string unknown_section_text(const std::string& section) {
  const auto shown = [](const std::string& name) { return "[" + name + "]"; };
  return "unknown section" + unknown_text(section, known_names(section), shown);
}

/// What records of earlier versions say of their modes, and what holds for all modes now.
bool is_former(const DocumentEntry& entry) {
  const auto* text = std::get_if<std::string>(&entry.value);
  return entry.full_name() == "analysis.formulation" && text != nullptr && *text == "consistent";
}

[[noreturn]] void fail_unknown(const Document& document, const DocumentEntry& entry) {
  if (entry.section.empty() && is_section(entry.key))
    fail_at(document, entry, "expected a section [" + entry.key + "] of keys");
  if (entry.section.empty()) fail_at(document, entry, "unknown key outside of any section");
  if (entry.full_name() == "contact.pairs")
    fail_at(document, entry, "expected tables [[contact.pairs]], one for each direction of contact");
  if (entry.full_name() == "forcing.terms")
    fail_at(document, entry, "expected tables [[forcing.terms]], one for each further load");
  if (entry.full_name() == "analysis.formulation")
    fail_at(
        document, entry,
        "a mode has consistent equations, and the key is left out; those that Laxalde & Legrand published are "
        "solved in reproduce/laxalde_legrand_2010");
  if (is_term_section(entry.section) && !document.has_section(entry.section))
    fail_at(document, entry,
            "the scene has " + std::to_string(count_terms(document)) + " [[forcing.terms]], counted from 1");
  if (is_pair_section(entry.section) && !document.has_section(entry.section))
    fail_at(document, entry,
            "the scene has " + std::to_string(count_pairs(document)) + " [[contact.pairs]], counted from 1");
  if (!is_section(entry.section) && !is_table_section(entry.section))
    fail_at(document, entry, unknown_section_text(entry.section));
  const auto shown = [&](const std::string& name) { return entry.section + "." + name; };
  if (const std::string_view meant = name_for(entry.section, entry.key); !meant.empty())
    fail_at(document, entry, "unknown key; did you mean " + shown(std::string(meant)) + "?");
  fail_at(document, entry, "unknown key" + unknown_text(entry.key, known_names(entry.section), shown));
}

void reject_unknown(const Document& document) {
  for (const DocumentSection& section : document.sections)
    if (!is_section(section.name) && !is_table_section(section.name))
      throw SceneError({document.name, section.line, "", "[" + section.name + "]", "",
                        unknown_section_text(section.name)});
  const auto is_known = [&](const DocumentEntry& entry) {
    if (is_former(entry)) return true;
    if (!is_table_section(entry.section)) return find_scene_key(entry.full_name()) != nullptr;
    const std::vector<std::string> names = known_names(entry.section);
    return document.has_section(entry.section) &&
           std::find(names.begin(), names.end(), entry.key) != names.end();
  };
  for (const DocumentEntry& entry : document.entries)
    if (!is_known(entry)) fail_unknown(document, entry);
}

SceneValue checked_text(const Document& document, const DocumentEntry& entry, const SceneKey& key) {
  const auto* text = std::get_if<std::string>(&entry.value);
  const bool any = key.choices.empty();
  if (text != nullptr &&
      (any || std::find(key.choices.begin(), key.choices.end(), *text) != key.choices.end()))
    return *text;
  std::string allowed = "expected " + key.expected();
  if (text != nullptr) {
    std::string close(name_for(key.name, *text));
    if (close.empty())
      close = closest(*text, std::vector<std::string>(key.choices.begin(), key.choices.end()));
    if (!close.empty()) allowed += "; did you mean \"" + close + "\"?";
  }
  fail_at(document, entry, allowed);
}

void check_number(const Document& document, const DocumentEntry& entry, const SceneKey& key, double value) {
  if (!std::isfinite(value)) fail_at(document, entry, "expected " + key.expected() + "; it must be finite");
  if (!key.bounds.contain(value)) fail_at(document, entry, "out of range; expected " + key.expected());
}

SceneValue checked_number(const Document& document, const DocumentEntry& entry, const SceneKey& key) {
  const auto* integer = std::get_if<std::int64_t>(&entry.value);
  const auto* number = std::get_if<double>(&entry.value);
  const bool right_type = integer != nullptr || (number != nullptr && key.type == SceneKey::Type::number);
  if (!right_type) fail_at(document, entry, "expected " + key.expected());
  const double value = integer != nullptr ? static_cast<double>(*integer) : *number;
  check_number(document, entry, key, value);
  if (key.type == SceneKey::Type::integer) return *integer;
  return value;
}

SceneValue checked_list(const Document& document, const DocumentEntry& entry, const SceneKey& key) {
  const auto* integers = std::get_if<std::vector<std::int64_t>>(&entry.value);
  const auto* given = std::get_if<std::vector<double>>(&entry.value);
  if (integers == nullptr && (given == nullptr || key.type == SceneKey::Type::integer))
    fail_at(document, entry, "expected " + key.expected());
  const std::vector<double> numbers =
      integers == nullptr ? *given : std::vector<double>(integers->begin(), integers->end());
  const bool right_length =
      key.length == 0 ? !numbers.empty() : static_cast<int>(numbers.size()) == key.length;
  if (!right_length)
    fail_at(document, entry, "there are " + std::to_string(numbers.size()) + "; expected " + key.expected());
  for (const double value : numbers) check_number(document, entry, key, value);
  if (key.type == SceneKey::Type::integer) return *integers;
  return numbers;
}

/// An entry as TOML has it, or as an element of a list of texts and integers.
NumberOrText entry_of_text(const std::string& text) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error == std::errc() && end == text.data() + text.size()) return number;
  return text;
}

/// A number, a text or a list as a list of both; empty for anything else.
std::vector<NumberOrText> entries_of(const DocumentValue& value) {
  if (const auto* entries = std::get_if<std::vector<NumberOrText>>(&value)) return *entries;
  if (const auto* text = std::get_if<std::string>(&value)) return {entry_of_text(*text)};
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return {static_cast<double>(*integer)};
  if (const auto* number = std::get_if<double>(&value)) return {*number};
  std::vector<NumberOrText> entries;
  if (const auto* texts = std::get_if<std::vector<std::string>>(&value))
    for (const std::string& text : *texts) entries.push_back(entry_of_text(text));
  if (const auto* integers = std::get_if<std::vector<std::int64_t>>(&value))
    for (const std::int64_t one : *integers) entries.emplace_back(static_cast<double>(one));
  if (const auto* numbers = std::get_if<std::vector<double>>(&value))
    entries.assign(numbers->begin(), numbers->end());
  return entries;
}

SceneValue checked_mixed(const Document& document, const DocumentEntry& entry, const SceneKey& key) {
  std::vector<NumberOrText> entries = entries_of(entry.value);
  if (entries.empty()) fail_at(document, entry, "expected " + key.expected());
  for (const NumberOrText& one : entries) {
    if (const auto* number = std::get_if<double>(&one)) {
      check_number(document, entry, key, *number);
      continue;
    }
    const std::string& text = std::get<std::string>(one);
    if (std::find(key.choices.begin(), key.choices.end(), text) != key.choices.end()) continue;
    fail_at(document, entry, toml_text(text) + " is none of them; expected " + key.expected());
  }
  return entries;
}

SceneValue checked_path(const Document& document, const DocumentEntry& entry, const SceneKey& key) {
  const auto* text = std::get_if<std::string>(&entry.value);
  if (text == nullptr || text->empty()) fail_at(document, entry, "expected " + key.expected());
  return path_in(document, *text);
}

bool is_list(const DocumentValue& value) {
  return std::holds_alternative<std::vector<std::int64_t>>(value) ||
         std::holds_alternative<std::vector<double>>(value);
}

SceneValue checked_truth(const Document& document, const DocumentEntry& entry, const SceneKey& key) {
  if (const auto* truth = std::get_if<bool>(&entry.value)) return *truth;
  fail_at(document, entry, "expected " + key.expected());
}

SceneValue checked(const Document& document, const DocumentEntry& entry, const SceneKey& key) {
  using Form = SceneKey::Form;
  if (key.form == Form::mixed) return checked_mixed(document, entry, key);
  if (key.form == Form::list || (key.form == Form::single_or_list && is_list(entry.value)))
    return checked_list(document, entry, key);
  if (key.form == Form::single_or_list && (std::holds_alternative<std::monostate>(entry.value) ||
                                           std::holds_alternative<std::vector<std::string>>(entry.value)))
    fail_at(document, entry, "expected " + key.expected() + ", or a list of them");
  switch (key.type) {
    case SceneKey::Type::boolean:
      return checked_truth(document, entry, key);
    case SceneKey::Type::text:
      return checked_text(document, entry, key);
    case SceneKey::Type::path:
      return checked_path(document, entry, key);
    case SceneKey::Type::integer:
    case SceneKey::Type::number:
      break;
  }
  return checked_number(document, entry, key);
}

/// The keys on which it depends whether others are allowed or required.
std::set<const SceneKey*> keys_that_govern() {
  std::set<const SceneKey*> found;
  for (const SceneKey& key : scene_keys())
    for (const SceneKey& other : scene_keys())
      if (other.belongs.concerns(key.full_name()) || other.needed.concerns(key.full_name()))
        found.insert(&key);
  return found;
}

/// Whether a key of scene_keys() is one of these, so that it must be read before the others.
bool governs(const SceneKey& key) {
  static const std::set<const SceneKey*> governing = keys_that_govern();
  return governing.contains(&key);
}

/// Why a key does not belong to the scene, and which keys do where the law decides.
std::string stray_text(const SceneKey& key, std::string_view broken, const Scene& scene) {
  std::string text = "does not belong to a scene with " + std::string(broken) + " = " +
                     toml_text(find_scene_key(broken)->get(scene)) + "; only with " + key.belongs.text();
  if (broken == "contact.law") text += "; the keys of this law are " + parameter_names(scene.contact.law);
  return text;
}

void read_key(const Document& document, const SceneKey& key, Scene& scene) {
  const DocumentEntry* entry = document.find(key.section, key.name);
  if (const std::string_view broken = key.belongs.broken_by(scene); !broken.empty()) {
    if (entry != nullptr && (broken != "analysis.type" || !is_of_former_analysis(document, *entry)))
      fail_at(document, *entry, stray_text(key, broken, scene));
    return;
  }
  if (entry != nullptr)
    key.set(scene, checked(document, *entry, key));
  else if (key.required_in(scene))
    fail_missing(document, key);
  else if (key.fallback == SceneKey::Default::derived)
    key.set(scene, key.derived(scene));
}

}  // namespace

void fail_at(const Document& document, const DocumentEntry& entry, std::string allowed) {
  throw SceneError(
      {document.name, entry.line, entry.override, entry.full_name(), entry.found, std::move(allowed)});
}

bool is_of_former_analysis(const Document& document, const DocumentEntry& entry) {
  const DocumentEntry* type = document.find("analysis", "type");
  return entry.section == "time" && entry.override.empty() && type != nullptr && !type->override.empty();
}

std::string path_in(const Document& document, const std::string& name) {
  const auto folder = std::filesystem::absolute(document.name).parent_path();
  return (folder / name).lexically_normal().string();
}

SceneValue checked_value(const Document& document, const DocumentEntry& entry, const SceneKey& key) {
  return checked(document, entry, key);
}

Scene read_scene(const Document& given) {
  Scene scene;
  scene.contact.pairs.resize(count_pairs(given));
  scene.forcing.terms.resize(count_terms(given));
  reject_unknown(given);
  const Document document = with_law_of_pairs(given);
  const auto read = [&](const auto& wanted) {
    for (const SceneKey& key : scene_keys())
      if (wanted(key)) read_key(document, key, scene);
  };
  read([](const SceneKey& key) { return governs(key) && key.belongs.empty(); });
  read([](const SceneKey& key) { return governs(key) && !key.belongs.empty(); });
  // Laws of pairs may need no pair of bases, and defaults of the analysis follow from that.
  const auto last = [](const SceneKey& key) { return key.section == "time" || key.section == "analysis"; };
  read([&](const SceneKey& key) { return !governs(key) && !last(key); });
  read_pairs(document, scene);
  read_terms(document, scene);
  read([&](const SceneKey& key) { return !governs(key) && last(key); });
  return scene;
}

}  // namespace wavebalance::app
