#include "analysis/mode_stability.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include "analysis/stability.hpp"
#include "analysis/summary_parts.hpp"
#include "wavebalance/app/analysis/stability_figure.hpp"

namespace wavebalance::app {
namespace {

using solvers::StabilityStatus;

solvers::ElasticBackbone solved_curve(const Backbone& curve) {
  return {solvers::BackboneStatus::reached_energy, curve.points};
}

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

/// `y` where `shown`, and where `beside` it there is a point that is shown.
std::vector<double> selected(const std::vector<double>& y, const std::vector<bool>& shown, bool beside) {
  std::vector<double> result(y.size(), std::nan(""));
  for (std::size_t i = 0; i < y.size(); ++i) {
    const bool near = beside && ((i > 0 && shown[i - 1]) || (i + 1 < y.size() && shown[i + 1]));
    if (shown[i] || near) result[i] = y[i];
  }
  return result;
}

}  // namespace

solvers::BackboneStability stability_of(const ModeStudy& study, const Backbone& curve,
                                        const Observer& observer) {
  if (!study.elastic_mode() || !study.scene().analysis.stability) return {};
  solvers::ModeStabilityOptions options;
  options.observer = observer;
  return solvers::backbone_stability(*study.elastic_mode(), solved_curve(curve), options);
}

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
    summary.emplace_back("stability", std::string(no_law_of_impact));
    return;
  }
  summary.emplace_back("stability",
                       stability.cancelled ? "interrupted" : std::string(to_string(stability.status())));
  summary.emplace_back("special_points", table_of(study, stability.special_points));
}

void append_stability(Record& record, const ModeStudy& study, const solvers::ModePoint& point) {
  if (!study.scene().analysis.stability) return;
  ResponseStability stability;
  stability.status = no_law_of_impact;
  if (study.elastic_mode()) {
    const auto found = solvers::ModeMultipliers(*study.elastic_mode())(point);
    const bool known = found.status == StabilityStatus::converged;
    stability.status = !known ? to_string(found.status) : found.unstable > 0 ? "unstable" : "stable";
    stability.unstable = found.unstable;
    if (found.multipliers.size() > 0)
      stability.leading = {found.multipliers[0].real(), std::abs(found.multipliers[0].imag())};
  }
  append_stability(record, stability, "free motion");
}

void draw_stability(Figure& figure, const Table& backbone, const ModeStudy& study,
                    const solvers::BackboneStability& stability) {
  if (stability.points.empty() || figure.panels.empty()) return;
  Panel& panel = figure.panels.front();
  const std::vector<double> energy = backbone.numbers("energy_ratio"),
                            unstable = backbone.numbers("unstable");
  const std::vector<double> solved = panel.series.front().y;  // without points that were not accepted
  std::vector<bool> is_stable(solved.size()), is_unstable(solved.size()), is_unknown(solved.size());
  bool any_unstable = false, any_unknown = false;
  for (std::size_t i = 0; i < solved.size(); ++i) {
    is_stable[i] = unstable[i] == 0.0;
    is_unstable[i] = unstable[i] > 0.0;
    is_unknown[i] = std::isnan(unstable[i]) && !std::isnan(solved[i]);
    any_unstable = any_unstable || (is_unstable[i] && !std::isnan(solved[i]));
    any_unknown = any_unknown || is_unknown[i];
  }
  Series stable("ω", energy, selected(solved, is_stable, false));
  stable.colour = Colour::blue;
  Series dashed("ω, unstable", energy, selected(solved, is_unstable, true));
  dashed.colour = Colour::blue;
  dashed.dash = Dash::dashed;
  Series unknown("ω, stability unknown", energy, selected(solved, is_unknown, false), SeriesStyle::points);
  unknown.colour = Colour::blue;
  panel.series.front() = std::move(stable);
  auto next = panel.series.begin() + 1;
  if (any_unstable) next = panel.series.insert(next, std::move(dashed)) + 1;
  if (any_unknown) panel.series.insert(next, std::move(unknown));
  std::vector<PlacedPoint> marks;
  for (const auto& point : stability.special_points)
    marks.push_back({point.type, point.energy_ratio, point.omega / study.mode().linear_omega()});
  draw_special_points(panel, marks);
}

}  // namespace wavebalance::app
