#include "results/analyses.hpp"

#include "attractors/limit_cycle.hpp"
#include "results/quantities.hpp"
#include "results/record_parts.hpp"

namespace wavebalance::app {
namespace {

Table multipliers_table(const Response& response) {
  Table table({"real", "imag", "modulus"});
  const Eigen::VectorXcd multipliers =
      response.moves ? response.exact->motion.multipliers() : Eigen::VectorXcd();
  for (const std::complex<double> one : multipliers)
    table.append_row({one.real(), one.imag(), std::abs(one)});
  return table;
}

}  // namespace

std::string limit_cycle_plan(const Scene& scene) {
  return fmt::format(
      "time       event-driven integration from rest, from contacts moved by their surfaces, "
      "and from up to {} random states\n",
      scene.analysis.random_starts);
}

Record limit_cycle_record(const Scene& scene, const StructureModel& model, const AnalysisOptions& how) {
  ResponseOptions options = response_options(scene, how.observer);
  options.stability = true;
  const LimitCycleResponse solved = limit_cycle_response(scene, model, how.start, options);
  Scene moving = scene;
  moving.forcing.frequency = solved.frequency;
  Record record = response_record(moving, model, solved.response);
  record.interrupted = solved.found.status == solvers::LimitCycleStatus::cancelled;
  if (record.interrupted) record.status = "interrupted";
  if (!how.start.source.empty()) record.add(quantities::start_from, how.start.source);
  if (solved.response.moves)
    record.cycle = {.source = {}, .contacts = solved.response.contacts, .frequency = solved.frequency};
  record.add("period_s", 1.0 / solved.frequency);
  record.add("starts", solved.found.starts);
  record.add("starts_at_rest", solved.found.came_to_rest);
  record.add("starts_that_grow", solved.found.grew);
  record.add("starts_without_motion", solved.found.lost);
  record.add("multipliers", multipliers_table(solved.response));
  return record;
}

}  // namespace wavebalance::app
