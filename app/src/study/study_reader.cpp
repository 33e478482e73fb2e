#include <fmt/format.h>

#include <cmath>
#include <sstream>

#include "files/contains.hpp"
#include "scene/spelling.hpp"
#include "scene/toml_text.hpp"
#include "wavebalance/app/scene/scene_error.hpp"
#include "wavebalance/app/scene/scene_keys.hpp"
#include "wavebalance/app/study/study.hpp"

namespace wavebalance::app {
namespace {

constexpr std::size_t max_study_bytes = std::size_t{1} << 26;

int line_of_node(const toml::node& node) { return static_cast<int>(node.source().begin.line); }

/// A value as TOML; numbers are the shortest text that reads back equal.
std::string text_of(const toml::node& node) {
  if (node.is_integer()) return toml_text(SceneValue(node.as_integer()->get()));
  if (node.is_floating_point()) return toml_text(SceneValue(node.as_floating_point()->get()));
  if (node.is_string()) return toml_text(SceneValue(node.as_string()->get()));
  if (const auto* array = node.as_array()) {
    std::string text;
    for (const toml::node& one : *array) text += (text.empty() ? "" : ", ") + text_of(one);
    return "[" + text + "]";
  }
  std::ostringstream text;
  node.visit([&](const auto& concrete) { text << concrete; });
  return text.str();
}

/// The keys of one table of a study, each read once; what is left over is unknown.
class StudyTable {
 public:
  StudyTable(const toml::table& table, std::string file, std::string prefix)
      : table_(table), file_(std::move(file)), prefix_(std::move(prefix)) {}

  [[noreturn]] void fail(const std::string& key, const toml::node* node, const std::string& allowed) const {
    throw SceneError({file_, node == nullptr ? line_of_node(table_) : line_of_node(*node), "", prefix_ + key,
                      node == nullptr ? "" : found_text(*node), allowed});
  }

  const toml::node* find(const std::string& key) {
    known_.push_back(key);
    return table_.get(key);
  }

  std::string text(const std::string& key, const std::string& missing, const std::string& allowed) {
    const toml::node* node = find(key);
    if (node == nullptr) return missing;
    if (!node->is_string() || node->as_string()->get().empty()) fail(key, node, "expected " + allowed);
    return node->as_string()->get();
  }

  /// `missing` unless the key is there.
  std::int64_t integer(const std::string& key, std::int64_t missing, std::int64_t least, std::int64_t most) {
    const toml::node* node = find(key);
    if (node == nullptr) return missing;
    const bool fits =
        node->is_integer() && node->as_integer()->get() >= least && node->as_integer()->get() <= most;
    if (!fits) fail(key, node, fmt::format("expected an integer in {}..{}", least, most));
    return node->as_integer()->get();
  }

  bool truth(const std::string& key) {
    const toml::node* node = find(key);
    if (node != nullptr && !node->is_boolean()) fail(key, node, "expected true or false");
    return node != nullptr && node->as_boolean()->get();
  }

  double number(const std::string& key, const std::string& when) {
    const toml::node* node = find(key);
    if (node == nullptr) fail(key, nullptr, "missing; expected a number " + when);
    const auto value = node->value<double>();
    if (!node->is_number() || !value || !std::isfinite(*value)) fail(key, node, "expected a finite number");
    return *value;
  }

  std::vector<std::string> texts(const std::string& key, const std::string& example) {
    const toml::node* node = find(key);
    std::vector<std::string> list;
    if (node == nullptr) return list;
    const std::string expected = "expected a list of texts such as " + example;
    if (!node->is_array()) fail(key, node, expected);
    for (const toml::node& one : *node->as_array()) {
      if (!one.is_string()) fail(key, &one, expected);
      list.push_back(one.as_string()->get());
    }
    return list;
  }

