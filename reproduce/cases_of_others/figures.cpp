#include "figures.hpp"

namespace wavebalance::cases {
namespace {

report::Identity identity(const char* number, const char* title, const char* stem) {
  return {"cases_of_others", number, title, stem};
}

}  // namespace

const std::vector<report::Step>& figures() {
  static const std::vector<report::Step> all{
      {"pyharm_onedofgap",
       identity("pyHarm", "the case onedofgap of its non-regression tests", "pyharm_onedofgap"),
       pyharm_onedofgap},
      {"nlvib_example03",
       identity("NLvib", "example 03, two masses and a unilateral spring", "nlvib_example03"),
       nlvib_example03},
      {"oscillator_with_stop",
       identity("Oscillator", "an elastic stop and two period doublings", "oscillator_with_stop"),
       oscillator_with_stop},
      {"small_gap_bar", identity("Bar, small gap", "period doublings far from a resonance", "small_gap_bar"),
       small_gap_bar},
      {"lightly_damped_bar",
       identity("Bar, light damping", "case 2 of JL14 with a tenth of its damping", "lightly_damped_bar"),
       lightly_damped_bar},
      {"impact_oscillator",
       identity("Impacts", "the oscillator with restitution of Recipes for Continuation",
                "impact_oscillator"),
       impact_oscillator},
      {"slider", identity("Friction", "a mass on an elastic slider, driven and free", "slider"), slider},
      {"den_hartog", identity("Rigid friction", "Den Hartog's oscillator, by a stiff slider", "den_hartog"),
       den_hartog}};
  return all;
}

}  // namespace wavebalance::cases
