#include <array>

#include "data_file.hpp"
#include "limits.hpp"
#include "program.hpp"

// Time of the kernels compared with the best of this machine: kernels.csv and its picture.
namespace wavebalance::bench {
namespace {

constexpr const char* about =
    "Measures the parts of a solve beside the limits of this machine: the rate of a dense LU and of a copy.\n"
    "Writes kernels.csv and a picture.";

void run(const Program& program) {
  const std::string min_time = std::string("--benchmark_min_time=") + (program.quick ? "0.0001" : "0.02");
  const std::string repetitions = std::string("--benchmark_repetitions=") + (program.quick ? "1" : "5");
  const std::string filter = program.quick ? "--benchmark_filter=/(25|64|256|1024)$" : "--benchmark_filter=.";
  std::string name = "kernels";
  std::array<std::string, 4> arguments{name, min_time, repetitions, filter};
  std::array<char*, 4> pointers{};
  for (std::size_t i = 0; i < arguments.size(); ++i) pointers[i] = arguments[i].data();
  int count = static_cast<int>(pointers.size());
  benchmark::Initialize(&count, pointers.data());
  LimitReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  const app::Table table = reporter.table();
  write_data(
      program.output, "kernels", table,
      {"Time of the kernels over their limit",
       "seconds of the processor, operations and bytes of one call",
       {},
       {"limit_seconds: the longer of flops at the largest rate of dense_lu and bytes at the rate of the "
        "copy nearest in size, both of this run",
        "flops and bytes: what a kernel cannot do without, see bench/kernels/kernels.cpp"}});
  write_pictures(program.output / "kernels", ratio_figure(table));
}

}  // namespace
}  // namespace wavebalance::bench

int main(int argc, char** argv) {
  return wavebalance::bench::run_program(argc, argv, wavebalance::bench::about, wavebalance::bench::run);
}
