#include <fmt/format.h>

#include "curve_measures.hpp"
#include "figures.hpp"
#include "jl14.hpp"
#include "wavebalance/app/analysis/measures.hpp"

namespace wavebalance::jl14 {
namespace {

double share_in_contact(const Eigen::VectorXd& force) { return (force.array() > 0.0).cast<double>().mean(); }

void claim_duration(report::Artefact& artefact, const Eigen::VectorXd& reference, const Values& forces) {
  std::vector<double> shares;
  double largest = 0.0;
  for (const auto& force : forces) {
    shares.push_back(share_in_contact(force));
    largest = std::max(largest, std::abs(shares.back() - share_in_contact(reference)));
  }
  artefact.check(
      {"section 5.3",
       "Notice the time duration of the contact forces coincide with the tip displacement plateaus of Fig. 6",
       "the time in contact differs from that of time stepping by at most 2/64 of the period, one cell at "
       "its start and one at its end",
       fmt::format("time stepping {} of the period; {}", report::percent(share_in_contact(reference)),
                   listed(pairs(), shares)),
       largest <= 2.0 / 64});
}

void claim_force_ringing(report::Artefact& artefact, const Eigen::VectorXd& reference, const Values& forces) {
  const auto excess = measured(forces, reference, &excess_variation);
  artefact.check(
      {"section 5.3", "The effect of Gibbs phenomenon can be seen in the HBM and Galerkin B-spline cases.",
       "the force of both varies more over the period than that of time stepping, by more than 10 %",
       "excess variation " + listed(pairs(), excess), excess[0] > 0.1 && excess[1] > 0.1});
}

void claim_accuracy(report::Artefact& artefact, const std::vector<double>& rms,
                    const std::vector<double>& mean) {
  const std::string measured = "relative rms error: " + listed(pairs(), rms);
  const std::string quote =
      "Again, the DB6 trial functions appear to most accurately approximate the contact forces compared to "
      "the other cases.";
  const auto claim = [&](const std::string& name, const std::vector<double>& errors) {
    const auto& best = lowest(errors);
    artefact.check({"section 5.3", quote,
                    "the lowest " + name + " is that of a pair with DB6 trial functions",
                    "lowest: " + best.label + "; " + listed(pairs(), errors), best.trial == "daubechies6"});
  };
  claim("relative rms error", rms);
  claim("mean absolute error", mean);
  artefact.check(
      {"abstract", "and seemingly more accurate contact force prediction",
       "the three Petrov-Galerkin pairs have a lower relative rms error of the force than Fourier:Fourier",
       measured, std::max({rms[3], rms[4], rms[5]}) < rms[0]});
}

/// The force of the Haar pairs with `functions`, and of Fourier:Fourier.
void claim_haar(report::Artefact& artefact, Case& study, const std::vector<double>& rms) {
  const auto haar = pairs_named({"haar_fourier", "haar_bspline"});
  const Eigen::VectorXd& reference = study.reference().force();
  Values exact;
  for (const auto& pair : haar) exact.push_back(study.solve_exactly(pair, 64).force());
  artefact.check(
      {"section 5.3",
       "The cases where Haar trial functions are used approximate the contact force relatively well.",
       "both Haar pairs have a relative rms error at most twice that of Fourier:Fourier",
       listed(pairs_named({"fourier_fourier", "haar_fourier", "haar_bspline"}), {rms[0], rms[3], rms[5]}) +
           "; with exact inner products in place of the 256-point sums: " +
           listed(haar, measured(exact, reference, &app::relative_rms_error)),
       std::max(rms[3], rms[5]) < 2.0 * rms[0]});
}

}  // namespace

void fig09(report::Artefact& artefact) {
  Case study(artefact, 1);
  const double amplitude = study.scene().forcing.amplitude;
  const Eigen::VectorXd reference = study.reference().force() / amplitude;
  auto forces = drawn(study.solve_all(pairs()), &app::Response::force);
  for (auto& force : forces) force /= amplitude;
  artefact.data(comparison_table(study.time(), reference, forces),
                "time in periods, contact forces divided by the amplitude F of the external force",
                {"64 functions; reference: time stepping"});
  artefact.picture(pair_figure({"Contact force at 150 Hz, 64 functions",
                                axis("Contact force f_c/F (-)", 0.0, 0.7),
                                -0.5,
                                1.0,
                                reference,
                                forces,
                                {},
                                Zoom{-0.17, 0.17, 0.0, 0.4, {}}}));
  artefact.caption(
      "64 functions at 150 Hz; dashed: time stepping. The force is eq. (5) of the predicted displacement.");
  claim_duration(artefact, reference, forces);
  claim_force_ringing(artefact, reference, forces);
  const auto rms = measured(forces, reference, &app::relative_rms_error);
  claim_haar(artefact, study, rms);
  claim_accuracy(artefact, rms, measured(forces, reference, &relative_mean_error));
}

}  // namespace wavebalance::jl14
