#include "complementarity/lcp_homotopy.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

namespace wavebalance::solvers {
namespace {

using End = ComplementarityPath::End;

// Pivots that a segment may take.
int short_segment(int samples) { return samples / 16 + 50; }
int random_segment(int samples) { return samples + 100; }
int long_segment(int samples) { return 10 * samples + 200; }

double largest_finite(const Eigen::VectorXd& values) {
  double largest = 0.0;
  for (const double value : values)
    if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  return largest;
}

}  // namespace

LcpHomotopy::LcpHomotopy(CondensedProblem& problem, const ComplementarityOptions& options, Observer observer)
    : options_(options),
      path_(problem),
      largest_compliance_(problem.columns().cwiseAbs().maxCoeff()),
      least_(least_flexibility * largest_compliance_) {
  path_.limit_operations(options_.max_operations);
  if (observer)
    path_.set_observer([this, observer = std::move(observer)](double height) {
      cancelled_ = !observer({"lowering the obstacle", path_.pivots(), height, "height over the first"});
      return !cancelled_;
    });
}

SolveStatus LcpHomotopy::status() const {
  if (strategy_ != Strategy::none) return SolveStatus::converged;
  if (cancelled_) return SolveStatus::cancelled;
  return path_.has_operations_left() ? SolveStatus::stalled : SolveStatus::effort_limit;
}

// Scales gaps and forces by a length, so that gaps are about 1 and products do not overflow or underflow.
Obstacles LcpHomotopy::scaled(const Obstacles& goal, double least) const {
  return {goal.gap_without_force / scale_, goal.flexibility.cwiseMax(least)};
}

void LcpHomotopy::keep(double flexibility) {
  if (force_.size() != 0 && flexibility >= reached_) return;
  reached_ = flexibility;
  force_ = scale_ * path_.force();
}

bool LcpHomotopy::lower(const Obstacles& goal, double flexibility, const Eigen::VectorXd& covering_vector) {
  level_ = std::max(least_, flexibility);
  return !cancelled_ && path_.lower(scaled(goal, level_), covering_vector) == End::reached;
}

bool LcpHomotopy::is_stiff_enough(const Obstacles& goal) const {
  return level_ <= least_ || level_ <= goal.flexibility.minCoeff();
}

// Stiffens the obstacle from level_ to the goal, dividing the flexibility by `factor`; when a segment fails
// the factor is square-rooted, down to `smallest`.
bool LcpHomotopy::stiffen(const Obstacles& goal, double factor, double smallest) {
  const double largest = factor;
  for (keep(level_); !is_stiff_enough(goal); keep(level_)) {
    const ComplementarityPath::State before = path_.state();
    const double next = std::max(least_, level_ / factor);
    if (path_.follow(scaled(goal, next)) == End::reached) {
      level_ = next;
      factor = std::min(largest, factor * std::sqrt(factor));
      continue;
    }
    factor = std::sqrt(factor);
    path_.restore(before);
    if (cancelled_ || !path_.has_operations_left() || factor < smallest) return false;
  }
  condition_ = path_.condition();
  return true;
}

// Paths with obstacles of the same height at all samples.
Strategy LcpHomotopy::even_paths(const Obstacles& goal, const Eigen::VectorXd& even) {
  struct Segments {
    Strategy strategy;
    int length;  // pivots allowed, in short segments
    double smallest_factor;
  };
  const int samples = static_cast<int>(even.size());
  const double soft = largest_compliance_;
  path_.set_max_segment(long_segment(samples));
  if (lower(goal, soft, even)) {
    const ComplementarityPath::State start = path_.state();
    for (const auto& [strategy, length, smallest] : {Segments{Strategy::soft_obstacle, 1, 1.2},
                                                     {Strategy::long_segments, 4, 1.2},
                                                     {Strategy::small_factors, 1, 1.02}}) {
      path_.set_max_segment(length * short_segment(samples));
      if (stiffen(goal, 3.0, smallest)) return strategy;
    }
    path_.set_max_segment(long_segment(samples));
    path_.restore(start);
    level_ = std::max(least_, soft);
    if (stiffen(goal, 10.0, 10.0)) return Strategy::fixed_factor;
  }
  return lower(goal, 0.0, even) && stiffen(goal, 1.0, 1.0) ? Strategy::stiff_obstacle : Strategy::none;
}

// Paths with obstacles whose height varies at random from sample to sample. Initial flexibility and factor
// are random, too.
Strategy LcpHomotopy::random_paths(const Obstacles& goal, const Eigen::VectorXd& even) {
  path_.set_max_segment(random_segment(static_cast<int>(even.size())));
  path_.limit_operations(options_.max_random_operations);
  std::mt19937 generator(20140817);
  const auto power = [&](double low, double high) {
    return std::pow(10.0, std::uniform_real_distribution<double>(low, high)(generator));
  };
  for (int i = 0; i < options_.max_random_paths && !cancelled_ && path_.has_operations_left(); ++i) {
    std::uniform_real_distribution<double> spread(-power(-2.0, -0.3), 0.0);
    const Eigen::VectorXd covering_vector =
        even.unaryExpr([&](double one) { return one + spread(generator); });
    const double soft = i % 3 == 2 ? 0.0 : largest_compliance_ * power(-3.0, 1.0);
    if (lower(goal, soft, covering_vector) && stiffen(goal, power(0.3, 2.0), 1.5))
      return Strategy::random_obstacles;
  }
  return Strategy::none;
}

bool LcpHomotopy::solve(const Obstacles& goal) {
  force_.resize(0);
  scale_ = largest_finite(goal.gap_without_force);
  if (scale_ == 0.0) scale_ = 1.0;
  const Eigen::VectorXd even = Eigen::VectorXd::Ones(goal.gap_without_force.size());
  strategy_ = even_paths(goal, even);
  if (strategy_ == Strategy::none) strategy_ = random_paths(goal, even);
  return strategy_ != Strategy::none;
}

bool LcpHomotopy::follow(const Obstacles& goal) {
  if (cancelled_ || path_.follow(scaled(goal, least_)) != End::reached) return false;
  force_ = scale_ * path_.force();
  condition_ = path_.condition();
  return true;
}

}  // namespace wavebalance::solvers
