#include <cmath>

#include "scene/scene_key_builders.hpp"

namespace wavebalance::app {
namespace {

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

}  // namespace

void add_analysis_keys(std::vector<SceneKey>& keys) {
  constexpr auto s = &Scene::analysis;
  const Condition time_stepping{"analysis.type", {"time_stepping"}};
  keys.push_back(optional(key<s, &Analysis::type>("analysis", "type", "", "what is computed")));
  keys.push_back(
      optional(bounded(key<s, &Analysis::output_points>("analysis", "output_points", "",
                                                        "uniform points of one period in response.csv"),
                       {2, 1 << 24})));
  keys.push_back(belonging(
      derived(
          bounded(key<s, &Analysis::motion_points>(
                      "analysis", "motion_points", "",
                      "instants of one motion's period at which the whole structure is written: a blade to "
                      "motion.pvd for ParaView, matrices to motion.mtx, a column an instant"),
                  {0, 9999}),
          "32 for a blade, 0 for matrices",
          [](const Scene& scene) -> SceneValue {
            return std::int64_t{scene.structure.type == StructureType::blade ? 32 : 0};
          }),
      structure_is({"blade", "matrices"}) && analysis_is({"forced_response", "nonlinear_mode"})));
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

}  // namespace wavebalance::app
