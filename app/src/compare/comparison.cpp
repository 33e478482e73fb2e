#include "wavebalance/app/compare/comparison.hpp"

#include <fmt/format.h>

#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/app/files/quantity_text.hpp"

namespace wavebalance::app {
namespace {

constexpr int error_points = 1024;        // at which motions are compared
constexpr double reference_share = 0.3;   // of the budget; a third of it for the exact solution
constexpr double exact_share = 0.1;       // of the budget: the exact solution, in addition to the pairs
constexpr double longest_share = 0.1;     // of the budget: a single solve
constexpr double smallest_error = 1e-8;   // a pair that reaches it is not solved with more functions
constexpr double stability_share = 0.05;  // of the budget, kept for the stability of what is recommended

std::vector<int> doubled_sizes(int first, int largest) {
  std::vector<int> sizes;
  for (int size = first; size <= largest; size *= 2) sizes.push_back(size);
  return sizes;
}

class ResponseComparison {
 public:
  ResponseComparison(const Scene& scene, const ComparisonOptions& options, const solvers::Observer& observer)
      : measured_{scene, make_model(scene, observer), {}}, options_(options), observer_(observer) {
    measured_.model.threads = options.threads;
  }

  Comparison compare() {
    SplitPairs pairs = split_pairs(measured_.scene, options_);
    found_.reference = find_reference(
        measured_.scene, measured_.model, error_points, reference_share * options_.budget,
        [&](const solvers::Progress&) { return goes_on("reference"); }, options_.start);
    if (found_.reference.converged) {
      measured_.reference = found_.reference.motion;
      found_.from_reference = !options_.start.contacts.empty() || !found_.reference.reached_directly;
      if (found_.from_reference) measured_.start = {"the reference", found_.reference.motion, 1};
      choose_measure();
      const std::vector<SolvePoint> exact = collocation_points();
      found_.points = size_study(measured_, pairs.admissible, size_options());
      std::erase_if(found_.points, [](const SolvePoint& point) { return point.status == "not_run"; });
      found_.points.insert(found_.points.begin(), exact.begin(), exact.end());
      mark_front(found_.points);
      add_recommendations();
    }
    found_.pairs = pair_results(pairs.admissible, found_.points, reference_error());
    add_exact_result();
    for (PairResult& other : pairs.others) found_.pairs.push_back(std::move(other));
    found_.wall_seconds = clock_.seconds();
    return std::move(found_);
  }

 private:
  /// False after an interrupt.
  bool goes_on(std::string_view phase) {
    if (!found_.interrupted)
      found_.interrupted = !solvers::goes_on(
          observer_, {phase, 0, solvers::missing, {}, std::min(1.0, clock_.seconds() / options_.budget)});
    return !found_.interrupted;
  }

  double reference_error() const { return found_.reference.error_by(found_.measure); }

  /// The force decides, too, where its error is defined: some force acts, and the reference's is accurate
  /// enough for the largest error of a recommendation.
  void choose_measure() {
    using enum ErrorMeasure;
    found_.measure = options_.measure.value_or(both);
    found_.force_asked = options_.measure.has_value() && found_.measure != displacement;
    if (found_.measure != displacement) {
      const double of_force = found_.reference.force_error;
      double largest = 0.0;
      for (const double error : options_.errors) largest = std::max(largest, error);
      if (!(found_.reference.motion.force.squaredNorm() > 0.0))
        found_.without_force = "no contact force acts";
      else if (!std::isfinite(of_force))
        found_.without_force = "the force error of the reference is not known";
      else if (!found_.force_asked && of_force > known_share * largest)
        found_.without_force =
            fmt::format("the force error of the reference is about {}", short_number(of_force, 1));
      if (!found_.without_force.empty()) found_.measure = displacement;
    }
    measured_.measure = found_.measure;
  }

  /// Where they have found the reference.
  std::vector<SolvePoint> collocation_points() {
    if (found_.reference.kind != "phases") return {};
    ExactStudyOptions study;
    study.max_seconds = longest_share * exact_share * options_.budget;
    study.solve = timed_solves();
    const double end = clock_.seconds() + exact_share * options_.budget;
    study.observer = [this, end](const solvers::Progress& progress) {
      return goes_on(progress.phase) && clock_.seconds() < end;
    };
    return exact_study(measured_, found_.reference, study);
  }

  /// After the admissible pairs: the exact solution, or why it was not computed.
  void add_exact_result() {
    const std::string& reason = found_.reference.without_exact;
    const BasisPair exact = BasisPair::exact();
    if (reason.empty() && points_of(exact, found_.points).empty()) return;
    found_.pairs.push_back(pair_results({exact}, found_.points, reference_error()).front());
    found_.pairs.back().inadmissible = reason;
  }

