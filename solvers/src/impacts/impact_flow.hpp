#pragma once
#include <Eigen/Core>
#include <vector>

#include "impacts/flight.hpp"
#include "wavebalance/solvers/linalg/missing.hpp"

namespace wavebalance::solvers::detail {

/// A motion with impacts in time, by exact flights of the modes from one impact to the next. Times are in
/// periods of the model; times of events are shifted with each period, so that they keep their digits.
class ImpactFlow {
 public:
  explicit ImpactFlow(const ImpactModel& model);

  /// Begins in a state at time 0; without one where the motion without contact is farthest from the
  /// obstacles, pressed away from those it passes.
  void start(const Eigen::VectorXcd& state);

  struct Event {
    int contact = 0;
    double time = 0.0, impulse = 0.0;
  };
  /// Continues for a period and then shifts time and events back by one period. False if it ends earlier;
  /// end() has the reason.
  bool advance_period();
  ExactStatus end() const { return end_; }
  /// When chattering ends, or lasting contact begins.
  double end_time() const { return end_time_; }
  int end_contact() const { return end_contact_; }

  const Eigen::VectorXcd& state() const { return state_; }
  double time() const { return time_; }
  const std::vector<Event>& events() const { return events_; }
  void forget_before(double time);

 private:
  bool advance_to(double time);
  bool rebound(int contact);
  bool comes_to_rest(double time);

  const ImpactModel& model_;
  Eigen::VectorXcd state_;
  double time_ = 0.0, fastest_ = 0.0;
  std::vector<Event> events_;
  ExactStatus end_ = ExactStatus::not_settled;
  double end_time_ = missing;
  int end_contact_ = -1;
};

}  // namespace wavebalance::solvers::detail
