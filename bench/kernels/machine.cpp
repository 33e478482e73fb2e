#include <Eigen/LU>
#include <cstring>
#include <vector>

#include "limits.hpp"

// Best speed of this machine with plain code: the reference of the kernels.
namespace wavebalance::bench {
namespace {

void copy(benchmark::State& state) {
  const auto half = static_cast<std::size_t>(state.range(0)) / 2;  // read, and written
  std::vector<char> from(half, 1), to(half);
  for (auto _ : state) {
    std::memcpy(to.data(), from.data(), half);
    benchmark::DoNotOptimize(to.data());
    benchmark::ClobberMemory();
  }
  set_work(state, 0.0, 2.0 * double(half));
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
  const auto n = double(size);
  set_work(state, 2.0 / 3.0 * n * n * n, 16.0 * n * n);
}

BENCHMARK(copy)->RangeMultiplier(8)->Range(1 << 10, 1 << 28);
BENCHMARK(dense_lu)->Arg(64)->Arg(256)->Arg(1024)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace wavebalance::bench
