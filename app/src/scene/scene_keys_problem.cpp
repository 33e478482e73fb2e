#include "scene/scene_key_builders.hpp"

namespace wavebalance::app {
namespace {

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

SceneValue get_gap(const Scene& scene) {
  if (scene.contact.gaps.empty()) return scene.contact.gap;
  return scene.contact.gaps;
}

void set_gap(Scene& scene, const SceneValue& value) {
  Contact& contact = scene.contact;
  const auto* list = std::get_if<std::vector<double>>(&value);
  const bool one = list == nullptr || list->size() == 1;
  contact.gap = list == nullptr ? std::get<double>(value) : one ? list->front() : 0.0;
  contact.gaps = one ? std::vector<double>{} : *list;
}

}  // namespace

void add_contact_keys(std::vector<SceneKey>& keys) {
  constexpr auto s = &Scene::contact;
  const Condition exponential{"contact.law", {"exponential"}};
  const Condition linear{"contact.law", {"linear"}};
  const Condition any_law{"contact.law", {"exponential", "linear", "rigid"}};
  keys.push_back(optional(key<s, &Contact::law>(
      "contact", "law", "",
      "force on each degree of freedom in contact (a bar: its tip; a blade: its tip's corner nodes, "
      "radially) "
      "once its displacement u exceeds the gap: constant (exp(exponent (u - gap)) - 1), stiffness (u - gap), "
      "or, rigid, whatever keeps u at the gap")));
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
  SceneKey gap = key<s, &Contact::gap>(
      "contact", "gap", "m",
      "displacement towards the obstacle at which contact starts; a list has one for each degree of freedom "
      "in contact");
  gap.form = SceneKey::Form::single_or_list;
  gap.get = &get_gap;
  gap.set = &set_gap;
  keys.push_back(belonging(std::move(gap), any_law));
}

void add_forcing_keys(std::vector<SceneKey>& keys) {
  constexpr auto s = &Scene::forcing;
  keys.push_back(needed(key<s, &Forcing::amplitude>(
                            "forcing", "amplitude", "N",
                            "force amplitude cos(2 pi frequency t): at the tip of a bar, at one place of a "
                            "blade's tip, along load or load_dofs of matrices"),
                        analysis_is({"forced_response", "frequency_sweep", "time_stepping"})));
  keys.push_back(
      needed(bounded(key<s, &Forcing::frequency>("forcing", "frequency", "Hz",
                                                 "frequency of the force; a sweep does not use it"),
                     positive),
             analysis_is({"forced_response", "time_stepping"})));
  keys.push_back(belonging(
      optional(path(key<s, &Forcing::load>("forcing", "load", "",
                                           "forces of all degrees of freedom for amplitude 1: Matrix Market "
                                           "array file of one column"))),
      structure_is({"matrices"})));
  keys.push_back(
      belonging(optional(bounded(
                    key<s, &Forcing::load_dofs>(
                        "forcing", "load_dofs", "",
                        "degrees of freedom that each take the whole force, rows counted from 1; -7 is row "
                        "7 in its negative direction; in place of load"),
                    {-2147483647, 2147483647})),
                structure_is({"matrices"})));
  keys.push_back(belonging(optional(key<s, &Forcing::place>("forcing", "place", "",
                                                            "corner nodes of the blade's tip that share the "
                                                            "force")),
                           structure_is({"blade"})));
  keys.push_back(belonging(
      optional(key<s, &Forcing::direction>("forcing", "direction", "",
                                           "of the force; the blade stands along z, its chord nearest to x")),
      structure_is({"blade"})));
}

void add_time_keys(std::vector<SceneKey>& keys) {
  constexpr auto s = &Scene::time;
  const Condition weighted_residual =
      analysis_is({"forced_response", "frequency_sweep"}).unless("time.tolerance");
  keys.push_back(belonging(
      derived(
          bounded(key<s, &Time::tolerance>(
                      "time", "tolerance", "",
                      "relative rms error of the contact displacement over the period to be met, in place of "
                      "functions and quadrature_points, which the program then chooses, and, where trial "
                      "and weight are left out, of these too"),
                  {0, 1}),
          "none", [](const Scene&) -> SceneValue { return 0.0; }),
      analysis_is({"forced_response"})));
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

}  // namespace wavebalance::app
