#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "figures.hpp"
#include "rotating_blade.hpp"
#include "wavebalance/app/analysis/modes.hpp"
#include "wavebalance/report/artefact.hpp"

namespace wavebalance::blade {
using app::Colour;

namespace {

constexpr double energies[] = {1.0, 2.0, 4.0, 7.0, 10.4};
constexpr double largest_rpm = 12000.0;
constexpr int speeds = 11;
constexpr double lowest = 500.0, highest = 900.0;  // Hz, of the picture
constexpr int shown_order = 5;

double rad_per_s(double rpm) { return rpm * 2.0 * std::numbers::pi / 60.0; }

std::string column(double energy) { return "energy_" + report::number(energy); }

/// Hz over rotation speed for each energy; missing where the branch was not found.
struct Diagram {
  app::Table table;
  std::string interruptions;  ///< of the branches, by speed
  std::string ends;           ///< why points are missing
};

std::string reason(const app::Interruption& gap) {
  if (!gap.resonances.empty()) return "internal resonance " + gap.resonances.front();
  return gap.status;
}

Diagram campbell(const RotatingBlade& blade, const app::Scene& scene) {
  Diagram diagram;
  std::string& interruptions = diagram.interruptions;
  std::vector<std::string> columns{"rotation_rpm", "linear_Hz"};
  for (const double energy : energies) columns.push_back(column(energy));
  app::Table table(columns);
  for (int i = 0; i < speeds; ++i) {
    const double rpm = largest_rpm * i / (speeds - 1);
    const app::ModeStudy study(scene, blade.at(rad_per_s(rpm)));
    const auto curve = study.backbone();
    for (const auto& gap : curve.interruptions)
      interruptions += fmt::format(
          "{}{} 1/min: {} at {}", interruptions.empty() ? "" : ", ", report::number(rpm, 5),
          gap.resonances.empty() ? gap.status : gap.resonances.front(), report::number(gap.first_ratio, 4));
    std::vector<app::Cell> row{rpm, study.linear_frequency()};
    for (const double energy : energies) {
      const auto point = study.at_energy(curve, energy);
      if (!point.accepted())
        diagram.ends += fmt::format("{}energy {} at {} 1/min ({})", diagram.ends.empty() ? "" : ", ",
                                    report::number(energy), report::number(rpm, 5),
                                    curve.early_end.empty() && !curve.interruptions.empty()
                                        ? reason(curve.interruptions.back())
                                        : curve.status());
      row.emplace_back(point.accepted() ? point.omega / (2.0 * std::numbers::pi) : solvers::missing);
    }
    table.append_row(row);
  }
  diagram.table = table;
  return diagram;
}

/// The last points of curves that end within the picture.
app::Series ends(const app::Table& table) {
  const auto rpm = table.numbers("rotation_rpm");
  app::Series marks("not found beyond", std::vector<double>(), std::vector<double>(),
                    app::SeriesStyle::points);
  for (const double energy : energies) {
    const auto hz = table.numbers(column(energy));
    for (std::size_t i = 0; i + 1 < hz.size(); ++i)
      if (!std::isnan(hz[i]) && std::isnan(hz[i + 1])) {
        marks.x.push_back(rpm[i]);
        marks.y.push_back(hz[i]);
      }
  }
  marks.colour = Colour::black;
  marks.marker = 7;  // open
  return marks;
}

app::Figure drawn(const app::Table& table) {
  app::Figure figure;
  figure.panel_width = 620;
  figure.panel_height = 520;
  auto& panel = figure.add_panel("first mode of the blade");
  panel.x = report::axis("Rotation speed (1/min)", 0.0, largest_rpm);
  panel.y = report::axis("Frequency (Hz)", lowest, highest);
  for (const double energy : energies) {
    app::Series series("energy " + report::number(energy) + (energy == 1.0 ? " (linear)" : ""), table,
                       "rotation_rpm", column(energy), app::SeriesStyle::line_points);
    series.marker = 1;
    panel.add(series);
  }
  panel.add(ends(table));
  // Every order whose line crosses the picture, up to one that only the slowest blade meets.
  const int first_order = static_cast<int>(std::ceil(60.0 * lowest / largest_rpm)), last_order = 10;
  for (int order = first_order; order <= last_order; ++order) {
    const double per_rpm = order / 60.0, to = std::min(highest / per_rpm, largest_rpm);
    panel.segments.push_back(
        {lowest / per_rpm, lowest, to, to * per_rpm, false, app::Dash::dashed, Colour::grey, 1.0});
    const double label = lowest + 0.08 * (highest - lowest);
    panel.texts.push_back({label / per_rpm - 60.0, label,
                           (order == first_order ? "order " : "") + std::to_string(order),
                           app::TextMark::Align::right});
  }
  return figure;
}

/// Rotation speed at which engine order `order` meets the frequencies of a column, linear between speeds; NaN
/// outside.
double crossing(const app::Table& table, double energy, int order) {
  const auto rpm = table.numbers("rotation_rpm"), hz = table.numbers(column(energy));
  for (std::size_t i = 1; i < rpm.size(); ++i) {
    const double before = hz[i - 1] - order * rpm[i - 1] / 60.0, after = hz[i] - order * rpm[i] / 60.0;
    if (before >= 0.0 && after <= 0.0) return rpm[i - 1] + (rpm[i] - rpm[i - 1]) * before / (before - after);
  }
  return solvers::missing;
}

/// Where the tip's contact moves a resonance with an engine order.
void note_crossing(report::Artefact& artefact, const app::Table& table) {
  artefact.note(fmt::format(
      "Engine order {} meets the first mode at {} 1/min without contact and at {} 1/min at energy 10.4.",
      shown_order, report::number(crossing(table, 1.0, shown_order), 5),
      report::number(crossing(table, 10.4, shown_order), 5)));
}

}  // namespace

void campbell_diagram(report::Artefact& artefact) {
  const auto scene = artefact.scene("campbell.toml");
  const RotatingBlade blade(scene);
  const auto diagram = campbell(blade, scene);
  const auto& table = diagram.table;
  artefact.data(table, "rotation_rpm in 1/min, frequencies in Hz; missing where the branch was not found",
                {"energies over that of the linear mode that just touches at the same speed"});
  artefact.picture(drawn(table));
  artefact.caption(
      "Nonlinear Campbell diagram of the first mode of the open blade with rigid contact along its tip, five harmonics. "
      "Energies are relative to the linear mode that just touches at the same speed. Dashed: engine orders.");
  artefact.note(fmt::format(
      "The gap is that of the turning blade. Its static displacement, up to {} mm at the largest speed, "
      "stiffens the blade but is not part of the motion; Coriolis forces are not included. All speeds take "
      "the reduction at rest ({} s).",
      report::number(1e3 * blade.static_displacement(rad_per_s(largest_rpm)), 2),
      report::number(blade.at_rest().reduction_seconds, 2)));
  if (!diagram.ends.empty())
    artefact.note("Points that were not found, and are not drawn: " + diagram.ends + ".");
  if (!diagram.interruptions.empty())
    artefact.note(fmt::format(
        "Branches interrupted by internal resonances (harmonic : linear mode) or unsolved, at frequencies "
        "over the linear one: {}.",
        diagram.interruptions));
  note_crossing(artefact, table);
}

}  // namespace wavebalance::blade
