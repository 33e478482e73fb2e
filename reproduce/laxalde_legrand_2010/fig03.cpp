#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "curves.hpp"
#include "figures.hpp"
#include "rod_statements.hpp"

namespace wavebalance::ll10 {
using app::Colour;
using app::Dash;
using app::SeriesStyle;

namespace {

constexpr double largest_jump = 0.16;  // of the energy between points that a line joins

struct Look {
  const char* label;
  const char* formulation;
  Colour colour;
  Dash dash;
  int marker;  ///< 0: a line without symbols
};

constexpr Look looks[] = {
    {"exact", "exact", Colour::black, Dash::solid, 0},
    {"eq. (28)", "consistent", Colour::blue, Dash::solid, 1},
    {"half-lumped mass, a remedy", "consistent_half_lumped", Colour::orange, Dash::solid, 4},
    {"as published: √r", "published", Colour::vermillion, Dash::dash_dotted, 0}};

/// More than a step of the curve's frequencies.
double step_of(const app::Scene& scene) {
  constexpr double usual_range = 0.3;  // of the frequency ratio, without a last one
  const double last = scene.analysis.last_frequency_ratio;
  return 1.5 * (last > 0.0 ? last - 1.0 : usual_range) / scene.analysis.points;
}

/// A column of one formulation over the energy. Lines end where points are missing between neighbours, and
/// where the energy jumps from one to the next.
app::Series curve(const Look& look, const Table& table, const std::string& column, double largest_step) {
  const auto rows = table.where("formulation", look.formulation);
  const auto energy = rows.numbers("energy_ratio"), ratio = rows.numbers("frequency_ratio"),
             value = rows.numbers(column);
  std::vector<double> x, y;
  for (std::size_t i = 0; i < energy.size(); ++i) {
    const double change = i > 1 ? energy[i] / energy[i - 1] - 1.0 : 0.0;
    const bool far =
        look.marker > 0 && i > 1 && (ratio[i] - ratio[i - 1] > largest_step || change > largest_jump);
    if (far || change < -largest_jump) {
      x.push_back(energy[i]);
      y.push_back(std::numeric_limits<double>::quiet_NaN());
    }
    x.push_back(energy[i]);
    y.push_back(value[i]);
  }
  const bool marked = look.marker > 0;
  return report::styled({look.label, x, y, marked ? SeriesStyle::line_points : SeriesStyle::line},
                        look.colour, {.dash = look.dash, .width = marked ? 1.1 : 1.8, .marker = look.marker});
}

app::Series resonance_points(const std::vector<double>& energy, const std::vector<double>& ratio) {
  return report::styled({"eq. (28), on internal resonances", energy, ratio, SeriesStyle::points},
                        Colour::grey, {.marker = 8});
}

/// Points on internal resonances, with their names if these do not overlap.
void add_resonances(app::Panel& panel, const app::ModeStudy& study, const app::Backbone& backbone,
                    bool onset) {
  std::vector<double> energy, ratio;
  std::string named;
  for (const auto& point : backbone.points) {
    if (point.status != solvers::ModeStatus::internal_resonance) continue;
    energy.push_back(point.energy_ratio);
    ratio.push_back(point.omega / study.mode().linear_omega());
    const std::string name = app::resonance_name(point.resonance);
    const bool shown = energy.back() < 0.93 * *panel.x.upper && energy.back() > *panel.x.lower &&
                       ratio.back() > (onset ? *panel.y.lower : 1.05) && ratio.back() < *panel.y.upper;
    if (name != named && shown) {
      // Beside the mark, away from the curves: above it where contact begins, below it elsewhere.
      const double side = onset ? 1.0 : -1.0;
      panel.texts.push_back({energy.back() - side * 0.008 * (*panel.x.upper - *panel.x.lower),
                             ratio.back() + side * 0.035 * (*panel.y.upper - *panel.y.lower), name,
                             onset ? app::TextMark::Align::right : app::TextMark::Align::left});
      named = name;
    }
  }
  panel.add(resonance_points(energy, ratio));
}

void add_panel(app::Figure& figure, const RodCurves& curves, const Table& table, bool onset) {
  auto& panel = figure.add_panel(onset ? "the beginning of contact, ω"
                                       : "frequency ω, " + discretisation(curves.study.scene()));
  panel.x = axis("Energy γ over its value at linear grazing", onset ? 0.6 : 0.0, onset ? 2.0 : 10.0);
  panel.y = axis("Frequency over the linear one", 0.98, onset ? 1.14 : 1.28);
  for (const Look& look : looks) {
    auto series = curve(look, table, "frequency_ratio", step_of(curves.study.scene()));
    if (!onset) series.marker_every = 4;
    panel.add(series);
  }
  add_resonances(panel, curves.study, curves.backbone, onset);
  panel.mark_x(1.0);
}

void add_quotient(app::Figure& figure, const Table& table, double step) {
  auto& panel = figure.add_panel("root of the Rayleigh quotient, √r");
  panel.x = axis("Energy γ over its value at linear grazing", 0.0, 10.0);
  panel.y = axis("√r over the linear frequency", 0.98, 1.20);
  for (const Look& look : looks) {
    auto series = curve(look, table, "rayleigh_frequency_ratio", step);
    series.marker_every = 4;
    panel.add(series);
  }
  panel.add(resonance_points({}, {}));  // for the legend of all panels
  panel.mark_x(1.0);
}

app::Figure drawn(const RodCurves& curves, const Table& table) {
  app::Figure figure;
  figure.panel_width = 620;
  figure.panel_height = 400;
  add_panel(figure, curves, table, false);
  add_panel(figure, curves, table, true);
  add_quotient(figure, table, step_of(curves.study.scene()));
  return figure;
}

std::string errors_text(const app::ModeStudy& study, const app::Backbone& backbone) {
  std::string text;
  for (const double energy : {1.2, 1.8, 3.0, 5.0, 10.0}) {
    const auto point = study.at_energy(backbone, energy);
    const double exact = exact_mode(study.scene(), energy).frequency_ratio();
    text += (text.empty() ? "" : ", ") +
            (point.accepted() ? report::percent(point.omega / study.mode().linear_omega() / exact - 1.0, 2)
                              : std::string(to_string(point.status))) +
            " at " + report::number(energy);
  }
  const auto distance = exact_distance(study, backbone);
  return fmt::format("{}; over the {} accepted points at energy ratios 1.2 to 10 median {}, largest {}", text,
                     distance.points, report::percent(distance.median, 2),
                     report::percent(distance.largest, 2));
}

/// Where internal resonances cut the curves.
Table resonances_table(const RodCurves& curves) {
  Table table({"Mass matrix", "n:k", "ω over the linear one, from", "to"});
  const auto add = [&](const std::string& matrix, const app::Backbone& backbone) {
    for (const auto& gap : backbone.interruptions) {
      std::string names;
      for (const auto& name : gap.resonances) names += (names.empty() ? "" : ", ") + name;
      table.append_row({matrix, names.empty() ? gap.status : names, report::number(gap.first_ratio, 5),
                        report::number(gap.last_ratio, 5)});
    }
  };
  add("eq. (28)", curves.backbone);
  add("half-lumped", curves.remedy_backbone);
  return table;
}

double frequency_quotient(const app::ModeStudy& study) {
  const auto& squares = study.mode().model().omega_squared;
  return std::sqrt(squares[1] / squares[0]);
}

void notes(report::Artefact& artefact, const RodCurves& curves) {
  artefact.note(fmt::format("Error of ω against the exact curve. Eq. (28): {}. Half-lumped mass: {}.",
                            errors_text(curves.study, curves.backbone),
                            errors_text(curves.remedy, curves.remedy_backbone)));
  artefact.note(fmt::format(
      "With eq. (28) the second linear frequency is {} times the first. Harmonic 3 of the motion therefore "
      "meets the second mode just above the linear frequency, and the curve is cut there. Half consistent, half "
      "lumped mass is no part of the paper; it has {} and is drawn as the remedy that it is.",
      report::number(frequency_quotient(curves.study), 6),
      report::number(frequency_quotient(curves.remedy), 6)));
  artefact.printed(resonances_table(curves));
  artefact.note(
      fmt::format("{} points with eq. (28) in {} ms; {} of them on internal resonances, {} unsolved.",
                  curves.backbone.points.size(), report::number(1e3 * curves.backbone.wall_seconds, 3),
                  curves.backbone.count(solvers::ModeStatus::internal_resonance),
                  curves.backbone.count(solvers::ModeStatus::cycling)));
}

}  // namespace

void fig03(report::Artefact& artefact) {
  const app::ModeStudy study(artefact.scene("rod.toml")), remedy(artefact.scene("rod_half_lumped.toml"));
  const auto published_scene = artefact.scene("rod_published.toml");
  const RodCurves curves{study, study.backbone(), remedy, remedy.backbone(),
                         published_branch(app::ModeStudy(published_scene))};
  for (const auto* backbone : {&curves.backbone, &curves.remedy_backbone})
    if (!backbone->converged()) throw report::NotConverged("backbone: " + backbone->status());
  const auto table = backbones_table(curves);
  const std::string settings = discretisation(study.scene());
  artefact.data(table, "ratios to the linear mode; energy_ratio is gamma over its value at linear grazing",
                {"consistent: eq. (28), " + settings, "consistent_half_lumped: " + settings,
                 "published: eqs. (24) as printed with eq. (28), Algorithm 2, " +
                     discretisation(published_scene) + "; frequency_ratio is the root of r",
                 "exact: d'Alembert; below contact the linear mode"});
  artefact.picture(drawn(curves, table));
  artefact.caption(fmt::format(
      "First nonlinear mode of the rod: exact, with the mass matrix of eq. (28), with a half-lumped one, and by the "
      "printed equations (N = {}). (b) shows the beginning of contact; (c) is what the paper takes for ω. The dotted "
      "line is the linear mode that grazes. Stability is not defined without an impact law. The table lists internal "
      "resonances: n:k means harmonic n and linear mode k.",
      published_scene.analysis.harmonics));
  rod_statements(artefact, curves);
  notes(artefact, curves);
}

}  // namespace wavebalance::ll10
