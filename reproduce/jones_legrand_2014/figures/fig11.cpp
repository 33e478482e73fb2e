#include <algorithm>

#include "fig11_claims.hpp"
#include "figures.hpp"

namespace wavebalance::jl14 {

void fig11(report::Artefact& artefact) {
  const auto all = under_all_sums(artefact, false);
  const Convergence& drawn = all.front();
  artefact.data(drawn.table(&Measures::rms, "rms_relative_error"), "ratio without unit",
                {"rms_relative_error: rms over 1024 points of (u - u_ref) divided by the rms of u_ref"});
  app::Figure figure;
  figure.panel_width = 600;
  figure.panel_height = 330;
  figure.panels = drawn.panels(&Measures::rms, "Relative rms error (-)", true);
  artefact.picture(figure);
  artefact.caption(
      "Rms of the difference from the exact motion over a period, divided by the rms of the exact motion, at the tip. "
      "Curves are shifted so that none hides another.");
  state_errors(artefact, all);
  state_haar_errors(artefact, all);
  state_similar_trends(artefact, all);
  state_abstract(artefact, all);
  state_conclusions(artefact, all);
  note_convergence_sums(artefact);
  note_nyquist_resonances(artefact);
}

}  // namespace wavebalance::jl14
