#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "dense_system.hpp"
#include "solver_scenes.hpp"
#include "wavebalance/app/compare/solve_point.hpp"
#include "wavebalance/solvers/problem/contact_problem.hpp"
#include "wavebalance/solvers/response/forced_response.hpp"
#include "wavebalance/spectral/fft.hpp"
#include "wavebalance/wavelets/connection.hpp"

// One periodic response from the linear response, condensation included, the pair of bases and FFT plans
// made before; and the same by Newton on all n (2H + 1) unknowns with dense LU, the way the published codes
// do it.
namespace wavebalance::bench {
namespace {

// The time of a forward and an inverse transform.
double fft_pair_seconds(int points) {
  spectral::RealFft fft(points);
  std::vector<double> samples(static_cast<std::size_t>(points), 1.0);
  std::vector<std::complex<double>> spectrum(static_cast<std::size_t>(fft.harmonics()));
  return app::least_seconds([&] {
    fft.forward(samples, spectrum);
    fft.inverse(spectrum, samples);
    for (double& sample : samples) sample /= points;
  });
}

// "over_ffts" is the time over the time of the transforms that every Newton method on samples needs: one
// pair for each residual and one for each step.
void solve_points(benchmark::State& state, solvers::CondensedProblem& problem, const Case& scene) {
  const solvers::AnyContactLaw law = scene.law();
  solvers::PeriodicResponse response;
  double quickest = std::numeric_limits<double>::infinity();
  for (auto _ : state) {
    const double start = app::processor_seconds();
    problem.forget_condensation();
    problem.set_frequency(scene.frequency);
    response = solvers::forced_response(problem, law, {});
    benchmark::DoNotOptimize(response.displacement.data());
    quickest = std::min(quickest, app::processor_seconds() - start);
  }
  if (!response.converged()) state.SkipWithError("not converged");
  state.counters["newton"] = response.iterations;
  state.counters["quickest_ms"] = 1e3 * quickest;
  state.counters["over_ffts"] =
      quickest / ((2 * response.iterations + 1) * fft_pair_seconds(problem.points()));
}

void point(benchmark::State& state) {
  const Case scene = jl14_case(static_cast<int>(state.range(0)));
  auto problem = fourier_problem(scene, static_cast<int>(state.range(1)), static_cast<int>(state.range(2)));
  solve_points(state, problem, scene);
}

// From a balance of 63 functions to the motion of the structure; the second argument is the tolerance's
// exponent.
void exact(benchmark::State& state) {
  const Case scene = jl14_case(static_cast<int>(state.range(0)));
  solvers::ContactProblem problem(fourier_problem(scene, 63, 256), scene.law());
  const solvers::PeriodicResponse response = problem.respond(scene.frequency);
  const solvers::CollocationOptions options{.tolerance = std::pow(10.0, -double(state.range(1)))};
  std::optional<solvers::ExactNearResponse> found;
  for (auto _ : state) found = problem.exact_near(response, options);
  if (!found || !found->motion.converged()) {
    state.SkipWithError("not converged");
    return;
  }
  state.counters["unknowns"] = found->motion.unknowns;
  state.counters["estimated_error"] = found->motion.estimated_error;
}

// 2^14 functions of a pair of wavelets, or of wavelets and Fourier functions, 65536 points.
constexpr int wavelet_level = 14;

solvers::TimePair large_pair(const wavelets::ScalingFunction& trial,
                             const wavelets::ScalingFunction* weight) {
  const wavelets::PeriodicBasis left(trial, wavelet_level);
  solvers::TimePairOptions options;
  options.quadrature_points = 4 << wavelet_level;
  if (weight == nullptr) return {left, spectral::FourierBasis(1 << wavelet_level), options};
  const wavelets::PeriodicBasis right(*weight, wavelet_level);
  options.inner_products = solvers::InnerProducts::exact;
  options.exact_column = [left, right](int derivative) {
    return wavelets::periodic_inner_products(left, right, derivative);
  };
  return {left, right, options};
}

solvers::TimePair large_pair(const std::string& name) {
  const auto daubechies = wavelets::ScalingFunction::daubechies(6);
  if (name == "daubechies6_daubechies6") return large_pair(daubechies, &daubechies);
  if (name == "haar_fourier") return large_pair(wavelets::ScalingFunction::haar(), nullptr);
  const auto spline = wavelets::ScalingFunction::orthonormal_bspline();
  return large_pair(spline, &spline);
}

void wavelet_point(benchmark::State& state, const std::string& name) {
  const Case scene = jl14_case(static_cast<int>(state.range(0)));
  solvers::CondensedProblem problem(large_pair(name), scene.structure(), cosine_load());
  solve_points(state, problem, scene);
}

// Part that wavelet_point and point omit: the symbol of the pair with its plans.
void make_pair(benchmark::State& state, const std::string& name) {
  const spectral::FourierBasis basis((1 << wavelet_level) - 1);
  for (auto _ : state) {
    const solvers::TimePair pair =
        name == "fourier_fourier" ? solvers::TimePair(basis, basis, {.quadrature_points = 4 << wavelet_level})
                                  : large_pair(name);
    benchmark::DoNotOptimize(pair.symbol(0).data());
  }
}

dense::DenseSystem dense_problem(const Case& scene, int functions, int points) {
  const spectral::FourierBasis basis(functions);
  return {scene.structure(), scene.law(),
          dense::discretise(basis, basis, {.quadrature_points = points}, cosine_load())};
}

void dense_point(benchmark::State& state) {
  const Case scene = jl14_case(static_cast<int>(state.range(0)));
  auto system = dense_problem(scene, static_cast<int>(state.range(1)), static_cast<int>(state.range(2)));
  dense::Solution solution;
  for (auto _ : state) {
    system.set_frequency(scene.frequency);
    solution = system.newton(system.linear_response(), {.tolerance = 1e-11});
  }
  if (!solution.converged) state.SkipWithError("not converged");
  state.counters["newton"] = solution.iterations;
}

// Times only one Newton step of the large system, assembly included: the ratio is then a lower bound.
void dense_step(benchmark::State& state) {
  const Case scene = jl14_case(static_cast<int>(state.range(0)));
  auto system = dense_problem(scene, static_cast<int>(state.range(1)), static_cast<int>(state.range(2)));
  for (auto _ : state) {
    system.set_frequency(scene.frequency);
    benchmark::DoNotOptimize(system.linear_response().data());
  }
}

BENCHMARK(point)
    ->ArgNames({"case", "functions", "points"})
    ->Args({1, 63, 256})
    ->Args({2, 63, 256})
    ->Args({1, 255, 1024})
    ->Args({2, 255, 1024})
    ->Args({1, 1023, 4096})
    ->Args({2, 1023, 4096})
    ->Args({1, 16383, 65536})
    ->Args({2, 16383, 65536})
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(wavelet_point, daubechies6_daubechies6, "daubechies6_daubechies6")
    ->ArgName("case")
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(wavelet_point, haar_fourier, "haar_fourier")
    ->ArgName("case")
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(wavelet_point, bspline_bspline, "bspline_bspline")
    ->ArgName("case")
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(make_pair, fourier_fourier, "fourier_fourier")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(make_pair, daubechies6_daubechies6, "daubechies6_daubechies6")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(make_pair, haar_fourier, "haar_fourier")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(make_pair, bspline_bspline, "bspline_bspline")->Unit(benchmark::kMillisecond);
BENCHMARK(exact)
    ->ArgNames({"case", "digits"})
    ->Args({1, 8})
    ->Args({1, 12})
    ->Args({2, 8})
    ->Args({2, 12})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(dense_point)
    ->ArgNames({"case", "functions", "points"})
    ->Args({1, 63, 256})
    ->Args({2, 63, 256})
    ->Iterations(1)
    ->Repetitions(1)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(dense_step)
    ->Name("dense_point")
    ->ArgNames({"case", "functions", "points"})
    ->Args({1, 255, 1024})
    ->Iterations(1)
    ->Repetitions(1)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace wavebalance::bench
