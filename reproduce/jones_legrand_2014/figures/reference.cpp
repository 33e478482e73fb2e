// The time-stepping reference of one case, which Figs. 6-11 read.
#include <fmt/format.h>

#include "figures.hpp"
#include "jl14.hpp"
#include "motion.hpp"
#include "readings.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/results/tables.hpp"
#include "wavebalance/report/rule.hpp"

namespace wavebalance::jl14 {
namespace {

app::Response converged(const app::Response& response, const std::string& method) {
  if (!response.converged) throw report::NotConverged(method + ": " + response.status);
  return response;
}

/// Both cases with a part of their damping: is it the damping that ends the transient?
void state_transient(report::Artefact& artefact) {
  constexpr double share = 0.1;
  constexpr int longer = 2;
  std::vector<report::Verdict> parts;
  std::string text;
  for (const char* name : {"reference_case1.toml", "reference_case2.toml"}) {
    const auto scene = artefact.scene(name);
    const int periods = app::time_stepping_response(scene).iterations;
    const auto weak = app::time_stepping_response(artefact.scene(
        name, {fmt::format("structure.stiffness_damping={}", share * scene.structure.stiffness_damping),
               fmt::format("analysis.max_periods={}", longer * periods)}));
    parts.push_back(report::plain(!weak.converged));
    text += fmt::format("{}{} periods at {:g} Hz; with less damping the last two of {} differ by {}",
                        text.empty() ? "" : ". ", periods, scene.forcing.frequency, weak.iterations,
                        report::number(weak.residual));
  }
  report::Statement statement{
      "section 4",
      "This is possible due to the structural damping terms listed in Table 1 causing any transient response to "
      "decay relatively quickly.",
      fmt::format(
          "in both cases two periods agree to 1e-7, and with {} of the damping they do not within {} times "
          "as many periods",
          report::percent(share), longer),
      text, report::together(parts)};
  statement.because = "The transient ends with less damping too. " + statement.measured + ".";
  artefact.statement(reasoned(statement));
}

}  // namespace

void reference(report::Artefact& artefact, int case_number) {
  const std::string number = std::to_string(case_number);
  const auto scene = artefact.scene("reference_case" + number + ".toml");
  app::ResponseOptions options;
  options.structure_points = scene.analysis.output_points;
  const auto stepping = converged(app::time_stepping_response(scene, options), "time stepping");
  const auto phases = converged(app::phases_response(scene), "contact phases");
  auto table = app::response_table(stepping.contacts);
  table.add_column("system_energy_J", app::system_energy(scene, stepping.structure));
  artefact.data(table, "SI; a column's name ends in its unit; time_fraction in periods");
  artefact.more_data("nodes", node_columns(stepping.structure),
                     "displacements of the nodes in m; time_fraction in periods");
  artefact.caption(
      fmt::format("The last of {} periods, computed once and read by Figs. 6-11.", stepping.iterations));
  artefact.check(
      {"section 4",
       "the solution is deemed to have converged to its periodic state when the rms of the relative error "
       "between the tip displacements for the i and i − 1 periods is below $10^{-7}$",
       "reached within " + std::to_string(scene.analysis.max_periods) + " periods",
       report::number(stepping.residual) + " after " + std::to_string(stepping.iterations) + " periods",
       stepping.residual < 1e-7});
  if (case_number == 2) state_transient(artefact);
  const double difference = app::relative_rms_error(stepping.displacement(), phases.displacement());
  artefact.note(
      fmt::format("Its contact phases differ from it by {} (relative rms of the tip displacement); "
                  "largest displacement {} mm, in contact for {} of the period.",
                  report::number(difference), report::number(1e3 * stepping.displacement().maxCoeff(), 7),
                  report::percent(app::contact_fraction(stepping.contacts), 4)));
}

}  // namespace wavebalance::jl14
