#include <fmt/format.h>

#include "curve_measures.hpp"
#include "figures.hpp"
#include "jl14.hpp"
#include "motion.hpp"
#include "wavebalance/app/analysis/measures.hpp"

namespace wavebalance::jl14 {
namespace {

Eigen::VectorXd on_plateau(const Case& study, const Eigen::VectorXd& values, bool inside = true) {
  const Eigen::VectorXd force = shifted_by_half_a_period(study.reference().force());
  return select(shifted_by_half_a_period(values), (force.array() > 0.0) == inside);
}

void claim_hbm(report::Artefact& artefact, const Case& study, const app::Response& hbm) {
  const auto& reference = study.reference();
  const Eigen::VectorXd difference = on_plateau(study, hbm.displacement() - reference.displacement());
  const int changes = sign_changes(difference);
  const double swing =
      (difference.maxCoeff() - difference.minCoeff()) / (reference.displacement().maxCoeff() - study.gap());
  artefact.check({"section 5.1",
                  "close examination of the contact plateau for the 150 Hz case shows oscillations due to "
                  "Gibbs phenomenon",
                  "on the plateau the difference from time stepping changes sign four times or more",
                  fmt::format("{} changes of sign, swing {} of the largest penetration", changes,
                              report::percent(swing)),
                  changes >= 4});
  const int steps = reference.contacts.points() / 128;
  const double kink = largest_change(hbm.velocity(), steps) / largest_change(reference.velocity(), steps);
  artefact.check(
      {"section 5.1", "and rounding off of the sharp gradient changes",
       "the largest change of velocity within 1/128 of the period is smaller than in time stepping",
       report::percent(kink) + " of that of time stepping", kink < 1.0});
}

/// Share of the plateau on which a response is within 2 % of the gap of time stepping.
double share_on_plateau(const Case& study, const Eigen::VectorXd& displacement) {
  const Eigen::ArrayXd distance =
      on_plateau(study, displacement - study.reference().displacement()).cwiseAbs();
  return (distance < 0.02 * study.gap()).cast<double>().mean();
}

void claim_haar(report::Artefact& artefact, Case& study, const Eigen::VectorXd& haar,
                const Eigen::VectorXd& hbm) {
  const auto outside = [&](const Eigen::VectorXd& u) {
    return millimetres * app::rms(on_plateau(study, u - study.reference().displacement(), false));
  };
  artefact.check(
      {"section 5.1",
       "the Haar:Fourier combination appears to approximate the tip displacement outside the contact zone "
       "less well due to the blocky nature of the Haar scaling functions",
       "outside the contact the rms error is above that of Fourier:Fourier",
       report::number(outside(haar)) + " mm against " + report::number(outside(hbm)) + " mm",
       outside(haar) > outside(hbm)});
  const double share = share_on_plateau(study, haar);
  const double exact = share_on_plateau(study, study.solve_exactly(pair("haar_fourier"), 64).displacement());
  artefact.check({"section 5.1",
                  "However, the contact plateau is well represented by the constant Haar scaling functions.",
                  "Haar:Fourier is within 2 % of the gap of time stepping on at least 90 % of the plateau",
                  fmt::format("on {} of it (with exact inner products in place of the 256-point sums on {})",
                              report::percent(share), report::percent(exact)),
                  share >= 0.9});
}

void claim_bspline(report::Artefact& artefact, const Case& study, const Eigen::VectorXd& spline) {
  const Eigen::VectorXd difference = on_plateau(study, spline - study.reference().displacement()).cwiseAbs();
  const Eigen::Index cells = difference.size() / 4;
  const double start = millimetres * difference.head(cells).maxCoeff(),
               end = millimetres * difference.tail(cells).maxCoeff();
  artefact.check(
      {"section 5.5",
       "a localized error which was found to develop at the end of the contact plateau (see Fig. 6(d))",
       "B-spline:B-spline: the error is larger in the last quarter of the plateau than in its middle half",
       fmt::format("{} mm in the last quarter, {} mm in the middle half (and {} mm in the first quarter)",
                   report::number(end),
                   report::number(millimetres * difference.segment(cells, 2 * cells).maxCoeff()),
                   report::number(start)),
       end > millimetres * difference.segment(cells, 2 * cells).maxCoeff()});
}

}  // namespace

void fig06(report::Artefact& artefact) {
  Case study(artefact, 1);
  const auto responses = study.solve_all(pairs(), true);
  const auto u = drawn(responses, &app::Response::displacement);
  artefact.attach("motion_case1.json",
                  motion_json(study, responses, artefact.result("reference_case1_nodes.csv")), false);
  const Eigen::VectorXd& reference = study.reference().displacement();
  artefact.data(comparison_table(study.time(), reference, u), "time in periods, displacements in m",
                {"64 functions; reference: time stepping"});
  artefact.picture(
      pair_figure({"Tip displacement at 150 Hz, 64 functions", axis("Displacement (mm)", -1.6, 1.2), -0.5,
                   millimetres, reference, u, study.gap(), Zoom{-0.17, 0.17, 0.97, 1.03, {}}}));
  artefact.caption(
      "64 functions at 150 Hz; dashed: time stepping; dotted: the gap. The force F cos 2πft puts the contact "
      "about t = 0, which stands in the middle. The panels follow the letters that the text gives.");
  const double error = app::relative_rms_error(u[0], reference);
  artefact.check(
      {"section 5.1",
       "For this number of basis functions HBM (Fourier:Fourier) approximates the tip displacements well at "
       "both 150 Hz and 1275 Hz compared to the time-stepping solution.",
       "at 150 Hz: relative rms error below 1 %", report::percent(error), error < 0.01});
  claim_hbm(artefact, study, responses[0]);
  claim_haar(artefact, study, u[3], u[0]);
  claim_bspline(artefact, study, u[1]);
}

}  // namespace wavebalance::jl14
