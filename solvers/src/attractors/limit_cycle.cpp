#include "wavebalance/solvers/attractors/limit_cycle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "flow/flow_start.hpp"
#include "linalg/dense.hpp"
#include "linalg/enum_table.hpp"
#include "linalg/index.hpp"
#include "linalg/option_checks.hpp"
#include "stability/pole_states.hpp"
#include "wavebalance/solvers/flow/contact_flow.hpp"
#include "wavebalance/solvers/flow/exact_motion.hpp"

namespace wavebalance::solvers {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

// The period of the slowest moving pole, the unit of integration until the period of the motion is known.
double slowest_period(const ContactDynamics& dynamics) {
  double slowest = 0.0;
  for (const bool rings : {true, false}) {
    for (const ContactPole& pole : dynamics.poles())
      if (const double rate = std::abs(pole.exponent); rate > 0.0 && (!rings || pole.exponent.imag() != 0.0))
        slowest = std::max(slowest, two_pi / rate);
    if (slowest > 0.0) break;
  }
  return slowest > 0.0 ? slowest : 1.0;
}

// The speed of the surface along each row, m/s.
Eigen::VectorXd surface_speeds(const ExactProblem& problem) {
  Eigen::VectorXd speeds = Eigen::VectorXd::Zero(problem.dynamics.contacts());
  for (int row = 0; row < speeds.size(); row += problem.laws[row].rows())
    if (const auto friction = problem.laws[row].friction())
      speeds[row + problem.laws[row].rows() - 1] = friction->surface_speed;
  return speeds;
}

// A length that motions have: of static loads and friction, gaps, and surfaces that move in a radian.
double typical_length(const ExactProblem& problem, double period) {
  const Eigen::VectorXd speeds = surface_speeds(problem);
  const Eigen::MatrixXcd at_rest =
      problem.dynamics.compliance(0.0, Eigen::VectorXd::Zero(1), false).compliance;
  double length = std::max(problem.linear_motion.col(0).cwiseAbs().maxCoeff(),
                           speeds.cwiseAbs().maxCoeff() * period / two_pi);
  if (const double gap = problem.laws.largest_gap(); std::isfinite(gap)) length = std::max(length, gap);
  for (int row = 0; row < speeds.size(); row += problem.laws[row].rows()) {
    const auto friction = problem.laws[row].friction();
    const Index tangent = row + problem.laws[row].rows() - 1;
    if (!friction) continue;
    const double flexible = std::abs(at_rest(0, tangent * speeds.size() + tangent));
    if (std::isfinite(flexible))
      length = std::max(length, friction->friction * friction->normal_load * flexible);
  }
  return length > 0.0 ? length : 1.0;
}

// Displacements and velocities over 2 pi times the frequency of the contacts, 2 R, at uniform times.
struct Trace {
  std::vector<Eigen::VectorXd> points;
  double step = 0.0;  // s

  // Half the largest peak-to-peak value of any.
  double amplitude() const {
    Eigen::VectorXd least = points.front(), most = least;
    for (const Eigen::VectorXd& point : points) {
      least = least.cwiseMin(point);
      most = most.cwiseMax(point);
    }
    return 0.5 * (most - least).maxCoeff();
  }
  // Where it first passes its beginning again, having left it, s.
  std::optional<double> returns(double near) const;
};

// The distance of a point from the way between two others, and its share of the way.
std::pair<double, double> distance_from_way(const Eigen::VectorXd& point, const Eigen::VectorXd& from,
                                            const Eigen::VectorXd& to) {
  const Eigen::VectorXd way = to - from;
  const double length = way.squaredNorm(),
               share = length > 0.0 ? std::clamp(way.dot(point - from) / length, 0.0, 1.0) : 0.0;
  return {(from + share * way - point).norm(), share};
}

std::optional<double> Trace::returns(double near) const {
  constexpr double away = 0.3;  // of the amplitude
  const double size = amplitude();
  bool left = false;
  double nearest = near * size;
  std::optional<double> time;
  for (std::size_t k = 0; k + 1 < points.size(); ++k) {
    left = left || (points[k] - points.front()).norm() > away * size;
    if (!left) continue;
    const auto [distance, share] = distance_from_way(points.front(), points[k], points[k + 1]);
    if (distance < nearest) {
      nearest = distance;
      time = step * (double(k) + share);
    } else if (time && distance > away * size) {
      return time;
    }
  }
  return time;
}

class CycleSearch {
 public:
  CycleSearch(const ExactProblem& problem, const LimitCycleOptions& options)
      : options_(options),
        period_(slowest_period(problem.dynamics)),
        length_(typical_length(problem, period_)),
        problem_{problem.dynamics, problem.laws, problem.linear_motion.leftCols(1), 1.0 / period_},
        flow_(problem_, {.tolerance = attractor_tolerance, .length = length_}),
        random_(options.seed) {}

