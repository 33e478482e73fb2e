#include "results/mode_stability.hpp"

#include <cmath>
#include <string>

#include "files/missing.hpp"
#include "results/quantities.hpp"
#include "results/stability.hpp"
#include "results/summary_parts.hpp"

namespace wavebalance::app {
namespace {

/// The word for a rigid obstacle, at which contacts with mass have no linearised motion.
constexpr const char* no_law_of_impact = "no_law_of_impact";

using solvers::StabilityStatus;

Table table_of(const ModeStudy& study, const std::vector<solvers::ModeSpecialPoint>& points) {
  Table table(
      {"type", "frequency_Hz", "bracket_Hz", "energy_ratio", "multiplier_real", "multiplier_imag", "status"});
  const double hertz = study.linear_frequency() / study.mode().linear_omega();
  for (const auto& point : points)
    table.append_row({std::string(to_string(point.type)), hertz * point.omega, hertz * point.bracket,
                      point.energy_ratio, point.multiplier.real(), point.multiplier.imag(),
                      std::string(point.located ? "located" : "bracketed")});
  return table;
}

/// Without the digits that an error leaves open.
double known_digits(double value, double error) {
  if (!(error > 0.0)) return value;
  const double decimals = std::pow(10.0, -std::floor(std::log10(error)));
  return std::round(value * decimals) / decimals;
}

}  // namespace

void add_stability(Table& table, const solvers::BackboneStability& stability) {
  const auto& points = stability.points;
  if (points.empty()) return;
  const std::size_t first = table.rows() - points.size();
  std::vector<double> unstable(table.rows(), 0.0), contacts(table.rows(), 0.0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    unstable[first + i] = points[i].unstable >= 0 ? points[i].unstable : missing;
    contacts[first + i] = points[i].contacts;
  }
  table.add_column("unstable", unstable).add_column("contacts", contacts);
}

void append_stability(Summary& summary, const ModeStudy& study, const solvers::BackboneStability& stability) {
  if (!study.scene().analysis.stability) return;
  if (!study.elastic_mode()) {
    summary.emplace_back(quantities::stability, std::string(no_law_of_impact));
    return;
  }
  summary.emplace_back(quantities::stability,
                       stability.cancelled ? "interrupted" : std::string(to_string(stability.status())));
  summary.emplace_back(quantities::special_points, table_of(study, stability.special_points));
}

void append_stability(Record& record, const ModeStudy& study, const solvers::ModePoint& point) {
  if (!study.scene().analysis.stability) return;
  ResponseStability stability;
  stability.status = no_law_of_impact;
  double error = missing;
  if (study.elastic_mode()) {
    const auto found = solvers::ModeMultipliers(*study.elastic_mode())(point);
    const bool known = found.status == StabilityStatus::converged;
    stability.status = !known ? to_string(found.status) : found.unstable > 0 ? "unstable" : "stable";
    stability.unstable = found.unstable;
    if (found.multipliers.size() > 0)
      stability.leading = {known_digits(found.multipliers[0].real(), found.error),
                           known_digits(std::abs(found.multipliers[0].imag()), found.error)};
    error = found.error;
  }
  append_stability(record, stability, "free motion");
  record.summary.emplace_back(quantities::leading_multiplier_error, error);
}

}  // namespace wavebalance::app
