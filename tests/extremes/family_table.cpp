// The table of the extremes: an input, what must happen, what happened, what the solution leaves.
#include <fmt/format.h>

#include <algorithm>

#include "family.hpp"
#include "tables.hpp"
#include "wavebalance/report/artefact.hpp"

namespace wavebalance::extremes {
namespace {

std::string input_text(const Case& item) {
  std::string text = item.scene;
  for (const auto& one : item.overrides) text += " --set " + one;
  return text;
}

std::string must_text(const Case& item) {
  const std::string must = item.may_be_solved ? "solved or " + to_string(item.must) : to_string(item.must);
  return item.named.empty() ? must : must + ": " + item.named;
}

std::string happened_text(const CheckResult& result) {
  return result.outcome == Outcome::solved ? to_string(result.outcome)
                                           : to_string(result.outcome) + ": " + result.text;
}

const std::vector<std::string> columns{"group",       "input",           "must",
                                       "happened",    "motion_residual", "complementarity",
                                       "periodicity", "seconds",         "holds"};

void append(app::Table& table, const Case& item, const CheckResult& result) {
  const auto& found = result.residuals;
  table.append_row({item.group, input_text(item), must_text(item), happened_text(result), found.motion,
                    found.complementarity, found.periodicity, result.seconds,
                    led_to_what_it_must(item, result)});
}

/// The same with three digits, for reading.
void append_rounded(app::Table& table, const Case& item, const CheckResult& result) {
  const auto short_text = [](double value) {
    return std::isnan(value) ? std::string("-") : report::number(value, 2);
  };
  const auto& found = result.residuals;
  table.append_row({item.group, input_text(item), must_text(item), happened_text(result),
                    short_text(found.motion), short_text(found.complementarity),
                    short_text(found.periodicity), short_text(result.seconds),
                    led_to_what_it_must(item, result)});
}

void append_units(app::Table& table, app::Table& rounded, const std::filesystem::path& scenes) {
  constexpr double bound = 1e-9;
  std::string names;
  for (const auto& units : unit_systems()) names += (names.empty() ? "" : ", ") + units.scene;
  const double difference = difference_between_units(scenes);
  const bool holds = difference <= bound;
  const std::string happened = "largest relative difference " + report::number(difference, 2);
  const double none = std::numeric_limits<double>::quiet_NaN();
  table.append_row({"units", names, "equal to 1e-9", happened, none, none, none, none, holds});
  rounded.append_row({"units", names, "equal to 1e-9", happened, "-", "-", "-", "-", holds});
}

}  // namespace

void family_table(report::Artefact& artefact) {
  const std::filesystem::path& scenes = artefact.scenes();
  for (const char* name : {"bar.toml", "bar_linear.toml", "bar_rigid.toml", "bar_mm_n_t.toml",
                           "bar_nondimensional.toml", "blade.toml", "chain.toml", "chain_rigid.toml"})
    artefact.scene(name);
  app::Table table(columns), rounded(columns);
  int holding = 0;
  double longest = 0.0;
  for (const Case& item : family(scenes)) {
    const CheckResult result = check_residuals(item, scenes);
    append(table, item, result);
    append_rounded(rounded, item, result);
    holding += led_to_what_it_must(item, result) ? 1 : 0;
    longest = std::max(longest, result.seconds);
  }
  append_units(table, rounded, scenes);
  artefact.caption(fmt::format(
      "{} of {} inputs led to what they must, the longest in {} s. Residuals are computed from the samples "
      "of the response, apart from the solver: the equation of motion of every degree of freedom; force and "
      "penetration; the change of the state over one period of time stepping, where the error of the time "
      "basis shows.",
      holding, table.rows() - 1, report::number(longest, 2)));
  artefact.data(std::move(table), "residuals are relative; processor seconds of one run, checks included");
  artefact.printed(rounded);
}

}  // namespace wavebalance::extremes
