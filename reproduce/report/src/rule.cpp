#include "wavebalance/report/rule.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "wavebalance/report/artefact.hpp"

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
  return 2 * losses > first.size() ? Verdict::differs : Verdict::ties;
}

Verdict together(const std::vector<Verdict>& parts) {
  using enum Verdict;
  if (parts.empty()) throw std::invalid_argument("together: no parts; it takes one or more");
  const auto number = [&](Verdict verdict) { return std::count(parts.begin(), parts.end(), verdict); };
  const auto agree = number(agrees), differ = number(differs), tie = number(ties);
  const auto count = static_cast<std::ptrdiff_t>(parts.size());
  if (agree + differ + tie + number(partly) != count)
    throw std::invalid_argument(
        "together: a part is a misprint or depends; it takes agrees, differs, partly, ties");
  if (tie == count) return ties;
  if (agree + tie == count) return agrees;
  return agree + number(partly) == 0 ? differs : partly;
}

Verdict invisible(double largest_difference, double range) {
  if (!(largest_difference >= 0.0) || !(range > 0.0) || !std::isfinite(largest_difference + range))
    throw std::invalid_argument(fmt::format(
        "invisible: a difference of {} in a range of {}; it takes a finite one in a positive range",
        largest_difference, range));
  return plain(largest_difference <= visible_share * range);
}

Verdict similar(const std::vector<double>& first, const std::vector<double>& second) {
  require_comparable(first, second, "similar");
  std::size_t count = 0;
  for (std::size_t i = 0; i < first.size(); ++i)
    count += std::max(first[i], second[i]) <= similar_factor * std::min(first[i], second[i]) ? 1 : 0;
  return mostly(count, first.size());
}

Verdict mostly(std::size_t count, std::size_t all) {
  return 2 * count == all ? Verdict::ties : plain(2 * count > all);
}

Verdict misprint(Verdict as_printed, Verdict as_corrected) {
  const bool slip = as_printed != Verdict::agrees && as_corrected == Verdict::agrees;
  return slip ? Verdict::misprint : as_printed;
}

std::vector<Reading> of_text(const std::vector<Reading>& readings, bool allowed) {
  std::vector<Reading> chosen;
  for (const Reading& reading : readings)
    if (reading.of_text == allowed) chosen.push_back(reading);
  return chosen;
}

Verdict over(const std::vector<Reading>& readings) {
  using enum Verdict;
  const auto deciding = of_text(readings);
  if (deciding.empty())
    throw std::invalid_argument("over: the text allows none of the readings; it takes one or more");
  const auto has = [&](Verdict verdict) {
    return std::any_of(deciding.begin(), deciding.end(),
                       [&](const Reading& reading) { return reading.verdict == verdict; });
  };
  const Verdict first = deciding.front().verdict;
  if (std::all_of(deciding.begin(), deciding.end(),
                  [&](const Reading& reading) { return reading.verdict == first; }))
    return first;
  if (has(agrees)) return depends;
  return has(differs) ? differs : partly;
}

int agreeing(const std::vector<Reading>& readings, bool allowed) {
  return static_cast<int>(std::count_if(readings.begin(), readings.end(), [&](const Reading& reading) {
    return reading.of_text == allowed && reading.verdict == Verdict::agrees;
  }));
}

namespace {

std::vector<std::string> comparisons_text() {
  return {
      fmt::format(
          "A comparison (“lower”, “best”) holds if it holds for more than half of the sizes or cases drawn, differs if "
          "its opposite does, and ties otherwise. Values within {:g} % of each other tie.",
          100.0 * tie_share),
      "Several parts or measures agree together if each agrees or ties, and one agrees. They tie if all tie. They hold in "
      "part if only some agree.",
      fmt::format(
          "“Well”, “close” and “approximately” mean within {:g} % of the range or of the value compared with. "
          "“Similar”, “comparable” and “constant” mean within a factor of {:g}. Equal means to {}.",
          100.0 * visible_share, similar_factor, number(rounding))};
}

std::vector<std::string> figures_text() {
  return {
      fmt::format(
          "“Sharp” means within 1/{} of the period. A plateau leaves out {} of these parts at either end. The beginning of an "
          "interval is its first 1/{}.",
          parts_of_period, parts_at_an_end, parts_of_interval),
      fmt::format(
          "“Converges” means that {} doublings at least halve the change per doubling. An effect of a parameter shrinks if "
          "the parameter changes {:g} and {:g} times.",
          doublings, parameter_factor, parameter_factor * parameter_factor)};
}

}  // namespace

std::vector<std::string> rule_text() {
  std::vector<std::string> text = comparisons_text();
  for (auto& sentence : figures_text()) text.push_back(std::move(sentence));
  text.emplace_back(
      "Where the paper leaves a detail open, only interpretations that its text allows decide; it depends if they "
      "disagree. Variants are listed as “if instead”.");
  text.emplace_back("A misprint does not agree as printed, but as another place of the same paper has it.");
  text.emplace_back(
      "Checks of the code are not counted, nor are statements on the blade of Laxalde and Legrand, which is not published; "
      "another blade stands in.");
  return text;
}

}  // namespace wavebalance::report
