#include "limits.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace wavebalance::bench {
namespace {

double counter(const benchmark::BenchmarkReporter::Run& run, const std::string& name) {
  const auto found = run.counters.find(name);
  return found == run.counters.end() ? 0.0 : double(found->second);
}

std::string short_text(double ratio) {
  char text[32];
  std::snprintf(text, sizeof text, ratio < 10.0 ? "%.1f" : "%.0f", ratio);
  return text;
}

}  // namespace

void set_work(benchmark::State& state, double flops, double bytes) {
  state.counters["flops"] = flops;
  state.counters["bytes"] = bytes;
}

void LimitReporter::ReportRuns(const std::vector<Run>& runs) {
  std::vector<Run> shown;
  for (const Run& run : runs)
    if (runs.size() == 1 || run.aggregate_name == "median") shown.push_back(run);
  ConsoleReporter::ReportRuns(shown);
  for (const Run& run : runs) {
    if (run.run_type != Run::RT_Iteration) continue;
    if (run.error_occurred) throw std::runtime_error(run.benchmark_name() + ": " + run.error_message);
    const double seconds = run.cpu_accumulated_time / double(run.iterations);
    const std::string& kernel = run.run_name.function_name;
    const std::string& size = run.run_name.args;
    const auto same = std::find_if(measured_.begin(), measured_.end(), [&](const Measured& one) {
      return one.kernel == kernel && one.size == size;
    });
    if (same != measured_.end())
      same->seconds = std::min(same->seconds, seconds);
    else
      measured_.push_back({kernel, size, seconds, counter(run, "flops"), counter(run, "bytes")});
  }
}

double LimitReporter::flop_rate() const {
  double rate = 0.0;
  for (const Measured& one : measured_)
    if (one.kernel == "dense_lu") rate = std::max(rate, one.flops / one.seconds);
  return rate;
}

// The time of the copy nearest in size: what fits into a cache is copied faster than what does not.
double LimitReporter::copy_seconds(double bytes) const {
  const Measured* nearest = nullptr;
  const auto distance = [bytes](const Measured& one) { return std::abs(std::log(one.bytes / bytes)); };
  for (const Measured& one : measured_)
    if (one.kernel == "copy" && (nearest == nullptr || distance(one) < distance(*nearest))) nearest = &one;
  return nearest == nullptr ? 0.0 : nearest->seconds * bytes / nearest->bytes;
}

app::Table LimitReporter::table() const {
  app::Table table({"kernel", "size", "seconds", "flops", "bytes", "limit_seconds", "limited_by", "ratio"});
  const double rate = flop_rate();
  for (const Measured& one : measured_) {
    const double computing = rate > 0.0 ? one.flops / rate : 0.0;
    const double copying = one.bytes > 0.0 ? copy_seconds(one.bytes) : 0.0;
    const double limit = std::max(computing, copying);
    table.append_row({one.kernel, one.size, one.seconds, one.flops, one.bytes, limit,
                      std::string(computing > copying ? "flops" : "bytes"), one.seconds / limit});
  }
  return table;
}

app::Figure ratio_figure(const app::Table& table) {
  using Align = app::TextMark::Align;
  const std::vector<double> ratios = table.numbers("ratio");
  const std::vector<std::string> kernels = table.texts("kernel"), sizes = table.texts("size");
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < ratios.size(); ++i)
    if (kernels[i] != "copy" && kernels[i] != "dense_lu") rows.push_back(i);
  app::Figure figure;
  figure.panel_width = 900;
  figure.panel_height = 80 + 22 * static_cast<int>(rows.size());
  app::Panel& panel =
      figure.add_panel("Time of the kernels over their limit (kernel, size: time over limit)");
  constexpr double names = 0.006, bars = 0.2;
  const double largest = *std::max_element(ratios.begin(), ratios.end());
  panel.x = {"Measured time over limit", names, 3.0 * largest, true, {1.0, 10.0, 100.0, 1000.0}, {}, ""};
  panel.y = {"", 0.0, double(rows.size()) + 1.0, false, {-1.0}, {}, ""};  // no tick in sight
  panel.mark_x(1.0);
  for (std::size_t j = 0; j < rows.size(); ++j) {
    const double y = double(rows.size() - j), ratio = ratios[rows[j]];
    panel.rectangles.push_back({bars, y - 0.35, ratio, y + 0.35, app::Colour::blue, 0.6});
    panel.texts.push_back(
        {0.9 * bars, y, app::plain(kernels[rows[j]] + "  " + sizes[rows[j]]), Align::right});
    panel.texts.push_back({1.1 * std::max(ratio, 1.0), y, short_text(ratio), Align::left});
  }
  return figure;
}

}  // namespace wavebalance::bench
