#include <fmt/format.h>

#include "figures.hpp"
#include "jl14.hpp"
#include "motion.hpp"
#include "wavebalance/app/analysis/measures.hpp"

namespace wavebalance::jl14 {
namespace {

double haar_error(Case& study) {
  const auto response = study.solve(pair("haar_fourier"), 64);
  return app::relative_rms_error(response.displacement(), study.reference().displacement());
}

double penetration(const Case& study) {
  return study.reference().displacement().maxCoeff() / study.gap() - 1.0;
}

void claim_haar(report::Artefact& artefact, Case& study) {
  Case other(artefact, 1);
  const double here = haar_error(study), there = haar_error(other);
  artefact.check({"section 5.1", "The Haar basis appears to be less suited for the response at 1275 Hz",
                  "the relative rms error of Haar:Fourier is higher than at 150 Hz",
                  report::percent(here) + " against " + report::percent(there), here > there});
  const double share = app::contact_fraction(study.reference().contacts);
  const double other_share = app::contact_fraction(other.reference().contacts);
  artefact.check(
      {"section 5.1", "as the contact plateau is smaller and not as flat",
       "the contact takes less of the period than at 150 Hz, and its penetration is a larger part of the gap",
       fmt::format("contact during {} against {} of the period, penetration {} against {} of the gap",
                   report::percent(share), report::percent(other_share), report::percent(penetration(study)),
                   report::percent(penetration(other))),
       share < other_share && penetration(study) > penetration(other)});
}

}  // namespace

void fig07(report::Artefact& artefact) {
  Case study(artefact, 2);
  const auto responses = study.solve_all(pairs(), true);
  const auto u = drawn(responses, &app::Response::displacement);
  artefact.attach("motion_case2.json",
                  motion_json(study, responses, artefact.result("reference_case2_nodes.csv")), false);
  const Eigen::VectorXd& reference = study.reference().displacement();
  artefact.data(comparison_table(study.time(), reference, u), "time in periods, displacements in m",
                {"64 functions; reference: time stepping"});
  artefact.picture(pair_figure({"Tip displacement at 1275 Hz, 64 functions",
                                axis("Displacement (mm)", -20.0, 20.0), 0.0, millimetres, reference, u,
                                study.gap(), Zoom{0.03, 0.22, 13.0, 16.0, {0.05, 0.1, 0.15, 0.2}}}));
  artefact.caption("64 functions at 1275 Hz; dashed: time stepping; dotted: the gap.");
  const double error = app::relative_rms_error(u[0], reference);
  artefact.check(
      {"section 5.1",
       "For this number of basis functions HBM (Fourier:Fourier) approximates the tip displacements well at "
       "both 150 Hz and 1275 Hz compared to the time-stepping solution.",
       "at 1275 Hz: relative rms error below 1 %", report::percent(error), error < 0.01});
  claim_haar(artefact, study);
}

}  // namespace wavebalance::jl14