  /// Call last.
  void refuse_others() const {
    for (const auto& [key, node] : table_) {
      const std::string name(key.str());
      if (contains(known_, name)) continue;
      fail(name, &node, "unknown key" + suggestion(name, known_, "; known are " + joined(known_)));
    }
  }

 private:
  const toml::table& table_;
  std::string file_, prefix_;
  std::vector<std::string> known_;
};

/// Throws if no scene has such a key. Only the scene counts entries of lists of tables.
void check_key(const StudyTable& table, const toml::node* node, const std::string& key) {
  if (key.starts_with("contact.pairs[") || key.starts_with("forcing.terms[") ||
      find_scene_key(key) != nullptr)
    return;
  std::vector<std::string> names;
  for (const SceneKey& one : scene_keys()) names.push_back(one.full_name());
  table.fail("key", node,
             "no key of a scene" + suggestion(key, names, "; `wavebalance keys --names` lists them"));
}

void read_interval(StudyTable& table, Sampling sampling, StudyParameter& parameter) {
  parameter.from = table.number("from", "or the key `values`");
  parameter.to = table.number("to", "in addition to the key `from`");
  const toml::node* node = table.find("spacing");
  const std::string spacing = node == nullptr ? "linear" : node->value_or(std::string());
  if (spacing != "linear" && spacing != "logarithmic")
    table.fail("spacing", node, "expected \"linear\" or \"logarithmic\"");
  parameter.logarithmic = spacing == "logarithmic";
  if (parameter.logarithmic && !(parameter.from * parameter.to > 0.0))
    table.fail("spacing", node, "expected from and to of one sign and not 0 with logarithmic spacing");
  parameter.count = static_cast<int>(table.integer("count", 0, 1, max_study_runs));
  if (sampling == Sampling::grid && parameter.count == 0)
    table.fail("count", nullptr, "missing; expected the number of values of the interval in a grid");
  if (sampling != Sampling::grid && parameter.count > 0)
    table.fail("count", table.find("count"), "has no meaning unless sampling = \"grid\"");
  if (sampling == Sampling::list)
    table.fail("from", table.find("from"), "a list takes the key `values` of each parameter");
  const SceneKey* key = find_scene_key(parameter.key);
  parameter.integer = key != nullptr && key->type == SceneKey::Type::integer;
}

StudyParameter read_parameter(const toml::table& entry, const std::string& file, std::size_t index,
                              Sampling sampling) {
  StudyTable table(entry, file, fmt::format("parameters[{}].", index + 1));
  StudyParameter parameter;
  parameter.key = table.text("key", "", "a key of the scene, as \"contact.gap\"");
  if (parameter.key.empty()) table.fail("key", nullptr, "missing; expected a key of the scene");
  check_key(table, table.find("key"), parameter.key);
  if (const toml::node* values = table.find("values")) {
    if (!values->is_array() || values->as_array()->empty())
      table.fail("values", values, "expected a list of values of " + parameter.key);
    for (const toml::node& value : *values->as_array()) {
      if (value.is_table()) table.fail("values", &value, "expected values of " + parameter.key);
      parameter.values.push_back(text_of(value));
    }
  } else {
    read_interval(table, sampling, parameter);
  }
  table.refuse_others();
  return parameter;
}

Sampling read_sampling(StudyTable& table) {
  const toml::node* node = table.find("sampling");
  if (node == nullptr) return Sampling::grid;
  std::vector<std::string> names;
  for (const Sampling one : {Sampling::grid, Sampling::list, Sampling::sobol, Sampling::latin_hypercube}) {
    names.push_back("\"" + name_of(one) + "\"");
    if (node->value_or(std::string()) == name_of(one)) return one;
  }
  table.fail("sampling", node, "expected one of " + joined(names));
}

void read_samples(StudyTable& table, Study& study) {
  constexpr int most = static_cast<int>(max_study_runs);
  const bool sampled = study.sampling == Sampling::sobol || study.sampling == Sampling::latin_hypercube;
  study.samples = static_cast<int>(table.integer("samples", 0, 1, most));
  if (sampled && study.samples == 0) table.fail("samples", nullptr, "missing; expected the number of runs");
  if (!sampled && study.samples > 0)
    table.fail("samples", table.find("samples"),
               "has no meaning unless sampling is \"sobol\" or \"latin_hypercube\"");
  const toml::node* seed = table.find("seed");
  study.seed = static_cast<std::uint64_t>(table.integer("seed", 1, 0, std::int64_t{1} << 62));
  if (seed != nullptr && study.sampling != Sampling::latin_hypercube)
    table.fail("seed", seed, "has no meaning unless sampling is \"latin_hypercube\"");
}

void read_parameters(StudyTable& table, Study& study) {
  const toml::node* node = table.find("parameters");
  if (node == nullptr || !node->is_array_of_tables())
    table.fail("parameters", node, "expected tables [[parameters]], one for each key that varies");
  const toml::array& entries = *node->as_array();
  for (std::size_t i = 0; i < entries.size(); ++i) {
    study.parameters.push_back(read_parameter(*entries[i].as_table(), study.name, i, study.sampling));
    const auto same = [&](const StudyParameter& one) { return one.key == study.parameters.back().key; };
    if (std::ranges::count_if(study.parameters, same) > 1)
      table.fail("parameters", &entries[i], study.parameters.back().key + " is there twice");
  }
}

void read_scene_of_study(StudyTable& table, Study& study, const std::string& scene_text) {
  const std::string scene = table.text("scene", "", "the path of a scene, relative to the study");
  if (scene.empty() && table.find("structure") != nullptr)
    table.fail("scene", nullptr,
               "missing: this is a scene, and a study names one; `wavebalance init study` writes a study");
  if (scene.empty() && scene_text.empty())
    table.fail("scene", nullptr, "missing; expected the path of a scene, relative to the study");
  study.scene = scene.empty() ? std::filesystem::path(study.name)
                              : std::filesystem::path(study.name).parent_path() / scene;
  study.scene_text = scene.empty() ? scene_text : read_toml(study.scene, max_study_bytes);
}

}  // namespace

Study parse_study(std::string_view text, const std::string& name, const std::string& scene_text) {
  const toml::table root = parse_toml(text, name);
  StudyTable table(root, name, "");
  Study study;
  study.name = name;
  read_scene_of_study(table, study, scene_text);
  study.set = table.texts("set", "\"time.functions=31\"");
  study.unset = table.texts("unset", "\"contact.exponent\"");
  study.quantity = table.text(
      "quantity", "", "a value of summary.json, as \"max_displacement_m\", or an output, as \"row 19\"");
  study.sampling = read_sampling(table);
  read_samples(table, study);
  study.follow = table.truth("follow");
  if (study.follow && study.sampling != Sampling::grid && study.sampling != Sampling::list)
    table.fail("follow", table.find("follow"), "has no meaning unless sampling is \"grid\" or \"list\"");
  read_parameters(table, study);
  table.refuse_others();
  return study;
}

Study load_study(const std::filesystem::path& file) {
  return parse_study(read_toml(file, max_study_bytes), file.string());
}

std::string study_identity(const Study& study) {
  std::string text =
      fmt::format("{}\n{}\n{}\n{}\n", name_of(study.sampling), study.samples, study.seed,
                  std::filesystem::weakly_canonical(std::filesystem::absolute(study.scene)).string());
  if (study.follow) text += "follow\n";
  for (const std::string& one : study.set) text += "set " + one + "\n";
  for (const std::string& one : study.unset) text += "unset " + one + "\n";
  for (const StudyParameter& one : study.parameters)
    text += fmt::format("{} [{}] {} {} {} {}\n", one.key, fmt::join(one.values, ", "), one.from, one.to,
                        one.logarithmic, one.count);
  return text + study.scene_text;
}

}  // namespace wavebalance::app
