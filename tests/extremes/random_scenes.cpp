#include "random_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "draw.hpp"
#include "wavebalance/app/scene/scene_keys.hpp"

namespace {

using namespace wavebalance::app;

std::string valid_number(Draw& draw, const SceneKey& key) {
  if (key.type == SceneKey::Type::integer) {
    const double most = std::min(key.bounds.upper, 300.0), least = std::max(key.bounds.lower, 1.0);
    return std::to_string(draw.between(static_cast<int>(least), static_cast<int>(most)));
  }
  if (std::isfinite(key.bounds.upper))
    return toml_text(draw.uniform(std::max(key.bounds.lower, 1e-9), key.bounds.upper));
  return toml_text(std::max(key.bounds.lower, 0.0) + draw.magnitude(-6.0, 12.0));
}

std::string valid_list(Draw& draw, const SceneKey& key) {
  std::string text;
  for (int i = 0; i < std::max(key.length, 1); ++i) text += (i == 0 ? "[" : ", ") + valid_number(draw, key);
  return text + "]";
}

std::string valid_value(Draw& draw, const SceneKey& key) {
  if (key.type == SceneKey::Type::boolean) return draw.chance(0.5) ? "true" : "false";
  if (key.type == SceneKey::Type::path) return "\"no_such_file.mtx\"";
  if (key.form == SceneKey::Form::list) return valid_list(draw, key);
  if (key.type != SceneKey::Type::text) return valid_number(draw, key);
  if (key.choices.empty()) return "\"contact 1\"";  // the only free text that is no path: an output
  // Daubechies filters take the loader milliseconds.
  const bool basis = key.section == "time" && key.choices.size() > 3;
  const std::size_t choices = basis && draw.chance(0.9) ? 3 : key.choices.size();
  return "\"" +
         std::string(key.choices[static_cast<std::size_t>(draw.between(0, static_cast<int>(choices) - 1))]) +
         "\"";
}

/// No key admits any of these.
std::string invalid_value(Draw& draw) {
  static const std::vector<std::string> values{"nan",        "-inf", "[true]",     "{a = 1}",
                                               "1979-05-27", "\"\"", "\"\\u0000\""};
  return draw.one_of(values);
}

/// A scene of which only the keys that decide whether others belong are set.
Scene draw_kinds(Draw& draw) {
  Scene scene;
  for (const char* name : {"contact.law", "analysis.type"}) {
    const SceneKey& key = *find_scene_key(name);
    key.set(scene, std::string(draw.one_of(key.choices)));
  }
  if (draw.chance(0.1)) scene.structure.type = StructureType::blade;
  if (draw.chance(0.05)) scene.structure.type = StructureType::matrices;
  if (scene.analysis.type == AnalysisType::nonlinear_mode && draw.chance(0.9)) scene.contact.law = "rigid";
  return scene;
}

bool decides(const SceneKey& key) {
  const std::string name = key.full_name();
  return name == "contact.law" || name == "analysis.type" || name == "structure.type";
}

}  // namespace

RandomText random_text(std::uint64_t seed) {
  Draw draw(seed);
  const Scene kinds = draw_kinds(draw);
  const int functions =
      1 << draw.between(0, 8);  // most sizes that are drawn freely break the rule of wavelets
  const double corruption = draw.chance(0.5) ? 0.0 : 0.05;
  RandomText result;
  std::string_view section;
  for (const SceneKey& key : scene_keys()) {
    if (key.section != section) result.text += "[" + std::string(section = key.section) + "]\n";
    const bool belongs = key.belongs.holds(kinds);
    if (!belongs && !draw.chance(0.1 * corruption)) continue;
    if (belongs && !decides(key) && !key.required_in(kinds) && draw.chance(0.5)) continue;
    std::string value = decides(key) ? toml_text(key.get(kinds)) : valid_value(draw, key);
    const std::string name = key.full_name();
    if (name == "time.functions") value = std::to_string(functions);
    if (name == "time.quadrature_points" || name == "analysis.output_points")
      value = std::to_string(draw.chance(0.1) ? draw.between(2, 500) : functions << draw.between(1, 3));
    const bool damage = draw.chance(corruption);
    if (damage) value = invalid_value(draw);
    result.invalid = result.invalid || !belongs || damage;
    result.text += std::string(key.name) + " = " + value + "\n";
  }
  if (draw.chance(corruption)) {
    result.text += "unknown_key = 1\n";
    result.invalid = true;
  }
  return result;
}

namespace {

Structure draw_structure(Draw& draw, bool wild) {
  const double range = wild ? 60.0 : 4.0;
  Structure bar;
  bar.youngs_modulus = 70e9 * draw.magnitude(-range, range);
  bar.density = 2700.0 * draw.magnitude(-range, range);
  bar.area = 25e-4 * draw.magnitude(-range, range);
  bar.length = draw.magnitude(-range, range);
  bar.elements = draw.between(1, 30);
  bar.lumped_mass_fraction = draw.one_of(std::vector<double>{0.0, 0.5, 1.0});
  bar.massless_tip = bar.elements > 1 && draw.chance(0.1);
  return bar;
}

/// Forces and lengths in units of a static tip displacement, so that contact does happen.
void draw_contact(Draw& draw, Scene& scene, double displacement, double stiffness) {
  Contact& contact = scene.contact;
  contact.law = draw.one_of(std::vector<std::string>{"none", "exponential", "linear", "rigid"});
  if (contact.law == "none") return;
  if (contact.law == "rigid" && scene.structure.elements == 1)
    contact.law = "linear";  // there is no neighbour to take the tip's mass
  contact.gap = displacement * draw.uniform(-0.5, 1.5);
  if (draw.chance(0.1)) contact.gap = draw.one_of(std::vector<double>{0.0, 1e-300, -1e-300, 1e30});
  const double penalty = stiffness * draw.magnitude(-3.0, 8.0);
  if (contact.law == "linear") contact.values["stiffness"] = penalty;
  if (contact.law != "exponential") return;
  contact.values["exponent"] = draw.magnitude(-2.0, 2.0) / displacement;
  contact.values["constant"] = penalty / contact.number("exponent");
}

Time draw_time(Draw& draw) {
  const auto [trial, weight] = draw.pair_of_bases();
  Time time{trial, weight};
  const bool fourier = std::string_view(trial) == "fourier";
  time.functions = fourier ? draw.between(1, 24) : 1 << draw.between(2, 4);
  time.quadrature_points =
      fourier ? time.functions + draw.between(0, 60) : time.functions << draw.between(0, 2);
  return time;
}

}  // namespace

Scene random_scene(std::uint64_t seed) {
  Draw draw(seed);
  Scene scene;
  const bool wild = draw.chance(0.15);
  scene.structure = draw_structure(draw, wild);
  const Structure& bar = scene.structure;
  const double wave_speed = std::sqrt(bar.youngs_modulus / bar.density);
  const double stiffness = bar.youngs_modulus * bar.area / bar.length;
  const double displacement = bar.length * draw.magnitude(-6.0, 0.0);
  scene.forcing.frequency = 0.25 * wave_speed / bar.length * draw.magnitude(-2.0, wild ? 6.0 : 1.0);
  scene.forcing.amplitude = stiffness * displacement * (draw.chance(0.05) ? 0.0 : 1.0);
  scene.structure.stiffness_damping =
      draw.chance(0.2) ? 0.0 : draw.magnitude(-4.0, 0.0) / scene.forcing.frequency;
  draw_contact(draw, scene, displacement, stiffness);
  scene.time = draw_time(draw);
  return scene;
}
