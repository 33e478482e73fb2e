#include "scene/scene_reader.hpp"

#include <charconv>
#include <set>

#include "files/contains.hpp"
#include "scene/keys/law_keys.hpp"
#include "scene/pair_reader.hpp"
#include "scene/spelling.hpp"
#include "scene/term_reader.hpp"
#include "wavebalance/app/scene/scene_error.hpp"

namespace wavebalance::app {
namespace {

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
    if (!contains(names, key.section)) names.emplace_back(key.section);
  return names;
}

bool is_section(const std::string& name) {
  const auto keys = scene_keys();
  return std::ranges::any_of(keys, [&](const SceneKey& key) { return key.section == name; });
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

/// Keys of modes in records of earlier versions, with their fixed present values.
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
    return document.has_section(entry.section) && contains(names, entry.key);
  };
  for (const DocumentEntry& entry : document.entries)
    if (!is_known(entry)) fail_unknown(document, entry);
}

SceneValue checked_text(const Document& document, const DocumentEntry& entry, const SceneKey& key) {
  const auto* text = std::get_if<std::string>(&entry.value);
  const bool any = key.choices.empty();
  if (text != nullptr && (any || contains(key.choices, *text))) return *text;
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
  if (key.bounds.contain(value)) return;
  const bool other_side = key.dofs && value < 0.0 && entry.section.starts_with("contact.pairs");
  fail_at(
      document, entry,
      "out of range; expected " + key.expected() +
          (other_side ? "; the other sign is a negative one of coefficients, or side = \"negative\"" : ""));
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

template <class Type>
bool holds(const DocumentScalar& one) {
  return std::holds_alternative<Type>(one);
}

/// Whether a value is a list of numbers only.
bool is_list(const DocumentValue& value) {
  const auto* list = std::get_if<DocumentList>(&value);
  return list != nullptr && std::none_of(list->begin(), list->end(), holds<std::string>);
}

SceneValue checked_list(const Document& document, const DocumentEntry& entry, const SceneKey& key) {
  const bool of_integers = key.type == SceneKey::Type::integer;
  const auto* list = std::get_if<DocumentList>(&entry.value);
  if (!is_list(entry.value) || (of_integers && std::any_of(list->begin(), list->end(), holds<double>)))
    fail_at(document, entry, "expected " + key.expected());
  if (key.length == 0 ? list->empty() : std::ssize(*list) != key.length)
    fail_at(document, entry, "there are " + std::to_string(list->size()) + "; expected " + key.expected());
  std::vector<std::int64_t> integers;
  std::vector<double> numbers;
  for (const DocumentScalar& one : *list) {
    const auto* integer = std::get_if<std::int64_t>(&one);
    numbers.push_back(integer == nullptr ? std::get<double>(one) : static_cast<double>(*integer));
    if (integer != nullptr) integers.push_back(*integer);
    check_number(document, entry, key, numbers.back());
  }
  if (of_integers) return integers;
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
  std::vector<NumberOrText> entries;
  const auto append = [&](const DocumentScalar& one) {
    if (const auto* text = std::get_if<std::string>(&one)) return entries.push_back(entry_of_text(*text));
    const auto* integer = std::get_if<std::int64_t>(&one);
    entries.emplace_back(integer == nullptr ? std::get<double>(one) : static_cast<double>(*integer));
  };
  if (const auto* list = std::get_if<DocumentList>(&value)) std::for_each(list->begin(), list->end(), append);
  if (const auto* text = std::get_if<std::string>(&value)) append(*text);
  if (const auto* integer = std::get_if<std::int64_t>(&value)) append(*integer);
  if (const auto* number = std::get_if<double>(&value)) append(*number);
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
    if (key.choices.empty() || contains(key.choices, text)) continue;
    fail_at(document, entry, toml_text(text) + " is none of them; expected " + key.expected());
  }
  return entries;
}

SceneValue checked_path(const Document& document, const DocumentEntry& entry, const SceneKey& key) {
  const auto* text = std::get_if<std::string>(&entry.value);
  if (text == nullptr || text->empty()) fail_at(document, entry, "expected " + key.expected());
  return path_in(document, *text);
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
                                           std::holds_alternative<DocumentList>(entry.value)))
    fail_at(document, entry, "expected " + key.expected() + ", or a list of them");
  if (key.type == SceneKey::Type::boolean) return checked_truth(document, entry, key);
  if (key.type == SceneKey::Type::text) return checked_text(document, entry, key);
  if (key.type == SceneKey::Type::path) return checked_path(document, entry, key);
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
    fail_missing(document, std::string(key.section), key.name,
                 key.expected() + (document.section_line(key.section) == 0
                                       ? ", in a section [" + std::string(key.section) + "]"
                                       : ""));
  else if (key.fallback == SceneKey::Default::derived)
    key.set(scene, key.derived(scene));
}

}  // namespace

void fail_at(const Document& document, const DocumentEntry& entry, std::string allowed) {
  throw SceneError(
      {document.name, entry.line, entry.override, entry.full_name(), entry.found, std::move(allowed)});
}

void fail_missing(const Document& document, const std::string& section, std::string_view name,
                  const std::string& expected) {
  throw SceneError({document.name, document.section_line(section), "", section + "." + std::string(name), "",
                    "missing; expected " + expected});
}

void take_key(const Document& document, const std::string& section, const SceneKey& key, Scene& scene) {
  const DocumentEntry* given = document.find(section, key.name);
  key.set(scene, given == nullptr ? key.derived(scene) : checked(document, *given, key));
}

bool is_of_former_analysis(const Document& document, const DocumentEntry& entry) {
  const DocumentEntry* type = document.find("analysis", "type");
  return entry.section == "time" && entry.override.empty() && type != nullptr && !type->override.empty();
}

std::string path_in(const Document& document, const std::string& name) {
  const auto folder = std::filesystem::absolute(document.name).parent_path();
  return (folder / name).lexically_normal().string();
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
