#include "command/commands.hpp"

#include <fmt/format.h>

#include <unistd.h>

#include <cstdio>

namespace wavebalance::app {
namespace {

using namespace std::chrono_literals;

constexpr int bar_width = 24;

std::string bar_text(double fraction) {
  if (std::isnan(fraction)) return "";
  const int filled = static_cast<int>(std::lround(std::clamp(fraction, 0.0, 1.0) * bar_width));
  return "[" + std::string(static_cast<std::size_t>(filled), '#') +
         std::string(static_cast<std::size_t>(bar_width - filled), '.') + "] ";
}

// "frequency sweep: step 12, 1342 Hz"
std::string progress_text(const Progress& progress) {
  std::string text(progress.phase);
  if (progress.step > 0) text += ": step " + std::to_string(progress.step);
  if (std::isnan(progress.value) || progress.measure.empty()) return text;
  const bool common = std::abs(progress.value) >= 1.0 && std::abs(progress.value) < 1e5;
  const std::string number =
      common ? fmt::format("{:.1f}", progress.value) : fmt::format("{:.1e}", progress.value);
  const bool unit = progress.measure.size() <= 3;
  return text + (unit ? fmt::format(", {} {}", number, progress.measure)
                      : fmt::format(", {} {}", progress.measure, number));
}

}  // namespace

ProgressBar::ProgressBar()
    : terminal_(::isatty(STDERR_FILENO) == 1), next_(Clock::now() + (terminal_ ? 500ms : 5s)) {}

ProgressBar::~ProgressBar() { finish(); }

void ProgressBar::show(const Progress& progress) {
  const auto now = Clock::now();
  if (now < next_) return;
  next_ = now + (terminal_ ? 100ms : 10s);
  const std::string text = progress_text(progress);
  if (terminal_)
    std::fprintf(stderr, "\r%s%s\033[K", bar_text(progress.done).c_str(), text.substr(0, 50).c_str());
  else
    std::fprintf(stderr, "%s\n", text.c_str());
  std::fflush(stderr);
  visible_ = terminal_;
}

void ProgressBar::finish() {
  if (visible_) std::fputs("\r\033[K", stderr);
  visible_ = false;
}

}  // namespace wavebalance::app
