#include "wavebalance/app/scene/scene_keys.hpp"
#include "files/contains.hpp"

namespace wavebalance::app {

const SceneKey* find_scene_key(std::string_view full_name) {
  static const auto by_name = [] {
    std::map<std::string, const SceneKey*, std::less<>> keys;
    for (const SceneKey& key : scene_keys()) keys.emplace(key.full_name(), &key);
    return keys;
  }();
  const auto found = by_name.find(full_name);
  return found == by_name.end() ? nullptr : found->second;
}

bool Bounds::contain(double value) const {
  return (lower_excluded ? value > lower : value >= lower) && value <= upper;
}

bool Condition::Clause::holds(const Scene& scene) const {
  const std::string value = std::get<std::string>(find_scene_key(key)->get(scene));
  return contains(values, value);
}

Condition Condition::unless(std::string_view key) const {
  Condition result = *this;
  result.unless_.push_back(key);
  return result;
}

bool Condition::holds(const Scene& scene) const { return broken_by(scene).empty(); }

bool Condition::concerns(std::string_view key) const {
  return contains(unless_, key) ||
         std::ranges::any_of(clauses_, [&](const Clause& clause) { return clause.key == key; });
}

std::string_view Condition::broken_by(const Scene& scene) const {
  for (const std::string_view name : unless_)
    if (const SceneKey* key = find_scene_key(name); key && key->get(scene) != key->get(Scene{})) return name;
  const auto broken =
      std::ranges::find_if(clauses_, [&](const Clause& clause) { return !clause.holds(scene); });
  return broken == clauses_.end() ? std::string_view{} : broken->key;
}

Condition operator&&(Condition left, const Condition& right) {
  left.clauses_.insert(left.clauses_.end(), right.clauses_.begin(), right.clauses_.end());
  for (const std::string_view name : right.unless_)
    if (!contains(left.unless_, name)) left.unless_.push_back(name);
  return left;
}

bool SceneKey::required_in(const Scene& scene) const {
  if (section == "time" && moves_by_events(scene)) return false;
  if (!belongs.holds(scene) || (in_pairs && !scene.contact.pairs.empty())) return false;
  if (in_terms && !scene.forcing.terms.empty()) return false;
  if (fallback == Default::derived) return !needed.empty() && needed.holds(scene);
  return fallback == Default::required && needed.holds(scene);
}

std::string term_section(std::size_t index) { return "forcing.terms[" + std::to_string(index + 1) + "]"; }

std::string pair_section(std::size_t index) { return "contact.pairs[" + std::to_string(index + 1) + "]"; }

std::string SceneKey::full_name() const { return std::string(section) + "." + std::string(name); }

}  // namespace wavebalance::app
