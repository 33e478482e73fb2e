#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "blade.hpp"
#include "curves.hpp"
#include "figures.hpp"
#include "wavebalance/report/rule.hpp"

namespace wavebalance::ll10 {
using app::Colour;
using report::styled;

namespace {

constexpr const char* abscissa = "energy_ratio";

void add_backbones(app::Figure& figure, const app::ModeStudy& study, const app::Backbone& curve,
                   const Table& table, const std::vector<SecondSolution>& second, int published_harmonics,
                   bool published_ends) {
  using app::Dash;
  auto& panel =
      figure.add_panel(fmt::format("frequency, {} harmonics, {} samples", study.scene().analysis.harmonics,
                                   study.scene().analysis.samples));
  panel.x = axis("Energy γ over its value at linear grazing", 0.0, 13.0);
  panel.y = axis("Frequency over the linear one", 0.98, 1.38);
  const auto consistent = table.where("formulation", "consistent");
  panel.add(styled({"corrected equations, ω", consistent, abscissa, "frequency_ratio"}, Colour::blue))
      .add(styled({"the same motions, √r", consistent, abscissa, "rayleigh_frequency_ratio"},
                  Colour::sky_blue, {.dash = Dash::dashed}));
  const auto published = styled(
      {fmt::format("as published: √r, N = {}", published_harmonics), table.where("formulation", "published"),
       abscissa, "frequency_ratio", app::SeriesStyle::line_points},
      Colour::vermillion, {.dash = Dash::dash_dotted, .marker = 1});
  panel.add(published);
  constexpr int open = 8;
  if (published_ends)
    panel.add(styled({"as published, not found beyond", std::vector{published.x.back()},
                      std::vector{published.y.back()}, app::SeriesStyle::points},
                     Colour::black, {.marker = open}));
  std::vector<double> x, y, resonance_energy, resonance_frequency;
  for (const auto& one : second) {
    x.push_back(one.energy_ratio);
    y.push_back(one.lagrangian);
  }
  panel.add(styled({"ω by the augmented Lagrangian", x, y, app::SeriesStyle::points}, Colour::black,
                   {.marker = 7}));
  for (const auto& point : curve.points)
    if (point.status == solvers::ModeStatus::internal_resonance) {
      resonance_energy.push_back(point.energy_ratio);
      resonance_frequency.push_back(point.omega / study.mode().linear_omega());
    }
  if (!resonance_energy.empty())
    panel.add(styled({"internal resonances", resonance_energy, resonance_frequency, app::SeriesStyle::points},
                     Colour::grey, {.marker = open}));
  panel.mark_x(1.0);
}

void add_torsion(app::Figure& figure, const Table& measures) {
  auto& panel = figure.add_panel("torsion");
  panel.x = axis("Energy γ over its value at linear grazing", 0.0, 13.0);
  panel.y = axis("Share of kinetic energy in torsion modes", 0.0, 0.05);
  panel.add(styled({"", measures, abscissa, "torsion_share"}, Colour::green)).mark_x(1.0);
}

using report::number;
using report::percent;

constexpr double energies[] = {1.2, 2.0, 3.0, 7.0, 10.4};

void claim_hardening(report::Artefact& artefact, const std::vector<SecondSolution>& second) {
  bool rising = true;
  double before = 1.0;
  std::string measured;
  for (const auto& one : second) {
    rising = rising && one.condensed > before;
    before = one.condensed;
    measured += (measured.empty() ? "" : ", ") + number(one.condensed, 5) + " at " + number(one.energy_ratio);
  }
  judge(artefact,
        {.place = "section 5.2",
         .quote = "This results in an increase of the natural frequency of the blade.",
         .criterion = "ω over the linear frequency rises from one to the next of the energies compared",
         .measured = measured,
         .verdict = report::plain(rising),
         .panel = "(a)",
         .apart = on_our_blade},
        "The frequency falls between two of these energies.");
}

/// The least energies of motions that touch with either half of the tip.
struct FirstContacts {
  double leading = std::numeric_limits<double>::infinity(), trailing = leading;
};

FirstContacts first_contacts(const app::Backbone& curve) {
  FirstContacts first;
  for (const auto& point : curve.points) {
    if (!point.accepted()) continue;
    const auto contact = blade::edge_contact(point.force);
    if (!contact.leading.empty()) first.leading = std::min(first.leading, point.energy_ratio);
    if (!contact.trailing.empty()) first.trailing = std::min(first.trailing, point.energy_ratio);
  }
  return first;
}

void claim_contact(report::Artefact& artefact, const app::ModeStudy& study, const app::Backbone& curve) {
  const double sample = 1.0 / study.scene().analysis.samples;
  std::string measured;
  for (const double energy : {shape_energies[1], shape_energies[2]}) {
    const auto contact = blade::edge_contact(accepted_at(study, curve, energy).force);
    measured += fmt::format(
        "; at energy {} the leading half touches for {} of the period and the trailing half for {}",
        number(energy), percent(static_cast<double>(contact.leading.size()) * sample),
        percent(static_cast<double>(contact.trailing.size()) * sample));
  }
  const auto first = first_contacts(curve);
  const auto at_unity = [](double energy) {
    return report::plain(std::max(energy, 1.0 / energy) <= 1.0 + report::tie_share);
  };
  judge(artefact,
        {.place = "section 5.2",
         .quote =
             "When the normalized energy is greater that one, intermittent contacts occur at the leading and "
             "trailing edges of the contact interface.",
         .criterion = fmt::format("contact begins at either edge at an energy that ties with 1 (within {})",
                                  percent(report::tie_share)),
         .measured = fmt::format("leading edge from {}, trailing edge from {}", number(first.leading, 4),
                                 number(first.trailing, 4)) +
                     measured,
         .verdict = report::together({at_unity(first.leading), at_unity(first.trailing)}),
         .panel = "(a)",
         .apart = on_our_blade},
        fmt::format("The edges do not touch together: one does so from energy {}, the other from {} on.",
                    number(std::min(first.leading, first.trailing), 3),
                    number(std::max(first.leading, first.trailing), 3)));
}

void notes(report::Artefact& artefact, const app::ModeStudy& study, const app::Backbone& curve,
           const std::vector<LagrangianPoint>& published) {
  const auto& last = published.back();
  double reached = 0.0, defect = 0.0;
  for (const auto& point : published)
    if (point.accepted()) {
      reached = std::max(reached, point.prescribed_ratio);
      defect = std::max(defect, point.equation_residual);
    }
  const std::string end = last.accepted()
                              ? std::string()
                              : fmt::format(" and not found beyond: {} at {}", to_string(last.status),
                                            number(last.prescribed_ratio, 3));
  artefact.note(fmt::format(
      "The printed equations, in all {} coordinates, were followed to energy {}{}. Their motions miss the equation of "
      "motion by up to {} of the elastic forces. The dashed line, the root of r of the corrected motions, is what the "
      "paper's formula would call frequency.",
      study.model().size(), number(reached, 3), end, percent(defect, 2)));
  artefact.note(fmt::format(
      "The curve, {} points, took {} ms after assembly and reduction in {} s. {} points on internal "
      "resonances, {} unsolved.",
      curve.points.size(), number(1e3 * curve.wall_seconds, 3), number(study.model().reduction_seconds, 3),
      curve.count(solvers::ModeStatus::internal_resonance),
      static_cast<int>(curve.points.size()) - curve.count(solvers::ModeStatus::internal_resonance) -
          curve.count(solvers::ModeStatus::converged)));
}

}  // namespace

void fig07(report::Artefact& artefact) {
  const app::ModeStudy study(artefact.scene("blade_mode.toml", {"analysis.largest_energy=12.5"}));
  const auto curve = study.backbone();
  if (!curve.converged()) throw report::NotConverged("backbone: " + curve.status());
  const auto scene = artefact.scene("blade_published.toml");
  const auto published = published_branch(app::ModeStudy(scene, study.model()));
  const auto second = second_solutions(study, curve, {std::begin(energies), std::end(energies)});
  const auto table = backbones_table(study, curve, published);
  const auto measures = blade_measures(study, curve);
  artefact.data(
      table, "ratios to the linear mode; energy_ratio is gamma over its value at linear grazing",
      {fmt::format("consistent: N = {}, m = {}; below contact the linear mode",
                   study.scene().analysis.harmonics, study.scene().analysis.samples),
       fmt::format(
           "published: eqs. (24) as printed, Algorithm 2, N = {}, m = {}; frequency_ratio is the root of r",
           scene.analysis.harmonics, scene.analysis.samples)});
  artefact.more_data("torsion", measures,
                     "torsion_share of the kinetic energy; tip_twist_degrees: amplitude of the tip's "
                     "rotation about z for a gap of 1 mm; contact_fraction of the period");
  app::Figure figure;
  figure.panel_width = 620;
  figure.panel_height = 370;
  add_backbones(figure, study, curve, table, second, scene.analysis.harmonics, !published.back().accepted());
  add_torsion(figure, measures);
  artefact.picture(figure);
  artefact.caption(fmt::format(
      "First nonlinear mode of the open blade: frequency by corrected equations, the root of the Rayleigh quotient, and "
      "the equations as published with {} harmonics. The dotted line is the energy at which the linear mode reaches the "
      "casing. Tips of torsion modes rotate more than they translate.",
      scene.analysis.harmonics));
  claim_hardening(artefact, second);
  claim_contact(artefact, study, curve);
  notes(artefact, study, curve, published);
}

}  // namespace wavebalance::ll10
