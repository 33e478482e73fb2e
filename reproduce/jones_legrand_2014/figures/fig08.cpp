#include "curve_measures.hpp"
#include "figures.hpp"
#include "jl14.hpp"
#include "wavebalance/app/analysis/measures.hpp"

namespace wavebalance::jl14 {
namespace {

void claim_jump(report::Artefact& artefact, const Eigen::VectorXd& reference) {
  const int steps = static_cast<int>(reference.size()) / 64;
  const double jump = largest_change(reference, steps) / reference.cwiseAbs().maxCoeff();
  artefact.check({"section 5.2", "there is a sharp jump in velocity due to the contact condition",
                  "within 1/64 of the period the velocity of time stepping changes by more than a quarter of "
                  "its maximum",
                  "it changes by " + report::percent(jump) + " of its maximum", jump > 0.25});
}

void claim_ringing(report::Artefact& artefact, const Eigen::VectorXd& reference, const Values& v) {
  const auto excess = measured({v[0], v[1]}, reference, &excess_variation);
  const std::string found =
      "excess variation " + listed(pairs_named({"fourier_fourier", "bspline_bspline"}), excess);
  artefact.check({"section 5.2",
                  "As expected, this results in ringing due to Gibbs phenomenon when the Fourier trial "
                  "functions are used.",
                  "the velocity of Fourier:Fourier varies more over the period than that of time stepping, "
                  "by more than 10 %",
                  found, excess[0] > 0.1});
  artefact.check(
      {"section 5.2", "Interestingly, the ringing is more pronounced in the Galerkin B-spline case.",
       "the excess variation is higher than that of Fourier:Fourier", found, excess[1] > excess[0]});
}

void claim_daubechies(report::Artefact& artefact, const Eigen::VectorXd& reference, const Values& v) {
  const std::string quote =
      "The DB6 trial functions appear to do the best job of approximating the tip response.";
  const auto claim = [&](const std::string& name, const std::vector<double>& errors) {
    const auto& best = lowest(errors);
    artefact.check({"section 5.2", quote,
                    "of the six pairs one with DB6 trial functions has the lowest " + name,
                    "lowest: " + best.label + "; " + listed(pairs(), errors), best.trial == "daubechies6"});
  };
  claim("relative rms error of the velocity", measured(v, reference, &app::relative_rms_error));
  claim("mean absolute error of the velocity", measured(v, reference, &relative_mean_error));
}

void claim_haar(report::Artefact& artefact, Case& study, const Values& v) {
  const auto haar = pairs_named({"haar_fourier", "haar_bspline"});
  const Eigen::VectorXd& reference = study.reference().velocity();
  Values exact;
  for (const auto& pair : haar) exact.push_back(study.solve_exactly(pair, 64).velocity());
  const auto errors = measured({v[3], v[5]}, reference, &app::relative_rms_error);
  artefact.check({"section 5.2",
                  "For cases involving Haar trial functions the velocity function envelope is reasonably "
                  "approximated by the delta function representation discussed above.",
                  "relative rms error below 20 % for both Haar pairs",
                  listed(haar, errors) + "; with exact inner products in place of the 256-point sums: " +
                      listed(haar, measured(exact, reference, &app::relative_rms_error)),
                  errors[0] < 0.2 && errors[1] < 0.2});
}

}  // namespace

void fig08(report::Artefact& artefact) {
  Case study(artefact, 1);
  const Eigen::VectorXd& reference = study.reference().velocity();
  const auto responses = study.solve_all(pairs());
  const auto v = drawn(responses, &app::Response::velocity);
  artefact.data(comparison_table(study.time(), reference, v), "time in periods, velocities in m/s",
                {"64 functions; reference: time stepping"});
  artefact.picture(pair_figure({"Tip velocity at 150 Hz, 64 functions",
                                axis("Velocity (m/s)", -2.0, 2.0),
                                -0.5,
                                1.0,
                                reference,
                                v,
                                {},
                                Zoom{-0.17, 0.17, -1.6, 1.6, {}}}));
  artefact.caption(
      "64 functions at 150 Hz; dashed: time stepping. Haar trial functions: the jump between neighbouring "
      "cells divided by the cell width, placed at the cell edge.");
  claim_jump(artefact, reference);
  claim_ringing(artefact, reference, v);
  claim_daubechies(artefact, reference, v);
  claim_haar(artefact, study, v);
}

}  // namespace wavebalance::jl14
