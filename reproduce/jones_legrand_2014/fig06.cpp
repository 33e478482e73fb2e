#include "jl14.hpp"
#include "wavebalance/reproduce/curve_measures.hpp"
#include "wavebalance/reproduce/measures.hpp"

using namespace wavebalance;

namespace {

constexpr double millimetres = 1e3;

/// rms of the difference from the reference where the reference is in contact, or where it is not, m.
double error_where(const jl14::Case& study, const Eigen::VectorXd& displacement, bool in_contact) {
  const auto& reference = study.reference();
  const Eigen::VectorXd difference = displacement - reference.displacement;
  return reproduce::rms(reproduce::select(difference, (reference.contact_force.array() > 0.0) == in_contact));
}

void claim_plateau(report::Artefact& artefact, const jl14::Case& study, const reproduce::Response& hbm) {
  const auto& reference = study.reference();
  const Eigen::VectorXd difference =
      jl14::half_turn(hbm.samples.displacement - reference.displacement);
  const Eigen::VectorXd plateau =
      reproduce::select(difference, jl14::half_turn(reference.contact_force).array() > 0.0);
  const int changes = reproduce::sign_changes(plateau);
  const double swing = (plateau.maxCoeff() - plateau.minCoeff()) /
                       (reference.displacement.maxCoeff() - study.gap());
  artefact.claim({"section 5.1",
                  "close examination of the contact plateau for the 150 Hz case shows oscillations due to Gibbs phenomenon",
                  "on the plateau the difference from time stepping changes sign four times or more",
                  std::to_string(changes) + " changes of sign, swing " + report::percent(swing) +
                      " of the largest penetration",
                  changes >= 4});
  const int steps = static_cast<int>(reference.points()) / 128;
  const double kink = reproduce::largest_change(hbm.samples.velocity, steps) /
                      reproduce::largest_change(reference.velocity, steps);
  artefact.claim({"section 5.1", "and rounding off of the sharp gradient changes",
                  "the largest change of velocity within 1/128 of the period is smaller than in time stepping",
                  report::percent(kink) + " of that of time stepping", kink < 1.0});
}

void claim_haar(report::Artefact& artefact, const jl14::Case& study, const Eigen::VectorXd& haar,
                const Eigen::VectorXd& hbm) {
  const double outside = error_where(study, haar, false), outside_hbm = error_where(study, hbm, false);
  artefact.claim({"section 5.1",
                  "the Haar:Fourier combination appears to approximate the tip displacement outside the contact zone "
                  "less well due to the blocky nature of the Haar scaling functions",
                  "outside the contact the rms error is above that of Fourier:Fourier",
                  report::number(millimetres * outside) + " mm against " + report::number(millimetres * outside_hbm) + " mm",
                  outside > outside_hbm});
  const double plateau = error_where(study, haar, true), plateau_hbm = error_where(study, hbm, true);
  artefact.claim({"section 5.1",
                  "However, the contact plateau is well represented by the constant Haar scaling functions.",
                  "in contact the rms error is below 1 % of the gap and below a tenth of the error outside",
                  report::number(millimetres * plateau) + " mm (Fourier:Fourier " +
                      report::number(millimetres * plateau_hbm) + " mm)",
                  plateau < 0.01 * study.gap() && plateau < 0.1 * outside});
}

}  // namespace

int main(int argc, char** argv) {
  const auto identity = jl14::identity("Fig. 6", "Tip displacement, case 1", "fig06_tip_displacement_case1");
  return report::run_artefact(argc, argv, identity, [](report::Artefact& artefact) {
    jl14::Case study(artefact, 1);
    const auto responses = study.solve_all(jl14::panel_pairs());
    const Eigen::VectorXd& reference = study.reference().displacement;
    jl14::PairPanels panels{"Displacement (mm)", -0.5, millimetres * reference, {}, millimetres * study.gap(),
                            jl14::Zoom{-0.17, 0.17, 0.97, 1.03}};
    std::vector<Eigen::VectorXd> columns;
    for (const auto& response : responses) {
      columns.push_back(jl14::drawn(response, response.samples.displacement));
      panels.values.push_back(millimetres * columns.back());
    }
    artefact.data(jl14::comparison_table(study.time(), reference, jl14::panel_pairs(), columns),
                  "time in periods, displacements in m", {"64 functions; reference: time stepping"});
    artefact.picture(jl14::pair_figure(panels));
    artefact.caption("64 functions at 150 Hz; dashed: time stepping; dotted: the gap. The force F cos 2πft puts the "
                     "contact about t = 0, which stands in the middle. Panels (d) and (e) are those that the text names.");
    const double error = reproduce::relative_rms_error(responses[0].samples.displacement, reference);
    artefact.claim({"section 5.1",
                    "For this number of basis functions HBM (Fourier:Fourier) approximates the tip displacements well "
                    "at both 150 Hz and 1275 Hz compared to the time-stepping solution.",
                    "at 150 Hz: relative rms error below 1 %", report::percent(error), error < 0.01});
    claim_plateau(artefact, study, responses[0]);
    claim_haar(artefact, study, responses[2].samples.displacement, responses[0].samples.displacement);
  });
}
