#include "wavebalance/reproduce/scene_keys.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "enum_names.hpp"

namespace wavebalance::reproduce {
namespace {

using Type = SceneKey::Type;
using Default = SceneKey::Default;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Bounds positive{0.0, infinity, true};
constexpr Bounds not_negative{0.0, infinity, false};

template <auto Section, auto Member>
SceneValue get_member(const Scene& scene) {
  const auto& member = (scene.*Section).*Member;
  using Field = std::remove_cvref_t<decltype(member)>;
  if constexpr (std::is_enum_v<Field>)
    return enum_name(member);
  else if constexpr (std::is_same_v<Field, int>)
    return static_cast<std::int64_t>(member);
  else
    return member;
}

template <auto Section, auto Member>
void set_member(Scene& scene, const SceneValue& value) {
  auto& member = (scene.*Section).*Member;
  using Field = std::remove_cvref_t<decltype(member)>;
  if constexpr (std::is_enum_v<Field>)
    member = enum_value<Field>(std::get<std::string>(value));
  else if constexpr (std::is_same_v<Field, int>)
    member = static_cast<int>(std::get<std::int64_t>(value));
  else
    member = std::get<Field>(value);
}

template <auto Section, auto Member>
SceneKey key(std::string_view section, std::string_view name, std::string_view unit, std::string_view help) {
  using Field = std::remove_cvref_t<decltype((std::declval<Scene&>().*Section).*Member)>;
  SceneKey result;
  result.section = section;
  result.name = name;
  result.unit = unit;
  result.help = help;
  result.get = &get_member<Section, Member>;
  result.set = &set_member<Section, Member>;
  if constexpr (std::is_enum_v<Field>) {
    result.type = Type::text;
    result.choices = enum_choices<Field>();
  } else if constexpr (std::is_same_v<Field, std::string>) {
    result.type = Type::text;
  } else if constexpr (std::is_same_v<Field, bool>) {
    result.type = Type::boolean;
  } else {
    result.type = std::is_same_v<Field, int> ? Type::integer : Type::number;
  }
  return result;
}

SceneKey bounded(SceneKey key, Bounds bounds) {
  key.bounds = bounds;
  return key;
}

/// The default is the one that the Scene's member is initialised with.
SceneKey optional(SceneKey key) {
  key.fallback = Default::value;
  return key;
}

SceneKey derived(SceneKey key, std::string_view text, SceneValue (*rule)(const Scene&)) {
  key.fallback = Default::derived;
  key.derived_text = text;
  key.derived = rule;
  return key;
}

/// An error in scenes where `condition` does not hold.
SceneKey belonging(SceneKey key, Condition condition) {
  key.belongs = std::move(condition);
  return key;
}

/// May be left out of scenes where `condition` does not hold.
SceneKey needed(SceneKey key, Condition condition) {
  key.needed = std::move(condition);
  return key;
}

SceneKey basis(SceneKey key) {
  key.choices = {"fourier", "haar", "bspline"};
  static constexpr std::array<std::string_view, 20> daubechies{
      "daubechies2",  "daubechies4",  "daubechies6",  "daubechies8",  "daubechies10",
      "daubechies12", "daubechies14", "daubechies16", "daubechies18", "daubechies20",
      "daubechies22", "daubechies24", "daubechies26", "daubechies28", "daubechies30",
      "daubechies32", "daubechies34", "daubechies36", "daubechies38", "daubechies40"};
  key.choices.insert(key.choices.end(), daubechies.begin(), daubechies.end());
  return key;
}

void add_structure(std::vector<SceneKey>& keys) {
  constexpr auto s = &Scene::structure;
  keys.push_back(
      key<s, &Structure::type>("structure", "type", "", "kind of structure; a bar is clamped at x = 0"));
  keys.push_back(bounded(
      key<s, &Structure::youngs_modulus>("structure", "youngs_modulus", "Pa", "Young's modulus"), positive));
  keys.push_back(
      bounded(key<s, &Structure::density>("structure", "density", "kg/m^3", "mass density"), positive));
  keys.push_back(bounded(key<s, &Structure::area>("structure", "area", "m^2", "cross-section"), positive));
  keys.push_back(
      bounded(key<s, &Structure::length>("structure", "length", "m", "length of the bar"), positive));
  keys.push_back(bounded(key<s, &Structure::elements>("structure", "elements", "",
                                                      "two-node elements, as many as degrees of freedom"),
                         {1, 10'000'000}));
  keys.push_back(optional(bounded(
      key<s, &Structure::stiffness_damping>("structure", "stiffness_damping", "s", "beta in C = beta K"),
      not_negative)));
  keys.push_back(
      optional(bounded(key<s, &Structure::lumped_mass_fraction>(
                           "structure", "lumped_mass_fraction", "",
                           "0 for the consistent mass matrix, 1 for the lumped one, between them a mixture"),
                       {0, 1})));
  keys.push_back(belonging(
      optional(key<s, &Structure::massless_tip>("structure", "massless_tip", "",
                                                "true moves the tip's mass to its neighbour, so that rigid "
                                                "contact has no mass to stop at once")),
      {"analysis.type", {"forced_response", "frequency_sweep"}}));
}

void add_contact(std::vector<SceneKey>& keys) {
  constexpr auto s = &Scene::contact;
  const Condition exponential{"contact.law", {"exponential"}};
  const Condition linear{"contact.law", {"linear"}};
  const Condition any_law{"contact.law", {"exponential", "linear", "rigid"}};
  keys.push_back(optional(key<s, &Contact::law>(
      "contact", "law", "",
      "force at the tip once its displacement u exceeds the gap: constant (exp(exponent "
      "(u - gap)) - 1), stiffness (u - gap), or, rigid, whatever keeps u at the gap")));
  keys.push_back(belonging(
      bounded(key<s, &Contact::constant>("contact", "constant", "N", "a_c of the exponential law"), positive),
      exponential));
  keys.push_back(belonging(
      bounded(key<s, &Contact::exponent>("contact", "exponent", "1/m", "alpha of the exponential law"),
              positive),
      exponential));
  keys.push_back(
      belonging(bounded(key<s, &Contact::stiffness>("contact", "stiffness", "N/m", "slope of the linear law"),
                        positive),
                linear));
  keys.push_back(belonging(
      key<s, &Contact::gap>("contact", "gap", "m", "displacement at which contact starts"), any_law));
}

void add_forcing(std::vector<SceneKey>& keys) {
  constexpr auto s = &Scene::forcing;
  keys.push_back(needed(key<s, &Forcing::amplitude>("forcing", "amplitude", "N",
                                                    "force at the tip, amplitude cos(2 pi frequency t)"),
                        {"analysis.type", {"forced_response", "frequency_sweep", "time_stepping"}}));
  keys.push_back(
      needed(bounded(key<s, &Forcing::frequency>("forcing", "frequency", "Hz",
                                                 "frequency of the force; a sweep does not use it"),
                     positive),
             {"analysis.type", {"forced_response", "time_stepping"}}));
}

void add_time(std::vector<SceneKey>& keys) {
  constexpr auto s = &Scene::time;
  const Condition weighted_residual{"analysis.type", {"forced_response", "frequency_sweep"}};
  keys.push_back(needed(basis(key<s, &Time::trial>("time", "trial", "", "basis of the displacement in time")),
                        weighted_residual));
  keys.push_back(
      needed(basis(key<s, &Time::weight>("time", "weight", "", "basis that the residual is weighted with")),
             weighted_residual));
  keys.push_back(needed(bounded(key<s, &Time::functions>("time", "functions", "",
                                                         "trial functions; a power of two for wavelets"),
                                {1, 1 << 20}),
                        weighted_residual));
  keys.push_back(optional(key<s, &Time::formulation>(
      "time", "formulation", "", "how many derivatives move to the weights: none, one or two")));
  keys.push_back(derived(bounded(key<s, &Time::quadrature_points>(
                                     "time", "quadrature_points", "",
                                     "uniform points of one period where the contact force is evaluated; a "
                                     "multiple of functions for wavelets"),
                                 {1, 1 << 24}),
                         "4 x functions", [](const Scene& scene) -> SceneValue {
                           return std::int64_t{4} * scene.time.functions;
                         }));
  keys.push_back(optional(key<s, &Time::inner_products>(
      "time", "inner_products", "",
      "inner products of trial and weight functions: sums over the quadrature points "
      "(Daubechies Galerkin pairs: connection coefficients) or exact")));
}

void add_sweep(std::vector<SceneKey>& keys) {
  constexpr auto s = &Scene::analysis;
  const Condition sweep{"analysis.type", {"frequency_sweep"}};
  keys.push_back(belonging(bounded(key<s, &Analysis::frequency_from>("analysis", "frequency_from", "Hz",
                                                                     "where the branch starts"),
                                   positive),
                           sweep));
  keys.push_back(
      belonging(bounded(key<s, &Analysis::frequency_to>("analysis", "frequency_to", "Hz",
                                                        "where the branch ends, above or below its start"),
                        positive),
                sweep));
  keys.push_back(
      belonging(derived(bounded(key<s, &Analysis::first_step>("analysis", "first_step", "Hz",
                                                              "first step along the branch"),
                                positive),
                        "|frequency_to - frequency_from| / 1000",
                        [](const Scene& scene) -> SceneValue {
                          return std::abs(scene.analysis.frequency_to - scene.analysis.frequency_from) / 1000;
                        }),
                sweep));
  keys.push_back(belonging(
      derived(bounded(key<s, &Analysis::largest_step>("analysis", "largest_step", "Hz",
                                                      "no step along the branch is larger; a displacement by "
                                                      "the gap counts as a 20th of the interval"),
                      positive),
              "|frequency_to - frequency_from| / 80",
              [](const Scene& scene) -> SceneValue {
                return std::abs(scene.analysis.frequency_to - scene.analysis.frequency_from) / 80;
              }),
      sweep));
  keys.push_back(belonging(
      optional(bounded(
          key<s, &Analysis::max_points>("analysis", "max_points", "", "the branch is given up after so many"),
          {2, 10'000'000})),
      sweep));
}

void add_mode(std::vector<SceneKey>& keys) {
  constexpr auto s = &Scene::analysis;
  const auto add = [&keys](SceneKey key) {
    keys.push_back(belonging(std::move(key), {"analysis.type", {"nonlinear_mode"}}));
  };
  add(optional(key<s, &Analysis::formulation>(
      "analysis", "formulation", "",
      "consistent: the equation of motion holds at every point; published: the equations of Laxalde & "
      "Legrand "
      "as printed, by their augmented Lagrangian, with the root of the Rayleigh quotient as frequency (runs "
      "with few harmonics only)")));
  add(optional(bounded(
      key<s, &Analysis::mode>("analysis", "mode", "", "the linear mode that the nonlinear one continues"),
      {1, 10'000'000})));
  add(optional(bounded(
      key<s, &Analysis::harmonics>("analysis", "harmonics", "", "harmonics N of the Fourier series in time"),
      {1, 4096})));
  add(derived(bounded(key<s, &Analysis::samples>(
                          "analysis", "samples", "",
                          "uniform times of one period at which contact is enforced, at least 2 x harmonics"),
                      {2, 1 << 16}),
              "2 x harmonics",
              [](const Scene& scene) -> SceneValue { return std::int64_t{2} * scene.analysis.harmonics; }));
  add(optional(key<s, &Analysis::cosine_only>("analysis", "cosine_only", "",
                                              "true seeks motions that are even in time only")));
  add(optional(bounded(
      key<s, &Analysis::energy_ratio>(
          "analysis", "energy_ratio", "",
          "the one motion of this energy, over that of the linear mode that just touches; 0 for the curve"),
      not_negative)));
  add(optional(bounded(key<s, &Analysis::largest_energy>("analysis", "largest_energy", "",
                                                         "the curve ends beyond this energy ratio"),
                       {1, infinity, true})));
  add(optional(bounded(
      key<s, &Analysis::last_frequency_ratio>("analysis", "last_frequency_ratio", "",
                                              "or beyond this ratio of the frequency to the linear one"),
      {1.001, infinity, true})));
  add(optional(bounded(
      key<s, &Analysis::points>("analysis", "points", "",
                                "of the curve, uniform in frequency up to there; in energy when published"),
      {2, 1'000'000})));
}

void add_analysis(std::vector<SceneKey>& keys) {
  constexpr auto s = &Scene::analysis;
  const Condition time_stepping{"analysis.type", {"time_stepping"}};
  keys.push_back(optional(key<s, &Analysis::type>("analysis", "type", "", "what is computed")));
  keys.push_back(
      optional(bounded(key<s, &Analysis::output_points>("analysis", "output_points", "",
                                                        "uniform points of one period in response.csv"),
                       {2, 1 << 24})));
  add_sweep(keys);
  keys.push_back(belonging(
      optional(bounded(
          key<s, &Analysis::tolerance>("analysis", "tolerance", "",
                                       "relative rms difference of two successive periods to be reached"),
          {0, 1, true})),
      time_stepping));
  keys.push_back(belonging(optional(bounded(key<s, &Analysis::max_periods>("analysis", "max_periods", "",
                                                                           "given up after so many periods"),
                                            {1, 100'000'000})),
                           time_stepping));
  add_mode(keys);
}

std::vector<SceneKey> make_keys() {
  std::vector<SceneKey> keys;
  add_structure(keys);
  add_contact(keys);
  add_forcing(keys);
  add_time(keys);
  add_analysis(keys);
  return keys;
}

}  // namespace

std::span<const SceneKey> scene_keys() {
  static const std::vector<SceneKey> keys = make_keys();
  return keys;
}

const SceneKey* find_scene_key(std::string_view full_name) {
  const auto keys = scene_keys();
  const auto found = std::find_if(keys.begin(), keys.end(),
                                  [&](const SceneKey& key) { return key.full_name() == full_name; });
  return found == keys.end() ? nullptr : &*found;
}

bool Bounds::contain(double value) const {
  return (lower_excluded ? value > lower : value >= lower) && value <= upper;
}

bool Condition::holds(const Scene& scene) const {
  if (key.empty()) return true;
  const std::string value = std::get<std::string>(find_scene_key(key)->get(scene));
  return std::find(values.begin(), values.end(), value) != values.end();
}

std::string SceneKey::full_name() const { return std::string(section) + "." + std::string(name); }

}  // namespace wavebalance::reproduce
