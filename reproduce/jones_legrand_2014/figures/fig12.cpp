#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "convergence.hpp"
#include "figures.hpp"
#include "sweeps.hpp"
#include "wavebalance/app/analysis/sweep.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/results/record.hpp"
#include "wavebalance/report/rule.hpp"

namespace wavebalance::jl14 {
namespace {

using report::number;
using report::Verdict;

constexpr const char* first_file = "case2_sweep.toml";
constexpr const char* second_file = "case2_sweep_second.toml";
constexpr int full_functions = 63;  // 31 full harmonics
const char* units = "SI; a column's name ends in its unit; points in their order along the curve";

/// The curves of Fig. 12.
struct Curves {
  Resonance first, second, near;  ///< 64 functions
  app::Sweep full;                ///< of the first resonance, Fourier:Fourier with 63 functions
  app::Sweep exact;               ///< of the first resonance, the motions of the bar themselves
};

std::string gap_text(const Resonance& resonance) {
  return "gap " + number(1e3 * resonance.gap) + " mm (dotted)";
}

app::Panel first_panel(const Curves& curves, const std::string& title, bool enlarged) {
  app::Panel panel = sweep_panel(title, curves.first);
  if (!enlarged)
    panel.add(report::styled(modulus_curve("Fourier, 63 functions, max |u|", curves.full), app::Colour::green,
                             {.dash = app::Dash::dash_dotted}));
  add_stable_sweep(panel, curves.full);
  // Every other point of either, so that the symbols do not cover each other.
  const int every = enlarged ? 1 : 6;
  for (std::size_t i = 0; i < curves.first.pairs.size(); ++i)
    add_points(panel, curves.first.pairs[i], curves.first.pairs[i].label, curves.first.sweeps[i],
               static_cast<int>(i) * every / 2, every);
  add_special_points(panel, curves.full);
  return panel;
}

app::Panel second_panel(const Resonance& resonance) {
  app::Panel panel = sweep_panel("second resonance, " + gap_text(resonance), resonance);
  add_stable_sweep(panel, resonance.sweeps[0]);
  constexpr int every = 8;
  add_points(panel, resonance.pairs[1], resonance.pairs[1].label, resonance.sweeps[1], 0, every);
  add_special_points(panel, resonance.sweeps[0]);
  panel.x.ticks = {3400, 3600, 3800, 4000, 4200};
  return panel;
}

app::Figure drawn(const Curves& curves) {
  app::Figure figure;
  figure.panel_width = 720;
  figure.panel_height = 270;
  figure.panels = {first_panel(curves, "first resonance, " + gap_text(curves.first), false),
                   first_panel(curves, "the same, enlarged", true), second_panel(curves.second),
                   second_panel(curves.near)};
  // The enlarged part holds all of max u beyond the gap.
  const auto highest = peak(curves.full);
  const auto& turns = curves.full.curve.turning_points;
  double right = highest.frequency;
  for (const auto& turn : turns) right = std::max(right, turn.frequency);
  const double gap = millimetres * curves.first.gap, above = millimetres * highest.max_displacement - gap;
  figure.panels[1].x = axis("Forcing frequency (Hz)", right - 125.0, right + 15.0);
  figure.panels[1].x.ticks = {1220, 1240, 1260, 1280, 1300, 1320, 1340};
  figure.panels[1].y = axis("Largest displacement (mm)", gap - 0.9 * above, gap + 1.35 * above);
  const double both = 1.15 * millimetres * peak(curves.second.free).max_displacement;
  figure.panels[2].y.upper = figure.panels[3].y.upper = both;
  return figure;
}

void state_stiffening(report::Artefact& artefact, const Curves& curves) {
  const double without = peak(curves.first.free).frequency;
  std::string text;
  bool rise = peak(curves.full).frequency > without;
  for (std::size_t i = 0; i < curves.first.pairs.size(); ++i) {
    const double with = peak(curves.first.sweeps[i]).frequency;
    rise = rise && with > without;
    text += fmt::format(", {} {} Hz", curves.first.pairs[i].label, number(with, 5));
  }
  artefact.statement(
      {.place = "section 5.6",
       .quote = "the resonant peaks for the system are expected to increase in frequency "
                "relative to the no-contact response",
       .criterion = "first resonance: the frequency of the largest displacement is above that "
                    "without contact",
       .measured = fmt::format("without contact {} Hz; Fourier:Fourier with 63 functions {} Hz{}",
                               number(without, 5), number(peak(curves.full).frequency, 5), text),
       .verdict = report::plain(rise),
       .because = rise ? "" : "A peak is not above that without contact: " + text,
       .panel = "(a)"});
}

/// The curves of all pairs under one reading, and whether the curves of `names` turn where the exact one
/// does.
struct UnderReading {
  SweepReading reading;
  std::vector<app::Sweep> sweeps;
};

Finding captured(const UnderReading& under, const app::Sweep& exact, const std::vector<std::string>& names,
                 double axis_range) {
  std::vector<Verdict> parts;
  std::string text;
  for (std::size_t i = 0; i < pairs().size(); ++i) {
    if (std::find(names.begin(), names.end(), pairs()[i].name()) == names.end()) continue;
    const double distance = turning_points_distance(under.sweeps[i], exact);
    parts.push_back(std::isfinite(distance) ? report::invisible(distance, axis_range) : Verdict::differs);
    text += (text.empty() ? "" : "; ") + pairs()[i].label + " " + end_text(under.sweeps[i]);
  }
  return {report::together(parts), text};
}

app::Sweep exact_curve(report::Artefact& artefact, const std::string& file) {
  const app::Scene scene = artefact.scene(file, {"analysis.exact=true"});
  return app::exact_sweep(scene, app::make_model(scene));
}

/// How many curves pass the interval with the Nyquist coefficient kept, and dropped.
std::string passing_text(const std::vector<UnderReading>& all) {
  std::size_t passes[2] = {0, 0}, curves[2] = {0, 0};
  for (const auto& [reading, sweeps] : all)
    for (const auto& sweep : sweeps) {
      ++curves[reading.keeps_nyquist ? 0 : 1];
      passes[reading.keeps_nyquist ? 0 : 1] += sweep.converged() ? 1 : 0;
    }
  return fmt::format("With the Nyquist coefficient {} of {} curves pass the interval, without it {} of {}.",
                     passes[0], curves[0], passes[1], curves[1]);
}

/// The curves of all pairs under each reading, the first of which is used by the scene.
std::vector<UnderReading> under_readings(report::Artefact& artefact) {
  std::vector<UnderReading> all;
  for (const SweepReading& reading : sweep_readings(artefact.scene(first_file)))
    all.push_back({reading, swept_under(artefact, first_file, reading)});
  return all;
}

void state_agreement(report::Artefact& artefact, const Curves& curves, const std::vector<UnderReading>& all) {
  double fold = 0.0;
  for (const auto& turn : curves.exact.curve.turning_points) fold = std::max(fold, turn.frequency);
  const double range = std::abs(fold - peak(curves.first.free).frequency);  // what contact moves
  const std::string criterion = fmt::format(
      "with the steps of the scene the curve passes the interval, and its turning points are within {} Hz, {} of what "
      "contact shifts the resonance by, of the folds of the exact curve, {}",
      number(report::visible_share * range), report::percent(report::visible_share),
      turning_points_text(curves.exact));
  std::vector<std::string> six;
  for (const Pair& one : pairs()) six.push_back(one.name());
  double lowest = fold, highest = 0.0;
  for (const auto& sweep : all.front().sweeps) {
    double last = 0.0;
    for (const auto& turn : sweep.curve.turning_points) last = std::max(last, turn.frequency);
    lowest = std::min(lowest, last), highest = std::max(highest, last);
  }
  artefact.note(fmt::format(
      "The length of the steps is this program's choice; the paper gives none. {} A path that ends early has met a "
      "resonance of the Nyquist coefficient, which belongs to an even number of functions and not to the bar. Short "
      "steps follow it, long ones pass it.",
      passing_text(all)));
  const auto state = [&](report::Statement statement, const std::vector<std::string>& names) {
    std::vector<report::Reading> readings;
    for (const auto& under : all) {
      const Finding outcome = captured(under, curves.exact, names, range);
      readings.push_back({under.reading.name(), outcome.verdict, outcome.measured, readings.empty()});
    }
    statement.panel = "(a), (b)";
    statement.because = passing_text(all);
    artefact.statement(concluded(std::move(statement), std::move(readings)));
  };
  state(
      {.place = "section 5.6",
       .quote = "As shown, the stiffening behaviour of the unilateral contact condition is captured by both "
                "trial:weighting function combinations",
       .criterion = "Fourier:Fourier and Haar:Fourier: " + criterion},
      {"fourier_fourier", "haar_fourier"});
  state({.place = "section 5.6",
         .quote = "other combinations showed similar approximations",
         .criterion = "the four other pairs: " + criterion},
        {"bspline_bspline", "daubechies6_daubechies6", "daubechies6_fourier", "haar_bspline"});
  state({.place = "section 6",
         .quote =
             "It is also shown that all the basis combinations considered can be used in an arc-length "
             "continuation framework to capture the nonlinear frequency response of the unilateral contact "
             "problem.",
         .criterion = "all six pairs: " + criterion,
         .claim = "All pairs can be continued by arc length",
         .headline = fmt::format(
             "their curves fold at {} to {} Hz; the resonance without contact is at {} Hz.",
             number(lowest, 6), number(highest, 6), number(peak(curves.first.free).frequency, 5))},
        six);
}

void state_second(report::Artefact& artefact, const Curves& curves) {
  const auto free = peak(curves.second.free);
  const bool touches = free.max_displacement > curves.second.gap;
  const std::string frequency = number(free.frequency, 5) + " Hz";
  const auto first_free = peak(curves.first.free);
  const Verdict verdict =
      report::misprint(report::plain(touches), report::plain(first_free.max_displacement > curves.first.gap));
  artefact.statement(
      {.place = "caption of Fig. 12",
       .quote = "Frequency response function over the second fundamental frequency of the unilateral contact "
                "system",
       .criterion =
           "with the constants of case 2 the tip would pass the gap at the second resonance; if it does not "
           "there, and does at the first, the caption is a misprint",
       .measured = fmt::format("without contact the peak is {} mm at {} and {} mm at {} Hz, the gap {} mm",
                               number(1e3 * free.max_displacement, 4), frequency,
                               number(1e3 * first_free.max_displacement, 4), number(first_free.frequency, 5),
                               number(1e3 * curves.second.gap, 4)),
       .verdict = verdict,
       .because =
           verdict == Verdict::agrees
               ? ""
               : "Section 5.6 says “over the system's fundamental frequency”, and only there is contact.",
       .panel = "(c)"});
  artefact.note(fmt::format(
      "Both resonances are drawn. With case 2's gap the largest displacement at the second one is {} of the gap "
      "(c). In (d) the gap is {} mm, the share {} of the peak without contact that {} mm is of the "
      "displacement without contact in case 2: the peak moves from {} to {} Hz; turning points: {}.",
      report::percent(free.max_displacement / curves.second.gap), number(1e3 * curves.near.gap, 4),
      report::percent(curves.near.gap / free.max_displacement), number(1e3 * curves.first.gap, 4), frequency,
      number(peak(curves.near.sweeps[0]).frequency, 5), turning_points_text(curves.near.sweeps[0])));
}

std::string caption(const Curves& curves) {
  const auto& points = curves.full.curve.points;
  const auto largest = std::max_element(points.begin(), points.end(), [](const auto& a, const auto& b) {
    return a.max_abs_displacement < b.max_abs_displacement;
  });
  const auto count = std::count_if(points.begin(), points.end(), [](const auto& one) {
    return one.max_abs_displacement > (1.0 + 1e-3) * one.max_displacement;
  });
  return fmt::format(
      "Symbols: 64 functions, in (a) every sixth point. Line in (a) and (b): Fourier:Fourier with 63 functions; in (c) and "
      "(d) with 64; dashed where unstable. Drawn is max u. The tip moves further to the other side at {} of {} points: "
      "max |u| is at most {} mm, at {} Hz, max u {} mm.",
      count, points.size(), number(1e3 * largest->max_abs_displacement, 4), number(largest->frequency, 5),
      number(1e3 * peak(curves.full).max_displacement, 4));
}

}  // namespace

void fig12(report::Artefact& artefact) {
  const auto two = pairs_named({"fourier_fourier", "haar_fourier"});
  Curves curves{swept(artefact, first_file, two),
                swept(artefact, second_file, two),
                {},
                swept_with_full_harmonics(artefact, first_file),
                exact_curve(artefact, first_file)};
  // As large a share of the peak without contact as the gap of case 2 is of its displacement without contact.
  auto free = artefact.scene("case2.toml");
  free.contact = {};
  const double alone = app::weighted_residual_response(app::complete_scene(free)).displacement().maxCoeff();
  const double gap = curves.first.gap * peak(curves.second.free).max_displacement / alone;
  curves.near = swept(artefact, second_file, two, {fmt::format("contact.gap={}", gap)});
  artefact.picture(drawn(curves));
  Table table = sweeps_table(curves.first), special = special_points_table();
  const auto all = under_readings(artefact);
  for (std::size_t i = 0; i < pairs().size(); ++i) {
    append_turning_points(special, "first resonance, " + pairs()[i].label, all.front().sweeps[i]);
    const auto same = [&](const Pair& one) { return one.name() == pairs()[i].name(); };
    if (std::none_of(two.begin(), two.end(), same))
      append_sweep(table, pairs()[i], curves.first.functions, all.front().sweeps[i]);
  }
  append_sweep(table, pair("fourier_fourier"), full_functions, curves.full);
  append_special_points(special, "first resonance, 63 functions", curves.full);
  append_special_points(special, "first resonance, exact", curves.exact);
  append_special_points(special, "first resonance", curves.first.sweeps[0]);
  append_special_points(special, "second resonance", curves.second.sweeps[0]);
  append_special_points(special, "second resonance, small gap", curves.near.sweeps[0]);
  artefact.data(table, units, {"first resonance"});
  artefact.more_data(
      "special_points", special,
      "Hz and m; of Fourier:Fourier if no pair is named, and 64 functions if no other number is");
  artefact.more_data("second", sweeps_table(curves.second), units);
  artefact.more_data("second_small_gap", sweeps_table(curves.near), units);
  artefact.more_data("without_contact", app::sweep_table(curves.first.free.curve), units);
  artefact.caption(caption(curves));
  artefact.note(fmt::format(
      "Stability, which the paper does not treat: motions of Fourier:Fourier are unstable in (a) {}; in (c) {}; in "
      "(d) {}. At a period doubling the motion of one period gives way to one of two.",
      unstable_text(curves.first.sweeps[0]), unstable_text(curves.second.sweeps[0]),
      unstable_text(curves.near.sweeps[0])));
  note_nyquist_resonances(artefact, first_file);
  state_stiffening(artefact, curves);
  state_agreement(artefact, curves, all);
  state_second(artefact, curves);
}

}  // namespace wavebalance::jl14
