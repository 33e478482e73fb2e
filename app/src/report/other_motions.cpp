#include "report/words.hpp"

#include <fmt/format.h>

#include "results/quantities.hpp"
#include "wavebalance/app/files/quantity_text.hpp"

namespace wavebalance::app {
namespace {

/// Number and starts of searches for isolated branches, and the results.
std::string isolas_sentence(const Summary& summary) {
  const auto* isolas = value_in<Table>(summary, quantities::isolas.name);
  const std::size_t found = isolas == nullptr ? 0 : isolas->rows();
  std::vector<std::string> each;
  for (std::size_t i = 0; i < found; ++i)
    each.push_back(fmt::format("isola {} from {} to {}, with a contact force of up to {}", i + 1,
                               short_number(isolas->numbers("lowest_frequency_Hz")[i], 5),
                               quantity(isolas->numbers("highest_frequency_Hz")[i], "Hz", 5),
                               quantity(isolas->numbers("max_contact_force_N")[i], "N")));
  const double starts = number_in(summary, quantities::isola_starts);
  const double frequencies = number_in(summary, quantities::isola_frequencies);
  return fmt::format(
      "Isolated branches were searched for at {:.0f} frequenc{}, from rest{}. {} Branches "
      "narrower than the spacing of these frequencies, or with a small basin of attraction, "
      "may be missed.",
      frequencies, frequencies > 1.0 ? "ies" : "y",
      starts > 1.0 ? fmt::format(" and {:.0f} random state{} each", starts - 1.0, starts > 2.0 ? "s" : "")
                   : "",
      found == 0 ? "None was found." : fmt::format("Found: {}.", fmt::join(each, "; ")));
}

}  // namespace

std::string other_motions_sentence(const Summary& summary, bool curve) {
  const std::string sought = text_in(summary, quantities::other_motions);
  if (sought == "sought") return isolas_sentence(summary);
  if (sought == "settled_from_rest")
    return "The attractor reached from rest was also computed. Other motions were not searched for.";
  if (sought != "not_sought") return "";
  return curve ? "Isolated branches were not searched for."
               : "Other motions at this frequency were not searched for.";
}

}  // namespace wavebalance::app
