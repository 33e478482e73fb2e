#include "wavebalance/app/compare/comparison.hpp"

#include <fmt/format.h>

#include "wavebalance/app/files/quantity_text.hpp"

namespace wavebalance::app {
namespace {

/// The first entries of every summary.
Summary heading(const ComparisonRecord& record, const Scene& scene, double wall_seconds) {
  return {{"converged", record.converged},
          {"status", record.status},
          {"analysis", "comparison of a " + name_of(scene.analysis.type)},
          {"wall_seconds", wall_seconds}};
}

/// A line of a Markdown table; a vertical bar in a cell would end it.
std::string markdown_line(std::vector<std::string> cells) {
  for (std::string& cell : cells) std::replace(cell.begin(), cell.end(), '|', '/');
  return fmt::format("| {} |\n", fmt::join(cells, " | "));
}

std::string markdown_table(const std::vector<std::string>& columns, const Table& table) {
  std::string text = markdown_line(columns) + markdown_line(std::vector<std::string>(columns.size(), "---"));
  for (std::size_t row = 0; row < table.rows(); ++row) {
    std::vector<std::string> cells;
    for (const std::string& column : columns) {
      const Cell& cell = table.at(row, column);
      const double* number = std::get_if<double>(&cell);
      cells.push_back(number != nullptr ? (std::isfinite(*number) ? short_number(*number, 5) : "")
                                        : cell_text(cell));
    }
    text += markdown_line(std::move(cells));
  }
  return text;
}

std::string reference_sentence(const Reference& reference) {
  if (!reference.converged) return "No reference was found within its part of the budget.";
  std::string text = fmt::format("The reference is {}, accurate to {} in displacement", reference.text,
                                 short_number(reference.error, 1));
  if (std::isfinite(reference.force_error))
    text += fmt::format(", to {} in force", short_number(reference.force_error, 1));
  const std::string& stability = reference.stability.status;
  if (stability == "stable" || stability == "unstable") text += "; its motion is " + stability;
  return text + ".";
}

/// Which error decides.
std::string measure_sentence(const Comparison& comparison) {
  if (comparison.measure == ErrorMeasure::both)
    return "The error is the larger one of displacement and force.";
  std::string text = "The error is measured in " + subject_of(comparison.measure);
  if (!comparison.without_force.empty()) text += ", because " + comparison.without_force;
  return text + ".";
}

std::string counted(const Comparison& comparison) {
  const auto converged = std::ranges::count_if(comparison.points, &SolvePoint::converged);
  return fmt::format("{} solves, {} of them converged, {} in all.", comparison.points.size(), converged,
                     quantity(comparison.wall_seconds, "s", 2));
}

std::string recommendations_text(const std::vector<Recommendation>& recommendations, bool markdown) {
  std::string text;
  std::string before;
  for (const Recommendation& one : recommendations) {
    text += "\n" + one.sentences + "\n";
    if (one.time_table.empty()) continue;
    const bool same = one.time_table == before;
    before = one.time_table;
    if (same)
      text += "The [time] table is the one above.\n";
    else
      text += markdown ? "\n```toml\n" + one.time_table + "```\n" : "\n" + one.time_table;
  }
  return text;
}

/// Where each solve begins, if not with the response without contact.
std::string start_sentence(const Comparison& comparison) {
  if (!comparison.from_reference) return "";
  return comparison.reference.reached_directly
             ? "Each solve starts from the motion of the reference.\n"
             : "Each solve starts from the motion of the reference, because few functions do not "
               "converge from the linear response.\n";
}

std::vector<std::string> warnings_of(const Comparison& comparison) {
  std::vector<std::string> warnings;
  if (comparison.force_asked && !comparison.without_force.empty())
    warnings.push_back("the error is measured in the displacement, because " + comparison.without_force);
  if (comparison.reference.stability.status == "unstable")
    warnings.emplace_back(
        "the motion of the reference is unstable: the attractor is another one, and a solver may find either");
  constexpr int many_functions = 64;
  constexpr double far = 0.1;
  const auto others = std::ranges::count_if(comparison.points, [&](const SolvePoint& point) {
    return point.converged && point.functions >= many_functions && point.displacement_error > far;
  });
  if (others > 0)
    warnings.push_back(
        fmt::format("converged solves with {} functions or more that differ from the reference by more than "
                    "{}: {}; another motion may exist",
                    many_functions, far, others));
  for (const Recommendation& one : comparison.recommendations)
    if (one.stability == "unstable" && comparison.reference.stability.status != "unstable")
      warnings.push_back(
          fmt::format("the motion recommended for an error of {} is unstable", short_number(one.error, 1)));
  return warnings;
}

Table front_table(const Comparison& comparison) {
  Table table({"trial", "weight", "functions", "points", "tolerance", "seconds", "error",
               "displacement_error", "force_error"});
  for (const SolvePoint& point : envelope(comparison.points))
    table.append_row({point.pair.trial, point.pair.weight, std::int64_t{point.functions},
                      std::int64_t{point.points}, point.tolerance, point.seconds, point.error,
                      point.displacement_error, point.force_error});
  return table;
}

void add_reference(Summary& summary, const Reference& reference) {
  summary.emplace_back("reference", reference.kind);
  summary.emplace_back("reference_text", reference.text);
  summary.emplace_back("reference_error", reference.error);
  summary.emplace_back("reference_force_error", reference.force_error);
  summary.emplace_back("reference_seconds", reference.wall_seconds);
  summary.emplace_back("reference_stability", reference.stability.status);
  summary.emplace_back("reference_unstable_multipliers", std::int64_t{reference.stability.unstable});
}

std::string inadmissible_text(const std::vector<PairResult>& pairs) {
  std::string text;
  for (const PairResult& pair : pairs)
    if (!pair.inadmissible.empty()) text += fmt::format("- {}: {}\n", label_of(pair.pair), pair.inadmissible);
  return text.empty() ? text : "\nNot admissible:\n\n" + text;
}

const std::string no_time_text =
    "\nNo time was left to compare pairs, so nothing is recommended. A larger --budget helps.\n";

const std::string title = "# Which basis for this scene?\n\n";

}  // namespace

Table points_table(const Comparison& comparison) {
  Table table({"trial", "weight", "functions", "points", "tolerance", "inner_products",
               "construction_seconds", "seconds", "error", "displacement_error", "force_error",
               "below_reference", "converged", "status", "on_front"});
  for (const SolvePoint& point : comparison.points)
    table.append_row({point.pair.trial, point.pair.weight, std::int64_t{point.functions},
                      std::int64_t{point.points}, point.tolerance, point.inner_products,
                      point.construction_seconds, point.seconds, point.error, point.displacement_error,
                      point.force_error, point.error <= comparison.reference.error_by(comparison.measure),
                      point.converged, point.status, point.on_front});
  return table;
}

Table pairs_table(const Comparison& comparison) {
  Table table({"trial", "weight", "admissible", "solves", "converged", "largest_functions", "smallest_error",
               "order", "force_order", "order_points_per_function", "failures"});
  for (const PairResult& pair : comparison.pairs) {
    const bool admissible = pair.inadmissible.empty();
    table.append_row({pair.pair.trial, pair.pair.weight, admissible, std::int64_t{pair.solves},
                      std::int64_t{pair.converged}, std::int64_t{pair.largest_functions}, pair.smallest_error,
                      pair.order, pair.force_order, std::int64_t{pair.order_points_per_function},
                      admissible ? pair.failures : pair.inadmissible});
  }
  return table;
}

Table recommendations_table(const std::vector<Recommendation>& recommendations) {
  return tabulated(recommendations, [](const Recommendation& one) -> Summary {
    const SolvePoint none, &choice = one.choice ? *one.choice : none,
                           &fourier = one.fourier ? *one.fourier : none,
                           &exact = one.exact ? *one.exact : none;
    // A number of what was not chosen is missing.
    const auto count = [](const char* name, int number) {
      return number > 0 ? Entry(name, number) : Entry(name, solvers::missing);
    };
    return {{"error", one.error},
            {"error_of", to_string(one.measure)},
            {"trial", choice.pair.trial},
            {"weight", choice.pair.weight},
            count("functions", choice.functions),
            count("quadrature_points", choice.points),
            {"seconds", choice.seconds},
            {"displacement_error", choice.displacement_error},
            {"force_error", choice.force_error},
            count("fourier_functions", fourier.functions),
            {"fourier_seconds", fourier.seconds},
            {"fourier_time_ratio", one.fourier_time_ratio()},
            {"basis_matters", to_string(one.matters)},
            count("phases_functions", exact.functions),
            count("phases_points", exact.points),
            {"phases_seconds", exact.seconds},
            {"phases_error", exact.error},
            {"stability", one.stability},
            {"sentences", one.sentences},
            {"time_table", one.time_table}};
  });
}

Table curves_table(const SweepComparison& comparison) {
  Table table({"trial", "weight", "functions", "points", "seconds", "curve_points", "max_displacement_m",
               comparison.peak_column, "turning_points", "distance_from_finest", "distance_from_exact",
               "status"});
  for (const ComparedCurve& curve : comparison.curves)
    table.append_row(
        {curve.pair.trial, curve.pair.weight, std::int64_t{curve.functions}, std::int64_t{curve.points},
         curve.seconds, static_cast<std::int64_t>(curve.varied.size()), curve.peak, curve.peak_at,
         std::int64_t{curve.turning_points}, curve.distance, curve.distance_from_exact, curve.status});
  return table;
}

ComparisonRecord comparison_record(const Scene& scene, const Comparison& comparison) {
  ComparisonRecord record;
  record.converged = comparison.converged();
  record.interrupted = comparison.interrupted;
  record.status = comparison.status();
  record.warnings = warnings_of(comparison);
  record.summary = heading(record, scene, comparison.wall_seconds);
  record.reference = comparison.reference;
  add_reference(record.summary, record.reference);
  record.summary.emplace_back("error_of", std::string(to_string(comparison.measure)));
  record.summary.emplace_back("solves_begin_with", comparison.from_reference ? "reference" : "no_contact");
  record.summary.emplace_back("solves", static_cast<std::int64_t>(comparison.points.size()));
  if (!comparison.points.empty()) record.recommendations = comparison.recommendations;
  record.summary.emplace_back("recommendations", recommendations_table(record.recommendations));
  record.summary.emplace_back("pairs", pairs_table(comparison));
  record.summary.emplace_back("front", front_table(comparison));
  record.summary.emplace_back("warnings", record.warnings);
  record.table = points_table(comparison);
  if (!envelope(comparison.points).empty()) {
    record.pictures.push_back(
        {"error_over_time", error_over_time(comparison),
         "errors over solve times of the six pairs with the most points on the Pareto front (grey)"});
    record.pictures.push_back({"error_over_functions", error_over_functions(comparison),
                               "errors over functions, with the best number of points for each"});
  }
  const std::string opening = reference_sentence(comparison.reference) + "\n" +
                              (comparison.reference.converged ? measure_sentence(comparison) + "\n" : "") +
                              start_sentence(comparison) + counted(comparison) + "\n";
  const bool compared = !comparison.points.empty();
  const auto advice = [&](bool markdown) {
    return compared ? recommendations_text(comparison.recommendations, markdown) : no_time_text;
  };
  record.text = opening + advice(false);
  record.markdown = title + opening + advice(true) + "\n## Pairs\n\n" +
                    markdown_table({"trial", "weight", "solves", "converged", "largest_functions",
                                    "smallest_error", "order", "force_order", "failures"},
                                   pairs_table(comparison).where("admissible", "true")) +
                    inadmissible_text(comparison.pairs);
  return record;
}

ComparisonRecord comparison_record(const Scene& scene, const SweepComparison& comparison) {
  ComparisonRecord record;
  record.converged = comparison.converged();
  record.interrupted = comparison.interrupted;
  record.status = comparison.status();
  record.table = curves_table(comparison);
  record.peak_column = comparison.peak_column;
  record.peak_unit = comparison.unit;
  record.summary = heading(record, scene, comparison.wall_seconds);
  record.summary.emplace_back("curves", record.table);
  record.text = fmt::format("{} curves, {} in all.\n", comparison.curves.size(),
                            quantity(comparison.wall_seconds, "s", 2));
  if (comparison.exact) {
    const ComparedCurve& exact = *comparison.exact;
    record.text += fmt::format("The exact curve took {}. Its peak is {} at {}, and it turns {} times.\n",
                               quantity(exact.seconds, "s", 2), quantity(exact.peak, "m", 6),
                               quantity(exact.peak_at, comparison.unit, 6), exact.turning_points);
  }
  if (comparison.finest) {
    const ComparedCurve& finest = comparison.curves[*comparison.finest];
    record.text += fmt::format(
        "The finest curve is {} with {} functions. Its peak is {} at {}, and it turns {} times.\n",
        label_of(finest.pair), finest.functions, quantity(finest.peak, "m", 6),
        quantity(finest.peak_at, comparison.unit, 6), finest.turning_points);
    record.pictures.push_back(
        {"sweeps", curves_figure(comparison), "the finest curve of each pair, and distances over functions"});
  }
  std::vector<std::string> shown = record.table.columns();
  std::erase(shown, "points");
  const std::string table = markdown_table(shown, record.table);
  record.markdown = title + record.text + "\n" + table + inadmissible_text(comparison.inadmissible);
  record.text += "\n" + table;
  return record;
}

ComparisonRecord compare_bases(const Scene& scene, const ComparisonOptions& options,
                               const solvers::Observer& observer) {
  if (is_sweep(scene.analysis.type))
    return comparison_record(scene, compare_sweeps(scene, options, observer));
  return comparison_record(scene, compare_responses(scene, options, observer));
}

}  // namespace wavebalance::app
