#include "wavebalance/solvers/response/refinement.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "linalg/enum_table.hpp"
#include "linalg/option_checks.hpp"
#include "response/error_estimate.hpp"
#include "wavebalance/solvers/time/motion.hpp"
#include "wavebalance/solvers/time/translate_spectrum.hpp"

namespace wavebalance::solvers {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
// Levels with fewer points resolve only motions of a few harmonics.
constexpr int screening_points = 32;
constexpr double point_order = 1.5;  // assumed; sums over forces with kinks converge with order 2
constexpr double asymptotic = 0.03;  // larger errors do not yet decrease with an order

struct Size {
  int functions = 0;
  int points = 0;

  bool operator==(const Size&) const = default;
};

/// The error of the finer of two levels whose sizes differ by `factor`, over their distance.
double remainder_over_distance(double factor, double order) {
  constexpr double safety_factor = 1.5;
  return safety_factor / (std::pow(factor, order) - 1.0);
}

/// The power of two in 1..4 by which a size must grow to reduce an error by the factor `excess`, if it
/// decreases with `order`.
int growth(double excess, double order) {
  if (!(excess > 1.0)) return 1;
  return 1 << std::clamp(static_cast<int>(std::ceil(std::log2(excess) / order)), 1, 2);
}

class Refinement {
 public:
  Refinement(const ProblemFactory& make_problem, const ContactLaws& laws, const RefinementOptions& options)
      : make_problem_(make_problem),
        laws_(laws),
        options_(options),
        size_{options.first_functions, options.first_points},
        odd_(options.first_functions % 2 == 1) {
    options_.solver.observer = options_.observer;
  }

  RefinementResult refine() {
    const auto start = Clock::now();
    while (!step()) {
    }
    result_.estimated_error = result_.levels.back().estimated_error;
    result_.seconds = seconds_since(start);
    return std::move(result_);
  }

 private:
  using Clock = std::chrono::steady_clock;
  static double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
  }

  bool fourier() const {
    const TimePair& pair = result_.problem->pair();
    return pair.trial().band_limited() && pair.weight().band_limited();
  }
  double function_order() const {
    return std::clamp(result_.problem->pair().trial().sobolev_exponent() + 0.5, 1.0, 3.0);
  }

  /// Solves one level; true when it is the last.
  bool step() {
    const auto start = Clock::now();
    RefinementLevel level{size_.functions, size_.points, unknown, unknown, unknown, unknown};
    CondensedProblem problem = make_problem_(size_.functions, size_.points);
    if (problem.pair().first_sample() != 0.0)
      throw std::invalid_argument(
          "response_to_tolerance: the pair has a sample_offset of 0.5; it must be 0, so that levels share the "
          "points of the coarser one");
    PeriodicResponse response = find(problem, level);
    level.residual = response.residual;
    const SolveStatus ended_by = response.status;
    found_ = response.converged();
    if (found_ && solved_) estimate(level, problem, response);
    if (found_ || !solved_) {
      result_.problem = std::move(problem);
      result_.response = std::move(response);
    }
    level.seconds = seconds_since(start);
    if (found_)
      failures_ = 0;
    else if (level.points >= screening_points && !may_step_back())
      ++failures_;
    if (found_) solved_ = level;
    result_.levels.push_back(level);
    const bool cancelled = ended_by == SolveStatus::cancelled || !goes_on(options_.observer, progress(level));
    const std::optional<RefinementStatus> end = ending(cancelled);
    if (end) result_.status = *end;
    return end.has_value();
  }

  /// Whether the structure is known to converge to a motion of the problem's period.
  static bool settles(const CondensedProblem& problem, const PeriodicResponse& response) {
    return response.attractor_periods > 0 && load_periods(problem) % response.attractor_periods == 0;
  }

  Progress progress(const RefinementLevel& level) const {
    const double done = std::log(level.estimated_error) / std::log(options_.tolerance);
    return {"refinement", static_cast<int>(result_.levels.size()), level.estimated_error, "estimated error",
            std::isfinite(done) ? std::clamp(done, 0.0, 1.0) : 0.0};
  }

