#pragma once
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "wavebalance/app/scene/scene.hpp"

namespace wavebalance::app {

/// An entry of a list that mixes numbers and texts.
using NumberOrText = std::variant<double, std::string>;

/// The value of a scene's key.
using SceneValue = std::variant<std::int64_t, double, std::string, bool, std::vector<std::int64_t>,
                                std::vector<double>, std::vector<NumberOrText>>;

/// The numbers that a key admits.
struct Bounds {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool lower_excluded = false;

  bool contain(double value) const;
  /// "> 0", "in 0..1" or "" when every number is admitted.
  std::string text() const;
};

/// A condition on a scene: the conjunction of clauses "key has one of these values", true if there is no
/// clause. It is false if the scene holds a key of unless().
class Condition {
 public:
  Condition() = default;
  /// The key called `key` ("section.name") has one of `values`.
  Condition(std::string_view key, std::vector<std::string_view> values)
      : clauses_{{key, std::move(values)}} {}

  /// The same, except in scenes that hold the key called `key`.
  Condition unless(std::string_view key) const;

  bool empty() const { return clauses_.empty(); }
  bool holds(const Scene& scene) const;
  /// Whether the condition depends on the key of this name.
  bool concerns(std::string_view key) const;
  /// `contact.law = "exponential" or "linear"`; empty for every scene.
  std::string text() const;
  /// The key of the first clause that does not hold in `scene`; empty if all do.
  std::string_view broken_by(const Scene& scene) const;

  friend Condition operator&&(Condition left, const Condition& right);

 private:
  struct Clause {
    std::string_view key;
    std::vector<std::string_view> values;
    bool holds(const Scene& scene) const;
  };
  std::vector<Clause> clauses_;
  std::vector<std::string_view> unless_;
};

/// One key of a scene file; the loader, the writer and the help all use this description.
struct SceneKey {
  enum class Type { integer, number, text, boolean, path };
  /// Lists are of integers or numbers; `mixed` is a number, one of the choices, or a list of both.
  enum class Form { single, list, single_or_list, mixed };
  /// Meaning of a missing key: an error, the value that its member is initialised with, or one derived from
  /// other keys. Where `needed` holds, the key is required even if it has a derived default.
  enum class Default { required, value, derived };

  std::string_view section;
  std::string_view name;
  Type type = Type::number;
  Form form = Form::single;
  int length = 0;                         ///< number of entries of a list; 0: any from 1 on
  std::string_view unit;                  ///< empty for text and for pure numbers
  Bounds bounds;                          ///< what an integer, a number or each entry of a list may be
  std::vector<std::string_view> choices;  ///< the texts that are allowed
  Condition belongs;                      ///< scenes that may hold the key; in others it is an error
  Condition needed;                       ///< scenes in which the key is required if it has no default
  std::vector<std::string_view> laws;     ///< the contact laws that use it; empty: all
  bool dofs = false;                      ///< a list whose entries may be names such as "node 7 z"
  bool in_pairs = false;                  ///< not required where [[contact.pairs]] may each have their own
  bool in_terms = false;                  ///< nor where there are [[forcing.terms]]
  Default fallback = Default::required;
  std::string_view derived_text;                    ///< the derived default in words
  std::function<SceneValue(const Scene&)> derived;  ///< computes it from the other keys
  std::string_view help;
  std::function<SceneValue(const Scene&)> get;
  std::function<void(Scene&, const SceneValue&)> set;  ///< the value must have been checked

  std::string full_name() const;
  /// "a number in m, > 0", the expected value in error messages.
  std::string expected() const;
  /// "1024", "4 x functions", "required"; for the help.
  std::string default_text() const;
  /// Whether `scene` has to hold the key.
  bool required_in(const Scene& scene) const;
};

/// Every key, in the order in which a scene is written. Only keys with choices decide whether others are
/// allowed.
std::span<const SceneKey> scene_keys();

/// The keys of an entry of [[contact.pairs]], the one at `index` from 0: `get` and `set` act on that pair
/// of a scene. Each is read after scene_keys(), from which its default follows.
std::vector<SceneKey> pair_keys(std::size_t index);

/// The same of an entry of [[forcing.terms]].
std::vector<SceneKey> term_keys(std::size_t index);
std::string term_section(std::size_t index);

/// "contact.pairs[1]": the section of the pair at `index` from 0, in messages and overrides.
std::string pair_section(std::size_t index);

/// The key called "section.name", or nullptr.
const SceneKey* find_scene_key(std::string_view full_name);

/// Every key with its meaning, unit, range and default as lines of text of at most `width` columns.
std::string describe_scene_keys(int width = 100);

/// `value` as text of a scene file: 0.001, 64, "haar". Numbers are the shortest text that reads back equal.
std::string toml_text(const SceneValue& value);

}  // namespace wavebalance::app
