#include "jl14.hpp"
#include "wavebalance/reproduce/curve_measures.hpp"
#include "wavebalance/reproduce/measures.hpp"

using namespace wavebalance;

namespace {

constexpr double millimetres = 1e3;

double haar_error(jl14::Case& study) {
  const auto response = study.solve(jl14::pair("haar_fourier"), 64);
  return reproduce::relative_rms_error(response.samples.displacement, study.reference().displacement);
}

double penetration(const jl14::Case& study) {
  return study.reference().displacement.maxCoeff() / study.gap() - 1.0;
}

void claim_haar(report::Artefact& artefact, jl14::Case& study) {
  jl14::Case other(artefact, 1);
  const double here = haar_error(study), there = haar_error(other);
  artefact.claim({"section 5.1", "The Haar basis appears to be less suited for the response at 1275 Hz",
                  "the relative rms error of Haar:Fourier is higher than at 150 Hz",
                  report::percent(here) + " against " + report::percent(there), here > there});
  const double share = reproduce::contact_fraction(study.reference());
  const double other_share = reproduce::contact_fraction(other.reference());
  artefact.claim({"section 5.1", "as the contact plateau is smaller and not as flat",
                  "the contact takes less of the period than at 150 Hz, and its penetration is a larger part of the gap",
                  "contact during " + report::percent(share) + " against " + report::percent(other_share) +
                      " of the period, penetration " + report::percent(penetration(study)) + " against " +
                      report::percent(penetration(other)) + " of the gap",
                  share < other_share && penetration(study) > penetration(other)});
}

}  // namespace

int main(int argc, char** argv) {
  const auto identity = jl14::identity("Fig. 7", "Tip displacement, case 2", "fig07_tip_displacement_case2");
  return report::run_artefact(argc, argv, identity, [](report::Artefact& artefact) {
    jl14::Case study(artefact, 2);
    const auto responses = study.solve_all(jl14::panel_pairs());
    const Eigen::VectorXd& reference = study.reference().displacement;
    jl14::PairPanels panels{"Displacement (mm)", 0.0, millimetres * reference, {}, millimetres * study.gap(),
                            jl14::Zoom{0.04, 0.24, 13.0, 16.0}};
    std::vector<Eigen::VectorXd> columns;
    for (const auto& response : responses) {
      columns.push_back(jl14::drawn(response, response.samples.displacement));
      panels.values.push_back(millimetres * columns.back());
    }
    artefact.data(jl14::comparison_table(study.time(), reference, jl14::panel_pairs(), columns),
                  "time in periods, displacements in m", {"64 functions; reference: time stepping"});
    artefact.picture(jl14::pair_figure(panels));
    artefact.caption("64 functions at 1275 Hz; dashed: time stepping; dotted: the gap.");
    const double error = reproduce::relative_rms_error(responses[0].samples.displacement, reference);
    artefact.claim({"section 5.1",
                    "For this number of basis functions HBM (Fourier:Fourier) approximates the tip displacements well "
                    "at both 150 Hz and 1275 Hz compared to the time-stepping solution.",
                    "at 1275 Hz: relative rms error below 1 %", report::percent(error), error < 0.01});
    claim_haar(artefact, study);
  });
}
