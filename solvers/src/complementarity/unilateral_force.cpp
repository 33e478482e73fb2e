#include "complementarity/unilateral_force.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

namespace wavebalance::solvers {
namespace {

using End = ComplementarityPath::End;

// About eight seconds, in which 800 samples in rigid contact arrive, and of those at most two for the last
// attempts: a path that is lost runs through its corners to no avail.
constexpr double most_operations = 7e10, most_operations_unevenly = 1e10;
constexpr int uneven_attempts = 200;

int short_leg(int samples) { return samples / 16 + 50; }
int uneven_leg(int samples) { return samples + 100; }
int long_leg(int samples) { return 10 * samples + 200; }

double largest_finite(const Eigen::VectorXd& values) {
  double largest = 0.0;
  for (const double value : values)
    if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  return largest;
}

}  // namespace

UnilateralForce::UnilateralForce(CondensedProblem& problem, ComplementarityPath::Observer observer)
    : path_(problem),
      largest_compliance_(problem.columns().cwiseAbs().maxCoeff()),
      least_(least_flexibility * largest_compliance_) {
  path_.limit_operations(most_operations);
  if (observer)
    path_.set_observer([this, observer = std::move(observer)](double z) {
      stopped_ = !observer(z);
      return !stopped_;
    });
}

// In units in which openings are about 1, so that products of the largest and the smallest stay in range.
Obstacles UnilateralForce::scaled(const Obstacles& goal, double least) const {
  return {goal.opening / scale_, goal.flexibility.cwiseMax(least)};
}

void UnilateralForce::keep(double flexibility) {
  if (force_.size() != 0 && flexibility >= reached_) return;
  reached_ = flexibility;
  force_ = scale_ * path_.force();
}

bool UnilateralForce::lower(const Obstacles& goal, double flexibility, const Eigen::VectorXd& cover) {
  level_ = std::max(least_, flexibility);
  return !stopped_ && path_.lower(scaled(goal, level_), cover) == End::reached;
}

bool UnilateralForce::arrived(const Obstacles& goal) const {
  return level_ <= least_ || level_ <= goal.flexibility.minCoeff();
}

// From the obstacles of level_ to the goal, by a factor that is reduced to no less than `smallest` where a
// leg does not arrive.
bool UnilateralForce::stiffen(const Obstacles& goal, double factor, double smallest) {
  const double largest = factor;
  for (keep(level_); !arrived(goal); keep(level_)) {
    const ComplementarityPath::State before = path_.state();
    const double next = std::max(least_, level_ / factor);
    if (path_.follow(scaled(goal, next)) == End::reached) {
      level_ = next;
      factor = std::min(largest, factor * std::sqrt(factor));
      continue;
    }
    factor = std::sqrt(factor);
    path_.restore(before);
    if (stopped_ || !path_.may_go_on() || factor < smallest) return false;
  }
  condition_ = path_.condition();
  return true;
}

bool UnilateralForce::even_paths(const Obstacles& goal, const Eigen::VectorXd& even) {
  const int samples = static_cast<int>(even.size());
  const double soft = largest_compliance_;
  path_.set_longest_leg(long_leg(samples));
  if (lower(goal, soft, even)) {
    const ComplementarityPath::State start = path_.state();
    for (const auto& [longer, smallest] : {std::pair{1, 1.2}, {4, 1.2}, {16, 1.2}, {1, 1.02}}) {
      path_.set_longest_leg(longer * short_leg(samples));
      if (stiffen(goal, 3.0, smallest)) return true;
    }
    path_.set_longest_leg(long_leg(samples));
    for (const double factor : {3.0, 10.0, 100.0}) {
      path_.restore(start);
      level_ = std::max(least_, soft);
      if (stiffen(goal, factor, factor)) return true;
    }
  }
  return lower(goal, 0.0, even) && stiffen(goal, 1.0, 1.0);
}

bool UnilateralForce::uneven_paths(const Obstacles& goal, const Eigen::VectorXd& even) {
  path_.set_longest_leg(uneven_leg(static_cast<int>(even.size())));
  path_.limit_operations(most_operations_unevenly);
  std::mt19937 generator(20140817);
  const auto power = [&](double low, double high) {
    return std::pow(10.0, std::uniform_real_distribution<double>(low, high)(generator));
  };
  for (int i = 0; i < uneven_attempts && !stopped_ && path_.may_go_on(); ++i) {
    std::uniform_real_distribution<double> spread(-power(-2.0, -0.3), 0.0);
    const Eigen::VectorXd cover = even.unaryExpr([&](double one) { return one + spread(generator); });
    const double soft = i % 3 == 2 ? 0.0 : largest_compliance_ * power(-3.0, 1.0);
    if (lower(goal, soft, cover) && stiffen(goal, power(0.3, 2.0), 1.5)) return true;
  }
  return false;
}

bool UnilateralForce::solve(const Obstacles& goal) {
  force_.resize(0);
  scale_ = largest_finite(goal.opening);
  if (scale_ == 0.0) scale_ = 1.0;
  const Eigen::VectorXd even = Eigen::VectorXd::Ones(goal.opening.size());
  return even_paths(goal, even) || uneven_paths(goal, even);
}

bool UnilateralForce::follow(const Obstacles& goal) {
  if (stopped_ || path_.follow(scaled(goal, least_)) != End::reached) return false;
  force_ = scale_ * path_.force();
  condition_ = path_.condition();
  return true;
}

}  // namespace wavebalance::solvers
