#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <deque>

#include "period/repetition.hpp"

namespace wavebalance::solvers {

/// The contact displacements of the last periods, the last one first, and whether they repeat.
class PastPeriods {
 public:
  /// rounding, m: displacements with a smaller norm are only rounding.
  PastPeriods(int longest, double tolerance, double rounding = 0.0)
      : longest_(static_cast<std::size_t>(longest)), rule_(longest, tolerance), rounding_(rounding) {}

  void add(const Eigen::MatrixXd& displacement) {
    past_.push_front(displacement);
    if (past_.size() > longest_ + 1) past_.pop_back();
    rule_.add([&](int lag) {
      const double difference = (past_.front() - past_[static_cast<std::size_t>(lag)]).norm();
      return difference == 0.0 ? 0.0 : difference / std::max(past_.front().norm(), rounding_);
    });
  }
  /// The relative rms difference of the last period and that before it.
  double change() const { return rule_.change(); }
  int repeats() const { return rule_.found().periods; }

 private:
  std::size_t longest_;
  std::deque<Eigen::MatrixXd> past_;  // contacts x points
  RepetitionRule rule_;
  double rounding_;
};

}  // namespace wavebalance::solvers
