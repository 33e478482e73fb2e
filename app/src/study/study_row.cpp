#include "wavebalance/app/study/study_row.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <exception>
#include <limits>
#include <new>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "files/json_line.hpp"
#include "wavebalance/app/analysis/cost_estimate.hpp"
#include "wavebalance/app/results/record.hpp"
#include "wavebalance/app/scene/scene_error.hpp"

namespace wavebalance::app {
namespace {

/// Values of a summary that a row has members for, or that are those of the scene.
constexpr std::array<std::string_view, 5> left_out{"converged", "status", "wall_seconds", "analysis",
                                                   "reduction_seconds"};

/// Whether a value of a summary is one of a motion or a curve, and not of the scene or of its solution.
bool is_result(std::string_view name) {
  constexpr std::array<std::string_view, 4> units{"_m", "_N", "_J", "_m_per_s2"};
  constexpr std::array<std::string_view, 16> others{"contact_fraction",
                                                    "complementarity",
                                                    "change_after_one_period",
                                                    "period_of_motion",
                                                    "frequency_at_max_displacement_Hz",
                                                    "leading_contact",
                                                    "unstable_multipliers",
                                                    "leading_multiplier_real",
                                                    "leading_multiplier_imag",
                                                    "energy_ratio",
                                                    "frequency_ratio",
                                                    "rayleigh_frequency_ratio",
                                                    "virial_residual",
                                                    "largest_energy_ratio",
                                                    "largest_frequency_ratio",
                                                    "max_penetration_over_gap"};
  return std::any_of(units.begin(), units.end(), [&](auto unit) { return name.ends_with(unit); }) ||
         std::find(others.begin(), others.end(), name) != others.end();
}

/// Results of a run that did not converge are missing.
Summary scalars_of(const Summary& summary, bool converged) {
  Summary scalars;
  for (const auto& [name, value] : summary) {
    if (!converged && is_result(name)) {
      scalars.emplace_back(name, std::numeric_limits<double>::quiet_NaN());
      continue;
    }
    const bool scalar = std::holds_alternative<double>(value) ||
                        std::holds_alternative<std::int64_t>(value) || std::holds_alternative<bool>(value) ||
                        std::holds_alternative<std::string>(value);
    if (scalar && std::find(left_out.begin(), left_out.end(), name) == left_out.end())
      scalars.emplace_back(name, value);
  }
  return scalars;
}

void solve_into(StudyRow& row, const Scene& scene, LastStructure& last, const solvers::Observer& observer) {
  check_memory(scene);
  const Record record = analyse(scene, {.observer = observer, .model = &last.model_of(scene, observer)});
  row.status = record.status;
  row.converged = record.converged;
  row.values = scalars_of(record.summary, record.converged);
  if (!record.warnings.empty()) row.message = record.warnings.front();
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
  Summary line{{"run", row.run + 1},
               {"status", row.status},
               {"converged", row.converged},
               {"seconds", row.seconds},
               {"message", row.message}};
  line.insert(line.end(), row.values.begin(), row.values.end());
  return json_line(line);
}

StudyRow parse_row(std::string_view line) {
  const std::optional<Summary> found = parse_summary(line);
  constexpr std::array<std::string_view, 5> members{"run", "status", "converged", "seconds", "message"};
  const auto fits = [&] {
    for (std::size_t i = 0; i < members.size(); ++i)
      if ((*found)[i].first != members[i]) return false;
    return true;
  };
  if (!found || found->size() < members.size() || !fits())
    throw std::invalid_argument("parse_row: no row of a study");
  StudyRow row;
  try {
    row.run = std::get<std::int64_t>((*found)[0].second) - 1;
    row.status = std::get<std::string>((*found)[1].second);
    row.converged = std::get<bool>((*found)[2].second);
    row.seconds = std::get<double>((*found)[3].second);
    row.message = std::get<std::string>((*found)[4].second);
  } catch (const std::bad_variant_access&) {
    throw std::invalid_argument("parse_row: no row of a study");
  }
  row.values.assign(found->begin() + members.size(), found->end());
  return row;
}

}  // namespace wavebalance::app
