#include <algorithm>

#include "page/page_parts.hpp"

namespace wavebalance::report {

const std::vector<Paper>& papers() {
  static const std::vector<Paper> all{
      {"jones_legrand_2014",
       "Jones & Legrand 2014",
       "Jones & Legrand 2014, Vibrations of an axial bar experiencing periodic unilateral contact using the "
       "wavelet balance method",
       "https://hal.science/hal-01403614",
       "CC BY 4.0",
       false,
       {"fig01", "fig02", "fig03", "fig04", "fig05", "tab01", "reference", "tab02"}},
      {"laxalde_legrand_2010",
       "Laxalde & Legrand 2010",
       "Laxalde & Legrand 2010, Nonlinear modal analysis of mechanical systems with frictionless contact "
       "interfaces (preprint, version 1)",
       "https://hal.science/hal-00492775",
       "the right of quotation",
       false,
       {"fig01", "fig02", "fig03", "algorithms"}},
      {"blade", "The blade further", "The blade further: beyond the papers", "", "", false, {}},
      {"cases_of_others",
       "Cases of others",
       "Cases of others: curves that other programs publish or whose bifurcation points are known exactly",
       "",
       "",
       true,
       {}},
      {"extremes",
       "Extremes",
       "Extremes: inputs at the edge of what numbers, structures and bases can be",
       "",
       "",
       true,
       {}},
  };
  return all;
}

std::vector<Record> ordered(std::vector<Record> records, const std::vector<std::string>& order) {
  const auto place = [&](const Record& record) {
    const auto found = std::find_if(order.begin(), order.end(), [&](const std::string& beginning) {
      return record.identity.stem.starts_with(beginning);
    });
    return found - order.begin();
  };
  std::stable_sort(records.begin(), records.end(),
                   [&](const Record& a, const Record& b) { return place(a) < place(b); });
  return records;
}

}  // namespace wavebalance::report
