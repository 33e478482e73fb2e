#include "comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace wavebalance::cases {
namespace {

using solvers::missing;

std::string kind(solvers::SpecialPointType type) {
  std::string name(to_string(type));
  std::replace(name.begin(), name.end(), '_', ' ');
  return name == "neimark sacker" ? "Neimark-Sacker point" : name;
}

std::string verdict(const Row& row) { return row.agrees() ? "agrees" : "differs"; }

/// The nearest special point of a type that is not taken yet.
const solvers::SpecialPoint* nearest(const Curve& curve, const references::KnownPoint& known,
                                     std::vector<bool>& taken) {
  const auto& points = curve.sweep.stability.special_points;
  const auto distance = [&](std::size_t i) {
    return std::abs(curve.unit * points[i].frequency - known.frequency);
  };
  std::size_t best = points.size();
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].type == known.type && !taken[i] && (best == points.size() || distance(i) < distance(best)))
      best = i;
  if (best == points.size()) return nullptr;
  taken[best] = true;
  return &points[best];
}

app::Table printed_table(const std::vector<Row>& rows) {
  app::Table table({"quantity", "computed here", "given", "difference", "tolerance", "source", "verdict"});
  for (const Row& row : rows)
    if (row.reference)
      table.append_row({row.quantity, report::number(row.computed, row.digits),
                        report::number(*row.reference, row.digits), report::number(row.difference(), 2),
                        report::number(row.tolerance, 2), row.source, verdict(row)});
  return table;
}

/// What was computed and has no value to compare it with; empty without any.
std::string others_text(const std::vector<Row>& rows) {
  std::string text;
  for (const Row& row : rows)
    if (!row.reference)
      text += (text.empty() ? "" : ", ") + row.quantity + " " + report::number(row.computed, row.digits);
  return text.empty() ? "" : "Computed beside these, with no value to compare with: " + text + ".";
}

app::Table data_table(const std::vector<Row>& rows) {
  app::Table table({"quantity", "computed", "given", "difference", "tolerance", "source", "agrees"});
  for (const Row& row : rows)
    table.append_row({row.quantity, row.computed, row.reference.value_or(missing), row.difference(),
                      row.reference ? row.tolerance : missing, row.source, row.agrees()});
  return table;
}

void claim_source(report::Artefact& artefact, const std::vector<Row>& rows, const std::string& source) {
  int all = 0, agreeing = 0;
  double largest = 0.0;
  for (const Row& row : rows) {
    if (row.source != source || !row.reference) continue;
    ++all;
    agreeing += row.agrees() ? 1 : 0;
    largest = std::fmax(largest, std::abs(row.difference()) / row.tolerance);
  }
  artefact.check({source, fmt::format("{} values of the table", all),
                  "each differs by no more than the tolerance of its row",
                  fmt::format("{} of {} agree; the largest difference is {} of its tolerance", agreeing, all,
                              report::number(largest, 2)),
                  agreeing == all});
}

}  // namespace

double Row::difference() const { return reference ? computed - *reference : missing; }

bool Row::agrees() const { return reference && std::abs(difference()) <= tolerance; }

std::vector<Row> compare(const Curve& curve, const std::vector<references::KnownPoint>& known,
                         double tolerance, const std::string& source) {
  const auto& points = curve.sweep.stability.special_points;
  std::vector<bool> taken(points.size(), false);
  const auto row = [&](solvers::SpecialPointType type, double computed) {
    return Row{kind(type) + " (" + curve.unit_name() + ")", computed, std::nullopt, 0.0, "", 10};
  };
  std::vector<Row> rows;
  for (const references::KnownPoint& one : known) {
    const auto* found = nearest(curve, one, taken);
    rows.push_back(row(one.type, found == nullptr ? missing : curve.unit * found->frequency));
    rows.back().reference = one.frequency;
    rows.back().tolerance = tolerance;
    rows.back().source = source;
  }
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!taken[i]) rows.push_back(row(points[i].type, curve.unit * points[i].frequency));
  return rows;
}

void claim_count(report::Artefact& artefact, const Curve& curve, double from, double to, int count,
                 const std::string& quote, const std::string& source) {
  const std::set<int> counts = counts_between(curve, from, to);
  artefact.check({source, quote,
                  fmt::format("multipliers outside the unit circle at all points between {} and {} {}: {}",
                              report::number(from, 7), report::number(to, 7), curve.unit_name(), count),
                  fmt::format("{}", fmt::join(counts, ", ")), counts == std::set<int>{count}});
}

void report_rows(report::Artefact& artefact, const std::vector<Row>& rows) {
  artefact.printed(printed_table(rows));
  if (const std::string others = others_text(rows); !others.empty()) artefact.note(others);
  artefact.more_data("comparison", data_table(rows), "as each quantity names them");
  std::vector<std::string> sources;
  for (const Row& row : rows)
    if (row.reference && std::find(sources.begin(), sources.end(), row.source) == sources.end())
      sources.push_back(row.source);
  for (const std::string& source : sources) claim_source(artefact, rows, source);
}

}  // namespace wavebalance::cases
