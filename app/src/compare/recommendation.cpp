#include "wavebalance/app/compare/comparison.hpp"

#include <fmt/format.h>

#include <tuple>

#include "scene/enum_names.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/files/quantity_text.hpp"

namespace wavebalance::app {

template <>
inline constexpr std::array<NamedValue<BasisMatters>, 5> enum_names<BasisMatters>{
    {{BasisMatters::no_choice, "no_choice"},
     {BasisMatters::little, "little"},
     {BasisMatters::much, "much"},
     {BasisMatters::fourier_fails, "fourier_fails"},
     {BasisMatters::not_compared, "not_compared"}}};

namespace {

constexpr double little_ratio = 2.0;
constexpr double noise = 1.1;  // between the times of two runs

bool reaches(const SolvePoint& point, double error) {
  return point.method == "weighted_residual" && point.converged && point.error <= error;
}

bool is_cheaper(const SolvePoint& a, const SolvePoint& b) {
  return std::tuple(a.seconds, a.functions, a.points) < std::tuple(b.seconds, b.functions, b.points);
}

/// "DB6:Fourier with 128 functions and 256 points"
std::string choice_text(const SolvePoint& point) {
  return fmt::format("{} with {} functions and {} points", label_of(point.pair), point.functions,
                     point.points);
}

/// "0.012 in 110 µs"
std::string outcome_of(const SolvePoint& point) {
  return short_number(point.error, 2) + " in " + quantity(point.seconds, "s", 3);
}

std::string errors_of(const SolvePoint& point) {
  std::string text = "error " + short_number(point.displacement_error, 2) + " in displacement";
  if (!std::isnan(point.force_error)) text += ", " + short_number(point.force_error, 2) + " in force";
  return text;
}

/// "1e-2 in displacement and force"
std::string asked_text(const Recommendation& found) {
  return short_number(found.error, 1) + " in " + subject_of(found.measure);
}

std::string first_sentence(const Recommendation& found, bool steady) {
  std::string text = fmt::format("For an error of {} the cheapest pair is {}: {} per solve ({})",
                                 asked_text(found), choice_text(*found.choice),
                                 quantity(found.choice->seconds, "s", 3), errors_of(*found.choice));
  if (!steady) text += ", but the next size is less accurate";
  if (found.near_miss) text += "; " + choice_text(*found.near_miss) + " has " + outcome_of(*found.near_miss);
  return text + ".";
}

/// "takes 1.3 times as long"
std::string ratio_text(double ratio) {
  if (std::abs(ratio - 1.0) < noise - 1.0) return "needs as long";
  return fmt::format("needs {:.{}f} times as long", ratio, ratio < 9.95 ? 1 : 0);
}

/// The second sentence where the choice is Fourier:Fourier: it names the best other pair.
std::string runner_up_sentence(const Recommendation& found) {
  if (!found.runner_up) return "No other pair reaches it within the budget.";
  const double ratio = found.runner_up->seconds / found.choice->seconds;
  if (found.runner_up->error > found.error)
    return fmt::format("The basis matters little: the next pair, {}, has {}.", choice_text(*found.runner_up),
                       outcome_of(*found.runner_up));
  const char* opening = ratio <= little_ratio ? "The basis matters little" : "The basis matters";
  return fmt::format("{}: the next pair, {}, {} ({}).", opening, choice_text(*found.runner_up),
                     ratio_text(ratio), quantity(found.runner_up->seconds, "s", 3));
}

/// Where Fourier:Fourier is late or never reaches the error, but misses it by little.
std::string near_fourier_sentence(const Recommendation& found) {
  const SolvePoint& near = *found.fourier_near_miss;
  const std::string later =
      found.fourier ? fmt::format(", and reaches it with {} and {} in {}", found.fourier->functions,
                                  found.fourier->points, quantity(found.fourier->seconds, "s", 3))
                    : std::string();
  return fmt::format("The basis matters little: {} has {}{}.", choice_text(near), outcome_of(near), later);
}

std::string second_sentence(const Recommendation& found, const std::vector<SolvePoint>& points) {
  if (found.matters == BasisMatters::fourier_fails) {
    double least = std::numeric_limits<double>::infinity();
    for (const SolvePoint& point : points)
      if (point.pair.is_fourier() && reaches(point, least)) least = point.error;
    const bool known = std::isfinite(least) && least > found.error;
    return "The basis matters: Fourier:Fourier does not reach it within the budget" +
           (known ? ", its smallest error is " + short_number(least, 2) + "." : std::string("."));
  }
  if (found.matters == BasisMatters::little && found.choice->pair.is_fourier())
    return runner_up_sentence(found);
  if (found.matters == BasisMatters::little && found.fourier_near_miss) return near_fourier_sentence(found);
  if (found.matters == BasisMatters::little || found.matters == BasisMatters::much)
    return fmt::format("The basis matters{}: {} {} ({}).",
                       found.matters == BasisMatters::little ? " little" : "", choice_text(*found.fourier),
                       ratio_text(found.fourier_time_ratio()), quantity(found.fourier->seconds, "s", 3));
  return "Fourier:Fourier was not among the pairs.";
}

/// If no pair reaches the error of the force: the choice for the displacement only.
std::string displacement_sentence(const Recommendation& found, std::vector<SolvePoint> points) {
  if (found.measure == ErrorMeasure::displacement) return "";
  for (SolvePoint& point : points) point.error = point.displacement_error;
  const auto able = cheapest(points, found.error);
  if (!able) return "";
  return fmt::format(" In displacement only, {} reaches it in {} (--error displacement).", choice_text(*able),
                     quantity(able->seconds, "s", 3));
}

/// Why there is no choice, and what came nearest.
std::string without_choice(const Recommendation& found, const std::vector<SolvePoint>& points,
                           double reference_error) {
  const auto nearer = [](const SolvePoint& a, const SolvePoint& b) {
    const bool first = reaches(a, std::numeric_limits<double>::infinity());
    const bool second = reaches(b, std::numeric_limits<double>::infinity());
    return first != second ? first : first && a.error < b.error;
  };
  const auto best = std::ranges::min_element(points, nearer);
  const std::string which = asked_text(found);
  if (best == points.end() || !reaches(*best, std::numeric_limits<double>::infinity()))
    return "No pair reaches an error of " + which +
           " within the budget. None of the solves has converged with a known error.";
  const std::string nearest = choice_text(*best) + " comes nearest, with " + outcome_of(*best) + ".";
  const auto below = cheapest(points, reference_error);  // how far below is not known
  if (reference_error > known_share * found.error)
    return fmt::format(
        "Whether a pair reaches an error of {} is not known, because the reference has an error "
        "of about {}. A larger budget refines it. {}",
        which, short_number(reference_error, 2),
        below ? fmt::format("{} is below this in {}.", choice_text(*below), quantity(below->seconds, "s", 3))
              : nearest);
  return "No pair reaches an error of " + which + " within the budget. " + nearest +
         displacement_sentence(found, points);
}

/// The time of the exact solution, and what a run can report of it.
std::string exact_sentence(const Recommendation& found) {
  const SolvePoint& exact = *found.exact;
  return fmt::format(
      " The exact solution {}: {} from harmonic balance with {} functions and {} points ({}). "
      "A run with these sizes also reports the contact intervals, the errors of the response "
      "and its stability.",
      found.choice ? "is faster" : "reaches it", quantity(exact.seconds, "s", 3), exact.functions,
      exact.points, errors_of(exact));
}

std::string time_table_of(const SolvePoint& point, Time time) {
  time.trial = point.pair.trial;
  time.weight = point.pair.weight;
  std::string text = fmt::format(
      "[time]\ntrial = \"{}\"\nweight = \"{}\"\nfunctions = {}\nquadrature_points = {}\nformulation = "
      "\"{}\"\ninner_products = \"{}\"\n",
      time.trial, time.weight, point.functions, point.points, name_of(time.formulation),
      name_of(effective_inner_products(time)));
  if (point.functions % 2 == 0) text += fmt::format("nyquist = \"{}\"\n", name_of(time.nyquist));
  if (time.sample_offset != 0.0) text += fmt::format("sample_offset = {}\n", time.sample_offset);
  return text;
}

/// The error is a sharp limit, which a size may miss by little.
void note_near_misses(Recommendation& found, const std::vector<SolvePoint>& points) {
  constexpr double slightly = 1.5, much_faster = 0.5;
  const auto near = [&](const std::vector<SolvePoint>& among, double most_seconds) {
    auto one = cheapest(among, slightly * found.error);
    if (one && (one->error <= found.error || one->seconds > most_seconds)) one.reset();
    return one;
  };
  if (found.choice->pair.is_fourier()) {
    std::vector<SolvePoint> others = points;
    std::erase_if(others, [](const SolvePoint& point) { return point.pair.is_fourier(); });
    const double little = little_ratio * found.choice->seconds;
    found.runner_up = cheapest(others, found.error);
    if (!found.runner_up || found.runner_up->seconds > little)
      if (auto close = near(others, little)) found.runner_up = std::move(close);
  }
  found.near_miss = near(points, much_faster * found.choice->seconds);
  if (!found.fourier || found.fourier_time_ratio() > little_ratio)
    found.fourier_near_miss =
        near(points_of({"fourier", "fourier"}, points), little_ratio * found.choice->seconds);
}

BasisMatters matters_of(const Recommendation& found, const std::vector<SolvePoint>& points) {
  const bool compared =
      std::ranges::any_of(points, [](const SolvePoint& point) { return point.pair.is_fourier(); });
  if (!found.choice) return BasisMatters::no_choice;
  if (!compared) return BasisMatters::not_compared;
  if (found.fourier_near_miss) return BasisMatters::little;
  if (!found.fourier) return BasisMatters::fourier_fails;
  return found.fourier_time_ratio() <= little_ratio ? BasisMatters::little : BasisMatters::much;
}

void prefer_fourier(Recommendation& found, const std::vector<SolvePoint>& points) {
  if (!found.fourier) return;
  const bool steady = is_steady(*found.fourier, points, found.error);
  if (steady && found.fourier->seconds <= noise * found.choice->seconds) found.choice = found.fourier;
}

void note_exact(Recommendation& found, const std::vector<SolvePoint>& points) {
  for (const SolvePoint& point : points_of(BasisPair::exact(), points))
    if (point.converged && point.error <= found.error &&
        (!found.exact || point.seconds < found.exact->seconds))
      found.exact = point;
  if (found.exact && found.choice && noise * found.exact->seconds >= found.choice->seconds)
    found.exact.reset();
}

}  // namespace

bool is_steady(const SolvePoint& point, const std::vector<SolvePoint>& points, double error) {
  const int next = point.functions % 2 == 0 ? 2 * point.functions : 2 * point.functions + 1;
  const auto is_next = [&](const SolvePoint& other) {
    return other.method == point.method && other.pair == point.pair && other.functions == next &&
           other.points == 2 * point.points && other.status != "not_run";
  };
  const auto found = std::ranges::find_if(points, is_next);
  return found == points.end() || reaches(*found, error);
}

std::optional<SolvePoint> cheapest(const std::vector<SolvePoint>& points, double error) {
  std::vector<SolvePoint> able;
  for (const SolvePoint& point : points)
    if (reaches(point, error)) able.push_back(point);
  if (able.empty()) return std::nullopt;
  const auto unsteady = [&](const SolvePoint& point) { return !is_steady(point, points, error); };
  if (!std::ranges::all_of(able, unsteady)) std::erase_if(able, unsteady);
  const SolvePoint best = *std::ranges::min_element(able, is_cheaper);
  return *std::ranges::min_element(able, [&](const SolvePoint& a, const SolvePoint& b) {
    const auto rank = [&](const SolvePoint& point) {
      const bool equal = point.pair == best.pair && point.seconds <= noise * best.seconds;
      return std::tuple(!equal, point.functions, point.points);
    };
    return rank(a) < rank(b);
  });
}

std::string_view to_string(BasisMatters value) { return enum_name(value); }

double Recommendation::fourier_time_ratio() const {
  return choice && fourier ? fourier->seconds / choice->seconds : solvers::missing;
}

Recommendation recommend(const std::vector<SolvePoint>& points, double error, double reference_error,
                         const Time& time, ErrorMeasure measure) {
  Recommendation found;
  found.error = error;
  found.measure = measure;
  if (reference_error <= known_share * error) {
    found.choice = cheapest(points, error);
    found.fourier = cheapest(points_of({"fourier", "fourier"}, points), error);
    prefer_fourier(found, points);
    note_exact(found, points);
  }
  if (found.choice) note_near_misses(found, points);
  found.matters = matters_of(found, points);
  const std::string of_exact = found.exact ? exact_sentence(found) : std::string();
  if (!found.choice) {
    found.sentences = without_choice(found, points, reference_error) + of_exact;
    return found;
  }
  found.sentences = first_sentence(found, is_steady(*found.choice, points, error)) + " " +
                    second_sentence(found, points) + of_exact;
  found.time_table = time_table_of(*found.choice, time);
  return found;
}

}  // namespace wavebalance::app
