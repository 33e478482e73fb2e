#include <benchmark/benchmark.h>

#include "dense_system.hpp"
#include "solver_scenes.hpp"
#include "wavebalance/solvers/forced_response.hpp"

// One periodic response by harmonic balance, from the contact-free response, condensation included; beside it
// the same by Newton on all n (2H + 1) unknowns with dense LU, the way the published codes do it.
namespace wavebalance::bench {
namespace {

void point(benchmark::State& state) {
  const Case scene = jl14_case(static_cast<int>(state.range(0)));
  auto problem = fourier_problem(scene, static_cast<int>(state.range(1)), static_cast<int>(state.range(2)));
  const solvers::AnyContactLaw law = scene.law();
  solvers::PeriodicResponse response;
  for (auto _ : state) {
    problem.set_frequency(scene.frequency);
    response = solvers::forced_response(problem, law, {});
    benchmark::DoNotOptimize(response.displacement.data());
  }
  if (!response.converged()) state.SkipWithError("not converged");
  state.counters["newton"] = response.iterations;
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

// Of the large system one Newton step alone, assembly included: the ratio is then a lower bound.
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
    ->Unit(benchmark::kMillisecond);
BENCHMARK(dense_point)
    ->ArgNames({"case", "functions", "points"})
    ->Args({1, 63, 256})
    ->Args({2, 63, 256})
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(dense_step)
    ->Name("dense_point")
    ->ArgNames({"case", "functions", "points"})
    ->Args({1, 255, 1024})
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace wavebalance::bench
