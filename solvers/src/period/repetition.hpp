#pragma once
#include <deque>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace wavebalance::solvers {

/// After how many periods a motion repeats.
struct Repetition {
  int periods = 0;                                         ///< 0 for none
  double apart = std::numeric_limits<double>::infinity();  ///< the least distance of two of these periods
};

/// Finds the number of periods after which a motion repeats. It is the least p for which the last period
/// agrees to a tolerance with that p before. For p > 1 any two of the last p periods must differ a hundred
/// times as much as these two, after a transient, and as much as they did 16 or more periods before: a motion
/// that spirals towards one of fewer periods comes near past periods, too, and nearer ones later. Distances
/// are relative.
class RepetitionRule {
 public:
  RepetitionRule(int longest, double tolerance) : longest_(longest), tolerance_(tolerance) {}

  /// The distances of the next period to those before it that it may repeat, the latest first.
  template <class Distance>
  void add(Distance&& to_the_one_before) {
    std::vector<double> distances;
    for (int lag = 1; lag <= longest_ && lag <= count_; ++lag) distances.push_back(to_the_one_before(lag));
    add_distances(std::move(distances));
  }

  /// The distance of the last period to that before it; infinite of the first.
  double change() const;
  Repetition found() const;

 private:
  void add_distances(std::vector<double> distances);
  double least_distance(int periods, int before) const;
  std::optional<Repetition> steady(int periods) const;

  int longest_;
  double tolerance_;
  int count_ = 0;
  std::deque<std::vector<double>> distances_;  // by periods, the last one first
};

}  // namespace wavebalance::solvers
