#include "tables.hpp"

namespace wavebalance::extremes {

const std::vector<report::Step>& tables() {
  static const std::vector<report::Step> all{
      {"extremes", {"extremes", "Extremes", "inputs at the edge", "extremes"}, family_table},
      {"daubechies",
       {"extremes", "Daubechies", "filters of 2 to 40 coefficients", "daubechies"},
       daubechies_table},
  };
  return all;
}

}  // namespace wavebalance::extremes
