#pragma once
#include <benchmark/benchmark.h>

#include <map>
#include <string>
#include <vector>

#include "wavebalance/app/files/table.hpp"
#include "wavebalance/app/plot/plot.hpp"

namespace wavebalance::bench {

/// Lower bounds for one call of a kernel: floating-point operations and bytes moved. Set as counters of its
/// benchmark.
void set_work(benchmark::State& state, double flops, double bytes);

/// Collects a run of Google Benchmark, in which `copy/BYTES` and `dense_lu/SIZE` give this machine's rates.
class LimitReporter final : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override;

  /// kernel, size, seconds, flops, bytes, limit_seconds, limited_by, ratio = seconds / limit_seconds. The
  /// limit is the longer of the operations at the largest rate of dense_lu and the bytes at the rate of the
  /// copy of as many bytes; the copies and factorizations themselves are rows too. Seconds are the least of
  /// the repetitions.
  app::Table table() const;

 private:
  struct Measured {
    std::string kernel, size;
    double seconds, flops, bytes;
  };
  double flop_rate() const;
  double copy_seconds(double bytes) const;

  std::vector<Measured> measured_;
};

/// Ratios of time to limit as bars, a row a kernel and size.
app::Figure ratio_figure(const app::Table& table);

}  // namespace wavebalance::bench
