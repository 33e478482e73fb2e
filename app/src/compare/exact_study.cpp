#include "wavebalance/app/compare/solve_point.hpp"

#include <fmt/format.h>

#include "compare/exact_reference.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/files/quantity_text.hpp"
#include "wavebalance/solvers/collocation/exact_near_response.hpp"
#include "wavebalance/solvers/flow/exact_motion.hpp"

namespace wavebalance::app {
namespace {

constexpr double choosing_tolerance = 1e-6;  // with which the balance is chosen
constexpr double same_motion = 1e-2;         // error below which the reference's error dominates

struct CollocationSolve {
  solvers::PeriodicResponse balance;
  std::optional<solvers::ExactNearResponse> exact;
};

class ExactStudy {
 public:
  ExactStudy(const MeasuredScene& measured, const Reference& reference, const ExactStudyOptions& options)
      : measured_(measured), reference_(reference), options_(options) {}

  std::vector<SolvePoint> study() {
    const std::optional<SolvePoint> chosen = choose_balance();
    if (!chosen) return std::move(points_);
    for (const double tolerance : options_.tolerances)
      if (tolerance != choosing_tolerance && goes_on(chosen->functions, tolerance))
        points_.push_back(point_of(chosen->functions, tolerance));
    return std::move(points_);
  }

 private:
  bool goes_on(int functions, double tolerance) const {
    return solvers::goes_on(options_.observer, {fmt::format("exact solution to {} from {} functions",
                                                            short_number(tolerance, 1), functions)});
  }

  /// The one from which the exact solutions are found soonest.
  std::optional<SolvePoint> choose_balance() {
    std::optional<SolvePoint> best;
    for (int functions = options_.first_functions; functions <= options_.largest_functions;
         functions = 2 * functions + 1) {
      if (!goes_on(functions, choosing_tolerance)) break;
      const SolvePoint point = point_of(functions, choosing_tolerance);
      points_.push_back(point);
      const bool found = point.converged && point.displacement_error <= same_motion;
      if (best && (!found || point.seconds >= best->seconds)) break;
      if (found) best = point;
      if (found && point.seconds > options_.max_seconds) break;
    }
    return best;
  }

  CollocationSolve solve(solvers::ContactProblem& problem, const solvers::ResponseStart& start,
                         double tolerance) const {
    const solvers::Observer observer = [this](const solvers::Progress& progress) {
      return solvers::goes_on(options_.observer, progress);
    };
    CollocationSolve found{response_near(measured_.scene, problem, start, observer), std::nullopt};
    if (!found.balance.converged()) return found;
    const solvers::ContactDynamics dynamics(problem.structure());
    const int nodes = tolerance > 1e-3 ? 4 : tolerance > 1e-5 ? 6 : 8;
    found.exact = solvers::exact_near_response(problem.condensed(), problem.laws(), found.balance, dynamics,
                                               {.tolerance = tolerance, .nodes = nodes, .observer = observer},
                                               solvers::exact_motion);
    return found;
  }

  SolvePoint point_of(int functions, double tolerance) const {
    const Scene scene = discretised(measured_.scene, {"fourier", "fourier"}, functions, 4 * (functions + 1));
    SolvePoint point = unsolved_point(scene);
    point.method = "phases";
    point.pair = BasisPair::exact();
    point.tolerance = tolerance;
    auto problem = timed_problem(measured_, scene, options_.construction, point);
    if (!problem) return point;
    const solvers::ResponseStart start = response_start(measured_.start, scene);
    CollocationSolve found;
    if (time_solve([&] { found = solve(*problem, start, tolerance); }, options_.solve, point))
      note(found, point);
    return point;
  }

  void note(const CollocationSolve& found, SolvePoint& point) const {
    point.status = found.exact ? to_string(found.exact->motion.status) : to_string(found.balance.status);
    point.converged = found.exact && found.exact->motion.converged();
    if (point.converged)
      set_errors(measured_, sampled(found.exact->motion, measured_.reference.points()), point,
                 reference_.error, reference_.force_error);
  }

  const MeasuredScene& measured_;
  const Reference& reference_;
  const ExactStudyOptions& options_;
  std::vector<SolvePoint> points_;
};

}  // namespace

std::vector<SolvePoint> exact_study(const MeasuredScene& measured, const Reference& reference,
                                    const ExactStudyOptions& options) {
  return ExactStudy(measured, reference, options).study();
}

}  // namespace wavebalance::app
