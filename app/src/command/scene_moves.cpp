#include "command/scene_moves.hpp"

#include "files/contains.hpp"
#include "files/number_text.hpp"
#include "wavebalance/app/scene/contacts.hpp"
#include "wavebalance/app/scene/scene_keys.hpp"

namespace wavebalance::app::moves {
namespace {

using Step = std::optional<NextStep>;

std::string setting(const std::string& key, const SceneValue& value) { return key + "=" + toml_text(value); }

/// A key with a value that is named.
Step set_to(const std::string& key, const SceneValue& value) {
  return NextStep{key + " = " + toml_text(value), {.set = {setting(key, value)}}};
}

/// A key that is named without the value, as the one that is tried is one of many.
Step changed(const std::string& words, const std::string& key, const SceneValue& value) {
  return NextStep{words + " " + key, {.set = {setting(key, value)}}};
}

Step in_words(const std::string& words) { return NextStep{words, {}}; }

bool has_wavelets(const Time& time) {
  const auto wavelets = [](const std::string& basis) { return !basis.empty() && is_wavelet(basis); };
  return wavelets(time.trial) || wavelets(time.weight);
}

/// More basis functions, and points for them.
Step functions_step(const Scene& scene, int functions) {
  const Time& time = scene.time;
  const int least = 4 * functions, points = std::max(time.quadrature_points, least);
  const int taken = has_wavelets(time) ? std::max(2 * time.quadrature_points, least) : points;
  Step step = set_to("time.functions", std::int64_t{functions});
  step->change.set.push_back(setting("time.quadrature_points", std::int64_t{taken}));
  return step;
}

std::string name_of_interval(const Scene& scene, const char* end) {
  return std::string("analysis.") +
         (scene.analysis.type == AnalysisType::amplitude_sweep ? "amplitude_" : "frequency_") + end;
}

constexpr std::string_view depth_name = "damping_depth";

/// The contact whose damper sets in at once, or nullptr.
const SceneContact* sudden_damper(const std::vector<SceneContact>& contacts) {
  const std::vector<std::string_view>& laws = find_scene_key("contact.damping_depth")->laws;
  const auto found = std::ranges::find_if(contacts, [&](const SceneContact& one) {
    if (!contains(laws, one.law)) return false;
    const auto given = one.values.find(depth_name);
    return given == one.values.end() || std::get<double>(given->second) == 0.0;
  });
  return found == contacts.end() ? nullptr : &*found;
}

double restitution_of(const Contact& contact) {
  const auto found = contact.values.find("restitution");
  return found == contact.values.end() ? 0.0 : std::get<double>(found->second);
}

}  // namespace

Move always(const std::string& words, const SceneChange& change) {
  return [=](const Scene&) -> Step { return NextStep{words, change}; };
}

Move scaled(const std::string& words, const std::string& key, double factor, double most) {
  return [=](const Scene& scene) -> Step {
    const SceneValue now = find_scene_key(key)->get(scene);
    if (const auto* integer = std::get_if<std::int64_t>(&now))
      return changed(words, key, static_cast<std::int64_t>(factor) * *integer);
    const auto* number = std::get_if<double>(&now);
    if (number == nullptr || *number == 0.0) return std::nullopt;
    return changed(words, key, std::min(factor * *number, most));
  };
}

Step more_functions(const Scene& scene) {
  const int now = scene.time.functions;
  return functions_step(scene, has_wavelets(scene.time) ? 2 * now : 2 * now + 1);
}

Step odd_functions(const Scene& scene) {
  const int now = scene.time.functions;
  if (now % 2 == 1 || has_wavelets(scene.time)) return std::nullopt;
  Step step = functions_step(scene, now + 1);
  step->text = "an odd time.functions";
  return step;
}

Step more_points(const Scene& scene) {
  return set_to("time.quadrature_points", std::int64_t{4} * scene.time.quadrature_points);
}

Step tolerance_in_place(const Scene& scene) {
  if (scene.time.tolerance > 0.0) return std::nullopt;
  return NextStep{"time.tolerance in place of time.functions and time.quadrature_points",
                  {.set = {"time.tolerance=1e-3"}, .unset = {"time.functions", "time.quadrature_points"}}};
}

Step sizes_in_place(const Scene& scene) {
  if (!(scene.time.tolerance > 0.0)) return std::nullopt;
  return NextStep{"time.trial, time.weight and time.functions in place of time.tolerance",
                  {.set = {"time.trial=\"fourier\"", "time.weight=\"fourier\"", "time.functions=127"},
                   .unset = {"time.tolerance"}}};
}

Step dropped_nyquist(const Scene& scene) {
  if (scene.time.functions % 2 == 1) return std::nullopt;
  return set_to("time.nyquist", std::string("drop"));
}

Step balance(const Scene& scene) {
  if (scene.time.method == TimeMethod::balance) return std::nullopt;
  return NextStep{"time.method = \"balance\" with time.trial, time.weight and time.functions",
                  {.set = {"time.method=\"balance\"", "time.trial=\"fourier\"", "time.weight=\"fourier\"",
                           "time.functions=127"},
                   .unset = {"time.tolerance"}}};
}

Step response(const Scene& scene) {
  SceneChange change = as_response(scene);
  const char* bases = change.set.empty() ? "" : " with time.trial, time.weight and time.functions";
  return NextStep{std::string("analysis.type = \"forced_response\"") + bases, std::move(change)};
}

Step response_of_periods(const Scene& scene) {
  Step step = response(scene);
  step->text += step->change.set.empty() ? " with analysis.subharmonic" : ", and analysis.subharmonic";
  step->change.set.emplace_back("analysis.subharmonic=2");
  return step;
}

Step more_damping(const Scene& scene) {
  const Structure& structure = scene.structure;
  if (structure.modal_damping > 0.0)
    return changed("a larger", "structure.modal_damping", std::min(1.0, 2.0 * structure.modal_damping));
  if (structure.stiffness_damping > 0.0)
    return changed("a larger", "structure.stiffness_damping", 2.0 * structure.stiffness_damping);
  if (!structure.matrices.damping.empty() || structure.loss_factor > 0.0) return in_words("more damping");
  return changed("damping, such as", "structure.stiffness_damping", 1e-6);
}

Step fewer_modes(const Scene& scene) {
  if (scene.structure.kept_modes >= 0) return std::nullopt;
  return set_to("structure.kept_modes", std::int64_t{8});
}

Step damping_depth(const Scene& scene) {
  constexpr double of_gap = 0.01;
  const std::vector<SceneContact> contacts = contacts_of(scene);
  const SceneContact* damper = sudden_damper(contacts);
  if (damper == nullptr) return std::nullopt;
  const bool own = damper->pair && damper->law != scene.contact.law;
  const std::string key = (own ? pair_section(*damper->pair) : "contact") + "." + std::string(depth_name);
  if (damper->gap > 0.0) return set_to(key, rounded(of_gap * damper->gap, 2));
  return changed("a positive", key, 1e-6);
}

// As stiff as lets the limit of a millionth of a metre hold, which is small compared with most motions.
Step elastic_friction(const Scene& scene) {
  constexpr double displacement = 1e-6;  // m
  for (const SceneContact& one : contacts_of(scene)) {
    if (!has_friction(one.law) || one.values.contains("tangential_stiffness")) continue;
    const bool own = one.pair && one.law != scene.contact.law;
    const auto number = [&](const char* name) {
      const auto found = one.values.find(name);
      return found == one.values.end() ? 0.0 : std::get<double>(found->second);
    };
    const double limit = number("friction") * number("normal_load"),
                 stiffness = limit > 0.0 ? limit / displacement : 1e6;
    return set_to((own ? pair_section(*one.pair) : "contact") + ".tangential_stiffness",
                  rounded(stiffness, 1));
  }
  return std::nullopt;
}

Step no_rebound(const Scene& scene) {
  if (restitution_of(scene.contact) == 0.0) return std::nullopt;
  return set_to("contact.restitution", 0.0);
}

Step more_rebound(const Scene& scene) {
  if (!has_impacts(scene.contact)) return std::nullopt;
  return changed("a larger", "contact.restitution", 0.5 * (1.0 + restitution_of(scene.contact)));
}

Step stiff_law(const Scene& scene) {
  if (!has_impacts(scene.contact)) return std::nullopt;
  NextStep step{
      "a stiff contact.law = \"linear\" in place of contact.restitution",
      {.set = {"contact.law=\"linear\"", "contact.stiffness=1e9"}, .unset = {"contact.restitution"}}};
  if (!integrates_in_time(scene.analysis.type) && scene.analysis.type != AnalysisType::motions) {
    step.text += ", with time.trial, time.weight and time.functions";
    step.change.set.insert(step.change.set.end(),
                           {"time.trial=\"fourier\"", "time.weight=\"fourier\"", "time.functions=127"});
  }
  return step;
}

Step reversed(const Scene& scene) {
  const auto [from, to] = sweep_interval(scene.analysis);
  return NextStep{
      "both ends of the interval exchanged",
      {.set = {setting(name_of_interval(scene, "from"), to), setting(name_of_interval(scene, "to"), from)}}};
}

Step other_start(const Scene& scene) {
  constexpr double part = 0.1;
  const auto [from, to] = sweep_interval(scene.analysis);
  const double outward = from - part * (to - from),
               start = outward > 0.0 ? outward : from + part * (to - from);
  Step step = changed("another", name_of_interval(scene, "from"), start);
  step->text += ", away from the resonance";
  return step;
}

Step exact_curve(const Scene& scene) {
  if (scene.analysis.exact) return std::nullopt;
  Step step = set_to("analysis.exact", true);
  if (scene.analysis.motion_at.empty()) return step;
  step->text += " without analysis.motion_at";
  step->change.unset.emplace_back("analysis.motion_at");
  return step;
}

Step curve_of_balance(const Scene& scene) {
  if (moves_by_events(scene)) return std::nullopt;
  NextStep step = *set_to("analysis.exact", false);  // and the pair, which an exact curve need not name
  const std::array names{"time.trial", "time.weight", "time.functions"};
  for (const char* name : names)
    step.change.set.push_back(std::string(name) + "=" + toml_text(find_scene_key(name)->get(scene)));
  return step;
}

Step smaller_step(const Scene& scene) {
  Step step = changed("a smaller", "analysis.largest_step", 0.5 * scene.analysis.largest_step);
  step->change.set.push_back(
      setting("analysis.first_step", std::min(scene.analysis.first_step, 0.5 * scene.analysis.largest_step)));
  return step;
}

Step samples_of_harmonics(const Scene& scene) {
  const std::int64_t samples = std::int64_t{2} * scene.analysis.harmonics;
  if (scene.analysis.samples == samples) return std::nullopt;
  return set_to("analysis.samples", samples);
}

Step more_harmonics(const Scene& scene) {
  const Analysis& analysis = scene.analysis;
  if (!scene.time.trial.empty()) return more_functions(scene);
  Step step = changed("other", "analysis.harmonics", std::int64_t{2} * analysis.harmonics);
  step->text += " and analysis.samples";
  step->change.set.push_back(setting("analysis.samples", std::int64_t{2} * analysis.samples));
  return step;
}

Step more_starts(const Scene& scene) {
  return changed("more", "analysis.random_starts", std::int64_t{2} * scene.analysis.random_starts + 10);
}

}  // namespace wavebalance::app::moves
