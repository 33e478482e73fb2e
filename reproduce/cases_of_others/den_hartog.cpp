#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "comparison.hpp"
#include "figures.hpp"
#include "wavebalance/app/results/record.hpp"

namespace wavebalance::cases {
namespace {

using std::numbers::pi;

constexpr double friction = 0.3;  // of the force
// A slider of stiffness k yields within a time of the order of 1 / sqrt(k) at each reversal, which is the
// relative distance from rigid friction.
constexpr double stiffest = 1e8, distance = 1e-4;

struct DryMotion {
  double amplitude, work, multiplier;  ///< work of friction in a period; modulus of the leading multiplier
};

/// The motion of x'' + x + friction sign x' = cos w t that reverses twice in a period without a stop [J. P.
/// Den Hartog, Trans. ASME 53, 1931, p. 107]. For its multiplier half a period is a rotation of the phase
/// plane by pi / w and, at the reversal, a jump of the acceleration by 2 friction.
DryMotion rigid(double w) {
  const double linear = 1.0 / (1.0 - w * w), share = std::tan(pi / (2.0 * w)) / w;
  const double amplitude = std::sqrt(linear * linear - friction * friction * share * share);
  const double restoring = amplitude / linear - amplitude;
  const double jump = (restoring + friction) / (restoring - friction);
  const double half_trace = 0.5 * (1.0 + jump) * std::cos(pi / w), rest = half_trace * half_trace - jump;
  const double of_half = rest < 0.0 ? std::sqrt(jump) : std::abs(half_trace) + std::sqrt(rest);
  return {amplitude, 4.0 * friction * amplitude, of_half * of_half};
}

DryMotion solved(report::Artefact& artefact, double w, double stiffness) {
  const app::Record record = app::analyse(
      artefact.scene("den_hartog.toml", {fmt::format("forcing.frequency={:.17g}", w / (2.0 * pi)),
                                         fmt::format("contact.tangential_stiffness={:.17g}", stiffness)}));
  if (!record.converged) throw report::NotConverged(fmt::format("{} rad/s: {}", w, record.status));
  const auto value = [&](const char* name) {
    const auto* number = app::value_in<double>(record.summary, name);
    return number ? *number : std::nan("");
  };
  return {value("max_displacement_m"), value("friction_work_J"),
          std::hypot(value("leading_multiplier_real"), value("leading_multiplier_imag"))};
}

std::vector<Row> rows_at(report::Artefact& artefact, double w) {
  const DryMotion exact = rigid(w);
  const DryMotion found = solved(artefact, w, stiffest);
  const auto row = [&](const char* quantity, double computed, double reference) {
    return Row{fmt::format("{} at {} rad/s", quantity, report::number(w)),
               computed,
               reference,
               distance * reference,
               references::closed_form,
               9};
  };
  return {row("largest displacement", found.amplitude, exact.amplitude),
          row("work of friction per period", found.work, exact.work),
          row("modulus of the leading multiplier", found.multiplier, exact.multiplier)};
}

app::Table response_table(report::Artefact& artefact) {
  std::vector<double> all, computed, exact;
  for (const double w : {0.6, 0.65, 0.7, 0.75, 0.8, 1.2, 1.25, 1.3, 1.4, 1.5, 1.6, 1.8, 2.0}) {
    all.push_back(w);
    computed.push_back(solved(artefact, w, stiffest).amplitude);
    exact.push_back(rigid(w).amplitude);
  }
  app::Table table;
  table.add_column("angular_frequency", all);
  table.add_column("largest_displacement", computed);
  table.add_column("of_rigid_friction", exact);
  return table;
}

app::Panel response_panel(const app::Table& responses) {
  app::Panel panel;
  panel.title = "response";
  panel.x.label = "Angular frequency (rad/s)";
  panel.y.label = "Largest displacement";
  for (const auto& [from, to] : {std::pair{0.6, 0.8}, std::pair{1.2, 2.0}}) {
    std::vector<double> x, y;
    for (int i = 0; i <= 100; ++i) {
      x.push_back(from + (to - from) * i / 100.0);
      y.push_back(rigid(x.back()).amplitude);
    }
    app::Series line(from < 1.0 ? "rigid, closed form" : "", x, y);
    line.colour = app::Colour::blue;
    panel.add(std::move(line));
  }
  panel.add(published_points("contact phases", responses.numbers("angular_frequency"),
                             responses.numbers("largest_displacement")));
  return panel;
}

app::Table distance_table(report::Artefact& artefact) {
  std::vector<double> stiffness, slow, fast;
  for (int power = 2; power <= 8; ++power) {
    stiffness.push_back(std::pow(10.0, power));
    for (auto [w, to] : {std::pair{0.75, &slow}, std::pair{1.5, &fast}}) {
      const double exact = rigid(w).amplitude;
      to->push_back(std::abs(solved(artefact, w, stiffness.back()).amplitude / exact - 1.0));
    }
  }
  app::Table table;
  table.add_column("tangential_stiffness", stiffness);
  table.add_column("distance_at_0.75", slow);
  table.add_column("distance_at_1.5", fast);
  return table;
}

app::Panel distance_panel(const app::Table& distances) {
  app::Panel panel;
  panel.title = "distance from rigid friction";
  panel.x.label = "Stiffness of the slider";
  panel.y.label = "Relative distance";
  panel.x.logarithmic = panel.y.logarithmic = true;
  panel.y.tick_format = panel.x.tick_format = "10^{%L}";
  for (const auto& [name, colour] : {std::pair{"distance_at_0.75", app::Colour::blue},
                                     std::pair{"distance_at_1.5", app::Colour::vermillion}}) {
    app::Series line(std::string(name).substr(12) + " rad/s", distances.numbers("tangential_stiffness"),
                     distances.numbers(name), app::SeriesStyle::line_points);
    line.colour = colour;
    panel.add(std::move(line));
  }
  return panel;
}

}  // namespace

void den_hartog(report::Artefact& artefact) {
  std::vector<Row> rows = rows_at(artefact, 0.75);
  for (Row& row : rows_at(artefact, 1.5)) rows.push_back(std::move(row));
  const app::Table responses = response_table(artefact), distances = distance_table(artefact);
  artefact.data(responses, "rad/s; displacements without unit");
  artefact.more_data("distances", distances, "without unit, at frequencies in rad/s");
  app::Figure figure;
  figure.columns = 2;
  figure.panel_width = 520;
  figure.panel_height = 460;
  figure.panels.push_back(response_panel(responses));
  figure.panels.push_back(distance_panel(distances));
  artefact.picture(std::move(figure));
  artefact.caption(
      "A mass on a spring with rigid dry friction of 0.3 times the force. Left: exact motions with a slider of 1e8 times the "
      "spring's stiffness. Right: the distance from rigid friction falls like the root of the slider's flexibility.");
  report_rows(artefact, rows);
}

}  // namespace wavebalance::cases
