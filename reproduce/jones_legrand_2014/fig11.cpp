#include "fig11_claims.hpp"
#include "wavebalance/app/analysis/curve_measures.hpp"
#include "wavebalance/app/analysis/measures.hpp"

using namespace wavebalance;
using jl14::Convergence;

int main(int argc, char** argv) {
  const auto identity =
      jl14::identity("Fig. 11", "Relative error of the tip displacement", "fig11_tip_error");
  return report::run_artefact(argc, argv, identity, [](report::Artefact& artefact) {
    const Convergence errors(
        artefact, "rms_relative_error", false, [](jl14::Case& study, const app::Response& response) {
          return app::relative_rms_error(response.samples.displacement, study.reference().displacement);
        });
    const Convergence midpoints(
        artefact, "midpoint_error", false, [](jl14::Case& study, const app::Response& response) {
          return app::relative_rms_error(
              app::cell_midpoints(response.samples.displacement, response.unknowns),
              app::cell_midpoints(study.reference().displacement, response.unknowns));
        });
    artefact.data(errors.table(), "ratio without unit",
                  {"rms_relative_error: rms over 1024 points of (u - u_ref) divided by the rms of u_ref"});
    artefact.picture(errors.figure("Relative rms error (-)", true));
    artefact.caption("rms of u − u_ref over a period divided by the rms of u_ref, tip.");
    jl14::claim_errors(artefact, errors);
    jl14::claim_midpoints(artefact, midpoints, errors);
    jl14::claim_abstract(artefact, errors);
    jl14::note_nyquist_resonances(artefact);
  });
}
