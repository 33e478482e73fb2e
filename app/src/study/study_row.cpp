#include "wavebalance/app/study/study_row.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <exception>
#include <limits>
#include <new>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <utility>

#include "wavebalance/app/analysis/analysis.hpp"
#include "wavebalance/app/analysis/cost_estimate.hpp"
#include "wavebalance/app/scene/scene_error.hpp"

namespace wavebalance::app {
namespace {

/// Values of a summary that a row has members for, or that are those of the scene.
constexpr std::array<std::string_view, 5> left_out{"converged", "status", "wall_seconds", "analysis",
                                                   "reduction_seconds"};

Summary scalars_of(const Summary& summary) {
  Summary scalars;
  for (const auto& [name, value] : summary) {
    const bool scalar = std::holds_alternative<double>(value) ||
                        std::holds_alternative<std::int64_t>(value) || std::holds_alternative<bool>(value) ||
                        std::holds_alternative<std::string>(value);
    if (scalar && std::find(left_out.begin(), left_out.end(), name) == left_out.end())
      scalars.emplace_back(name, value);
  }
  return scalars;
}

void require_memory(const Scene& scene) {
  const double needed = estimate_cost(scene).bytes, limit = available_memory();
  if (needed > limit)
    throw std::invalid_argument("it would take about " + memory_text(needed) + " of memory and there are " +
                                memory_text(limit));
}

/// One thread per run: others solve the next ones.
void solve_into(StudyRow& row, const Scene& scene, LastStructure& last, const solvers::Observer& observer) {
  require_memory(scene);
  const Record record =
      analyse(scene, {.observer = observer, .threads = 1, .model = &last.model_of(scene, observer)});
  row.status = record.status;
  row.converged = record.converged;
  row.values = scalars_of(record.summary);
  if (!record.warnings.empty()) row.message = record.warnings.front();
}

SummaryValue value_of_json(const nlohmann::ordered_json& value) {
  if (value.is_boolean()) return value.get<bool>();
  if (value.is_number_integer()) return value.get<std::int64_t>();
  if (value.is_number()) return value.get<double>();
  if (value.is_null()) return std::numeric_limits<double>::quiet_NaN();
  return value.get<std::string>();
}

}  // namespace

StudyRow solve_run(const Study& study, const StudyRuns& runs, std::int64_t run,
                   const solvers::Observer& observer) {
  LastStructure none;
  return solve_run(study, runs, run, none, observer);
}

StudyRow solve_run(const Study& study, const StudyRuns& runs, std::int64_t run, LastStructure& last,
                   const solvers::Observer& observer) {
  const auto start = std::chrono::steady_clock::now();
  StudyRow row;
  row.run = run;
  row.status = "refused";
  try {
    solve_into(row, scene_of_run(study, runs, run, last.earlier()), last, observer);
  } catch (const std::invalid_argument& error) {
    row.message = error.what();
  } catch (const SceneError& error) {
    row.message = error.what();
  } catch (const std::bad_alloc&) {
    row.status = "failed";
    row.message = "not enough memory";
  } catch (const std::exception& error) {
    row.status = "failed";
    row.message = error.what();
  }
  row.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return row;
}

std::string json_line(const StudyRow& row) {
  nlohmann::ordered_json object{{"run", row.run + 1},
                                {"status", row.status},
                                {"converged", row.converged},
                                {"seconds", row.seconds},
                                {"message", row.message}};
  nlohmann::ordered_json& values = object["values"] = nlohmann::ordered_json::object();
  for (const auto& [name, value] : row.values)
    std::visit(
        [&, &key = name](const auto& one) {
          using Value = std::decay_t<decltype(one)>;
          if constexpr (std::is_same_v<Value, double> || std::is_same_v<Value, std::int64_t> ||
                        std::is_same_v<Value, bool> || std::is_same_v<Value, std::string>)
            values[key] = one;
        },
        value);
  return object.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

StudyRow parse_row(std::string_view line) {
  StudyRow row;
  try {
    const auto object = nlohmann::ordered_json::parse(line);
    row.run = object.at("run").get<std::int64_t>() - 1;
    row.status = object.at("status").get<std::string>();
    row.converged = object.at("converged").get<bool>();
    row.seconds = object.at("seconds").get<double>();
    row.message = object.at("message").get<std::string>();
    for (const auto& [name, value] : object.at("values").items())
      row.values.emplace_back(name, value_of_json(value));
  } catch (const nlohmann::ordered_json::exception& error) {
    throw std::invalid_argument("parse_row: no row of a study: " + std::string(error.what()));
  }
  return row;
}

}  // namespace wavebalance::app
