#include "points.hpp"

#include <limits>

#include "stopwatch.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/solvers/response/forced_response.hpp"
#include "wavebalance/solvers/time/motion_evaluator.hpp"

namespace wavebalance::bench {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

solvers::CondensedProblem condensed_problem(const app::Scene& scene) {
  return {app::make_pair(scene.time), app::make_structure(scene), Eigen::Vector2cd(0.0, 1.0)};
}

// Ends a solve that takes too long; it has not converged then.
solvers::Observer deadline(double max_seconds) {
  return [max_seconds, start = processor_seconds()](const solvers::Progress&) {
    return processor_seconds() - start < max_seconds;
  };
}

solvers::PeriodicResponse solve(const app::Scene& scene, solvers::CondensedProblem& problem,
                                double max_seconds) {
  problem.set_frequency(scene.forcing.frequency);
  solvers::ForcedResponseOptions options;
  options.observer = deadline(max_seconds);
  return solvers::forced_response(problem, app::make_law(scene.contact), options);
}

app::Scene discretised(const Study& study, const Pair& pair, int functions, int points) {
  app::Scene scene = study.scene;
  scene.time.trial = pair.trial;
  scene.time.weight = pair.weight;
  scene.time.functions = functions;
  scene.time.quadrature_points = points;
  return scene;
}

Point blank(const Pair& pair, const app::Time& time) {
  Point point;
  point.method = "weighted_residual";
  point.trial = pair.trial;
  point.weight = pair.weight;
  point.inner_products = app::name_of(app::effective_inner_products(time));
  point.functions = time.functions;
  point.points = time.quadrature_points;
  point.construction_seconds = point.seconds = point.error = point.tolerance = unknown;
  return point;
}

Point measure(const Study& study, const Pair& pair, const app::Scene& scene, double max_seconds) {
  Point point = blank(pair, scene.time);
  point.construction_seconds = least_seconds([&] { condensed_problem(scene); }, {0.0, 2, 0.1});
  solvers::CondensedProblem problem = condensed_problem(scene);
  solvers::PeriodicResponse response;
  try {
    point.seconds = least_seconds([&] { response = solve(scene, problem, max_seconds); });
  } catch (const solvers::SingularSystem&) {
    point.status = "singular";
    return point;
  }
  point.converged = response.converged();
  point.status = to_string(response.status);
  solvers::MotionEvaluator motion(problem.pair().trial(), static_cast<int>(study.reference.size()));
  point.error = app::relative_rms_error(motion.displacement(response.coefficients.col(0)), study.reference);
  return point;
}

void add_series(const Study& study, const Pair& pair, const SizeSeries& series, int points_per_function,
                int change, std::vector<Point>& points) {
  TimeLimit limit(series.max_seconds);
  for (const int functions : series.functions) {
    const int number = functions + change;
    const app::Scene scene =
        discretised(study, pair, number, std::max(number, functions) * points_per_function);
    if (limit.allows()) {
      points.push_back(measure(study, pair, scene, series.max_seconds));
      if (points.back().status != "singular") limit.took(points.back().seconds);
    } else {
      points.push_back(blank(pair, scene.time));
      points.back().status = "not_run";
    }
  }
}

}  // namespace

std::vector<Point> weighted_residual_points(const Study& study, const SizeSeries& series) {
  std::vector<Point> points;
  for (const Pair& pair : pairs())
    for (const int points_per_function : series.points_per_function) {
      add_series(study, pair, series, points_per_function, 0, points);
      // An odd number of Fourier functions has no Nyquist coefficient.
      if (pair.trial == "fourier") add_series(study, pair, series, points_per_function, -1, points);
    }
  return points;
}

}  // namespace wavebalance::bench
