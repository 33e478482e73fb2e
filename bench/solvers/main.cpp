#include <benchmark/benchmark.h>

#include <cstdio>
#include <map>
#include <string>

#include "wavebalance/solvers/linalg/blas_threads.hpp"

namespace {

// Shows the console table, and after it each "dense_X" over its "X": how much slower the assembled system of
// all n (2H + 1) unknowns is in this run.
class RatioReporter final : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs)
      if (!run.error_occurred && run.run_type == Run::RT_Iteration)
        seconds_[bare_name(run)] = run.cpu_accumulated_time / double(run.iterations) * scale(run);
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

 private:
  static std::string bare_name(const Run& run) {
    std::string name = run.benchmark_name();
    const auto suffix = name.find("/iterations:");
    return suffix == std::string::npos ? name : name.substr(0, suffix);
  }
  // A benchmark that does one of many equal parts says how many there are.
  static double scale(const Run& run) {
    const auto parts = run.counters.find("parts");
    return parts == run.counters.end() ? 1.0 : double(parts->second);
  }

  std::map<std::string, double> seconds_;
};

}  // namespace

int main(int argc, char** argv) {
  wavebalance::solvers::use_one_blas_thread();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  RatioReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  return 0;
}
