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
  return names_exact_method(scene) ? default_exact_tolerance : 0.0;
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
       "method of a response: weighted residuals in a pair of bases (balance), or the exact "
       "periodic solution, which needs no basis functions and finds its own start",
       optional, only_with(analysis_is({"forced_response"}).unless("contact.restitution")));
  time(&Time::tolerance, "tolerance", "",
       "relative rms error of the contact displacement to be met; the program then chooses "
       "functions and quadrature_points, and trial and weight if not given; with method = "
       "\"exact\" the error of the exact solution",
       within(0, 1), derived("none; 1e-9 with method = \"exact\" and of motions", default_tolerance),
       only_with(analysis_where([](const AnalysisKind& kind) {
                   return kind.is_exact() || kind.type == AnalysisType::forced_response;
                 }).unless("contact.restitution")));
  time(&Time::trial, "trial", "", "trial basis of the displacement in time", one_of(basis_names()),
       required_with(balance), only_with(of_bases));
  time(&Time::weight, "weight", "", "test basis that weights the residual", one_of(basis_names()),
       required_with(balance), only_with(of_bases));
  time(&Time::functions, "functions", "",
       "number of basis functions, for Fourier 2 H + 1 for H harmonics; a power of two for wavelets",
       within(1, 1 << 20), required_with(balance), only_with(of_bases));
  time(&Time::formulation, "formulation", "", "derivatives moved to the weight functions: none, one or two",
       optional, only_with(of_bases));
  time(
      &Time::quadrature_points, "quadrature_points", "",
      "time samples per period at which the contact force is evaluated; a multiple of functions for wavelets",
      within(1, 1 << 24),
      derived("4 x functions", [](const Scene& scene) { return 4 * scene.time.functions; }),
      only_with(of_bases));
  time(&Time::sample_offset, "sample_offset", "",
       "offset of the time samples: 0 for k/N, 0.5 for the midpoints (k + 0.5)/N; no effect on output_points",
       optional, only_with(of_responses() && by_balance()));
  time(&Time::inner_products, "inner_products", "",
       "inner products of trial and weight functions: sums over the time samples (Daubechies "
       "Galerkin pairs: connection coefficients) or exact",
       optional, only_with(of_bases));
  time(&Time::nyquist, "nyquist", "",
       "undamped Nyquist coefficient of an even number of functions: drop removes it from both "
       "spaces, keep leaves it with spurious resonances; no effect for an odd number",
       optional, only_with(of_bases));
}

}  // namespace wavebalance::app
