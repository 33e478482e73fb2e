#include "figures.hpp"
#include "jl14.hpp"

namespace wavebalance::jl14 {
namespace {

/// Whether level J is 2^J on the first 2^-J of the period and zero on the rest.
bool is_box(const std::vector<double>& values, int level) {
  const std::size_t width = values.size() >> level;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (values[i] != (i < width ? static_cast<double>(1 << level) : 0.0)) return false;
  return true;
}

}  // namespace

void fig05(report::Artefact& artefact) {
  const auto table = levels_table("haar");
  artefact.data(table, "time in periods, functions normalised to integral 1", {"translate k = 0"});
  artefact.picture(levels_figure(table, "Scaling function (-)", app::SeriesStyle::steps));
  artefact.caption("The translate k = 0, closed on the left.");
  int boxes = 0;
  for (int level = 0; level <= 5; ++level)
    boxes += is_box(table.numbers("level_" + std::to_string(level)), level) ? 1 : 0;
  artefact.check(
      {"section 3.5",
       "Since the compact support of the father scaling function is S1, the periodized function "
       "is equivalent.",
       "every level is exactly the dilated box $2^J$ on $[0, 2^{-J})$",
       boxes == 6 ? std::string("all six levels are") : std::to_string(boxes) + " of six levels are",
       boxes == 6});
}

}  // namespace wavebalance::jl14
