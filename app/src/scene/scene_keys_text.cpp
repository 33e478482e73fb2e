#include "scene/scene_keys_text.hpp"

#include <charconv>
#include <sstream>

#include "files/number_text.hpp"
#include "scene/keys/law_keys.hpp"

namespace wavebalance::app {
namespace {

std::string quoted(std::string_view text) { return "\"" + std::string(text) + "\""; }

/// Limits are whole numbers or short ones, written without an exponent.
std::string limit_text(double value) {
  std::array<char, 32> buffer;
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed).ptr;
  return {buffer.data(), end};
}

/// `text` broken at spaces, each line opened by `indent` spaces.
std::string wrapped(const std::string& text, int indent, int width) {
  std::istringstream words(text);
  const std::string margin(static_cast<std::size_t>(indent), ' ');
  std::string result;
  std::string line = margin;
  for (std::string word; words >> word;) {
    const bool empty = line.size() == margin.size();
    if (!empty && static_cast<int>(line.size() + 1 + word.size()) > width) {
      result += line + "\n";
      line = margin;
    }
    if (line.size() > margin.size()) line += ' ';
    line += word;
  }
  return result + line + "\n";
}

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '"' || c == '\\')
      result += std::string("\\") + c;
    else if (c == '\n')
      result += "\\n";
    else if (c == '\t')
      result += "\\t";
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      constexpr char digits[] = "0123456789ABCDEF";
      result += std::string("\\u00") + digits[static_cast<unsigned char>(c) >> 4] + digits[c & 15];
    } else
      result += c;
  }
  return result;
}

SceneValue value_of_entry(double number) { return number; }
SceneValue value_of_entry(std::int64_t number) { return number; }
SceneValue value_of_entry(const NumberOrText& entry) {
  return std::visit([](const auto& content) { return SceneValue(content); }, entry);
}

template <class Entry>
std::string list_text(const std::vector<Entry>& list) {
  std::string text;
  for (const Entry& one : list) text += (text.empty() ? "" : ", ") + toml_text(value_of_entry(one));
  return "[" + text + "]";
}

std::string number_words(const SceneKey& key) {
  std::string text = key.type == SceneKey::Type::integer ? "an integer" : "a number";
  if (key.form == SceneKey::Form::list) {
    const std::string many = key.type == SceneKey::Type::integer ? "integers" : "numbers";
    text = key.dofs         ? "a list of integers or texts such as \"node 1042 z\""
           : key.length > 0 ? "a list of " + std::to_string(key.length) + " " + many
                            : "a list of " + many;
  }
  return text;
}

/// A key with its meaning and what it may be.
std::string key_text(const SceneKey& key, int width) {
  std::string status =
      key.fallback == SceneKey::Default::required ? key.default_text() : "default " + key.default_text();
  if (key.fallback == SceneKey::Default::derived && !key.needed.empty())
    status += ", required with " + key.needed.text();
  const std::string list = key.form == SceneKey::Form::single_or_list
                               ? "; a list has one for each degree of freedom in contact."
                               : ".";
  return "  " + std::string(key.name) + "\n" + wrapped(std::string(key.help) + list, 6, width) +
         wrapped(key.expected() + "; " + status +
                     (key.in_pairs ? " unless every one of [[contact.pairs]] has its own" : "") +
                     (key.belongs.empty() ? "" : "; only with " + key.belongs.text()),
                 6, width);
}

/// `title` and the keys of `keys` that are shown; empty if none is.
std::string section_text(const std::string& title, std::span<const SceneKey> keys,
                         const std::function<bool(const SceneKey&)>& shown, std::string_view law, int width) {
  std::string text;
  for (const SceneKey& key : keys)
    if (shown(key)) text += key_text(law.empty() ? key : key_of_law(key, law), width);
  return text.empty() ? "" : title + "\n" + text;
}

/// Heading of the keys of `section`.
std::string section_title(std::string_view section) {
  if (section == "contact.pairs")
    return "[[contact.pairs]], any number of them, in place of structure.contact_dofs";
  if (section == "forcing.terms")
    return "[[forcing.terms]], any number of loads in addition to forcing.amplitude";
  return "[" + std::string(section) + "]";
}