  LimitCycle run() {
    if (options_.near.frequency > 0.0) begin_near(options_.near);
    for (int start = 0; start < 2 + options_.random_starts && !done(); ++start) {
      if (start == 1 && surface_speeds(problem_).isZero(0.0)) continue;  // the same as at rest
      ++result_.starts;
      let_go(start);
      follow();
    }
    if (result_.motion.converged() && result_.status != LimitCycleStatus::cancelled)
      result_.status = LimitCycleStatus::converged;
    else if (!done())
      result_.status = result_.motion.parts != nullptr ? LimitCycleStatus::not_solved
                       : result_.grew > 0              ? LimitCycleStatus::grows
                       : result_.lost > 0              ? LimitCycleStatus::no_return
                                                       : LimitCycleStatus::at_rest;
    return std::move(result_);
  }

 private:
  static constexpr double attractor_tolerance = 1e-6, share_of_calm = 0.375;
  enum class End { goes_on, rest, grows, found, lost };

  bool done() const { return cancelled() || (result_.motion.converged() && is_stable_); }
  bool cancelled() const { return result_.status == LimitCycleStatus::cancelled; }

  // Newton's method from a cycle nearby, and where it fails what the motion converges to from there.
  void begin_near(const CycleNearby& near) {
    ++result_.starts;
    const ExactProblem own{problem_.dynamics, problem_.laws, problem_.linear_motion, near.frequency};
    const PeriodStart begin = detail::start_near(own, near.displacement, near.force, share_of_calm);
    const Eigen::VectorXd range =
        near.displacement.rowwise().maxCoeff() - near.displacement.rowwise().minCoeff();
    const End end = take(cycle_near(begin, 1.0 / near.frequency, 0.5 * range.maxCoeff()));
    if (end == End::found || done()) return;
    flow_.start(begin.state, begin.contacts);
    follow();
  }

  // From contacts at rest, from contacts that their surfaces carry, or from a random state.
  void let_go(int start) {
    constexpr double wide = 4.0;  // random states reach from a part of the length to so many times it
    flow_.start();
    if (start == 0) return;
    const std::vector<int> contacts = flow_.contact_states();
    Eigen::VectorXd state = flow_.state();
    const PoleStates poles(problem_.dynamics, period_);
    const Index count = poles.size();
    if (start == 1) {
      const Eigen::MatrixXd moved = poles.free_motion(0.0), speed = poles.free_velocity(0.0);
      Eigen::MatrixXd both(2 * moved.rows(), count);
      both << two_pi / period_ * moved, speed;
      Eigen::VectorXd wanted(both.rows());
      wanted << Eigen::VectorXd::Zero(moved.rows()), surface_speeds(problem_);
      state.head(count) += detail::least_squares(both, wanted);
    } else {
      const Eigen::VectorXd weights = flow_.displacements_by_state();
      std::normal_distribution<double> normal;
      const double size = length_ * wide * double(start - 1) / double(options_.random_starts);
      for (Index i = 0; i < count; ++i)
        if (const double random = normal(random_); weights[i] > 0.0) state[i] += size * random / weights[i];
    }
    flow_.start(state, contacts);
  }

  // Until a limit cycle is found and stable, or the motion ends otherwise.
  void follow() {
    End end = End::goes_on;
    int periods = 0;
    for (int next = 16; end == End::goes_on && !done();
         next = std::min(2 * next, options_.max_periods - periods)) {
      end = next > 0 ? settled_for(next) : End::lost;
      periods += next;
      if (end == End::goes_on) end = watched();
    }
    result_.came_to_rest += end == End::rest;
    result_.grew += end == End::grows;
    result_.lost += end == End::lost || end == End::goes_on;
  }

  End settled_for(int periods) {
    for (int i = 0; i < periods; ++i) {
      ended_ = flow_.advance_period();
      if (ended_ != FlowStatus::converged) return end_of_flow();
      ++result_.periods;
      if (!goes_on(options_.motion.observer, {"limit cycle", int(result_.periods), missing, "periods"})) {
        result_.status = LimitCycleStatus::cancelled;
        return End::goes_on;
      }
    }
    return End::goes_on;
  }

  End end_of_flow() const { return ended_ == FlowStatus::grows ? End::grows : End::lost; }

