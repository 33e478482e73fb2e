#include "wavebalance/solvers/response/resolution_ladder.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include "linalg/option_checks.hpp"
#include "response/error_estimate.hpp"
#include "wavebalance/solvers/time/translate_spectrum.hpp"

namespace wavebalance::solvers {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
// Problems with fewer points tell motions that a few harmonics hold from the others, which they do not
// resolve.
constexpr int screening_points = 32;
constexpr double point_order = 1.5;  // below that of sums over forces with kinks
constexpr double asymptotic = 0.03;  // errors above it do not yet fall with an order

struct Size {
  int functions = 0;
  int points = 0;

  bool operator==(const Size&) const = default;
};

/// The error of the finer of two rungs whose sizes differ by `factor`, over their distance.
double remainder_over_distance(double factor, double order) {
  constexpr double caution = 1.5;
  return caution / (std::pow(factor, order) - 1.0);
}

/// The power of two in 1..4 by which a size grows so that an error of `excess` times what is wanted, falling
/// with `order`, is met.
int growth(double excess, double order) {
  if (!(excess > 1.0)) return 1;
  return 1 << std::clamp(static_cast<int>(std::ceil(std::log2(excess) / order)), 1, 2);
}

class Ladder {
 public:
  Ladder(const ProblemFactory& make_problem, const ContactLaws& laws, const LadderOptions& options)
      : make_problem_(make_problem),
        laws_(laws),
        options_(options),
        size_{options.first_functions, options.first_points},
        odd_(options.first_functions % 2 == 1) {
    options_.solver.observer = options_.observer;
  }

