#include "figures.hpp"
#include "jl14.hpp"
#include "wavebalance/wavelets/bspline.hpp"

namespace wavebalance::jl14 {

void fig03(report::Artefact& artefact) {
  const auto table = levels_table("bspline", true);
  artefact.data(table, "time in periods, functions normalised to integral 1",
                {"the translate whose maximum lies at t = 1/2"});
  artefact.picture(levels_figure(table, "Scaling function (-)", app::SeriesStyle::line));
  artefact.caption("The translate with its maximum at t = 1/2 is drawn.");

  check_integrals(artefact, table);
  const Eigen::VectorXd c = wavelets::orthonormal_cubic_coefficients(100);
  const double left_out = 2.0 * c.tail(50).cwiseAbs().sum() / c.cwiseAbs().maxCoeff();
  artefact.check({"section 3.3",
                  "Numerical simulations showed that truncating the summation in Eq. (28) at −50 ≤ k ≤ 50 is "
                  "sufficient; larger k terms add negligibly to the summation.",
                  "the sum of |c_k| for 50 < |k| <= 100 is below 1e-12 of c_0",
                  "sum " + report::number(left_out), left_out < 1e-12});
}

}  // namespace wavebalance::jl14
