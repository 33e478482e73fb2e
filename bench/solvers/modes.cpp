#include <benchmark/benchmark.h>

#include <array>
#include <vector>

#include "wavebalance/contact/multipliers.hpp"
#include "wavebalance/fem/bar.hpp"
#include "wavebalance/fem/eigenmodes.hpp"
#include "wavebalance/solvers/mode_augmented_lagrangian.hpp"
#include "wavebalance/solvers/nonlinear_mode.hpp"

// The first nonlinear mode of the rod of [LL10, section 5.1] with a rigid obstacle, from contact to ten times
// the grazing energy: 20 elements with half-lumped mass, N = 10 harmonics, m = 20 samples, full Fourier
// series.
namespace wavebalance::bench {
namespace {

constexpr int elements = 20;
constexpr int harmonics = 10;
constexpr int samples = 20;
constexpr int points = 200;
constexpr double largest_energy = 10.0;

solvers::ModalModel rod() {
  const fem::Matrices bar = fem::bar({.youngs_modulus = 2.1e11,
                                      .density = 7800.0,
                                      .area = 9e-4,
                                      .elements = elements,
                                      .lumped_fraction = 0.5});
  const fem::EigenmodesResult modes = fem::eigenmodes(bar.stiffness, bar.mass, elements);
  return {modes.omega.cwiseAbs2(), modes.shapes.bottomRows(1), Eigen::VectorXd::Constant(1, 1e-3)};
}

solvers::NonlinearMode condensed_mode() { return {rod(), {.harmonics = harmonics, .samples = samples}}; }

std::vector<solvers::ModePoint> curve(const solvers::NonlinearMode& mode) {
  constexpr double last_ratio = 1.2379;  // omega over omega_1 a little beyond the largest energy
  return solvers::backbone(mode,
                           {.last_ratio = last_ratio, .points = points, .largest_energy = largest_energy});
}

void mode_backbone(benchmark::State& state) {
  const solvers::NonlinearMode mode = condensed_mode();
  std::vector<solvers::ModePoint> backbone;
  for (auto _ : state) backbone = curve(mode);
  double accepted = 0.0;
  for (const solvers::ModePoint& point : backbone) accepted += point.accepted() ? 1.0 : 0.0;
  if (backbone.back().energy_ratio < largest_energy)
    state.SkipWithError("the largest energy was not reached");
  state.counters["curve_points"] = double(backbone.size());
  state.counters["accepted"] = accepted;
}

// All r (2N + 1) = 420 unknowns in the augmented Lagrangian take long for the whole curve: four points of it,
// each from the condensed point one energy step before, scaled to as many points as the curve above.
void dense_mode_backbone(benchmark::State& state) {
  const solvers::NonlinearMode condensed = condensed_mode();
  const auto backbone = curve(condensed);
  const solvers::LagrangianMode mode(rod(), {.harmonics = harmonics, .samples = samples});
  constexpr std::array energies{1.5, 3.0, 5.0, 9.5};
  constexpr double step = (largest_energy - 1.0) / points, penalty = 300.0;
  double newton = 0.0;
  for (auto _ : state) {
    newton = 0.0;
    for (const double energy : energies) {
      state.PauseTiming();
      const solvers::ModePoint start = solvers::at_energy(condensed, backbone, energy - step);
      contact::MultiplierUpdate outer(std::vector<double>(samples, penalty), {penalty});
      state.ResumeTiming();
      const auto point = mode.solve(energy, outer, {start.amplitudes, start.force});
      if (!point.accepted()) state.SkipWithError(to_string(point.status).c_str());
      newton += point.newton_iterations();
    }
  }
  state.counters["newton_a_point"] = newton / double(energies.size());
  state.counters["parts"] = double(backbone.size()) / double(energies.size());
}

BENCHMARK(mode_backbone)->Unit(benchmark::kMillisecond);
BENCHMARK(dense_mode_backbone)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace wavebalance::bench
