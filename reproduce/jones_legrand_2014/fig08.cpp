#include "jl14.hpp"
#include "wavebalance/app/analysis/curve_measures.hpp"
#include "wavebalance/app/analysis/measures.hpp"

using namespace wavebalance;

namespace {

void claim_jump(report::Artefact& artefact, const Eigen::VectorXd& reference) {
  const int steps = static_cast<int>(reference.size()) / 64;
  const double jump = app::largest_change(reference, steps) / reference.cwiseAbs().maxCoeff();
  artefact.claim({"section 5.2", "there is a sharp jump in velocity due to the contact condition",
                  "within 1/64 of the period the velocity of time stepping changes by more than a quarter of "
                  "its maximum",
                  "it changes by " + report::percent(jump) + " of its maximum", jump > 0.25});
}

void claim_ringing(report::Artefact& artefact, const Eigen::VectorXd& reference, const jl14::Values& v) {
  const auto excess = jl14::measured({v[0], v[1]}, reference, &app::excess_variation);
  const std::string found =
      "excess variation " + jl14::listed(jl14::pairs_named({"fourier_fourier", "bspline_bspline"}), excess);
  artefact.claim({"section 5.2",
                  "As expected, this results in ringing due to Gibbs phenomenon when the Fourier trial "
                  "functions are used.",
                  "the velocity of Fourier:Fourier varies more over the period than that of time stepping, "
                  "by more than 10 %",
                  found, excess[0] > 0.1});
  artefact.claim(
      {"section 5.2", "Interestingly, the ringing is more pronounced in the Galerkin B-spline case.",
       "the excess variation is higher than that of Fourier:Fourier", found, excess[1] > excess[0]});
}

void claim_daubechies(report::Artefact& artefact, const Eigen::VectorXd& reference, const jl14::Values& v) {
  const std::string quote =
      "The DB6 trial functions appear to do the best job of approximating the tip response.";
  const auto claim = [&](const std::string& name, const std::vector<double>& errors) {
    const auto& best = jl14::lowest(errors);
    artefact.claim(
        {"section 5.2", quote, "of the six pairs one with DB6 trial functions has the lowest " + name,
         "lowest: " + best.label + "; " + jl14::listed(jl14::pairs(), errors), best.trial == "daubechies6"});
  };
  claim("relative rms error of the velocity", jl14::measured(v, reference, &app::relative_rms_error));
  claim("mean absolute error of the velocity", jl14::measured(v, reference, &app::relative_mean_error));
}

void claim_haar(report::Artefact& artefact, jl14::Case& study, const jl14::Values& v) {
  const auto haar = jl14::pairs_named({"haar_fourier", "haar_bspline"});
  const Eigen::VectorXd& reference = study.reference().velocity;
  jl14::Values exact;
  for (const auto& pair : haar) exact.push_back(study.solve_exactly(pair, 64).samples.velocity);
  const auto errors = jl14::measured({v[3], v[5]}, reference, &app::relative_rms_error);
  artefact.claim({"section 5.2",
                  "For cases involving Haar trial functions the velocity function envelope is reasonably "
                  "approximated by "
                  "the delta function representation discussed above.",
                  "relative rms error below 20 % for both Haar pairs",
                  jl14::listed(haar, errors) +
                      "; with exact inner products in place of the 256-point sums: " +
                      jl14::listed(haar, jl14::measured(exact, reference, &app::relative_rms_error)),
                  errors[0] < 0.2 && errors[1] < 0.2});
}

}  // namespace

int main(int argc, char** argv) {
  const auto identity = jl14::identity("Fig. 8", "Tip velocity, case 1", "fig08_tip_velocity_case1");
  return report::run_artefact(argc, argv, identity, [](report::Artefact& artefact) {
    jl14::Case study(artefact, 1);
    const Eigen::VectorXd& reference = study.reference().velocity;
    const auto responses = study.solve_all(jl14::pairs());
    const auto v = jl14::drawn(responses, &solvers::PeriodSamples::velocity);
    artefact.data(jl14::comparison_table(study.time(), reference, v), "time in periods, velocities in m/s",
                  {"64 functions; reference: time stepping"});
    artefact.picture(jl14::pair_figure({"Tip velocity at 150 Hz, 64 functions",
                                        jl14::axis("Velocity (m/s)", -2.0, 2.0),
                                        -0.5,
                                        1.0,
                                        reference,
                                        v,
                                        {},
                                        jl14::Zoom{-0.17, 0.17, -1.6, 1.6, {}}}));
    artefact.caption(
        "64 functions at 150 Hz; dashed: time stepping. Haar trial functions: the jump between neighbouring "
        "cells divided by the cell width, placed at the cell edge.");
    claim_jump(artefact, reference);
    claim_ringing(artefact, reference, v);
    claim_daubechies(artefact, reference, v);
    claim_haar(artefact, study, v);
  });
}
