#include "wavebalance/app/compare/solve_point.hpp"

#include <iterator>

#include "compare/shared_observer.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/solvers/linalg/parallel_for.hpp"

namespace wavebalance::app {
namespace {

double relative_error(const Eigen::MatrixXd& values, const Eigen::MatrixXd& reference) {
  if (values.size() != reference.size() || !(reference.squaredNorm() > 0.0)) return solvers::missing;
  return relative_rms_error(values.reshaped(), reference.reshaped());
}

/// Times of all series so far. Threads may share it.
class SolvedSoFar {
 public:
  /// `size` is the power of two that the functions are or are one less than.
  void note(int size, const SolvePoint& point) {
    if (!point.converged) return;
    const std::lock_guard alone(guard_);
    converged_.push_back(point);
    const auto found = fastest_.try_emplace({size, point.points}, point.seconds).first;
    found->second = std::min(found->second, point.seconds);
  }

  /// s, of this size, or four times the time of half the size where none of it has converged; infinite
  /// where no smaller one has either.
  double fastest(int size, int points) const {
    constexpr double growth = 4.0;
    double factor = 1.0;
    const std::lock_guard alone(guard_);
    for (; size > 0 && points > 0; size /= 2, points /= 2, factor *= growth)
      if (const auto found = fastest_.find({size, points}); found != fastest_.end())
        return factor * found->second;
    return std::numeric_limits<double>::infinity();
  }

  /// Time of a solve over the fastest with no larger error: 1 on the front, infinite for a failure.
  double lag(const SolvePoint& point) const {
    if (!point.converged) return std::numeric_limits<double>::infinity();
    double fastest = point.seconds;
    const std::lock_guard alone(guard_);
    for (const SolvePoint& other : converged_)
      if (other.error <= point.error) fastest = std::min(fastest, other.seconds);
    return point.seconds / fastest;
  }

  /// Whether another solve with no larger error was `ratio` times as fast. A failure has an infinite error.
  bool dominates(const SolvePoint& point, double ratio) const {
    const std::lock_guard alone(guard_);
    if (!point.converged) return !converged_.empty();
    return std::ranges::any_of(converged_, [&](const SolvePoint& other) {
      return other.error <= point.error && ratio * other.seconds <= point.seconds;
    });
  }

 private:
  mutable std::mutex guard_;
  std::vector<SolvePoint> converged_;
  std::map<std::pair<int, int>, double> fastest_;
};

/// Sizes of one pair with one number of points per function.
class SizeSeries {
 public:
  SizeSeries(const MeasuredScene& measured, const SizeStudyOptions& options, SolvedSoFar& solved,
             BasisPair pair, int points_per_function, int change)
      : measured_(measured),
        options_(options),
        solved_(solved),
        pair_(std::move(pair)),
        points_per_function_(points_per_function),
        change_(change),
        limit_(options.max_seconds) {}

  std::vector<SolvePoint>& points() { return points_; }
  /// SolvedSoFar::lag() of the last size, 1 before the first.
  double lag() const { return points_.empty() ? 1.0 : solved_.lag(points_.back()); }

  /// Solves the next size.
  void add(int functions) {
    if (ended_) return;
    const int number = functions + change_;
    const Scene scene = discretised(measured_.scene, pair_, number, functions * points_per_function_);
    points_.push_back(unsolved_point(scene));
    phase_ = name_of(pair_) + ", " + std::to_string(number) + " functions";
    if (!limit_.allows() || !goes_on()) {
      points_.back().status = "not_run";
      return;
    }
    SolvePoint& point = points_.back();
    max_seconds_ = longest_solve(functions, point.points);
    measure(scene, point);
    if (point.seconds > 0.0) limit_.took(point.seconds);
    solved_.note(functions, point);
    ended_ = (point.converged && point.error <= options_.smallest_error) || is_hopeless(functions, point);
  }

 private:
  double longest_solve(int functions, int points) const {
    constexpr double least = 5e-3, of_fourier = 10.0;
    if (!(options_.longest_ratio > 0.0)) return options_.max_seconds;
    const double ratio = options_.longest_ratio * (pair_.is_fourier() ? of_fourier : 1.0);
    const double longest = std::max(least, ratio * solved_.fastest(functions, points));
    return std::min(options_.max_seconds, longest);
  }

  bool is_hopeless(int functions, const SolvePoint& point) {
    constexpr int fewest_functions = 64, most_in_a_row = 2;
    constexpr double long_solve = 0.01;  // s
    const bool large = functions >= fewest_functions || point.seconds > long_solve;
    const bool applies = options_.dominated_ratio > 0.0 && !pair_.is_fourier() && large;
    dominated_ = applies && solved_.dominates(point, options_.dominated_ratio) ? dominated_ + 1 : 0;
    return dominated_ >= most_in_a_row;
  }

  bool goes_on() const { return solvers::goes_on(options_.observer, {phase_}); }

  void measure(const Scene& scene, SolvePoint& point) const {
    auto problem = timed_problem(measured_, scene, options_.construction, point);
    if (!problem) return;
    const solvers::ResponseStart start = response_start(measured_.start, scene);
    solvers::PeriodicResponse response;
    const auto solve = [&] {
      // Ends a solve that exceeds its time; it has not converged then.
      response =
          response_near(scene, *problem, start, [&, begin = processor_seconds()](const solvers::Progress&) {
            return processor_seconds() - begin < max_seconds_ && goes_on();
          });
    };
    if (!time_solve(solve, options_.solve, point)) return;
    point.status = to_string(response.status);
    if (response.status == solvers::SolveStatus::cancelled && !goes_on()) {
      point.status = "not_run";
      return;
    }
    point.converged = response.converged();
    set_errors(measured_, problem->motion(response, measured_.reference.points()), point);
  }

