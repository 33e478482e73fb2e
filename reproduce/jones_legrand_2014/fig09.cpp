#include "jl14.hpp"
#include "wavebalance/reproduce/curve_measures.hpp"
#include "wavebalance/reproduce/measures.hpp"

using namespace wavebalance;

namespace {

using Values = std::vector<Eigen::VectorXd>;

double share_in_contact(const Eigen::VectorXd& force) { return (force.array() > 0.0).cast<double>().mean(); }

void claim_duration(report::Artefact& artefact, const Eigen::VectorXd& reference, const Values& forces) {
  std::vector<double> shares;
  double largest = 0.0;
  for (const auto& force : forces) {
    shares.push_back(share_in_contact(force));
    largest = std::max(largest, std::abs(shares.back() - share_in_contact(reference)));
  }
  artefact.claim({"section 5.3",
                  "Notice the time duration of the contact forces coincide with the tip displacement plateaus of Fig. 6",
                  "the time in contact of each pair differs from that of time stepping by less than 2 % of the period",
                  "time stepping " + report::percent(share_in_contact(reference)) + " of the period; " +
                      jl14::listed(jl14::pairs(), shares),
                  largest < 0.02});
}

void claim_ringing(report::Artefact& artefact, const Eigen::VectorXd& reference, const Values& forces) {
  std::vector<double> excess;
  for (const auto& force : forces) excess.push_back(reproduce::excess_variation(force, reference));
  artefact.claim({"section 5.3", "The effect of Gibbs phenomenon can be seen in the HBM and Galerkin B-spline cases.",
                  "the force of both varies more over the period than that of time stepping, by more than 10 %",
                  "excess variation " + jl14::listed(jl14::pairs(), excess), excess[0] > 0.1 && excess[1] > 0.1});
}

void claim_accuracy(report::Artefact& artefact, const Eigen::VectorXd& reference, const Values& forces) {
  const auto& all = jl14::pairs();
  std::vector<double> e;
  std::size_t best = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    e.push_back(reproduce::relative_rms_error(forces[i], reference));
    if (e[i] < e[best]) best = i;
  }
  const std::string measured = "relative rms error of the force: " + jl14::listed(all, e);
  artefact.claim({"section 5.3",
                  "The cases where Haar trial functions are used approximate the contact force relatively well.",
                  "both Haar pairs have a lower relative rms error than Fourier:Fourier", measured,
                  std::max(e[3], e[5]) < e[0]});
  artefact.claim({"section 5.3",
                  "Again, the DB6 trial functions appear to most accurately approximate the contact forces compared to "
                  "the other cases.",
                  "the lowest relative rms error is that of a pair with DB6 trial functions",
                  "lowest: " + all[best].label + "; " + measured, all[best].trial == "daubechies6"});
  artefact.claim({"abstract", "and seemingly more accurate contact force prediction",
                  "the three Petrov-Galerkin pairs have a lower relative rms error of the force than Fourier:Fourier",
                  measured, std::max({e[3], e[4], e[5]}) < e[0]});
}

}  // namespace

int main(int argc, char** argv) {
  const auto identity = jl14::identity("Fig. 9", "Normalised contact force, case 1", "fig09_contact_force_case1");
  return report::run_artefact(argc, argv, identity, [](report::Artefact& artefact) {
    jl14::Case study(artefact, 1);
    const double amplitude = study.scene().forcing.amplitude;
    const Eigen::VectorXd reference = study.reference().contact_force / amplitude;
    const auto normalised = [&](const std::vector<jl14::Pair>& chosen) {
      Values values;
      for (const auto& response : study.solve_all(chosen))
        values.push_back(jl14::drawn(response, response.samples.contact_force / amplitude));
      return values;
    };
    const Values forces = normalised(jl14::pairs());
    artefact.data(jl14::comparison_table(study.time(), reference, jl14::pairs(), forces),
                  "time in periods, contact forces divided by the amplitude F of the external force",
                  {"64 functions; reference: time stepping"});
    jl14::PairPanels panels{"Contact force f_c/F (-)", -0.5, reference, normalised(jl14::panel_pairs()), {}, {}};
    artefact.picture(jl14::pair_figure(panels));
    artefact.caption("64 functions at 150 Hz; dashed: time stepping. The force is eq. (5) of the predicted displacement.");
    claim_duration(artefact, reference, forces);
    claim_ringing(artefact, reference, forces);
    claim_accuracy(artefact, reference, forces);
  });
}