  Repetition timed_solves() const {
    return {
        .budget = std::min(0.02, 2e-4 * options_.budget), .least = 2, .max_seconds = 0.005 * options_.budget};
  }

  SizeStudyOptions size_options() {
    SizeStudyOptions sizes;
    sizes.functions = doubled_sizes(options_.first_functions, options_.largest_functions);
    sizes.points_per_function = options_.points_per_function;
    sizes.max_seconds = longest_share * options_.budget;
    sizes.smallest_error = std::max(smallest_error, reference_error());
    sizes.solve = timed_solves();
    sizes.longest_ratio = 10.0;
    sizes.dominated_ratio = 5.0;
    sizes.construction = {.budget = 0.0, .least = 1, .max_seconds = 0.0};
    sizes.threads = options_.threads;
    sizes.observer = [this](const solvers::Progress& progress) {
      return goes_on(progress.phase) && clock_.seconds() < (1.0 - stability_share) * options_.budget;
    };
    return sizes;
  }

  void add_recommendations() {
    for (const double error : options_.errors) {
      Recommendation one =
          recommend(found_.points, error, reference_error(), measured_.scene.time, found_.measure);
      if (one.choice && measured_.scene.analysis.stability) one.stability = stability_of(*one.choice);
      found_.recommendations.push_back(std::move(one));
    }
  }

  /// The stability of the motion of a choice, computed once for choices that are recommended twice.
  std::string stability_of(const SolvePoint& choice) {
    for (const Recommendation& before : found_.recommendations)
      if (before.choice && before.choice->pair == choice.pair && before.choice->points == choice.points &&
          before.choice->functions == choice.functions)
        return before.stability;
    if (!goes_on("stability")) return "";
    Scene scene = discretised(measured_.scene, choice.pair, choice.functions, choice.points);
    scene.analysis.output_points = error_points;
    ResponseOptions options;
    options.stability = true;
    solvers::ResponseStart start = response_start(measured_.start, scene);
    options.stay_near_guess = start.displacement.size() > 0;
    options.guess = std::move(start.displacement);
    options.guess_force = std::move(start.force);
    const Response response = weighted_residual_response(scene, measured_.model, options);
    return response.stability ? response.stability->status : "";
  }

  WallClock clock_;
  MeasuredScene measured_;
  const ComparisonOptions& options_;
  const solvers::Observer& observer_;
  Comparison found_;
};

void check_scene_type(const Scene& scene) {
  const AnalysisType type = scene.analysis.type;
  if (type != AnalysisType::forced_response && !is_sweep(type))
    throw std::invalid_argument("analysis.type = \"" + name_of(type) +
                                "\": pairs of bases are compared in a \"forced_response\", a "
                                "\"frequency_sweep\" or an \"amplitude_sweep\"");
  if (has_impacts(scene.contact))
    throw std::invalid_argument(
        "contact.restitution is given, and motions with impacts have no bases to compare; "
        "expected none, or wavebalance run");
  if (names_friction_of_states(scene.contact))
    throw std::invalid_argument(
        "friction with surface_speed, static_friction, tangential_damping or normal_damping is "
        "solved exactly, without bases to compare; expected none of them, or wavebalance run");
  if (scene.analysis.subharmonic != 1)
    throw std::invalid_argument("analysis.subharmonic = " + std::to_string(scene.analysis.subharmonic) +
                                ": motions of one period of the load are compared; expected 1");
}

}  // namespace

void check_comparison(const Scene& scene, const ComparisonOptions& options) {
  check_scene_type(scene);
  if (!(options.budget > 0.0) || !std::isfinite(options.budget))
    throw std::invalid_argument("--budget " + cell_text(options.budget) + ": expected seconds > 0");
  if (options.threads < 0)
    throw std::invalid_argument("--threads " + std::to_string(options.threads) +
                                ": expected at least 1, or 0 for one per core");
  if (options.measure && *options.measure != ErrorMeasure::displacement &&
      scene.analysis.type != AnalysisType::forced_response)
    throw std::invalid_argument(
        "--error " + std::string(to_string(*options.measure)) +
        ": curves of a sweep are compared by their displacements; expected displacement");
  require_start_fits(options.start, discretised(scene, {"fourier", "fourier"}, 3, 8));
  for (const BasisPair& pair : options.pairs) {
    const auto found = admissibility_of(pair, scene);
    if (!found.admissible)
      throw std::invalid_argument("--pairs " + name_of(pair) + ": not an admissible pair: " + found.reason);
  }
}

Comparison compare_responses(const Scene& scene, const ComparisonOptions& options,
                             const solvers::Observer& observer) {
  check_comparison(scene, options);
  return ResponseComparison(scene, options, observer).compare();
}

}  // namespace wavebalance::app
