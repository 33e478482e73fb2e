#include <benchmark/benchmark.h>

#include <numbers>

#include "solver_scenes.hpp"
#include "wavebalance/contact/rigid_law.hpp"
#include "wavebalance/solvers/problem/contact_problem.hpp"

// A bar of 50 elements, EA = rho A = L = 1, whose end has an additional mass and meets a rigid stop twice
// in a period.
namespace wavebalance::bench {
namespace {

constexpr double turn = 2.0 * std::numbers::pi, gap = 0.8, restitution = 0.8, omega = 0.9;

solvers::LinearStructure bar_with_end_mass() {
  constexpr int elements = 50;
  constexpr double length = 1.0 / elements, end_mass = 0.5, damping = 0.02;
  Eigen::MatrixXd mass = length * Eigen::MatrixXd::Identity(elements, elements),
                  stiffness = Eigen::MatrixXd::Zero(elements, elements);
  mass(elements - 1, elements - 1) = 0.5 * length + end_mass;
  for (int i = 0; i < elements; ++i) {
    stiffness(i, i) = (i + 1 < elements ? 2.0 : 1.0) / length;
    if (i > 0) stiffness(i, i - 1) = stiffness(i - 1, i) = -1.0 / length;
  }
  solvers::LinearStructure structure;
  structure.mass = mass.sparseView();
  structure.stiffness = stiffness.sparseView();
  structure.damping = (damping * stiffness).sparseView();
  structure.load = Eigen::VectorXd::Unit(elements, elements - 1);
  structure.contact_directions =
      solvers::ContactDirections(Eigen::RowVectorXd::Unit(elements, elements - 1).sparseView());
  return structure;
}

struct ImpactBench {
  solvers::LinearStructure structure = bar_with_end_mass();
  solvers::ContactDynamics dynamics{structure};
  solvers::CondensedProblem condensed = condensed_at(structure);
  solvers::ProblemFamily family{condensed, contact::RigidLaw(gap, restitution), dynamics,
                                solvers::SweepParameter::frequency};
  solvers::ExactProblem problem = family.at(omega / turn);

  static solvers::CondensedProblem condensed_at(const solvers::LinearStructure& structure) {
    const spectral::FourierBasis basis(7);
    solvers::CondensedProblem problem(solvers::TimePair(basis, basis, {.quadrature_points = 32}), structure,
                                      cosine_load());
    problem.set_frequency(omega / turn);
    return problem;
  }
};

// From a start a thousandth of the period and of the impulses away.
void impact_motion(benchmark::State& state) {
  const ImpactBench bench;
  std::vector<solvers::ImpactGuess> start;
  for (const solvers::Impact& impact : solvers::impact_response(bench.problem).motion.impacts)
    start.push_back({impact.contact, impact.time + 1e-3, 1.001 * impact.impulse});
  if (start.size() != 2) state.SkipWithError("there are not two impacts");
  for (auto _ : state) benchmark::DoNotOptimize(solvers::impact_motion(bench.problem, start).residual);
}

// A motion computes its own once; each time it is another one.
void impact_multipliers(benchmark::State& state) {
  const ImpactBench bench;
  std::vector<solvers::ImpactGuess> start;
  for (const solvers::Impact& impact : solvers::impact_response(bench.problem).motion.impacts)
    start.push_back({impact.contact, impact.time, impact.impulse});
  for (auto _ : state) {
    state.PauseTiming();
    const solvers::ExactSolution motion = solvers::impact_motion(bench.problem, start);
    state.ResumeTiming();
    benchmark::DoNotOptimize(motion.multipliers().data());
  }
}

void follow_impacts(benchmark::State& state, bool stability) {
  const ImpactBench bench;
  const solvers::ExactSolution first = solvers::impact_response(bench.problem).motion;
  solvers::ExactCurve curve;
  for (auto _ : state)
    curve = solvers::exact_curve(bench.family, first,
                                 {.from = omega / turn, .to = 1.0 / turn, .stability = stability});
  if (curve.status != solvers::SweepStatus::reached_end)
    state.SkipWithError("the curve does not reach its end");
  state.counters["curve_points"] = double(curve.points.size());
}

void impact_sweep(benchmark::State& state) { follow_impacts(state, false); }
void impact_sweep_with_stability(benchmark::State& state) { follow_impacts(state, true); }

BENCHMARK(impact_motion)->Unit(benchmark::kMillisecond);
BENCHMARK(impact_multipliers)->Unit(benchmark::kMillisecond);
BENCHMARK(impact_sweep)->Unit(benchmark::kMillisecond);
BENCHMARK(impact_sweep_with_stability)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace wavebalance::bench