  /// The motion of these coefficients of the last response at `points` points, contact-major.
  Eigen::VectorXd prolonged(const Eigen::MatrixXcd& coefficients, int points) const {
    TrialEvaluator at_points(result_.problem->pair().trial(), points, 0);
    Eigen::VectorXd u(points * coefficients.cols());
    for (Eigen::Index contact = 0; contact < coefficients.cols(); ++contact)
      u.segment(contact * points, points) = at_points(coefficients.col(contact));
    return u;
  }

  /// `smooth` is the last response's displacement. Next to a sample in contact it is replaced by linear
  /// interpolation, because a stiff law fixes the samples there and the harmonics oscillate between them.
  Eigen::VectorXd straight_in_contact(const Eigen::VectorXd& smooth, int points) const {
    const Eigen::VectorXd& coarse = result_.response.displacement;
    const Eigen::VectorXd& force = result_.response.contact_force;
    const int before = result_.problem->points(), ratio = points / before;
    Eigen::VectorXd u = smooth;
    for (Eigen::Index here = 0; here < coarse.size(); ++here) {
      const Eigen::Index next = (here + 1) % before == 0 ? here + 1 - before : here + 1;
      if (force[here] == 0.0 && force[next] == 0.0) continue;
      for (int m = 0; m < ratio; ++m)
        u[here * ratio + m] = coarse[here] + (coarse[next] - coarse[here]) * m / ratio;
    }
    return u;
  }

  PeriodicResponse from_linear_response(CondensedProblem& problem, RefinementLevel& level, bool paths) {
    ForcedResponseOptions solver = options_.solver;
    solver.fallbacks = paths && solver.fallbacks && level.points >= screening_points;
    PeriodicResponse response = forced_response(problem, laws_, solver);
    level.iterations += response.iterations;
    settles_ = settles_ || settles(problem, response);
    return response;
  }

  /// Whether the next level may start from the previous one.
  bool resolved() const {
    return solved_ && (solved_->points >= screening_points || solved_->change < asymptotic);
  }

  /// Whether there are untried sizes between the previous level and this one.
  bool may_step_back() const {
    return failures_ == 0 && resolved() &&
           (size_.points > 2 * solved_->points || size_.functions > 2 * solved_->functions + 1);
  }

  PeriodicResponse newton_from(CondensedProblem& problem, RefinementLevel& level,
                               const Eigen::VectorXd& displacement, const Eigen::VectorXd& force = {}) const {
    ForcedResponseOptions solver = options_.solver;
    solver.fallbacks = false;
    PeriodicResponse response = forced_response(problem, laws_, solver, displacement, force);
    level.iterations += response.iterations;
    return response;
  }

  /// Newton in the force form from the last response, whose force follows its unknown.
  PeriodicResponse from_previous_force(CondensedProblem& problem, const Eigen::VectorXd& smooth,
                                       RefinementLevel& level) const {
    const PeriodicResponse& before = result_.response;
    const Eigen::VectorXd force =
        laws_.resolvents(before.series_flexibility)
            .force(by_contact(prolonged(before.unknown_coefficients, problem.points()), problem.contacts()))
            .reshaped<Eigen::RowMajor>();
    return newton_from(problem, level, smooth, force);
  }

  /// Newton from the last response with the better of its two prolongations, then with the other one.
  PeriodicResponse from_previous(CondensedProblem& problem, const Eigen::VectorXd& smooth,
                                 RefinementLevel& level) const {
    constexpr double much_better = 0.1;
    const Eigen::VectorXd straight = straight_in_contact(smooth, problem.points());
    ContactSystem system(problem, laws_);
    const bool trust = system.evaluate(smooth) <= much_better * system.evaluate(straight);
    PeriodicResponse response = newton_from(problem, level, trust ? smooth : straight);
    return response.converged() ? response : newton_from(problem, level, trust ? straight : smooth);
  }

