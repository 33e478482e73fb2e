#include "scene/keys/key_tables.hpp"

namespace wavebalance::app {
namespace {

std::vector<std::string_view> basis_names() {
  return {"fourier",      "haar",         "bspline",      "daubechies2",  "daubechies4",  "daubechies6",
          "daubechies8",  "daubechies10", "daubechies12", "daubechies14", "daubechies16", "daubechies18",
          "daubechies20", "daubechies22", "daubechies24", "daubechies26", "daubechies28", "daubechies30",
          "daubechies32", "daubechies34", "daubechies36", "daubechies38", "daubechies40"};
}

SceneValue default_tolerance(const Scene& scene) {
  return names_exact_method(scene) ? default_phases_tolerance : 0.0;
}

}  // namespace

void add_time_keys(std::vector<SceneKey>& keys) {
  const Section time(keys, "time", time_part);
  const Condition of_bases =
      analysis_is({"forced_response", "frequency_sweep", "amplitude_sweep", "nonlinear_mode"}) &&
      by_balance();
  const Condition balance =
      (of_responses() && by_balance()).unless("time.tolerance").unless("analysis.exact");
  time(&Time::method, "method", "",
       "what a response solves for: the balance in a pair of bases, or the motion of the structure itself by "
       "phases of contact, which has no functions and starts from a coarse balance of its own",
       optional, only_with(analysis_is({"forced_response"}).unless("contact.restitution")));
  time(&Time::tolerance, "tolerance", "",
       "relative rms error of the contact displacement over the period to be met, in place of functions and "
       "quadrature_points, which the program then chooses, and, where trial and weight are left out, of "
       "these too; with method = \"exact\" that of the phases",
       within(0, 1), derived("none; 1e-9 with method = \"exact\" and of motions", default_tolerance),
       only_with(analysis_where([](const AnalysisKind& kind) {
                   return kind.is_exact() || kind.type == AnalysisType::forced_response;
                 }).unless("contact.restitution")));
  time(&Time::trial, "trial", "", "basis of the displacement in time", one_of(basis_names()),
       required_with(balance), only_with(of_bases));
  time(&Time::weight, "weight", "", "basis that the residual is weighted with", one_of(basis_names()),
       required_with(balance), only_with(of_bases));
  time(&Time::functions, "functions", "", "trial functions; a power of two for wavelets", within(1, 1 << 20),
       required_with(balance), only_with(of_bases));
  time(&Time::formulation, "formulation", "", "how many derivatives move to the weights: none, one or two",
       optional, only_with(of_bases));
  time(&Time::quadrature_points, "quadrature_points", "",
       "uniform points of one period where the contact force is evaluated; a multiple of functions for "
       "wavelets",
       within(1, 1 << 24),
       derived("4 x functions", [](const Scene& scene) { return 4 * scene.time.functions; }),
       only_with(of_bases));
  time(&Time::sample_offset, "sample_offset", "",
       "first quadrature point in intervals of the points: 0 for their left ends k/N, 0.5 for their middles "
       "(k + 0.5)/N; without effect on output_points",
       optional, only_with(of_responses() && by_balance()));
  time(&Time::inner_products, "inner_products", "",
       "inner products of trial and weight functions: sums over the quadrature points (Daubechies Galerkin "
       "pairs: connection coefficients) or exact",
       optional, only_with(of_bases));
  time(
      &Time::nyquist, "nyquist", "",
      "the alternating coefficient of an even number of functions, which no damping acts on: drop takes it out "
      "of trial and weight space, keep leaves it there with resonances of its own; without effect for an odd "
      "number",
      optional, only_with(of_bases));
}

}  // namespace wavebalance::app
