#include "impacts/flight.hpp"

#include <algorithm>
#include <cmath>

#include "linalg/index.hpp"
#include "linalg/root.hpp"

namespace wavebalance::solvers::detail {
namespace {

// A cell is halved at most so often: instants are then known to rounding.
constexpr int deepest_cell = 50;

// The largest of u + v s + a s^2 / 2 for 0 <= s <= h.
double largest_of_parabola(double u, double v, double a, double h) {
  const double ends = std::max(u, u + h * (v + 0.5 * h * a));
  if (a < 0.0 && v > 0.0 && v < -a * h) return std::max(ends, u - 0.5 * v * v / a);
  return ends;
}

}  // namespace

Flight::Flight(const ImpactModel& model, Eigen::VectorXcd state, double begin, double length, double allowed)
    : model_(model), state_(std::move(state)), begin_(begin), length_(length), allowed_(allowed) {
  const double fastest = model.poles() > 0 ? model.exponents().real().maxCoeff() : 0.0;
  growth_ = std::max(fastest, 0.0);
}

const Eigen::VectorXcd& Flight::halved(int level) {
  while (static_cast<int>(factors_.size()) <= level)
    factors_.push_back(model_.growth(std::ldexp(length_, -static_cast<int>(factors_.size()))));
  return factors_[static_cast<std::size_t>(level)];
}

Eigen::VectorXcd Flight::state_at(double seconds) const {
  return model_.growth(seconds).cwiseProduct(state_);
}

ContactsAt Flight::motion_at(double seconds) const {
  return model_.motion(state_at(seconds), begin_ + seconds / model_.period());
}

Flight::Verdict Flight::verdict(int contact, const ContactsAt& at, double third, double cell) const {
  const double u = at.displacement[contact] - model_.gaps()[contact], v = at.velocity[contact],
               a = at.acceleration[contact];
  if (largest_of_parabola(u, v, a, cell) + third * cell * cell * cell / 6.0 <= allowed_)
    return Verdict::clear;
  const double slowest = std::min(v, v + a * cell) - 0.5 * third * cell * cell;
  return slowest > 0.0 ? Verdict::rises : Verdict::unknown;
}

Touch Flight::first_touch() { return in_cell(state_, 0.0, 0); }

// A cell begins at `from` with a state, and ends a share 2^-level of the flight later.
Touch Flight::in_cell(const Eigen::VectorXcd& state, double from, int level) {
  const double cell = std::ldexp(length_, -level);
  const ContactsAt at = model_.motion(state, begin_ + from / model_.period());
  Eigen::VectorXd third = model_.third_moduli() * state.cwiseAbs();
  third = third * std::exp(growth_ * cell) + model_.free_third();
  Touch touch;
  bool unknown = false;
  for (int c = 0; c < model_.contacts(); ++c) {
    const Verdict verdict = this->verdict(c, at, third[c], cell);
    unknown = unknown || verdict == Verdict::unknown;
    if (verdict != Verdict::rises) continue;
    const double time = crossing(c, from, from + cell);
    if (!(time <= from + cell)) continue;
    if (touch.kind == Touch::Kind::none || time < touch.time) touch = {Touch::Kind::touches, c, time};
  }
  if (!unknown) return touch;
  if (level == deepest_cell) return {Touch::Kind::unresolved, -1, from};
  touch = in_cell(state, from, level + 1);
  if (touch.kind != Touch::Kind::none) return touch;
  return in_cell(halved(level + 1).cwiseProduct(state), from + 0.5 * cell, level + 1);
}

// Where a contact that rises throughout a cell reaches its gap: by Newton's method within a bracket. Infinite
// where it ends at most as far above the gap as is allowed.
double Flight::crossing(int contact, double from, double to) const {
  constexpr int most_steps = 100;
  const double gap = model_.gaps()[contact];
  ContactsAt at = motion_at(to);
  if (at.displacement[contact] - gap <= allowed_) return std::numeric_limits<double>::infinity();
  double low = from, high = to, time = to;
  for (int step = 0; step < most_steps; ++step) {
    const double above = at.displacement[contact] - gap;
    (above > 0.0 ? high : low) = time;
    double next = time - above / at.velocity[contact];
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (above == 0.0 || next == time || high - low <= 1e-16 * (high + model_.period())) break;
    time = next;
    at = motion_at(time);
  }
  return time;
}

Flight::Peak Flight::peak_after(const Touch& touch) const {
  constexpr int samples = 512;
  const double gap = model_.gaps()[touch.contact];
  Peak best{0.0, touch.time};
  bool inside = false;
  for (int k = 1; k <= samples; ++k) {
    const double time = touch.time + (length_ - touch.time) * k / samples;
    const double height = motion_at(time).displacement[touch.contact] - gap;
    if (inside && height <= 0.0) break;
    inside = inside || height > 0.0;
    if (height > best.height) best = {height, time};
  }
  const double step = (length_ - touch.time) / samples;
  const double low = std::max(touch.time, best.time - step), high = std::min(length_, best.time + step);
  const auto velocity = [&](double time) { return motion_at(time).velocity[touch.contact]; };
  const auto top = root(velocity, {low, velocity(low)}, {high, velocity(high)}, 1e-12);
  if (!top) return best;
  const double height = motion_at(*top).displacement[touch.contact] - gap;
  return height > best.height ? Peak{height, *top} : best;
}

}  // namespace wavebalance::solvers::detail
