#pragma once
#include <deque>
#include <limits>
#include <vector>

#include "impacts/impact_flow.hpp"
#include "wavebalance/solvers/impacts/impact_response.hpp"

namespace wavebalance::solvers::detail {

/// Impacts of a motion in time that nearly repeats after some periods of the load.
struct NearReturn {
  int periods = 1;
  double distance = std::numeric_limits<double>::infinity();
  std::vector<ImpactGuess> impacts;
};

/// Integrates and looks for returns, of which Newton's method makes motions.
class ImpactSearch {
 public:
  /// Both must outlive it.
  ImpactSearch(const ExactProblem& problem, const ImpactResponseOptions& options);

  /// From the state of the options on.
  ImpactResponse run();
  /// Motions near the closest returns of the last run(), of each number of periods, stable or not.
  std::vector<ImpactResponse> near_returns() const;

 private:
  Progress progress() const;
  double distance_after(int periods) const;
  std::vector<ImpactGuess> last_impacts(int periods) const;
  bool look_back();
  bool is_motion(const NearReturn& start);
  ImpactResponse solve(const NearReturn& start) const;
  static void set_multipliers(ImpactResponse& response);
  ImpactResponse resting(ExactStatus status) const;
  ImpactResponse finished(ImpactResponse response) const;
  ImpactResponse ended(ExactStatus status);
  ImpactResponse none(ExactStatus status) const;

  const ExactProblem& problem_;
  const ImpactResponseOptions& options_;
  ImpactModel model_;
  ImpactFlow flow_;
  Eigen::VectorXd weights_;
  std::deque<Eigen::VectorXcd> states_;  // at ends of periods, the last one first
  std::vector<NearReturn> best_;
  std::vector<double> tried_;  // the distance at which Newton's method was last tried
  ImpactResponse found_;
  int period_ = 0;
};

}  // namespace wavebalance::solvers::detail
