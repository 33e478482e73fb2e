#pragma once
#include <Eigen/Core>
#include <vector>

#include "impacts/flight.hpp"
#include "wavebalance/solvers/impacts/impact_motion.hpp"

namespace wavebalance::solvers::detail {

/// A motion with impacts in time, by exact flights of the modes from one impact to the next. Times are in
/// periods of the model after t = 0.
class ImpactFlow {
 public:
  ImpactFlow(const ImpactModel& model, int max_impacts);

  /// Begins where the motion without contact is farthest from the obstacles, pressed away from those it
  /// passes.
  void start_clear();
  /// Begins in a state at a time.
  void start(const Eigen::VectorXcd& state, double time);

  struct Event {
    int contact = 0;
    double time = 0.0, impulse = 0.0;
  };
  /// Goes on to a time. False where it ends before, by what end() says.
  bool advance_to(double time);
  ImpactStatus end() const { return end_; }
  double end_time() const { return end_time_; }  ///< when chattering ends, or lasting contact begins
  int end_contact() const { return end_contact_; }

  const Eigen::VectorXcd& state() const { return state_; }
  double time() const { return time_; }
  const std::vector<Event>& events() const { return events_; }  ///< all so far
  void forget_before(double time);

 private:
  bool rebound(int contact);

  const ImpactModel& model_;
  int max_impacts_;
  Eigen::VectorXcd state_;
  double time_ = 0.0, fastest_ = 0.0;
  std::vector<Event> events_;
  ImpactStatus end_ = ImpactStatus::not_settled;
  double end_time_ = missing;
  int end_contact_ = -1;
};

}  // namespace wavebalance::solvers::detail
