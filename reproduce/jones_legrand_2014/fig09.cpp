#include "jl14.hpp"
#include "wavebalance/app/analysis/curve_measures.hpp"
#include "wavebalance/app/analysis/measures.hpp"

using namespace wavebalance;

namespace {

double share_in_contact(const Eigen::VectorXd& force) { return (force.array() > 0.0).cast<double>().mean(); }

void claim_duration(report::Artefact& artefact, const Eigen::VectorXd& reference,
                    const jl14::Values& forces) {
  std::vector<double> shares;
  double largest = 0.0;
  for (const auto& force : forces) {
    shares.push_back(share_in_contact(force));
    largest = std::max(largest, std::abs(shares.back() - share_in_contact(reference)));
  }
  artefact.claim(
      {"section 5.3",
       "Notice the time duration of the contact forces coincide with the tip displacement plateaus of Fig. 6",
       "the time in contact differs from that of time stepping by at most 2/64 of the period, one cell at "
       "its "
       "start and one at its end",
       "time stepping " + report::percent(share_in_contact(reference)) + " of the period; " +
           jl14::listed(jl14::pairs(), shares),
       largest <= 2.0 / 64});
}

void claim_ringing(report::Artefact& artefact, const Eigen::VectorXd& reference, const jl14::Values& forces) {
  const auto excess = jl14::measured(forces, reference, &app::excess_variation);
  artefact.claim(
      {"section 5.3", "The effect of Gibbs phenomenon can be seen in the HBM and Galerkin B-spline cases.",
       "the force of both varies more over the period than that of time stepping, by more than 10 %",
       "excess variation " + jl14::listed(jl14::pairs(), excess), excess[0] > 0.1 && excess[1] > 0.1});
}

void claim_accuracy(report::Artefact& artefact, const std::vector<double>& rms,
                    const std::vector<double>& mean) {
  const std::string measured = "relative rms error: " + jl14::listed(jl14::pairs(), rms);
  const std::string quote =
      "Again, the DB6 trial functions appear to most accurately approximate the contact forces compared to "
      "the other cases.";
  const auto claim = [&](const std::string& name, const std::vector<double>& errors) {
    const auto& best = jl14::lowest(errors);
    artefact.claim(
        {"section 5.3", quote, "the lowest " + name + " is that of a pair with DB6 trial functions",
         "lowest: " + best.label + "; " + jl14::listed(jl14::pairs(), errors), best.trial == "daubechies6"});
  };
  claim("relative rms error", rms);
  claim("mean absolute error", mean);
  artefact.claim(
      {"abstract", "and seemingly more accurate contact force prediction",
       "the three Petrov-Galerkin pairs have a lower relative rms error of the force than Fourier:Fourier",
       measured, std::max({rms[3], rms[4], rms[5]}) < rms[0]});
}

/// The force of the Haar pairs with `functions`, and of Fourier:Fourier.
void claim_haar(report::Artefact& artefact, jl14::Case& study, const std::vector<double>& rms) {
  const auto haar = jl14::pairs_named({"haar_fourier", "haar_bspline"});
  const Eigen::VectorXd& reference = study.reference().contact_force;
  jl14::Values exact;
  for (const auto& pair : haar) exact.push_back(study.solve_exactly(pair, 64).samples.contact_force);
  artefact.claim(
      {"section 5.3",
       "The cases where Haar trial functions are used approximate the contact force relatively well.",
       "both Haar pairs have a relative rms error at most twice that of Fourier:Fourier",
       jl14::listed(jl14::pairs_named({"fourier_fourier", "haar_fourier", "haar_bspline"}),
                    {rms[0], rms[3], rms[5]}) +
           "; with exact inner products in place of the 256-point sums: " +
           jl14::listed(haar, jl14::measured(exact, reference, &app::relative_rms_error)),
       std::max(rms[3], rms[5]) < 2.0 * rms[0]});
}

}  // namespace

int main(int argc, char** argv) {
  const auto identity =
      jl14::identity("Fig. 9", "Normalised contact force, case 1", "fig09_contact_force_case1");
  return report::run_artefact(argc, argv, identity, [](report::Artefact& artefact) {
    jl14::Case study(artefact, 1);
    const double amplitude = study.scene().forcing.amplitude;
    const Eigen::VectorXd reference = study.reference().contact_force / amplitude;
    auto forces = jl14::drawn(study.solve_all(jl14::pairs()), &solvers::PeriodSamples::contact_force);
    for (auto& force : forces) force /= amplitude;
    artefact.data(jl14::comparison_table(study.time(), reference, forces),
                  "time in periods, contact forces divided by the amplitude F of the external force",
                  {"64 functions; reference: time stepping"});
    artefact.picture(jl14::pair_figure({"Contact force at 150 Hz, 64 functions",
                                        jl14::axis("Contact force f_c/F (-)", 0.0, 0.7),
                                        -0.5,
                                        1.0,
                                        reference,
                                        forces,
                                        {},
                                        jl14::Zoom{-0.17, 0.17, 0.0, 0.4, {}}}));
    artefact.caption(
        "64 functions at 150 Hz; dashed: time stepping. The force is eq. (5) of the predicted displacement.");
    claim_duration(artefact, reference, forces);
    claim_ringing(artefact, reference, forces);
    const auto rms = jl14::measured(forces, reference, &app::relative_rms_error);
    claim_haar(artefact, study, rms);
    claim_accuracy(artefact, rms, jl14::measured(forces, reference, &app::relative_mean_error));
  });
}
