#include "wavebalance/report/rule.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace wavebalance::report {
namespace {

void require_comparable(const std::vector<double>& first, const std::vector<double>& second,
                        const char* rule) {
  if (first.empty() || first.size() != second.size())
    throw std::invalid_argument(fmt::format("{}: {} and {} values; it takes as many of both, at least one",
                                            std::string(rule), first.size(), second.size()));
  for (const auto* values : {&first, &second})
    for (const double value : *values)
      if (!(value >= 0.0) || !std::isfinite(value))
        throw std::invalid_argument(
            fmt::format("{}: a value is {}; it must be finite and not negative", std::string(rule), value));
}

std::size_t below(const std::vector<double>& first, const std::vector<double>& second) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < first.size(); ++i) count += second[i] > (1.0 + tie_share) * first[i] ? 1 : 0;
  return count;
}

}  // namespace

Verdict lower(const std::vector<double>& first, const std::vector<double>& second) {
  require_comparable(first, second, "lower");
  const std::size_t wins = below(first, second), losses = below(second, first);
  if (2 * wins > first.size()) return Verdict::agrees;
  return 2 * losses >= first.size() ? Verdict::differs : Verdict::partly;
}

Verdict together(const std::vector<Verdict>& parts) {
  if (parts.empty()) throw std::invalid_argument("together: no parts; it takes one or more");
  const auto number = [&](Verdict verdict) { return std::count(parts.begin(), parts.end(), verdict); };
  const auto agree = number(Verdict::agrees), differ = number(Verdict::differs);
  const auto count = static_cast<std::ptrdiff_t>(parts.size());
  if (agree + differ + number(Verdict::partly) != count)
    throw std::invalid_argument(
        "together: a part is a misprint or depends; it takes agrees, differs, partly");
  if (agree == count) return Verdict::agrees;
  return agree == 0 && differ > 0 ? Verdict::differs : Verdict::partly;
}

Verdict invisible(double largest_difference, double axis_range) {
  if (!(largest_difference >= 0.0) || !(axis_range > 0.0) || !std::isfinite(largest_difference + axis_range))
    throw std::invalid_argument(fmt::format(
        "invisible: a difference of {} on an axis of {}; it takes a finite one on a positive range",
        largest_difference, axis_range));
  return plain(largest_difference <= visible_share * axis_range);
}

Verdict similar(const std::vector<double>& first, const std::vector<double>& second) {
  require_comparable(first, second, "similar");
  std::size_t count = 0;
  for (std::size_t i = 0; i < first.size(); ++i)
    count += std::max(first[i], second[i]) <= similar_factor * std::min(first[i], second[i]) ? 1 : 0;
  return plain(2 * count > first.size());
}

Verdict over(const std::vector<Reading>& readings) {
  if (readings.empty()) throw std::invalid_argument("over: no readings; it takes one or more");
  const Verdict first = readings.front().verdict;
  const bool same = std::all_of(readings.begin(), readings.end(),
                                [&](const Reading& reading) { return reading.verdict == first; });
  return same ? first : Verdict::depends;
}

int agreeing(const std::vector<Reading>& readings) {
  return static_cast<int>(std::count_if(readings.begin(), readings.end(), [](const Reading& reading) {
    return reading.verdict == Verdict::agrees;
  }));
}

std::vector<std::string> rule_text() {
  return {
      fmt::format(
          "A comparison (“lower”, “larger”, “best”) holds if it holds for most of the sizes that the paper "
          "draws and by both the rms and the mean of the error. Values within {:g} % of each other tie.",
          100.0 * tie_share),
      fmt::format(
          "“Well”, “close” and “approximately” hold if the difference cannot be seen on the axis of the "
          "paper's figure: at most {:g} % of its range.",
          100.0 * visible_share),
      fmt::format("“Similar”, “comparable” and “constant” hold within a factor of {:g}.", similar_factor),
      "A sentence of several parts agrees if all of them do, and is partly right if some do.",
      "A statement that depends on what the paper leaves open is computed under each reading. It agrees or "
      "differs if it does so under all of them; otherwise the page says under how many it holds.",
  };
}

}  // namespace wavebalance::report
