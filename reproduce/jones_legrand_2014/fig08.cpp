#include "jl14.hpp"
#include "wavebalance/reproduce/curve_measures.hpp"
#include "wavebalance/reproduce/measures.hpp"

using namespace wavebalance;

namespace {

using Values = std::vector<Eigen::VectorXd>;

void claim_jump(report::Artefact& artefact, const Eigen::VectorXd& reference) {
  const int steps = static_cast<int>(reference.size()) / 64;
  const double jump = reproduce::largest_change(reference, steps) / reference.cwiseAbs().maxCoeff();
  artefact.claim({"section 5.2", "there is a sharp jump in velocity due to the contact condition",
                  "within 1/64 of the period the velocity of time stepping changes by more than a quarter of its maximum",
                  "it changes by " + report::percent(jump) + " of its maximum", jump > 0.25});
}

void claim_ringing(report::Artefact& artefact, const Eigen::VectorXd& reference, const Values& v) {
  const double hbm = reproduce::excess_variation(v[0], reference);
  const double bspline = reproduce::excess_variation(v[1], reference);
  const std::string measured = "excess variation " + report::percent(hbm) + " (Fourier:Fourier), " +
                               report::percent(bspline) + " (B-spline:B-spline)";
  artefact.claim({"section 5.2",
                  "As expected, this results in ringing due to Gibbs phenomenon when the Fourier trial functions are used.",
                  "the velocity varies more over the period than in time stepping, by more than 10 %", measured,
                  hbm > 0.1});
  artefact.claim({"section 5.2", "Interestingly, the ringing is more pronounced in the Galerkin B-spline case.",
                  "the excess variation is higher than that of Fourier:Fourier", measured, bspline > hbm});
}

void claim_accuracy(report::Artefact& artefact, const Eigen::VectorXd& reference, const Values& v) {
  const auto& all = jl14::pairs();
  std::vector<double> errors;
  std::size_t best = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    errors.push_back(reproduce::relative_rms_error(v[i], reference));
    if (errors[i] < errors[best]) best = i;
  }
  artefact.claim({"section 5.2", "The DB6 trial functions appear to do the best job of approximating the tip response.",
                  "of the six pairs one with DB6 trial functions has the lowest relative rms error of the velocity",
                  jl14::listed(all, errors), all[best].trial == "daubechies6"});
  artefact.claim({"section 5.2",
                  "For cases involving Haar trial functions the velocity function envelope is reasonably approximated by "
                  "the delta function representation discussed above.",
                  "relative rms error below 20 % for both Haar pairs",
                  jl14::listed({all[3], all[5]}, {errors[3], errors[5]}), errors[3] < 0.2 && errors[5] < 0.2});
}

}  // namespace

int main(int argc, char** argv) {
  const auto identity = jl14::identity("Fig. 8", "Tip velocity, case 1", "fig08_tip_velocity_case1");
  return report::run_artefact(argc, argv, identity, [](report::Artefact& artefact) {
    jl14::Case study(artefact, 1);
    const Eigen::VectorXd& reference = study.reference().velocity;
    const auto velocities = [&](const std::vector<jl14::Pair>& chosen) {
      Values values;
      for (const auto& response : study.solve_all(chosen))
        values.push_back(jl14::drawn(response, response.samples.velocity));
      return values;
    };
    const Values v = velocities(jl14::pairs());
    artefact.data(jl14::comparison_table(study.time(), reference, jl14::pairs(), v),
                  "time in periods, velocities in m/s", {"64 functions; reference: time stepping"});
    jl14::PairPanels panels{"Velocity (m/s)", -0.5, reference, {}, {}, jl14::Zoom{-0.2, 0.2, -1.3, 1.3}};
    panels.values = velocities(jl14::panel_pairs());
    artefact.picture(jl14::pair_figure(panels));
    artefact.caption("64 functions at 150 Hz; dashed: time stepping. Haar trial functions: the jump between neighbouring "
                     "cells divided by the cell width, placed at the cell edge.");
    claim_jump(artefact, reference);
    claim_ringing(artefact, reference, v);
    claim_accuracy(artefact, reference, v);
  });
}
