#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "curve_measures.hpp"
#include "figures.hpp"
#include "jl14.hpp"
#include "motion.hpp"
#include "readings.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/report/rule.hpp"

namespace wavebalance::jl14 {
using report::lower;
using report::percent;

namespace {

constexpr int compared_cells = 64;

/// rms and mean of an error in contact, over the rms of the whole motion.
struct PlateauError {
  double rms = 0.0, mean = 0.0;
};

PlateauError plateau_error(const Case& study, const Eigen::VectorXd& u) {
  const Eigen::VectorXd& reference = study.reference().displacement();
  const Eigen::VectorXd error = select(u - reference, study.reference().force().array() > 0.0);
  const double size = app::rms(reference);
  return {app::rms(error) / size, error.cwiseAbs().mean() / size};
}

/// How far the tip goes beyond the gap, over the gap.
double penetration(const Eigen::VectorXd& u, double gap) { return u.maxCoeff() / gap - 1.0; }

/// Variation of the plateau over the range of the motion: zero where it is flat.
double unevenness(const Case& study) {
  const Eigen::VectorXd& u = study.reference().displacement();
  const Eigen::VectorXd plateau = select(u, study.reference().force().array() > 0.0);
  return (plateau.maxCoeff() - plateau.minCoeff()) / (u.maxCoeff() - u.minCoeff());
}

void state_suited(report::Artefact& artefact, const Case& here, const Readings& readings) {
  const std::vector<std::string> haar{"haar_fourier", "haar_bspline"};
  const Case there(artefact, 1);
  const Readings others(artefact, there, readings.chosen());
  const auto best = [](const Case& study) {
    return plateau_error(study, best_constants(study.reference().displacement(), compared_cells));
  };
  const auto less = [](const PlateauError& low, const PlateauError& high) {
    return report::together({lower({low.rms}, {high.rms}), lower({low.mean}, {high.mean})});
  };
  const double share = app::contact_fraction(here.reference().contacts),
               other_share = app::contact_fraction(there.reference().contacts);
  const auto plateau =
      report::together({report::plain(share < other_share), lower({unevenness(there)}, {unevenness(here)})});
  const auto basis = less(best(there), best(here));
  const auto found = judged(
      [&](std::size_t i) {
        std::vector<report::Verdict> parts{plateau, basis};
        std::string text;
        for (const Pair& pair : readings.chosen()) {
          const auto low = plateau_error(there, others.at(i, pair.name()).displacement()),
                     high = plateau_error(here, readings.at(i, pair.name()).displacement());
          parts.push_back(less(low, high));
          text += fmt::format("{}{} {} at 1275 Hz, {} at 150 Hz", text.empty() ? "" : "; ", pair.label,
                              percent(high.rms), percent(low.rms));
        }
        return Finding{report::together(parts), text};
      },
      [&](std::size_t i) { return readings.missing(i, haar) + others.missing(i, haar); });
  report::Statement statement{
      "section 5.1",
      "The Haar basis appears to be less suited for the response at 1275 Hz as the contact plateau is smaller and "
      "not as flat",
      "the contact takes less of the period than at 150 Hz and varies more over the range of the motion; and in "
      "contact the best constants on 64 cells and both Haar pairs have a higher error, rms and mean over the "
      "rms of the motion"};
  statement.because = fmt::format(
      "The plateau takes {} of the period against {} and varies by {} of the range against {}, and the best "
      "constants have an rms error of {} there against {}. So much depends on no reading. The solutions at 150 Hz "
      "have a saw tooth besides, which depends on the sums.",
      percent(share), percent(other_share), percent(unevenness(here)), percent(unevenness(there)),
      percent(best(here).rms), percent(best(there).rms));
  statement.panel = "(c), (e)";
  artefact.statement(concluded(statement, found));
}

void state_penetration(report::Artefact& artefact) {
  std::vector<double> found;
  std::string text;
  const double paper = artefact.scene("reference_case2.toml").contact.number("constant");
  for (const int power : {0, 1, 2}) {
    const double constant = paper * std::pow(report::parameter_factor, power);
    const auto scene =
        artefact.scene("reference_case2.toml", {fmt::format("contact.constant={:.1f}", constant)});
    found.push_back(penetration(exact_solution(scene).displacement(), scene.contact.gap));
    text += fmt::format("{}{} of the gap with $a_c$ = {:g} N", text.empty() ? "" : ", ",
                        percent(found.back()), constant);
  }
  report::Statement statement{
      "section 5.1",
      "the tip penetration through the contact boundary is a result of the inexact modeling of hard contact using "
      "the exponential spring penalty function",
      fmt::format(
          "with a spring {0:g} and {1:g} times as stiff the tip penetrates less, each time by more than {2}",
          report::parameter_factor, report::parameter_factor * report::parameter_factor,
          percent(report::tie_share)),
      text, lower({found[1], found[2]}, {found[0], found[1]})};
  statement.because = "The penetration does not fall with a stiffer spring: " + text + ".";
  artefact.statement(statement);
}

/// Section 5.4 states it for Fig. 7 (c).
void state_no_plateau(report::Artefact& artefact, const Case& here) {
  const double varies = unevenness(here);
  report::Statement statement{
      "section 5.4",
      "This is attributed to the displacement response at this frequency (see Fig. 7(c)); there is no distinct contact "
      "plateau",
      fmt::format("in contact the displacement of the exact motion varies by more than {} of its range",
                  percent(report::visible_share)),
      fmt::format("it varies by {} at 1275 Hz, and by {} at 150 Hz", percent(varies),
                  percent(unevenness(Case(artefact, 1)))),
      report::plain(varies > report::visible_share)};
  statement.because = "It varies by less: the plateau is flat to " + percent(varies) + " of the range.";
  artefact.statement(statement);
}

app::Figure case2_figure(const Case& study, const Values& u) {
  PairView view;
  for (const auto& one : u) view.values.push_back(millimetres * one);
  view.reference = millimetres * study.reference().displacement();
  view.level = millimetres * study.gap();
  view.label = "Displacement (mm)";
  auto whole = pair_view(view, false);
  std::tie(view.from, view.to) = contact_interval(study, 0.0);
  return pair_rows("Tip displacement at 1275 Hz, 64 functions", {0.62, 8.0, {}}, std::move(whole),
                   pair_view(view, true), "in contact");
}

}  // namespace

void fig07(report::Artefact& artefact) {
  Case study(artefact, 2);
  const auto responses = study.solve_all(true);
  const auto u = drawn(responses, &app::Response::displacement);
  attach_motion(artefact, study, responses);
  artefact.data(comparison_table(study.time(), study.reference().displacement(), u),
                "time in periods, displacements in m",
                {fmt::format("64 functions; reference: {}", reference_label)});
  artefact.picture(case2_figure(study, u));
  artefact.caption(
      "64 functions at 1275 Hz; the grey line is the gap. Right: the time in which the reference is in contact, on one "
      "scale for (c) and (e), whose cells jump, and on another for the other four.");
  state_suited(artefact, study, Readings(artefact, study, pairs_named({"haar_fourier", "haar_bspline"})));
  state_penetration(artefact);
  state_no_plateau(artefact, study);
  refer_to_readings(artefact);
}

}  // namespace wavebalance::jl14
