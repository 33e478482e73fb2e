#include <benchmark/benchmark.h>

#include <Eigen/LU>
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <map>
#include <string>

#include "speeds.hpp"
#include "wavebalance/solvers/linalg/blas_threads.hpp"
#include "wavebalance/spectral/fft.hpp"

namespace wavebalance::bench {
namespace {

// Work of libraries only, of the kinds that a solve consists of: a dense LU and transforms.
constexpr auto yardstick_name = "yardstick";
void yardstick(benchmark::State& state) {
  constexpr int size = 120, points = 4096;
  const Eigen::MatrixXd matrix = Eigen::MatrixXd::Random(size, size);
  spectral::RealFft fft(points);
  const Eigen::VectorXd samples = Eigen::VectorXd::Random(points);
  Eigen::VectorXcd spectrum(fft.harmonics());
  for (auto _ : state) {
    benchmark::DoNotOptimize(matrix.partialPivLu().matrixLU().data());
    for (int i = 0; i < 10; ++i) {
      fft.forward({samples.data(), points}, {spectrum.data(), static_cast<std::size_t>(spectrum.size())});
      benchmark::DoNotOptimize(spectrum.data());
    }
  }
}
BENCHMARK(yardstick)->Unit(benchmark::kMicrosecond);

// A benchmark of one of many equal parts reports their number.
double parts(const benchmark::BenchmarkReporter::Run& run) {
  const auto found = run.counters.find("parts");
  return found == run.counters.end() ? 1.0 : double(found->second);
}

// The name without the numbers of iterations and repetitions.
std::string bare_name(const benchmark::BenchmarkReporter::Run& run) {
  std::string name = run.benchmark_name();
  for (const char* suffix : {"/iterations:", "/repeats:"}) name = name.substr(0, name.find(suffix));
  return name;
}

// Shows the console table, and after it each "dense_X" over its "X": how much slower the assembled system
// of all n (2H + 1) unknowns is in this run. The quickest repetition counts.
class RatioReporter final : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs) {
      if (run.error_occurred || run.run_type != Run::RT_Iteration) continue;
      const double seconds = run.cpu_accumulated_time / double(run.iterations) * parts(run);
      const auto [place, added] = seconds_.emplace(bare_name(run), seconds);
      if (!added) place->second = std::min(place->second, seconds);
    }
  }

  void Finalize() override {
    const std::string prefix = "dense_";
    std::printf("\ndense baseline / condensed solver\n");
    for (const auto& [name, dense] : seconds_) {
      if (name.rfind(prefix, 0) != 0) continue;
      const auto own = seconds_.find(name.substr(prefix.size()));
      if (own == seconds_.end()) continue;
      std::printf("  %-40s %10.4g s / %10.4g s = %8.0f\n", own->first.c_str(), dense, own->second,
                  dense / own->second);
    }
    ConsoleReporter::Finalize();
  }

  // The speeds of all but the baselines; empty without the yardstick.
  Speeds speeds() const {
    Speeds result;
    const auto unit = seconds_.find(yardstick_name);
    if (unit == seconds_.end()) return result;
    for (const auto& [name, seconds] : seconds_)
      if (name.rfind("dense_", 0) != 0 && name != yardstick_name) result[name] = unit->second / seconds;
    return result;
  }

 private:
  std::map<std::string, double> seconds_;
};

// Two runs of one build differ by less than this on a machine with other work.
constexpr double noise = 1.3;

// The value after `option`, removed from the arguments; empty without it.
std::filesystem::path take_option(int& argc, char** argv, const char* option) {
  const std::size_t length = std::strlen(option);
  for (int i = 1; i < argc; ++i) {
    if (std::strncmp(argv[i], option, length) != 0) continue;
    const std::filesystem::path value = argv[i] + length;
    std::copy(argv + i + 1, argv + argc, argv + i);
    --argc;
    return value;
  }
  return {};
}

int run(int argc, char** argv) {
  solvers::use_one_blas_thread();
  const auto reference = take_option(argc, argv, "--reference="),
             output = take_option(argc, argv, "--speeds=");
  const Speeds before = reference.empty() ? Speeds{} : speeds_of(app::read_csv(reference));
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  RatioReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  if (!output.empty()) app::write_csv(output, table_of(reporter.speeds()));
  if (!reference.empty()) std::printf("\n%s", report(before, reporter.speeds(), noise).c_str());
  return 0;
}

}  // namespace
}  // namespace wavebalance::bench

int main(int argc, char** argv) try {
  return wavebalance::bench::run(argc, argv);
} catch (const std::exception& error) {
  std::fprintf(stderr, "wavebalance_bench: %s\n", error.what());
  return 2;
}
