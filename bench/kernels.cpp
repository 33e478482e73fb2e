#include <benchmark/benchmark.h>

#include <Eigen/LU>

#include "solver_scenes.hpp"
#include "wavebalance/solvers/contact_system.hpp"
#include "wavebalance/spectral/fft.hpp"

// The parts of one Newton step, each for growing sizes.
namespace wavebalance::bench {
namespace {

void condensation(benchmark::State& state) {
  const Case scene = jl14_case(2);
  auto problem =
      fourier_problem(scene, static_cast<int>(state.range(0)), 4 * static_cast<int>(state.range(0)));
  for (auto _ : state) {
    problem.set_frequency(scene.frequency);
    benchmark::DoNotOptimize(problem.free_response().data());
  }
}

void fft_pair(benchmark::State& state) {
  spectral::RealFft fft(static_cast<int>(state.range(0)));
  std::vector<double> samples(static_cast<std::size_t>(state.range(0)), 1.0);
  std::vector<std::complex<double>> spectrum(static_cast<std::size_t>(fft.harmonics()));
  for (auto _ : state) {
    fft.forward(samples, spectrum);
    fft.inverse(spectrum, samples);
    benchmark::DoNotOptimize(samples.data());
    samples.assign(samples.size(), 1.0);
  }
}

void compliance_product(benchmark::State& state) {
  const Case scene = jl14_case(2);
  const int points = static_cast<int>(state.range(0));
  auto problem = fourier_problem(scene, points / 4 - 1, points);
  problem.set_frequency(scene.frequency);
  const Eigen::VectorXd force = Eigen::VectorXd::Random(points);
  Eigen::VectorXd displacement(points);
  for (auto _ : state) {
    problem.apply(force, displacement);
    benchmark::DoNotOptimize(displacement.data());
  }
}

void newton_matrix(benchmark::State& state) {
  const Case scene = jl14_case(1);
  const int points = static_cast<int>(state.range(0));
  auto problem = fourier_problem(scene, points / 4 - 1, points);
  problem.set_frequency(scene.frequency);
  solvers::ContactSystem system(problem, scene.law());
  system.evaluate(problem.free_response());
  for (auto _ : state) benchmark::DoNotOptimize(system.factorize());
  state.counters["active"] = double((system.tangent().array() != 0.0).count());
}

void dense_lu(benchmark::State& state) {
  const auto size = static_cast<Eigen::Index>(state.range(0));
  const Eigen::MatrixXd matrix =
      Eigen::MatrixXd::Random(size, size) + double(size) * Eigen::MatrixXd::Identity(size, size);
  Eigen::PartialPivLU<Eigen::MatrixXd> lu(size);
  for (auto _ : state) {
    lu.compute(matrix);
    benchmark::DoNotOptimize(lu.matrixLU().data());
  }
  state.counters["flops"] = benchmark::Counter(2.0 / 3.0 * double(size * size * size),
                                               benchmark::Counter::kIsIterationInvariantRate);
}

BENCHMARK(condensation)->Arg(63)->Arg(255)->Arg(1023)->Unit(benchmark::kMicrosecond);
BENCHMARK(fft_pair)->Arg(256)->Arg(1024)->Arg(4096)->Unit(benchmark::kMicrosecond);
BENCHMARK(compliance_product)->Arg(256)->Arg(1024)->Arg(4096)->Unit(benchmark::kMicrosecond);
BENCHMARK(newton_matrix)->Arg(256)->Arg(1024)->Unit(benchmark::kMicrosecond);
BENCHMARK(dense_lu)->Arg(64)->Arg(256)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace wavebalance::bench
