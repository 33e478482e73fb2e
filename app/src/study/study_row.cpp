#include "wavebalance/app/study/study.hpp"

#include <exception>
#include <new>

#include "files/json_line.hpp"
#include "files/missing.hpp"
#include "results/quantities.hpp"
#include "wavebalance/app/analysis/cost_estimate.hpp"
#include "wavebalance/app/files/wall_clock.hpp"
#include "wavebalance/app/results/record.hpp"
#include "wavebalance/app/scene/contacts.hpp"
#include "wavebalance/app/scene/scene_error.hpp"

namespace wavebalance::app {
namespace {

/// Results of a run that did not converge are missing, but not statistics of a motion that does not repeat.
/// A row has members for the entries of the heading.
Summary scalars_of(const Summary& summary, bool converged) {
  Summary scalars;
  for (const Entry& one : summary) {
    if (!one.scalar() || one.kind == EntryKind::heading) continue;
    scalars.push_back(one);
    if (!converged && one.kind == EntryKind::result) scalars.back().value = missing;
  }
  return scalars;
}

void solve_into(StudyRow& row, const Scene& scene, bool follow, LastStructure& last,
                const solvers::Observer& observer) {
  check_memory(scene);
  const bool fits = follow && last.cycle.contacts.rows() == contact_count(scene);
  const Record record = analyse(scene, {.start = fits ? last.cycle : StartMotion{},
                                        .observer = observer,
                                        .model = &last.model_of(scene, observer)});
  if (follow && record.converged) {
    last.cycle = record.cycle;
    last.cycle.source = "run " + std::to_string(row.run + 1);
  }
  row.status = record.status;
  row.converged = record.converged;
  row.values = scalars_of(record.summary, record.converged || record.status == quantities::aperiodic);
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
  const WallClock clock;
  StudyRow row;
  row.run = run;
  row.status = "refused";
  try {
    solve_into(row, scene_of_run(study, runs, run, last.earlier()), study.follow, last, observer);
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
  row.seconds = clock.seconds();
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
      if ((*found)[i].name != members[i]) return false;
    return true;
  };
  if (!found || found->size() < members.size() || !fits())
    throw std::invalid_argument("parse_row: no row of a study");
  StudyRow row;
  try {
    row.run = std::get<std::int64_t>((*found)[0].value) - 1;
    row.status = std::get<std::string>((*found)[1].value);
    row.converged = std::get<bool>((*found)[2].value);
    row.seconds = std::get<double>((*found)[3].value);
    row.message = std::get<std::string>((*found)[4].value);
  } catch (const std::bad_variant_access&) {
    throw std::invalid_argument("parse_row: no row of a study");
  }
  row.values.assign(found->begin() + members.size(), found->end());
  return row;
}

}  // namespace wavebalance::app
