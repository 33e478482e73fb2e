#include <algorithm>

#include "dense_system.hpp"
#include "points.hpp"
#include "wavebalance/app/compare/solve_point.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/solvers/flow/periodic_flow.hpp"
#include "wavebalance/spectral/fourier_basis.hpp"

// Baselines of the condensed solver: the assembled system, time stepping and collocation.
namespace wavebalance::bench {
namespace {

Point named(const std::string& method, double tolerance) {
  Point point;
  point.method = method;
  point.tolerance = tolerance;
  return point;
}

double error_of(const Study& study, const Eigen::VectorXd& displacement) {
  return app::displacement_error({displacement.transpose(), {}, {}}, study.measured.reference);
}

Point dense_point(const Study& study, int functions, double max_seconds) {
  Point point = named("dense", solvers::missing);
  point.pair = {"fourier", "fourier"};
  point.inner_products = "quadrature";
  point.functions = functions;
  point.points = 4 * (functions + 1);
  const spectral::FourierBasis basis(functions);
  const Eigen::Vector2cd cosine(0.0, 1.0);
  const double start = app::processor_seconds();
  dense::DenseSystem system(app::make_structure(study.scene()), app::make_law(study.scene().contact),
                            dense::discretise(basis, basis, {.quadrature_points = point.points}, cosine));
  point.construction_seconds = app::processor_seconds() - start;
  dense::Solution solution;
  point.seconds = app::least_seconds(
      [&] {
        system.set_frequency(study.scene().forcing.frequency);
        solution = system.newton(system.linear_response(), {.tolerance = 1e-11});
      },
      {.max_seconds = max_seconds / 10.0});
  point.converged = solution.converged;
  point.status = solution.converged ? "converged" : "not_converged";
  const int contact = study.scene().structure.elements - 1;
  const Eigen::VectorXd coefficients = solution.coefficients.segment(contact * functions, functions);
  const auto samples = study.measured.reference.points();
  point.error = error_of(study, dense::translate_samples(basis, samples, 0) * coefficients);
  return point;
}

}  // namespace

std::vector<Point> dense_points(const Study& study, const std::vector<int>& functions, double max_seconds) {
  std::vector<Point> points;
  for (const int number : functions) {
    points.push_back(dense_point(study, number, max_seconds));
    if (points.back().seconds > max_seconds) break;
  }
  return points;
}

std::vector<Point> time_stepping_points(const Study& study, const std::vector<double>& tolerances) {
  const solvers::LinearStructure structure = app::make_structure(study.scene());
  const solvers::AnyContactLaw law = app::make_law(study.scene().contact);
  const solvers::CondensedProblem problem = app::make_problem(study.scene());
  const solvers::ContactDynamics dynamics(structure);
  std::vector<Point> points;
  for (const double tolerance : tolerances) {
    Point point = named("time_stepping", tolerance);
    solvers::TimeSteppingOptions options;
    options.period_tolerance = tolerance;
    solvers::TimeSteppingResult result;
    point.seconds = app::least_seconds(
        [&] { result = solvers::integrate_by_events(problem, dynamics, law, options).stepping; },
        {.max_seconds = 0.2});
    point.status = to_string(result.status);
    point.converged = result.status == solvers::TimeSteppingStatus::converged;
    point.error = error_of(study, result.contacts.displacement.row(0));
    points.push_back(std::move(point));
  }
  return points;
}

std::vector<Point> collocation_points(const Study& study, const std::vector<double>& tolerances) {
  constexpr int functions = 63;
  app::ExactStudyOptions options;
  options.tolerances = tolerances;
  options.first_functions = options.largest_functions = functions;
  return app::exact_study(study.measured, study.reference, options);
}

}  // namespace wavebalance::bench
