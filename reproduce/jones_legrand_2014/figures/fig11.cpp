#include "curve_measures.hpp"
#include "fig11_claims.hpp"
#include "figures.hpp"
#include "wavebalance/app/analysis/measures.hpp"

namespace wavebalance::jl14 {

void fig11(report::Artefact& artefact) {
  const Convergence errors(
      artefact, "rms_relative_error", false, [](Case& study, const app::Response& response) {
        return app::relative_rms_error(response.displacement(), study.reference().displacement());
      });
  const Convergence midpoints(
      artefact, "midpoint_error", false, [](Case& study, const app::Response& response) {
        return app::relative_rms_error(cell_midpoints(response.displacement(), response.unknowns),
                                       cell_midpoints(study.reference().displacement(), response.unknowns));
      });
  artefact.data(errors.table(), "ratio without unit",
                {"rms_relative_error: rms over 1024 points of (u - u_ref) divided by the rms of u_ref"});
  artefact.picture(errors.figure("Relative rms error (-)", true));
  artefact.caption("rms of u − u_ref over a period divided by the rms of u_ref, tip.");
  claim_errors(artefact, errors);
  claim_midpoints(artefact, midpoints, errors);
  claim_abstract(artefact, errors);
  note_nyquist_resonances(artefact);
}

}  // namespace wavebalance::jl14