  const MeasuredScene& measured_;
  const SizeStudyOptions& options_;
  SolvedSoFar& solved_;
  BasisPair pair_;
  int points_per_function_;
  int change_;
  TimeLimit limit_;
  std::string phase_;
  std::vector<SolvePoint> points_;
  double max_seconds_ = 0.0;  // of the solve that is begun
  int dominated_ = 0;         // sizes in a row
  bool ended_ = false;
};

/// Series that were Pareto-optimal at their last size come first, because the budget may run out.
/// Benchmarks have the time for all and use a fixed order.
std::vector<SizeSeries*> in_order(std::vector<SizeSeries>& all, const SizeStudyOptions& options) {
  std::vector<std::pair<double, SizeSeries*>> lags;
  for (SizeSeries& series : all)
    lags.emplace_back(options.dominated_ratio > 0.0 ? series.lag() : 1.0, &series);
  std::ranges::stable_sort(lags, [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<SizeSeries*> order;
  for (const auto& [lag, series] : lags) order.push_back(series);
  return order;
}

/// All series of the pairs in the order of the rows.
std::vector<SizeSeries> make_series(const MeasuredScene& measured, const std::vector<BasisPair>& pairs,
                                    const SizeStudyOptions& options, SolvedSoFar& solved) {
  const bool dropped = measured.scene.time.nyquist == NyquistCoefficient::drop;
  std::vector<SizeSeries> all;
  for (const BasisPair& pair : pairs)
    for (const int points : options.points_per_function) {
      if (!pair.is_fourier() || !dropped || !options.without_equals)
        all.emplace_back(measured, options, solved, pair, points, 0);
      if (pair.is_fourier()) all.emplace_back(measured, options, solved, pair, points, -1);
    }
  return all;
}

}  // namespace

Scene discretised(Scene scene, const BasisPair& pair, int functions, int points) {
  scene.time.trial = pair.trial;
  scene.time.weight = pair.weight;
  scene.time.functions = functions;
  scene.time.quadrature_points = points;
  scene.time.tolerance = 0.0;
  return scene;
}

solvers::ContactProblem uncondensed_problem(const Scene& scene, const StructureModel& model) {
  return {make_pair(scene.time), model.structure, make_laws(scene)};
}

solvers::ResponseStart response_start(const StartMotion& start, const Scene& scene) {
  if (start.contacts.empty()) return {};
  StartSamples samples = start_samples(start, scene);
  return {std::move(samples.displacement), std::move(samples.force)};
}

solvers::PeriodicResponse response_near(const Scene& scene, solvers::ContactProblem& problem,
                                        const solvers::ResponseStart& start,
                                        const solvers::Observer& observer) {
  problem.condensed().forget_condensation();
  solvers::ForcedResponseOptions options;
  options.form = scene.contact.form;
  options.observer = observer;
  options.stay_near_guess = start.displacement.size() > 0;
  return problem.respond(scene.forcing.frequency, options, start);
}

SolvePoint unsolved_point(const Scene& scene) {
  SolvePoint point;
  point.pair = {scene.time.trial, scene.time.weight};
  point.inner_products = name_of(effective_inner_products(scene.time));
  point.functions = scene.time.functions;
  point.points = scene.time.quadrature_points;
  return point;
}

std::optional<solvers::ContactProblem> timed_problem(const MeasuredScene& measured, const Scene& scene,
                                                     const Repetition& repetition, SolvePoint& point) try {
  point.construction_seconds = least_seconds([&] { uncondensed_problem(scene, measured.model); }, repetition);
  return uncondensed_problem(scene, measured.model);
} catch (const std::invalid_argument&) {
  point.status = "refused";
  return std::nullopt;
}

bool time_solve(const std::function<void()>& solve, const Repetition& repetition, SolvePoint& point) try {
  point.seconds = least_seconds(solve, repetition);
  return true;
} catch (const solvers::SingularSystem&) {
  point.status = "singular";
  return false;
}

void set_errors(const MeasuredScene& measured, const solvers::Motion& motion, SolvePoint& point,
                double least_displacement, double least_force) {
  point.displacement_error = std::max(displacement_error(motion, measured.reference), least_displacement);
  point.force_error = std::max(force_error(motion, measured.reference), least_force);
  point.error = weighed_error(measured.measure, point.displacement_error, point.force_error);
}

double displacement_error(const solvers::Motion& motion, const solvers::Motion& reference) {
  return relative_error(motion.displacement, reference.displacement);
}

double force_error(const solvers::Motion& motion, const solvers::Motion& reference) {
  return relative_error(motion.force, reference.force);
}

std::vector<SolvePoint> size_study(const MeasuredScene& measured, const std::vector<BasisPair>& pairs,
                                   const SizeStudyOptions& options) {
  SharedObserver observer(options.observer);
  SizeStudyOptions shared = options;
  shared.observer = [&observer](const solvers::Progress& progress) { return observer.goes_on(progress); };
  const auto watch = [&observer] { observer.goes_on({observer.phase()}); };
  const int threads = solvers::thread_count(options.threads);
  SolvedSoFar solved;
  std::vector<SizeSeries> all = make_series(measured, pairs, shared, solved);
  for (const int functions : options.functions) {
    const std::vector<SizeSeries*> order = in_order(all, options);
    const auto add = [&](int, Eigen::Index i) { order[static_cast<std::size_t>(i)]->add(functions); };
    solvers::parallel_for(threads, static_cast<Eigen::Index>(order.size()), add, watch);
  }
  std::vector<SolvePoint> points;
  for (SizeSeries& series : all)
    points.insert(points.end(), std::make_move_iterator(series.points().begin()),
                  std::make_move_iterator(series.points().end()));
  return points;
}

}  // namespace wavebalance::app
