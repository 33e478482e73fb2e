#include <benchmark/benchmark.h>

#include "dense_system.hpp"
#include "solver_scenes.hpp"
#include "wavebalance/solvers/response/frequency_sweep.hpp"

// The frequency response 1100-1700 Hz of [JL14, Fig. 12] with 63 functions and 256 points.
namespace wavebalance::bench {
namespace {

constexpr int functions = 63;
constexpr int points = 256;

solvers::FrequencySweepOptions sweep_options() {
  solvers::FrequencySweepOptions options;
  options.from = 1100.0;
  options.to = 1700.0;
  return options;
}

void follow(benchmark::State& state, solvers::GrazingEvents events) {
  solvers::FrequencySweepOptions options = sweep_options();
  options.arc_length.grazing_events = events;
  const Case scene = jl14_case(2);
  auto problem = fourier_problem(scene, functions, points);
  const solvers::AnyContactLaw law = scene.law();
  solvers::FrequencySweep curve;
  for (auto _ : state) curve = solvers::frequency_sweep(problem, law, options);
  if (curve.status != solvers::SweepStatus::reached_end)
    state.SkipWithError(std::string(to_string(curve.status)).c_str());
  state.counters["curve_points"] = double(curve.points.size());
}

void sweep(benchmark::State& state) { follow(state, solvers::GrazingEvents::automatic); }
// Long steps between the first contact, the turning points and the last contact.
void sweep_at_turning_points(benchmark::State& state) {
  follow(state, solvers::GrazingEvents::at_turning_points);
}

// The dense system needs minutes for a whole sweep: two points of it, one with contact, each from the point
// before, scaled to as many points as the curve above has.
void dense_sweep(benchmark::State& state) {
  const Case scene = jl14_case(2);
  auto problem = fourier_problem(scene, functions, points);
  const auto curve = solvers::frequency_sweep(problem, scene.law(), sweep_options());
  const spectral::FourierBasis basis(functions);
  dense::DenseSystem system(scene.structure(), scene.law(),
                            dense::discretise(basis, basis, {.quadrature_points = points}, cosine_load()));
  constexpr double step = 4.0;  // Hz
  for (auto _ : state) {
    for (const double frequency : {1150.0, 1275.0}) {
      state.PauseTiming();
      system.set_frequency(frequency - step);
      const auto start = system.newton(system.linear_response(), {.tolerance = 1e-10});
      state.ResumeTiming();
      system.set_frequency(frequency);
      benchmark::DoNotOptimize(system.newton(start.coefficients, {.tolerance = 1e-10}).coefficients.data());
    }
  }
  state.counters["parts"] = double(curve.points.size()) / 2.0;
}

BENCHMARK(sweep)->Unit(benchmark::kMillisecond);
BENCHMARK(sweep_at_turning_points)->Unit(benchmark::kMillisecond);
BENCHMARK(dense_sweep)->Iterations(1)->Repetitions(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace wavebalance::bench
