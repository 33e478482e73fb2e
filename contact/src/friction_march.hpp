#pragma once
#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "wavebalance/contact/coulomb_law.hpp"

namespace wavebalance::contact::detail {

using Pair = std::array<double, 2>;
using Matrix = std::array<Pair, 2>;  // rows; of one tangent only [0][0] counts

/// A step of the tangential force: what it begins with and what happens in it.
struct ReturnStep {
  Pair force{};            // N, before
  Pair increment{};        // N, of a stuck contact
  double first_limit = 0;  // N
  double last_limit = 0;   // N
};

/// The result and its derivatives.
struct ReturnResult {
  Pair force{};
  FrictionState state = FrictionState::open;
  double mean_limit = 0.0;  // N, while it slips
  Matrix by_force{}, by_increment{};
  Pair by_first_limit{}, by_last_limit{};
};

/// The return mapping of a step of one or two tangents. Derivatives are computed on request.
ReturnResult return_mapping(const ReturnStep& step, int tangents, bool with_slopes);

/// The derivative of a tangential force by displacements, as a list of those that count.
class Memory {
 public:
  struct Entry {
    int displacement;
    Pair slope;  // N/m, of both components
  };
  /// Entries below `negligible` (N/m) are dropped.
  explicit Memory(double negligible) : negligible_(negligible) {}

  const std::vector<Entry>& entries() const { return entries_; }
  void clear() { entries_.clear(); }
  /// Multiplies all from the left.
  void turn(const Matrix& by);
  void add(int displacement, const Pair& slope);
  void drop_small();

 private:
  double negligible_;
  std::vector<Entry> entries_;
};

/// Goes over the samples of a period, as often as requested, with the present tangential force.
class FrictionMarch {
 public:
  FrictionMarch(const CoulombLaw& law, int points, std::span<const double> displacement, bool with_slopes);

  /// The force and its derivative before the first sample, at the position `slider` of the slider.
  void begin(const Pair& slider);
  /// One period; records it where `record` is given.
  void period(FrictionPeriod* record);

  const Pair& force() const { return force_; }
  void set_force(const Pair& force) { force_ = force; }
  /// Whether the contact neither slipped nor opened in the last period.
  bool stuck() const { return stuck_; }
  /// Within the limit at the end of the period.
  Pair within_limit(const Pair& force) const;
  /// By how much the force before the period is to change for a force that is `defect` larger after it.
  Pair closed_change(const Pair& defect) const;
  /// Begins the derivative anew, without memory, or completes it for a periodic force.
  void forget() { memory_.clear(); }
  void close_memory();

 private:
  struct Closing {  // the share of a step after closing, and its slopes by the normal displacements
    double share = 1.0, by_now = 0.0, by_before = 0.0;
  };
  int before(int sample) const { return sample > 0 ? sample - 1 : points_ - 1; }
  int tangent_at(std::size_t tangent, int sample) const {
    return (law_.normal_rows() + static_cast<int>(tangent)) * points_ + sample;
  }
  std::size_t tangents() const { return static_cast<std::size_t>(law_.tangents()); }
  /// The displacement along a tangent.
  double along(std::size_t tangent, int sample) const {
    return u_[static_cast<std::size_t>(tangent_at(tangent, sample))];
  }
  double raw(int sample) const { return raw_[static_cast<std::size_t>(sample)]; }
  double limit(int sample) const { return law_.friction() * std::max(0.0, raw(sample)); }
  double limit_slope(int sample) const;
  Closing closing(int sample) const;
  ReturnStep step_to(int sample, const Closing& closing, Pair& travel) const;
  void follow(int sample, const ReturnResult& result, const Closing& closing, const Pair& travel);
  std::pair<double, double> slip_in(int sample, const ReturnStep& step, const ReturnResult& result) const;
  void note(int sample, const ReturnStep& step, const ReturnResult& result, FrictionPeriod& record) const;

  const CoulombLaw& law_;
  int points_;
  std::span<const double> u_;
  bool with_slopes_;
  std::vector<double> raw_;  // N at the samples, without the bound at zero
  Pair force_{};
  Matrix carried_{};  // the derivative of the force after the last period by that before it
  Memory memory_;
  bool stuck_ = false;
};

}  // namespace wavebalance::contact::detail