  LadderResponse climb() {
    const auto start = Clock::now();
    while (!step()) {
    }
    result_.estimated_error = result_.ladder.back().estimated_error;
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

  /// Solves one rung; true when it is the last.
  bool step() {
    const auto start = Clock::now();
    LadderRung rung{size_.functions, size_.points, unknown, unknown, unknown, unknown};
    CondensedProblem problem = make_problem_(size_.functions, size_.points);
    PeriodicResponse response = find(problem, rung);
    rung.residual = response.residual;
    const SolveStatus ended_by = response.status;
    found_ = response.converged();
    if (found_ && solved_) estimate(rung, problem, response);
    if (found_ || !solved_) {
      result_.problem = std::move(problem);
      result_.response = std::move(response);
    }
    rung.seconds = seconds_since(start);
    if (found_)
      failures_ = 0;
    else if (rung.points >= screening_points && !may_step_back())
      ++failures_;
    if (found_) solved_ = rung;
    result_.ladder.push_back(rung);
    const bool cancelled = ended_by == SolveStatus::cancelled || !goes_on(options_.observer, progress(rung));
    const std::optional<LadderStatus> end = ending(cancelled);
    if (end) result_.status = *end;
    return end.has_value();
  }

  Progress progress(const LadderRung& rung) const {
    const double done = std::log(rung.estimated_error) / std::log(options_.tolerance);
    return {"refinement", static_cast<int>(result_.ladder.size()), rung.estimated_error, "estimated error",
            std::isfinite(done) ? std::clamp(done, 0.0, 1.0) : 0.0};
  }

  /// The last response's displacement at `points` points, contact-major.
  Eigen::VectorXd prolonged(int points) const {
    const Eigen::MatrixXcd& coefficients = result_.response.coefficients;
    TrialEvaluator at_points(result_.problem->pair().trial(), points, 0);
    Eigen::VectorXd u(points * coefficients.cols());
    for (Eigen::Index contact = 0; contact < coefficients.cols(); ++contact)
      u.segment(contact * points, points) = at_points(coefficients.col(contact));
    return u;
  }

  /// `smooth`, the last response's displacement, straight between its samples where one of them touches:
  /// there a stiff law holds the samples, but not the harmonics between them.
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

  PeriodicResponse from_afar(CondensedProblem& problem, LadderRung& rung, bool paths) const {
    ForcedResponseOptions solver = options_.solver;
    solver.complementarity = paths && solver.complementarity && rung.points >= screening_points;
    PeriodicResponse response = forced_response(problem, laws_, solver);
    rung.iterations += response.iterations;
    return response;
  }

  /// Whether the rung before is a start for the next.
  bool resolved() const {
    return solved_ && (solved_->points >= screening_points || solved_->change < asymptotic);
  }

  /// Whether sizes between the rung before and this one have not been tried.
  bool may_step_back() const {
    return failures_ == 0 && resolved() &&
           (size_.points > 2 * solved_->points || size_.functions > 2 * solved_->functions + 1);
  }

  /// Newton from the last response; where it stalls, from its other prolongation.
  PeriodicResponse from_nearby(CondensedProblem& problem, const Eigen::VectorXd& smooth,
                               LadderRung& rung) const {
    constexpr double much_better = 0.1;
    const Eigen::VectorXd straight = straight_in_contact(smooth, problem.points());
    ContactSystem system(problem, laws_);
    const bool trust = system.evaluate(smooth) <= much_better * system.evaluate(straight);
    ForcedResponseOptions solver = options_.solver;
    solver.complementarity = false;
    PeriodicResponse response = forced_response(problem, laws_, solver, trust ? smooth : straight);
    rung.iterations = response.iterations;
    if (response.converged()) return response;
    PeriodicResponse other = forced_response(problem, laws_, solver, trust ? straight : smooth);
    rung.iterations += other.iterations;
    return other;
  }

  PeriodicResponse find(CondensedProblem& problem, LadderRung& rung) {
    const bool touched = solved_ && !result_.response.contact_force.isZero(0.0);
    if (!resolved() || !touched) {
      rung.restarted = solved_.has_value();
      return from_afar(problem, rung, true);
    }
    const Eigen::VectorXd before = prolonged(problem.points());
    PeriodicResponse warm = from_nearby(problem, before, rung);
    const auto moved = [&](const PeriodicResponse& response) {
      return response.converged() ? (response.displacement - before).norm() / before.norm()
                                  : std::numeric_limits<double>::infinity();
    };
    const double warm_change = moved(warm);
    // Responses so near one another are one.
    if (warm_change <= std::max(solved_->change, asymptotic)) return warm;
    PeriodicResponse cold = from_afar(problem, rung, !warm.converged() && !may_step_back());
    if (!(moved(cold) < warm_change)) return warm;
    rung.restarted = true;
    return cold;
  }

  void estimate(LadderRung& rung, CondensedProblem& problem, const PeriodicResponse& response) {
    const LadderRung& before = *solved_;
    const LevelDifference distance = level_difference(*result_.problem, result_.response, problem, response);
    rung.change = distance.whole();
    const double functions = double(rung.functions) / before.functions;
    const double points = double(rung.points) / before.points;
    rung.truncation = before.truncation;
    if (!fourier()) {
      sums_ = 0.0;
      rung.truncation =
          distance.whole() * remainder_over_distance(functions, std::min(function_order(), point_order));
    } else {
      // Lower harmonics follow the truncated ones slowly where contact is stiff: what they moved by when both
      // sizes grew may be either's share.
      if (functions > 1.0)
        rung.truncation =
            std::hypot(distance.beyond * remainder_over_distance(functions, observed_order(rung, response)),
                       distance.within * remainder_over_distance(functions, point_order));
      constexpr double fading = 2.0 / 3.0;
      if (points > 1.0)
        sums_ = std::max(share_of_points(distance.within * remainder_over_distance(points, point_order),
                                         functions > 1.0, problem, response),
                         has_kinks(response) ? fading * sums_ / (points * points) : 0.0);
    }
    rung.quadrature = sums_ + missed_contacts(problem, response, laws_);
    rung.estimated_error = std::hypot(rung.truncation, rung.quadrature);
  }

  /// Contact for a part of the period. Sums then err by the square of the width of a point times a factor of
  /// either sign, that of the instants between the points: two in a row may agree by chance.
  static bool has_kinks(const PeriodicResponse& response) {
    const auto touching = (response.contact_force.array() != 0.0).count();
    return touching > 0 && touching < response.contact_force.size();
  }

  /// Of the functions: where a contact is shorter than the highest harmonic, these hardly fall yet.
  double observed_order(const LadderRung& rung, const PeriodicResponse& response) const {
    constexpr double least = 0.5;
    const double observed = decay_order(response, rung.functions);
    return std::isnan(observed) ? function_order() : std::clamp(observed, least, function_order());
  }

  /// What the points explain of the lower harmonics' distance, an error of `within`. With contacts that few
  /// points see, distances are small by chance, and the halved sums tell more.
  static double share_of_points(double within, bool functions_grew, CondensedProblem& problem,
                                const PeriodicResponse& response) {
    const bool brief = has_brief_contact(response, problem.points());
    if (!brief && !functions_grew) return within;
    const double halved = halved_quadrature(problem, response) * remainder_over_distance(2.0, point_order);
    return brief ? std::max(within, halved) : std::min(within, halved);
  }

  /// How the ladder ends with its last rung; nothing when it goes on, with the size of the next.
  std::optional<LadderStatus> ending(bool cancelled) {
    const LadderRung& rung = result_.ladder.back();
    constexpr int patience = 2;  // a small problem may have no solution although the motion exists
    if (failures_ == patience) return LadderStatus::not_converged;
    if (rung.estimated_error <= wanted(rung)) return LadderStatus::converged;
    if (cancelled) return LadderStatus::cancelled;
    if (has_stagnated()) return LadderStatus::stagnated;
    const Size next = next_size();
    if (next.functions > options_.max_functions || next.points > options_.max_points)
      return failed() ? LadderStatus::not_converged : LadderStatus::size_limit;
    size_ = next;
    return std::nullopt;
  }

  /// The estimate that ends the ladder: two small problems may come near one another by chance.
  double wanted(const LadderRung& rung) const {
    constexpr double doubt = 1e-3;
    return rung.points < screening_points ? doubt * options_.tolerance : options_.tolerance;
  }

  int grown(int functions, int factor) const {
    return odd_ ? factor * (functions + 1) - 1 : factor * functions;
  }

  Size next_size() const {
    const LadderRung& rung = result_.ladder.back();
    constexpr double observed_point_order = 2.0;
    constexpr int few_points = 256;  // doubling them costs little
    if (failed() && may_step_back()) return {grown(solved_->functions, 2), 2 * solved_->points};
    int functions = 2, points = 2;
    if (rung.points < screening_points) {
      points = result_.ladder.size() > 1 || failed() ? 4 : 2;
    } else if (fourier() && rung.estimated_error < asymptotic) {
      const double half = 0.5 * options_.tolerance;
      functions = growth(rung.truncation / half, function_order());
      points = growth(rung.quadrature / half, observed_point_order);
      functions = std::max(functions, points / 2);  // points so far from enough left truncation in doubt
    }
    Size next{grown(size_.functions, functions), points * size_.points};
    const int least = next.points < screening_points
                          ? next.functions
                          : std::min(2 * next.functions, std::max(next.functions, few_points));
    while (next.points < least) next.points *= 2;
    return next;
  }

  bool failed() const { return !found_; }

  /// Distances near the residual that Newton stops at do not fall any more.
  bool has_stagnated() const {
    const auto& ladder = result_.ladder;
    constexpr double above_residual = 100.0;
    const double floor = above_residual * options_.solver.newton.tolerance;
    const LadderRung& last = ladder.back();
    // Contact between the points may be what an estimate far above the distance comes from.
    if (ladder.size() < 3 || last.change > floor || last.estimated_error > 10.0 * floor) return false;
    return last.change > 0.5 * ladder[ladder.size() - 2].change;
  }

  const ProblemFactory& make_problem_;
  const ContactLaws& laws_;
  LadderOptions options_;
  Size size_;
  bool odd_;
  LadderResponse result_;
  std::optional<LadderRung> solved_;  // the last with a response, which is that of result_
  double sums_ = 0.0;                 // estimated error of its sums over the points
  bool found_ = false;                // whether the rung just solved has a response
  int failures_ = 0;                  // rungs without one since
};

}  // namespace

std::string_view to_string(LadderStatus status) {
  switch (status) {
    case LadderStatus::converged:
      return "converged";
    case LadderStatus::size_limit:
      return "size_limit";
    case LadderStatus::not_converged:
      return "not_converged";
    case LadderStatus::stagnated:
      return "stagnated";
    case LadderStatus::cancelled:
      return "cancelled";
  }
  return "unknown";
}

void LadderOptions::validate() const {
  constexpr const char* who = "LadderOptions";
  detail::require_positive(who, "tolerance", tolerance);
  detail::require_at_least(who, "first_functions", first_functions, 1);
  detail::require_at_least(who, "first_points", first_points, first_functions);
  detail::require_at_least(who, "max_functions", max_functions, first_functions);
  detail::require_at_least(who, "max_points", max_points, first_points);
  solver.validate();
}

LadderResponse response_to_tolerance(const ProblemFactory& make_problem, const ContactLaws& laws,
                                     const LadderOptions& options) {
  options.validate();
  return Ladder(make_problem, laws, options).climb();
}

}  // namespace wavebalance::solvers
