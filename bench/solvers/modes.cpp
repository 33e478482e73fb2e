#include <benchmark/benchmark.h>

#include <Eigen/Eigenvalues>
#include <vector>

#include "mode_augmented_lagrangian.hpp"
#include "wavebalance/contact/multipliers.hpp"
#include "wavebalance/fem/bar.hpp"
#include "wavebalance/fem/blade.hpp"
#include "wavebalance/fem/craig_bampton.hpp"
#include "wavebalance/fem/eigenmodes.hpp"
#include "wavebalance/solvers/modes/nonlinear_mode.hpp"

// First nonlinear modes with a rigid obstacle, from contact to a largest energy, full Fourier series: the rod
// of [LL10, section 5.1], 20 elements with half-lumped mass, and the open blade, reduced to 112 coordinates.
namespace wavebalance::bench {
namespace {

struct ModeCase {
  solvers::ModalModel model;
  int harmonics;
  int points;                          // of the curve
  double largest_energy;               // over the energy of grazing
  double last_ratio;                   // omega over omega_1 a little beyond the largest energy
  std::vector<double> dense_energies;  // at which the dense baseline is measured
};

constexpr int samples = 20;

ModeCase rod() {
  constexpr int elements = 20;
  const fem::Matrices bar = fem::bar({.youngs_modulus = 2.1e11,
                                      .density = 7800.0,
                                      .area = 9e-4,
                                      .elements = elements,
                                      .lumped_fraction = 0.5});
  const fem::EigenmodesResult modes = fem::eigenmodes(bar.stiffness, bar.mass, elements);
  return {{modes.omega.cwiseAbs2(), modes.shapes.bottomRows(1), Eigen::VectorXd::Constant(1, 1e-3)},
          10,
          200,
          10.0,
          1.2379,
          {1.5, 3.0, 5.0, 9.5}};
}

ModeCase blade() {
  const fem::Blade blade = fem::blade();
  const fem::Matrices matrices = fem::solid_matrices(blade.model);
  const fem::CraigBampton reduced = fem::craig_bampton(matrices, blade.boundary_unknowns);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(reduced.stiffness, reduced.mass);
  const auto contacts = static_cast<Eigen::Index>(blade.contact_unknowns.size());
  Eigen::MatrixXd shapes(contacts, modes.eigenvalues().size());
  for (Eigen::Index c = 0; c < contacts; ++c) shapes.row(c) = modes.eigenvectors().row(3 * c + 2);
  return {
      {modes.eigenvalues(), shapes, Eigen::VectorXd::Constant(contacts, 1e-3)}, 5, 108, 10.4, 1.26, {3.0}};
}

solvers::NonlinearMode condensed_mode(const ModeCase& study) {
  return {study.model, {.harmonics = study.harmonics, .samples = samples}};
}

std::vector<solvers::ModePoint> curve(const ModeCase& study, const solvers::NonlinearMode& mode) {
  return solvers::backbone(
      mode, {.last_ratio = study.last_ratio, .points = study.points, .max_energy = study.largest_energy});
}

void mode_backbone(benchmark::State& state, ModeCase (*make)()) {
  const ModeCase study = make();
  const solvers::NonlinearMode mode = condensed_mode(study);
  std::vector<solvers::ModePoint> backbone;
  for (auto _ : state) backbone = curve(study, mode);
  double accepted = 0.0;
  for (const solvers::ModePoint& point : backbone) accepted += point.accepted() ? 1.0 : 0.0;
  if (backbone.back().energy_ratio < study.largest_energy)
    state.SkipWithError("the largest energy was not reached");
  state.counters["curve_points"] = double(backbone.size());
  state.counters["accepted"] = accepted;
}

// All r (2N + 1) unknowns (rod 420, blade 1232) in the augmented Lagrangian are slow for the whole curve: a
// few points of it, each from the condensed point one energy step before, scaled to as many points as the
// curve above.
void dense_mode_backbone(benchmark::State& state, ModeCase (*make)()) {
  const ModeCase study = make();
  const solvers::NonlinearMode condensed = condensed_mode(study);
  const auto backbone = curve(study, condensed);
  const ll10::LagrangianMode mode(study.model, {.harmonics = study.harmonics, .samples = samples});
  const double step = (study.largest_energy - 1.0) / study.points;
  constexpr double penalty = 300.0;
  const auto unknowns = static_cast<std::size_t>(study.model.contacts() * samples);
  double newton = 0.0;
  for (auto _ : state) {
    newton = 0.0;
    for (const double energy : study.dense_energies) {
      state.PauseTiming();
      const solvers::ModePoint start = solvers::at_energy(condensed, backbone, energy - step);
      contact::MultiplierUpdate outer(std::vector<double>(unknowns, penalty), {penalty});
      state.ResumeTiming();
      const auto point = mode.solve(energy, outer, {start.amplitudes, start.force});
      if (!point.accepted()) state.SkipWithError(std::string(to_string(point.status)).c_str());
      newton += point.newton_iterations();
    }
  }
  const auto dense_points = double(study.dense_energies.size());
  state.counters["newton_a_point"] = newton / dense_points;
  state.counters["parts"] = double(backbone.size()) / dense_points;
}

BENCHMARK_CAPTURE(mode_backbone, rod, rod)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(dense_mode_backbone, rod, rod)->Repetitions(1)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(mode_backbone, blade, blade)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(dense_mode_backbone, blade, blade)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1)
    ->Repetitions(1);

}  // namespace
}  // namespace wavebalance::bench
