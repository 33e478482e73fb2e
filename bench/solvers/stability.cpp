#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "wavebalance/app/compare/solve_point.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/solvers/response/frequency_sweep.hpp"
#include "wavebalance/solvers/stability/floquet_exponents.hpp"
#include "wavebalance/solvers/stability/monodromy.hpp"

// Cost of the stability of one response, over the time of a point of its response curve in the same run:
// the counter sweep_points.
namespace wavebalance::bench {
namespace {

struct StabilityCase {
  solvers::CondensedProblem problem;
  solvers::ContactLaws laws;
  solvers::ContactDynamics dynamics;
  solvers::PeriodicResponse response;
  double seconds_per_point;
};

/// A scene's response at `frequency`, in contact, and the time of a point of its sweep.
StabilityCase stability_case(const std::string& file, double frequency,
                             const std::vector<std::string>& overrides = {}) {
  const app::Scene scene = app::load_scene(WAVEBALANCE_SCENES "/" + file, overrides);
  const app::StructureModel model = app::make_model(scene);
  solvers::CondensedProblem problem = app::make_problem(scene, model);
  const solvers::ContactLaws laws = app::make_laws(scene);
  solvers::FrequencySweepOptions options;
  options.from = scene.analysis.frequency_from;
  options.to = scene.analysis.frequency_to;
  const double start = app::processor_seconds();
  const auto sweep = solvers::frequency_sweep(problem, laws, options);
  const double seconds = (app::processor_seconds() - start) / double(sweep.points.size());
  problem.set_frequency(frequency);
  auto response = solvers::forced_response(problem, laws, {});
  solvers::ContactDynamics dynamics(problem.structure());
  return {std::move(problem), laws, std::move(dynamics), std::move(response), seconds};
}

StabilityCase scene_of(const std::string& name) {
  return name == "bar" ? stability_case("jones_legrand_2014/case2_sweep.toml", 1275.0)
         : name == "blade"
             ? stability_case("blade/sweep.toml", 600.0)
             : stability_case("blade/sweep.toml", 600.0, {"time.functions=63", "time.quadrature_points=256"});
}

void count_in_points(benchmark::State& state, const StabilityCase& scene) {
  using benchmark::Counter;
  state.counters["sweep_points"] =
      Counter(scene.seconds_per_point, Counter::kIsIterationInvariantRate | Counter::kInvert);
  state.counters["contacts"] = double(scene.problem.contacts());
  if (!scene.response.converged()) state.SkipWithError("no response");
}

void unstable_multipliers(benchmark::State& state, const std::string& name) {
  const StabilityCase scene = scene_of(name);
  solvers::UnstableMultipliers found;
  for (auto _ : state)
    found = solvers::unstable_multipliers(scene.dynamics, scene.problem, scene.laws, scene.response);
  count_in_points(state, scene);
  state.counters["evaluations"] = double(found.evaluations);
  if (found.status != solvers::StabilityStatus::converged)
    state.SkipWithError(std::string(to_string(found.status)).c_str());
}

void stability_signs(benchmark::State& state, const std::string& name) {
  const StabilityCase scene = scene_of(name);
  for (auto _ : state)
    benchmark::DoNotOptimize(
        solvers::stability_signs(scene.dynamics, scene.problem, scene.laws, scene.response));
  count_in_points(state, scene);
}

// Along a curve, from the exponents of the point before.
void follow_exponents(benchmark::State& state, const std::string& name) {
  const StabilityCase scene = scene_of(name);
  solvers::FloquetOptions options;
  options.max_exponents = 2;
  for (const auto& value :
       solvers::floquet_exponents(scene.dynamics, scene.problem, scene.laws, scene.response, options).values)
    options.starts.push_back(1.01 * value.exponent);
  for (auto _ : state)
    benchmark::DoNotOptimize(
        solvers::floquet_exponents(scene.dynamics, scene.problem, scene.laws, scene.response, options)
            .values.data());
  count_in_points(state, scene);
}

void monodromy(benchmark::State& state, const std::string& name) {
  const StabilityCase scene = scene_of(name);
  const auto stiffness = solvers::contact_stiffness(scene.problem, scene.laws, scene.response);
  for (auto _ : state)
    benchmark::DoNotOptimize(solvers::monodromy(scene.dynamics, stiffness, scene.response.frequency).data());
  count_in_points(state, scene);
}

BENCHMARK_CAPTURE(unstable_multipliers, bar, "bar")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(unstable_multipliers, blade, "blade")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(unstable_multipliers, blade_63_functions, "fine blade")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(stability_signs, bar, "bar")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(stability_signs, blade, "blade")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(follow_exponents, bar, "bar")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(follow_exponents, blade, "blade")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(monodromy, bar, "bar")->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace wavebalance::bench
