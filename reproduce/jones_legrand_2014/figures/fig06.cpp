#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "curve_measures.hpp"
#include "figures.hpp"
#include "jl14.hpp"
#include "motion.hpp"
#include "readings.hpp"
#include "sums_choices.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/report/rule.hpp"

namespace wavebalance::jl14 {
using report::lower;
using report::number;
using report::percent;

namespace {

constexpr int plateau_cells = 64;

Mask in_contact(const Case& study) { return study.reference().force().array() > 0.0; }

/// From t/T = -1/2 on, so that the contact about t = 0 is in one piece: the entries in contact.
Eigen::VectorXd on_plateau(const Case& study, const Eigen::VectorXd& values) {
  return select(shifted_by_half_a_period(values),
                shifted_by_half_a_period(study.reference().force()).array() > 0.0);
}

double range(const Eigen::VectorXd& values) { return values.maxCoeff() - values.minCoeff(); }

/// The largest difference of a pair from the reference over the range of the reference.
double largest_difference(const Case& study, const Readings& readings, std::size_t i) {
  const Eigen::VectorXd& reference = study.reference().displacement();
  return (readings.at(i, "fourier_fourier").displacement() - reference).cwiseAbs().maxCoeff() /
         range(reference);
}

void state_hbm(report::Artefact& artefact, const Case& study, const Readings& readings) {
  const Case other(artefact, 2);
  const Readings there(artefact, other, pairs_named({"fourier_fourier"}));
  const auto found = judged(there, {"fourier_fourier"}, [&](std::size_t i) {
    const double one = largest_difference(study, readings, i), two = largest_difference(other, there, i);
    return Finding{report::together({report::invisible(one, 1.0), report::invisible(two, 1.0)}),
                   fmt::format("{} of the range at 150 Hz, {} at 1275 Hz", percent(one), percent(two))};
  });
  report::Statement statement{
      "section 5.1",
      "For this number of basis functions HBM (Fourier:Fourier) approximates the tip displacements well at "
      "both 150 Hz and 1275 Hz compared to the time-stepping solution.",
      fmt::format("the largest difference from the reference is at most {} of the range of the motion, at "
                  "both frequencies",
                  percent(report::visible_share))};
  statement.because = spread(found) + ".";
  statement.panel = "(a)";
  statement.claim = "Harmonic balance approximates the tip well";
  statement.headline = fmt::format("within {} of its range at 150 Hz and {} at 1275 Hz.",
                                   percent(largest_difference(study, readings, 0), 2),
                                   percent(largest_difference(other, there, 0), 2));
  artefact.statement(concluded(statement, found));
}

/// Measures of the plateau of Fourier:Fourier under one reading.
Finding gibbs(const Case& study, const Readings& readings, std::size_t i) {
  const auto& hbm = readings.at(i, "fourier_fourier");
  const auto& reference = study.reference();
  const Eigen::VectorXd difference = on_plateau(study, hbm.displacement() - reference.displacement());
  const double height = reference.displacement().maxCoeff() - study.gap();
  const int steps = reference.contacts.points() / report::parts_of_period;
  const double kink = largest_change(hbm.velocity(), steps),
               sharp = largest_change(reference.velocity(), steps);
  const bool visible = report::invisible(range(difference), height) == report::Verdict::differs &&
                       sign_changes(difference) > 1;
  return {
      report::together({report::plain(visible), lower({kink}, {sharp})}),
      fmt::format("the difference swings over {} of the height of the plateau with {} changes of sign; the "
                  "velocity changes by {} of what it does in the reference",
                  percent(range(difference) / height), sign_changes(difference), percent(kink / sharp))};
}

void state_gibbs(report::Artefact& artefact, const Case& study, const Readings& readings) {
  const auto found =
      judged(readings, {"fourier_fourier"}, [&](std::size_t i) { return gibbs(study, readings, i); });
  report::Statement statement{
      "section 5.1",
      "However, close examination of the contact plateau for the 150 Hz case shows oscillations due to Gibbs "
      "phenomenon and rounding off of the sharp gradient changes.",
      fmt::format(
          "the difference from the reference changes sign on the plateau more than once and takes more than {} "
          "of the plateau's own height; the largest change of velocity within 1/{} of the period is lower than in "
          "the reference",
          percent(report::visible_share), report::parts_of_period)};
  statement.because = spread(found) + ".";
  statement.panel = "(a)";
  artefact.statement(concluded(statement, found));
}

/// Constants on 64 cells cannot do better, so that only a fault of the code could make it fail.
void check_outside(report::Artefact& artefact, const Case& study, const Readings& readings) {
  const Mask outside = !in_contact(study);
  const Eigen::VectorXd& reference = study.reference().displacement();
  const auto error = [&](const Eigen::VectorXd& u) { return select(u - reference, outside); };
  const auto mean = [](const Eigen::VectorXd& values) { return values.cwiseAbs().mean(); };
  const auto haar = error(readings.at(0, "haar_fourier").displacement()),
             hbm = error(readings.at(0, "fourier_fourier").displacement());
  const double best = app::rms(error(best_constants(reference, plateau_cells)));
  artefact.check(
      {"section 5.1",
       "The Haar:Fourier combination appears to approximate the tip displacement outside the contact zone less well "
       "due to the blocky nature of the Haar scaling functions.",
       fmt::format(
           "outside the contact rms and mean of the error are higher than with Fourier:Fourier, as the best "
           "constants on {} cells have an rms error of {} mm there",
           plateau_cells, number(millimetres * best)),
       fmt::format("rms error {} mm against {} mm", number(millimetres * app::rms(haar)),
                   number(millimetres * app::rms(hbm))),
       report::together({lower({app::rms(hbm)}, {app::rms(haar)}), lower({mean(hbm)}, {mean(haar)})}) ==
           report::Verdict::agrees});
}

/// The largest difference on the cells that lie wholly on the plateau, over the range of the motion.
double plateau_difference(const Case& study, const Eigen::VectorXd& u) {
  const Eigen::VectorXd& reference = study.reference().displacement();
  return select(u - reference, whole_cells(in_contact(study), plateau_cells)).cwiseAbs().maxCoeff() /
         range(reference);
}

void state_haar_plateau(report::Artefact& artefact, const Case& study, const Readings& readings) {
  double lowest_share = 1.0, highest = 0.0;
  const auto found = judged(readings, {"haar_fourier"}, [&](std::size_t i) {
    const double share = plateau_difference(study, readings.at(i, "haar_fourier").displacement());
    if (all_sums()[i].of_text()) {
      lowest_share = std::min(lowest_share, share);
      highest = std::max(highest, share);
    }
    return Finding{report::invisible(share, 1.0), percent(share) + " of the range"};
  });
  report::Statement statement{
      "section 5.1",
      "However, the contact plateau is well represented by the constant Haar scaling functions.",
      fmt::format("on the cells that lie wholly in contact the largest difference of Haar:Fourier from the "
                  "reference is at most {} of the range of the motion",
                  percent(report::visible_share))};
  statement.because = fmt::format(
      "Piecewise constants can follow the plateau to {} of the motion's range. The computed ones have a saw tooth "
      "from cell to cell and miss it by {} to {}, with points at left ends and at mid-points, which the text allows.",
      percent(plateau_difference(study, best_constants(study.reference().displacement(), plateau_cells))),
      percent(lowest_share), percent(highest));
  statement.panel = "(c)";
  artefact.statement(concluded(statement, found));
}

void state_localized_error(report::Artefact& artefact, const Case& study, const Readings& readings) {
  const auto parts = [&](std::size_t i, const std::string& pair) {
    const Eigen::VectorXd error =
        on_plateau(study, readings.at(i, pair).displacement() - study.reference().displacement()).cwiseAbs();
    const Eigen::Index part = error.size() / report::parts_of_interval;
    return std::array{error.head(part).maxCoeff(), error.segment(part, error.size() - 2 * part).maxCoeff(),
                      error.tail(part).maxCoeff()};
  };
  const auto found = judged(readings, {"bspline_bspline"}, [&](std::size_t i) {
    const auto [start, middle, end] = parts(i, "bspline_bspline");
    const double hbm = parts(i, "fourier_fourier")[2];
    return Finding{
        report::together({lower({middle}, {end}), lower({start}, {end}), lower({hbm}, {end})}),
        fmt::format("{} mm in the last quarter, {} mm in the middle half, {} mm in the first quarter; "
                    "Fourier:Fourier {} mm in the last",
                    number(millimetres * end), number(millimetres * middle), number(millimetres * start),
                    number(millimetres * hbm))};
  });
  const auto [start, middle, end] = parts(0, "bspline_bspline");
  const double hbm = parts(0, "fourier_fourier")[2];
  report::Statement statement{
      "section 5.5",
      "This is attributed to a localized error which was found to develop at the end of the contact plateau "
      "(see Fig. 6(d)).",
      "the largest error of B-spline:B-spline in the last quarter of the plateau is higher than in the middle "
      "half, than in the first quarter, and than that of Fourier:Fourier there"};
  statement.because = fmt::format(
      "With points at left ends the error at the end of the plateau is {} times that in the middle, {} times that at "
      "the beginning, and {} times that of Fourier:Fourier at the end.",
      number(end / middle, 2), number(end / start, 2), number(end / hbm, 2));
  statement.panel = "(d)";
  artefact.statement(concluded(statement, found));
}

app::Figure case1_figure(const Case& study, const Values& u) {
  PairView view;
  for (const auto& one : u) view.values.push_back(millimetres * one);
  view.reference = millimetres * study.reference().displacement();
  view.level = millimetres * study.gap();
  view.label = "Displacement (mm)";
  view.from = -0.5, view.to = 0.5;
  const auto whole = pair_view(view, false);
  std::tie(view.from, view.to) = contact_interval(study, -0.5);
  auto contact = pair_view(view, true);
  const double near = report::visible_share * range(view.reference);
  for (std::size_t i = 0; i < contact.size(); ++i) {
    if (!has_haar_trial(panel_pairs()[i])) continue;  // the others do not come near the bounds
    contact[i].title = "in contact; dotted: ± " + percent(report::visible_share) + " of the range";
    for (const double shift : {-near, near}) {
      auto bound = reference_series(view.reference.array() + shift, -0.5);
      bound.colour = app::Colour::grey;
      bound.dash = app::Dash::dotted;
      contact[i].add(std::move(bound));
    }
    constexpr double beyond = 1.2;  // so that both bounds are on the axis
    auto& y = contact[i].y;
    y.lower = std::min(*y.lower, view.reference.maxCoeff() - beyond * near);
    y.upper = std::max(*y.upper, view.reference.maxCoeff() + beyond * near);
  }
  return pair_rows("Tip displacement at 150 Hz, 64 functions", {0.0, -1.2, {}}, whole, std::move(contact),
                   "in contact");
}

}  // namespace

void fig06(report::Artefact& artefact) {
  Case study(artefact, 1);
  const auto responses = study.solve_all(true);
  const auto u = drawn(responses, &app::Response::displacement);
  attach_motion(artefact, study, responses);
  artefact.data(comparison_table(study.time(), study.reference().displacement(), u),
                "time in periods, displacements in m",
                {fmt::format("64 functions; reference: {}", reference_label)});
  artefact.picture(case1_figure(study, u));
  artefact.caption(
      "64 functions at 150 Hz. Right: the contact, on one scale for (c) and (e), whose cells jump, and on another for the "
      "other four; the grey line is the gap.");
  const Readings readings(artefact, study);
  state_hbm(artefact, study, readings);
  state_gibbs(artefact, study, readings);
  check_outside(artefact, study, readings);
  state_haar_plateau(artefact, study, readings);
  state_localized_error(artefact, study, readings);
  const auto [from, to] = contact_interval(study, -0.5);
  attach_sums(artefact, study, readings,
              {.label = "Displacement (mm)",
               .history = &app::Response::displacement,
               .scale = millimetres,
               .from = from,
               .to = to,
               .level = millimetres * study.gap()});
  note_readings(artefact);
}

}  // namespace wavebalance::jl14