/// The keys of one section that follow each other in `keys`.
std::span<const SceneKey> first_section(std::span<const SceneKey> keys) {
  std::size_t count = 0;
  while (count < keys.size() && keys[count].section == keys[0].section) ++count;
  return keys.first(count);
}

}  // namespace

std::string alternatives(const std::vector<std::string_view>& values) {
  std::vector<std::string> names;
  bool daubechies = false;
  for (const auto value : values) {
    if (!value.starts_with("daubechies"))
      names.push_back(quoted(value));
    else if (!std::exchange(daubechies, true))
      names.push_back("\"daubechiesN\" with an even N in 2..40");
  }
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 == names.size() ? " or " : ", ") + names[i];
  return text;
}

std::string toml_text(const SceneValue& value) {
  if (const auto* integers = std::get_if<std::vector<std::int64_t>>(&value)) return list_text(*integers);
  if (const auto* numbers = std::get_if<std::vector<double>>(&value)) return list_text(*numbers);
  if (const auto* entries = std::get_if<std::vector<NumberOrText>>(&value)) return list_text(*entries);
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return std::to_string(*integer);
  if (const auto* truth = std::get_if<bool>(&value)) return *truth ? "true" : "false";
  if (const auto* text = std::get_if<std::string>(&value)) return "\"" + escaped(*text) + "\"";
  const std::string number = number_text(std::get<double>(value));
  return number.find_first_of(".en") == std::string::npos ? number + ".0" : number;
}

std::string Bounds::text() const {
  if (lower <= std::numeric_limits<int>::min() + 1.0) return "";  // whatever an int holds
  if (std::isfinite(upper))
    return (lower_excluded ? "> " + limit_text(lower) + " and <= " : "in " + limit_text(lower) + "..") +
           limit_text(upper);
  return (lower_excluded ? "> " : ">= ") + limit_text(lower);
}

std::string Condition::text() const {
  std::string text;
  for (const Clause& clause : clauses_)
    text += (text.empty() ? "" : " and ") + std::string(clause.key) + " = " + alternatives(clause.values);
  std::string keys;
  for (const std::string_view key : unless_) keys += (keys.empty() ? "" : " or ") + std::string(key);
  return keys.empty() ? text : text + " unless " + keys + " is given";
}

std::string SceneKey::expected() const {
  if (form == Form::mixed && choices.empty()) return "a list of integers or texts such as \"node 1042 z\"";
  if (type == Type::text) return choices.empty() ? "a text" : alternatives(choices);
  if (type == Type::boolean) return "true or false";
  if (type == Type::path) return "the name of a file, relative to the scene's folder";
  std::string text = number_words(*this);
  if (!unit.empty()) text += " in " + std::string(unit);
  const std::string range = bounds.text();
  if (!range.empty()) text += ", " + range;
  if (form != Form::mixed) return text;
  std::string names = alternatives(choices);
  return names.replace(names.find(" or "), 4, ", ") + " or " + text + ", or a list of these";
}

std::string SceneKey::default_text() const {
  if (fallback == Default::derived) return std::string(derived_text);
  if (fallback == Default::value) {
    const SceneValue value = get(Scene{});
    const bool unset = value == SceneValue(std::string()) ||
                       value == SceneValue(std::vector<std::int64_t>()) ||
                       value == SceneValue(std::vector<NumberOrText>());
    return unset ? "none" : toml_text(value);
  }
  return needed.empty() ? "required" : "required with " + needed.text();
}

std::string describe_scene_keys(int width) {
  return describe_scene_keys([](const SceneKey&) { return true; }, {}, width);
}

std::string describe_scene_keys(const std::function<bool(const SceneKey&)>& shown, std::string_view law,
                                int width) {
  std::string text;
  const auto append = [&](std::span<const SceneKey> keys) {
    const std::string section = section_text(section_title(keys[0].section), keys, shown, law, width);
    if (!section.empty()) text += (text.empty() ? "" : "\n") + section;
  };
  for (std::span<const SceneKey> rest = scene_keys(); !rest.empty();) {
    const auto section = first_section(rest);
    if (section[0].section == "contact") append(pair_keys(0));
    if (section[0].section == "forcing") append(term_keys(0));
    append(section);
    rest = rest.subspan(section.size());
  }
  return text;
}

}  // namespace wavebalance::app
