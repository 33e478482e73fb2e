#include "drawing/figures.hpp"

#include "wavebalance/app/scene/contacts.hpp"

namespace wavebalance::app {
namespace {

/// At which instants the contact that leads is closed; at the nearest ones of its impacts.
std::vector<bool> closed_instants(const Response& response) {
  const Eigen::VectorXd force = response.force();
  std::vector<bool> closed(std::size_t(force.size()));
  for (Eigen::Index i = 0; i < force.size(); ++i) closed[std::size_t(i)] = force[i] != 0.0;
  if (closed.empty()) return closed;
  for (const solvers::Impact& one : response.struck)
    if (one.contact == response.contact)
      closed[std::size_t(std::floor(one.time * double(closed.size()))) % closed.size()] = true;
  return closed;
}

/// The longest cyclic run of false, as its first index and its length; nothing of a run of all.
std::pair<std::size_t, std::size_t> longest_open_run(const std::vector<bool>& closed) {
  std::pair<std::size_t, std::size_t> longest{0, 0};
  const std::size_t n = closed.size();
  for (std::size_t begin = 0; begin < n; ++begin) {
    if (closed[begin] || !closed[(begin + n - 1) % n]) continue;
    std::size_t length = 1;
    while (length < n && !closed[(begin + length) % n]) ++length;
    if (length > longest.second) longest = {begin, length};
  }
  return longest;
}

}  // namespace

PeriodWindow::PeriodWindow(const Response& response)
    : periods_(response.periods), repeats_(!response.recorded) {
  if (!repeats_) return;
  const std::vector<bool> closed = closed_instants(response);
  const auto [begin, length] = longest_open_run(closed);
  const std::size_t n = closed.size();
  // A force that passes zero is no opening.
  constexpr double shortest = 0.02;
  if (double(length) < shortest * double(n) || length == 0) return;
  const double middle = (double(begin) + 0.5 * double(length)) / double(n);
  const double tenth = std::round(10.0 * middle) / 10.0;
  const bool is_open = std::abs(tenth - middle) < 0.25 * double(length) / double(n);
  const double at = std::floor((is_open ? tenth : middle) * double(n)) / double(n);
  start_ = at >= 0.5 ? at - 1.0 : at;
}

Axis PeriodWindow::axis() const {
  const std::string what = periods_ == 1 ? "a period" : std::to_string(periods_) + " forcing periods";
  return {.label = "Time (fraction of " + what + ")",
          .lower = start_,
          .upper = start_ + 1.0,
          .ticks = {},
          .tick_texts = {},
          .tick_format = "%.1f"};
}

Series PeriodWindow::curve(const Eigen::VectorXd& values) const {
  const Eigen::Index n = values.size();
  const auto first = static_cast<Eigen::Index>(std::llround(start_ * double(n)));
  const Eigen::Index points = repeats_ ? n + 1 : n;
  Eigen::VectorXd times(points), rotated(points);
  for (Eigen::Index l = 0; l < points; ++l) {
    times[l] = double(first + l) / double(n);
    rotated[l] = values[(first + l + n) % n];
  }
  return Series("", times, rotated);
}

double PeriodWindow::instant(double fraction) const { return fraction - std::floor(fraction - start_); }

std::vector<std::pair<double, double>> PeriodWindow::spans(double begin, double end) const {
  const double from = instant(begin), to = from + std::min(end - begin, 1.0), last = start_ + 1.0;
  if (to <= last) return {{from, to}};
  return {{from, last}, {start_, to - 1.0}};
}

Eigen::VectorXd once_around(const Eigen::MatrixXd& rows, int row, double factor) {
  Eigen::VectorXd values(rows.cols() + 1);
  values << factor * rows.row(row).transpose(), factor * rows(row, 0);
  return values;
}

std::vector<std::pair<double, double>> contact_spans(const Scene& scene, const Response& response,
                                                     const PeriodWindow& window) {
  std::vector<std::pair<double, double>> spans;
  if (!response.exact || response.exact->motion.parts == nullptr) return spans;
  const solvers::ExactSolution& motion = response.exact->motion;
  double closed = 0.0;
  const auto add = [&](double begin, double end) {
    closed += end - begin;
    for (const auto& span : window.spans(begin, end)) spans.push_back(span);
  };
  const std::vector<SceneContact> places = contact_places(scene);
  const int number = places.at(std::size_t(response.contact)).number;
  for (const solvers::FrictionAlong& one : motion.friction)
    for (const solvers::FrictionPart& part : one.parts)
      if (places.at(std::size_t(one.row)).number == number &&
          part.state != solvers::FrictionPart::State::open)
        add(part.begin, part.end);
  if (motion.friction.empty())
    for (const solvers::ForceInterval& interval : motion.intervals)
      if (interval.contact == response.contact) add(interval.begin, interval.end);
  constexpr double always = 1.0 - 1e-9;
  if (closed > always) spans.clear();
  return spans;
}

}  // namespace wavebalance::app
