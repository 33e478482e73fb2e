#include "figures.hpp"

namespace wavebalance::blade {

const std::vector<report::Step>& figures() {
  static const std::vector<report::Step> all{
      {"campbell",
       {"blade", "Blade: Campbell diagram", "frequency over rotation speed at several energies", "campbell"},
       campbell_diagram},
      {"forced_response",
       {"blade", "Blade: forced response", "near the first mode, in three pairs of bases", "forced_response"},
       forced_response},
  };
  return all;
}

}  // namespace wavebalance::blade
