#include "study.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "stopwatch.hpp"
#include "wavebalance/reproduce/compose.hpp"
#include "wavebalance/reproduce/measures.hpp"
#include "wavebalance/solvers/resolution_ladder.hpp"

namespace wavebalance::bench {
namespace {

constexpr int output_points = 4096;
constexpr int reference_functions = 2047;
constexpr Repetition repetition{.budget = 0.003};

}  // namespace

ToleranceStudy::ToleranceStudy(const tolerance::Motion& motion, const std::string& folder, StudySizes sizes)
    : scene_(tolerance::scene(motion, folder, 1.0, output_points)),
      model_(reproduce::make_model(scene_)),
      sizes_(sizes),
      exact_(tolerance::reference(scene_, std::min(reference_functions, sizes.largest_functions - 1))) {}

double ToleranceStudy::error_of(const solvers::CondensedProblem& problem,
                                const solvers::PeriodicResponse& response) const {
  const auto motion =
      reproduce::sample_response(problem, response, reproduce::make_law(scene_.contact), output_points);
  return reproduce::relative_rms_error(motion.displacement.row(0), exact_);
}

bool ToleranceStudy::measure(FixedChoice& choice) const {
  reproduce::Scene scene = scene_;
  scene.time = {.trial = choice.trial,
                .weight = choice.weight,
                .functions = choice.functions,
                .quadrature_points = choice.points};
  const auto law = reproduce::make_law(scene.contact);
  const auto solve = [&] {
    solvers::CondensedProblem problem = reproduce::make_problem(scene, model_);
    // A choice that Newton alone does not solve is never the cheapest of its error.
    auto response = solvers::forced_response(problem, law, {.homotopy = false});
    return std::pair{std::move(problem), std::move(response)};
  };
  auto [problem, response] = solve();
  if (!response.converged()) return false;
  choice.error = error_of(problem, response);
  choice.seconds = least_seconds(solve, repetition);
  return true;
}

/// Points doubled for one number of functions; returns the seconds of the last.
double ToleranceStudy::add_row(FixedChoice choice, std::vector<FixedChoice>& choices) const {
  constexpr double settled = 0.02;
  double before = std::numeric_limits<double>::infinity();
  for (; choice.points <= sizes_.largest_points; choice.points *= 2) {
    if (!measure(choice)) continue;
    choices.push_back(choice);
    if (choice.seconds > sizes_.patience || std::abs(before / choice.error - 1.0) < settled) break;
    before = choice.error;
  }
  return choice.seconds;
}

void ToleranceStudy::add_pair(const std::string& trial, const std::string& weight,
                              std::vector<FixedChoice>& choices) const {
  const bool odd = trial == "fourier" && weight == "fourier";
  for (int size = 8; size <= sizes_.largest_functions; size *= 2)
    if (add_row({trial, weight, odd ? size - 1 : size, size, 0.0, 0.0}, choices) > sizes_.patience) return;
}

std::vector<FixedChoice> ToleranceStudy::fixed_choices() const {
  std::vector<FixedChoice> choices;
  add_pair("fourier", "fourier", choices);
  for (const char* basis : {"bspline", "daubechies6", "daubechies20"}) add_pair(basis, basis, choices);
  add_pair("haar", "fourier", choices);
  return choices;
}

Asked ToleranceStudy::ask(double tolerance) const {
  const auto law = reproduce::make_law(scene_.contact);
  const auto make = [this](int functions, int points) {
    reproduce::Scene scene = scene_;
    scene.time = {
        .trial = "fourier", .weight = "fourier", .functions = functions, .quadrature_points = points};
    return reproduce::make_problem(scene, model_);
  };
  const auto climb = [&] { return solvers::response_to_tolerance(make, law, {.tolerance = tolerance}); };
  auto found = climb();
  Asked asked{.tolerance = tolerance, .status = to_string(found.status)};
  asked.estimated_error = found.estimated_error;
  asked.error = error_of(*found.problem, found.response);
  asked.functions = found.ladder.back().functions;
  asked.points = found.ladder.back().points;
  asked.rungs = static_cast<int>(found.ladder.size());
  asked.seconds = least_seconds(climb, repetition);
  return asked;
}

const FixedChoice* cheapest(const std::vector<FixedChoice>& choices, double error) {
  const FixedChoice* best = nullptr;
  for (const FixedChoice& choice : choices)
    if (choice.error <= error && (best == nullptr || choice.seconds < best->seconds)) best = &choice;
  return best;
}

}  // namespace wavebalance::bench