  // Follows the motion until its outcome is known.
  End watched() {
    constexpr double resting = 1e-7, near = 0.02;
    if (cancelled()) return End::goes_on;
    const PeriodStart begin{0.0, flow_.state(), flow_.contact_states()};
    const auto trace = traced();
    if (!trace) return end_of_flow();
    if (trace->amplitude() < resting * length_) return End::rest;
    const auto repeats = trace->returns(near);
    if (!repeats) return End::goes_on;
    return take(cycle_near(begin, *repeats, trace->amplitude()));
  }

  End take(ExactSolution motion) {
    if (motion.status == ExactStatus::cancelled) result_.status = LimitCycleStatus::cancelled;
    if (motion.parts == nullptr) return End::goes_on;
    is_stable_ = motion.converged() && motion.count_unstable() <= 0;
    if (!result_.motion.converged() || is_stable_) result_.motion = std::move(motion);
    return is_stable_ ? End::found : End::goes_on;
  }

  std::optional<Trace> traced() {
    constexpr int periods = 8, points = 256;
    Trace trace{{}, period_ / points};
    for (int i = 0; i < periods; ++i) {
      ended_ = flow_.advance_period(points, [&](const FlowSample& sample) {
        Eigen::VectorXd point(2 * sample.displacement.size());
        point << sample.displacement, period_ / two_pi * sample.velocity;
        trace.points.push_back(std::move(point));
      });
      if (ended_ != FlowStatus::converged) return std::nullopt;
      ++result_.periods;
    }
    return trace;
  }

  // One that is as large as what was seen, since a state of rest comes back, too.
  ExactSolution cycle_near(const PeriodStart& begin, double repeats, double amplitude) const {
    constexpr double alike = 0.5;
    const ExactProblem own{problem_.dynamics, problem_.laws, problem_.linear_motion, 1.0 / repeats};
    const FlowOptions how{.tolerance = attractor_tolerance, .length = length_};
    ContactFlow flow(own, how);
    flow.start(begin.state, begin.contacts);
    if (flow.advance_period() != FlowStatus::converged) return {};
    const auto start = detail::calmed(own, begin, flow.events(), share_of_calm, how);
    if (!start) return {};
    ExactSolution motion = autonomous_motion_from(own, {0.0, start->state, start->contacts}, options_.motion);
    if (motion.parts == nullptr) return motion;
    const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(256, 0.0, 1.0 - 1.0 / 256.0);
    const Eigen::MatrixXd moved = motion.displacement(times),
                          speed = period_ / two_pi * motion.velocity(times);
    const auto vibration = [](const Eigen::MatrixXd& all) {
      return 0.5 * (all.rowwise().maxCoeff() - all.rowwise().minCoeff()).maxCoeff();
    };
    return std::max(vibration(moved), vibration(speed)) > alike * amplitude ? motion : ExactSolution();
  }

  const LimitCycleOptions& options_;
  double period_, length_;  // s, m
  FlowStatus ended_ = FlowStatus::converged;
  ExactProblem problem_;
  ContactFlow flow_;
  std::mt19937 random_;
  LimitCycle result_;
  bool is_stable_ = false;
};

}  // namespace

std::string_view to_string(LimitCycleStatus status) {
  using enum LimitCycleStatus;
  return detail::name_in<LimitCycleStatus>({{converged, "converged"},
                                            {at_rest, "at_rest"},
                                            {grows, "grows"},
                                            {no_return, "no_return"},
                                            {not_solved, "not_solved"},
                                            {cancelled, "cancelled"}},
                                           status);
}

void LimitCycleOptions::validate() const {
  constexpr const char* who = "LimitCycleOptions";
  detail::require_at_least(who, "random_starts", random_starts, 0);
  detail::require_at_least(who, "max_periods", max_periods, 1);
  motion.validate();
}

LimitCycle limit_cycle(const ExactProblem& problem, const LimitCycleOptions& options) {
  options.validate();
  if (!problem.linear_motion.rightCols(problem.linear_motion.cols() - 1).isZero(0.0))
    throw std::invalid_argument(
        "limit_cycle: linear_motion has harmonics of a periodic load; it must be static");
  for (const Eigen::MatrixXd* rows : {&options.near.displacement, &options.near.force})
    if (options.near.frequency > 0.0 && rows->rows() != problem.dynamics.contacts())
      throw std::invalid_argument("limit_cycle: the cycle nearby has " + std::to_string(rows->rows()) +
                                  " contacts; it must have " + std::to_string(problem.dynamics.contacts()));
  return CycleSearch(problem, options).run();
}

}  // namespace wavebalance::solvers
