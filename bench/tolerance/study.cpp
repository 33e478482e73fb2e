#include "study.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/compare/solve_point.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/solvers/response/refinement.hpp"
#include "wavebalance/solvers/response/response_motion.hpp"

namespace wavebalance::bench {
namespace {

constexpr int output_points = 4096;
constexpr int reference_functions = (1 << 14) - 1;
constexpr app::Repetition repetition{.budget = 0.003};

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

ToleranceStudy::ToleranceStudy(const tolerance::Motion& motion, const std::string& folder, StudySizes sizes)
    : scene_(tolerance::scene(motion, folder, 1.0, output_points)),
      model_(app::make_model(scene_)),
      sizes_(sizes),
      law_(app::make_law(scene_.contact)),
      exact_(tolerance::reference(scene_, std::min(reference_functions, sizes.largest_functions - 1))) {}

double ToleranceStudy::error_of(const solvers::CondensedProblem& problem,
                                const solvers::PeriodicResponse& response) const {
  const auto motion = solvers::contact_motion(problem, response, law_, output_points);
  return app::relative_rms_error(motion.displacement.row(0), exact_);
}

ToleranceStudy::Solution ToleranceStudy::solve(const FixedChoice& choice) const {
  app::Scene scene = scene_;
  scene.time = {.trial = choice.trial,
                .weight = choice.weight,
                .functions = choice.functions,
                .quadrature_points = choice.points};
  solvers::CondensedProblem problem = app::make_problem(scene, model_);
  // A choice that Newton's method does not solve is never the cheapest of its error.
  solvers::ForcedResponseOptions options;
  options.fallbacks = false;
  auto response = solvers::forced_response(problem, law_, options);
  return {std::move(problem), std::move(response)};
}

bool ToleranceStudy::measure(FixedChoice& choice) const {
  constexpr double hardly_swings = 0.01;  // s
  const double start = app::processor_seconds();
  const Solution found = solve(choice);
  choice.seconds = app::processor_seconds() - start;
  if (!found.response.converged()) return false;
  choice.error = error_of(found.problem, found.response);
  if (choice.seconds < hardly_swings)
    choice.seconds = std::min(choice.seconds, app::least_seconds([&] { solve(choice); }, repetition));
  return true;
}

/// Points doubled for one number of functions; returns the seconds of the last.
double ToleranceStudy::add_row(FixedChoice choice, Search& search) const {
  constexpr double settled = 0.02;
  double before = std::numeric_limits<double>::infinity();
  for (; choice.points <= sizes_.largest_points; choice.points *= 2) {
    if (!measure(choice)) continue;
    search.choices.push_back(choice);
    if (choice.error <= search.goal) search.max_seconds = std::min(search.max_seconds, choice.seconds);
    if (choice.seconds > search.max_seconds || std::abs(before / choice.error - 1.0) < settled) break;
    before = choice.error;
  }
  return choice.seconds;
}

void ToleranceStudy::add_pair(const std::string& trial, const std::string& weight, Search& search) const {
  const bool odd = trial == "fourier" && weight == "fourier";
  for (int size = 8; size <= sizes_.largest_functions; size *= 2)
    if (add_row({trial, weight, odd ? size - 1 : size, size, 0.0, 0.0}, search) > search.max_seconds) return;
}

std::vector<FixedChoice> ToleranceStudy::fixed_choices(double goal) const {
  Search search{.goal = goal, .max_seconds = sizes_.max_seconds};
  add_pair("fourier", "fourier", search);
  for (const char* basis : {"bspline", "daubechies6", "daubechies20"}) add_pair(basis, basis, search);
  add_pair("haar", "fourier", search);
  return search.choices;
}

solvers::RefinementResult ToleranceStudy::refine(double tolerance) const {
  return tolerance::refine(scene_, model_, law_, {.tolerance = tolerance});
}

Asked ToleranceStudy::ask(double tolerance) const {
  const auto found = refine(tolerance);
  Asked asked{.tolerance = tolerance, .status = std::string(to_string(found.status))};
  asked.estimated_error = found.estimated_error;
  asked.error = error_of(*found.problem, found.response);
  asked.functions = found.levels.back().functions;
  asked.points = found.levels.back().points;
  asked.levels = static_cast<int>(found.levels.size());
  return asked;
}

Beside ToleranceStudy::time_beside(const Asked& asked, const FixedChoice& choice) const {
  constexpr double budget = 0.02;  // s
  constexpr std::size_t least = 3;
  std::vector<double> of_asked, of_fixed;
  for (double total = 0.0; total < budget || of_asked.size() < least;
       total += of_asked.back() + of_fixed.back()) {
    const double start = app::processor_seconds();
    refine(asked.tolerance);
    const double middle = app::processor_seconds();
    if (!choice.trial.empty()) solve(choice);
    of_asked.push_back(middle - start);
    of_fixed.push_back(app::processor_seconds() - middle);
  }
  return {median(of_asked), choice.trial.empty() ? std::nan("") : median(of_fixed)};
}

const FixedChoice* cheapest(const std::vector<FixedChoice>& choices, double error) {
  const FixedChoice* best = nullptr;
  for (const FixedChoice& choice : choices)
    if (choice.error <= error && (best == nullptr || choice.seconds < best->seconds)) best = &choice;
  return best;
}

}  // namespace wavebalance::bench
