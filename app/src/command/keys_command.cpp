#include "command/commands.hpp"

#include "files/contains.hpp"
#include "scene/scene_keys_text.hpp"
#include "scene/spelling.hpp"

namespace wavebalance::app {
namespace {

using KeyFilter = std::function<bool(const SceneKey&)>;

constexpr std::string_view law_key = "contact.law";

std::vector<SceneKey> all_keys() {
  std::vector<SceneKey> keys(scene_keys().begin(), scene_keys().end());
  for (const auto& of_tables : {pair_keys(0), term_keys(0)})
    keys.insert(keys.end(), of_tables.begin(), of_tables.end());
  return keys;
}

/// The names without repetition, in the order in which they come first.
std::vector<std::string> sections_of(const std::vector<SceneKey>& keys) {
  std::vector<std::string> sections;
  for (const SceneKey& key : keys)
    if (!contains(sections, key.section)) sections.emplace_back(key.section);
  return sections;
}

/// The names of the keys whose choice decides whether others are allowed.
std::vector<std::string> deciding_keys(const std::vector<SceneKey>& keys) {
  std::vector<std::string> names;
  for (const SceneKey& key : scene_keys())
    if (!key.choices.empty() && std::ranges::any_of(keys, [&](const SceneKey& other) {
          return other.belongs.concerns(key.full_name());
        }))
      names.push_back(key.full_name());
  return names;
}

/// Whether `condition` holds for some choice of each of the keys `open`, all else as in `scene`.
bool can_hold(const Condition& condition, Scene scene, std::vector<std::string> open) {
  if (open.empty()) return condition.holds(scene);
  const SceneKey& key = *find_scene_key(open.back());
  open.pop_back();
  if (!condition.concerns(key.full_name())) return can_hold(condition, std::move(scene), std::move(open));
  return std::ranges::any_of(key.choices, [&](std::string_view choice) {
    key.set(scene, std::string(choice));
    return can_hold(condition, scene, open);
  });
}

[[noreturn]] void reject(const std::string& filter, const std::string& allowed, const std::string& word,
                         const std::vector<std::string>& names) {
  throw std::invalid_argument("keys " + filter + ": " + allowed + suggestion(word, names));
}

KeyFilter choice_filter(const std::string& filter, const std::vector<SceneKey>& keys) {
  const auto place = filter.find('=');
  const std::string name = filter.substr(0, place), value = filter.substr(place + 1);
  std::vector<std::string> deciding = deciding_keys(keys);
  if (!contains(deciding, name))
    reject(filter, "expected one of " + joined(deciding) + " before the sign =", name, deciding);
  const SceneKey& key = *find_scene_key(name);
  if (!contains(key.choices, value))
    reject(filter, name + " may be " + key.expected(), value, {key.choices.begin(), key.choices.end()});
  Scene scene;
  key.set(scene, value);
  std::erase(deciding, name);
  const bool by_law = name == law_key;
  return [=](const SceneKey& one) {
    if (by_law && !one.laws.empty() && !contains(one.laws, value)) return false;  // of a pair, too
    return can_hold(one.belongs, scene, deciding);
  };
}

/// The law of a choice "contact.law=linear"; empty without one.
std::string chosen_law(const std::vector<std::string>& filters) {
  const std::string choice = std::string(law_key) + "=";
  for (const std::string& filter : filters)
    if (filter.starts_with(choice)) return filter.substr(choice.size());
  return {};
}

KeyFilter filter_of(const std::string& filter, const std::vector<SceneKey>& keys) {
  if (filter.find('=') != std::string::npos) return choice_filter(filter, keys);
  const std::vector<std::string> sections = sections_of(keys);
  if (contains(sections, filter))
    return [filter](const SceneKey& key) {
      return key.section == filter || key.section.starts_with(filter + ".");
    };
  const KeyFilter named = [filter](const SceneKey& key) {
    return key.name == filter || key.full_name() == filter;
  };
  if (std::ranges::any_of(keys, named)) return named;
  std::vector<std::string> names = sections;
  for (const SceneKey& key : keys) {
    names.emplace_back(key.name);
    names.push_back(key.full_name());
  }
  reject(filter,
         "expected a section (" + joined(sections) + "), a key or a choice such as structure.type=matrices",
         filter, names);
}

}  // namespace

std::string selected_keys_text(const std::vector<std::string>& filters) {
  const std::vector<SceneKey> keys = all_keys();
  std::vector<KeyFilter> parts, choices;  // any of the parts, and what all choices leave
  for (const std::string& filter : filters)
    (filter.find('=') == std::string::npos ? parts : choices).push_back(filter_of(filter, keys));
  const auto shown = [&](const SceneKey& key) {
    const auto selects = [&](const KeyFilter& selected) { return selected(key); };
    return (parts.empty() || std::ranges::any_of(parts, selects)) && std::ranges::all_of(choices, selects);
  };
  const std::string text = describe_scene_keys(shown, chosen_law(filters));
  if (text.empty())
    throw std::invalid_argument("keys " + joined(filters) + ": such a scene has none of these");
  return text;
}

std::string key_names_text() {
  std::string text;
  for (const SceneKey& key : scene_keys()) {
    text += key.full_name();
    for (const auto choice : key.choices) text += " " + std::string(choice);
    if (key.type == SceneKey::Type::boolean) text += " true false";
    text += "\n";
  }
  return text;
}

}  // namespace wavebalance::app