  PeriodicResponse find(CondensedProblem& problem, RefinementLevel& level) {
    const bool touched = solved_ && !result_.response.contact_force.isZero(0.0);
    if (!resolved() || !touched) {
      level.restarted = solved_.has_value();
      return from_linear_response(problem, level, true);
    }
    const Eigen::VectorXd before = prolonged(result_.response.coefficients, problem.points());
    const bool force_form = result_.response.series_flexibility.size() > 0;
    PeriodicResponse warm =
        force_form ? from_previous_force(problem, before, level) : from_previous(problem, before, level);
    const auto moved = [&](const PeriodicResponse& response) {
      return response.converged() ? (response.displacement - before).norm() / before.norm()
                                  : std::numeric_limits<double>::infinity();
    };
    const double warm_change = moved(warm);
    // Responses as close as this are the same response.
    if (warm_change <= std::max(solved_->change, asymptotic)) return warm;
    PeriodicResponse cold = from_linear_response(problem, level, !warm.converged() && !may_step_back());
    if (!(moved(cold) < warm_change)) return warm;
    level.restarted = true;
    return cold;
  }

  void estimate(RefinementLevel& level, CondensedProblem& problem, const PeriodicResponse& response) {
    const RefinementLevel& before = *solved_;
    const LevelDifference distance = level_difference(*result_.problem, result_.response, problem, response);
    level.change = distance.whole();
    const double functions = double(level.functions) / before.functions;
    const double points = double(level.points) / before.points;
    level.truncation = before.truncation;
    if (!fourier()) {
      quadrature_error_ = 0.0;
      level.truncation =
          distance.whole() * remainder_over_distance(functions, std::min(function_order(), point_order));
    } else {
      // With stiff contact the lower harmonics converge slowly with the number of functions. When both sizes
      // grew, either of them may have caused their change.
      if (functions > 1.0)
        level.truncation = std::hypot(
            distance.truncated_part * remainder_over_distance(functions, observed_order(level, response)),
            distance.resolved_part * remainder_over_distance(functions, point_order));
      constexpr double least_decay = 2.0 / 3.0;  // factor on the decay with order 2 of the previous error
      if (points > 1.0)
        quadrature_error_ =
            std::max(points_part(distance.resolved_part * remainder_over_distance(points, point_order),
                                 functions > 1.0, problem, response),
                     has_kinks(response) ? least_decay * quadrature_error_ / (points * points) : 0.0);
    }
    level.quadrature = quadrature_error_ + missed_contacts(problem, response, laws_);
    level.estimated_error = std::hypot(level.truncation, level.quadrature);
  }

  /// Contact during a part of the period. The error of the sums is then the square of the distance of the
  /// points times a factor of either sign, which depends on where contact begins between two points. Two
  /// levels in a row may therefore agree by chance.
  static bool has_kinks(const PeriodicResponse& response) {
    const auto touching = (response.contact_force.array() != 0.0).count();
    return touching > 0 && touching < response.contact_force.size();
  }

  /// The order with which the harmonics decay. It is low where a contact is shorter than the highest
  /// harmonic.
  double observed_order(const RefinementLevel& level, const PeriodicResponse& response) const {
    constexpr double least = 0.5;
    const double observed = decay_order(response, level.functions);
    return std::isnan(observed) ? function_order() : std::clamp(observed, least, function_order());
  }

  /// The part of `resolved`, the error of the common harmonics, that is due to the points. With contacts of
  /// few points the distance may be small by chance, so the error of halved sums is used as well.
  static double points_part(double resolved, bool functions_grew, CondensedProblem& problem,
                            const PeriodicResponse& response) {
    const bool brief = has_brief_contact(response, problem.points());
    if (!brief && !functions_grew) return resolved;
    const double halved = halved_quadrature(problem, response) * remainder_over_distance(2.0, point_order);
    return brief ? std::max(resolved, halved) : std::min(resolved, halved);
  }

  /// The status if the refinement ends with its last level. Otherwise nothing, and size_ is the next size.
  std::optional<RefinementStatus> ending(bool cancelled) {
    const RefinementLevel& level = result_.levels.back();
    // A small problem may have no solution although the motion exists, as it does where the structure
    // converges to it.
    const int max_failures = settles_ ? 4 : 2;
    if (failures_ == max_failures) return RefinementStatus::not_converged;
    if (level.estimated_error <= wanted(level)) return RefinementStatus::converged;
    if (cancelled) return RefinementStatus::cancelled;
    if (has_stagnated()) return RefinementStatus::stagnated;
    const Size next = next_size();
    if (next.functions > options_.max_functions || next.points > options_.max_points)
      return failed() ? RefinementStatus::not_converged : RefinementStatus::size_limit;
    size_ = next;
    return std::nullopt;
  }

  /// The estimate that ends the refinement. Two small problems may be close by chance.
  double wanted(const RefinementLevel& level) const {
    constexpr double screening_factor = 1e-3;
    return level.points < screening_points ? screening_factor * options_.tolerance : options_.tolerance;
  }

  int grown(int functions, int factor) const {
    return odd_ ? factor * (functions + 1) - 1 : factor * functions;
  }

  Size next_size() const {
    const RefinementLevel& level = result_.levels.back();
    constexpr double observed_point_order = 2.0;
    constexpr int few_points = 256;  // doubling them costs little
    if (failed() && may_step_back()) return {grown(solved_->functions, 2), 2 * solved_->points};
    int functions = 2, points = 2;
    if (level.points < screening_points) {
      points = result_.levels.size() > 1 || failed() ? 4 : 2;
    } else if (fourier() && level.estimated_error < asymptotic) {
      const double half = 0.5 * options_.tolerance;
      functions = growth(level.truncation / half, function_order());
      points = growth(level.quadrature / half, observed_point_order);
      functions = std::max(functions, points / 2);  // with too few points truncation is not known
    }
    Size next{grown(size_.functions, functions), points * size_.points};
    const int least = next.points < screening_points
                          ? next.functions
                          : std::min(2 * next.functions, std::max(next.functions, few_points));
    while (next.points < least) next.points *= 2;
    return next;
  }

  bool failed() const { return !found_; }

  /// Distances near Newton's tolerance do not decrease any more.
  bool has_stagnated() const {
    const auto& levels = result_.levels;
    constexpr double above_residual = 100.0;
    const double floor = above_residual * options_.solver.newton.tolerance;
    const RefinementLevel& last = levels.back();
    // An estimate far above the distance may come from contact between the points.
    if (levels.size() < 3 || last.change > floor || last.estimated_error > 10.0 * floor) return false;
    return last.change > 0.5 * levels[levels.size() - 2].change;
  }

  const ProblemFactory& make_problem_;
  const ContactLaws& laws_;
  RefinementOptions options_;
  Size size_;
  bool odd_;
  RefinementResult result_;
  std::optional<RefinementLevel> solved_;  // the last with a response, the one of result_
  double quadrature_error_ = 0.0;          // estimated error of the sums over its points
  bool found_ = false;                     // whether the level just solved has a response
  int failures_ = 0;                       // levels without a response since `solved_`
  bool settles_ = false;                   // whether a failed level found where the structure converges to
};

}  // namespace

std::string_view to_string(RefinementStatus status) {
  using enum RefinementStatus;
  return detail::name_in<RefinementStatus>({{converged, "converged"},
                                            {size_limit, "size_limit"},
                                            {not_converged, "not_converged"},
                                            {stagnated, "stagnated"},
                                            {cancelled, "cancelled"}},
                                           status);
}

void RefinementOptions::validate() const {
  constexpr const char* who = "RefinementOptions";
  detail::require_positive(who, "tolerance", tolerance);
  detail::require_at_least(who, "first_functions", first_functions, 1);
  detail::require_at_least(who, "first_points", first_points, first_functions);
  detail::require_at_least(who, "max_functions", max_functions, first_functions);
  detail::require_at_least(who, "max_points", max_points, first_points);
  solver.validate();
}

RefinementResult response_to_tolerance(const ProblemFactory& make_problem, const ContactLaws& laws,
                                       const RefinementOptions& options) {
  options.validate();
  return Refinement(make_problem, laws, options).refine();
}

}  // namespace wavebalance::solvers
