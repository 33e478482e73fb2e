// The reference of one case, which Figs. 6-11 read: the exact periodic solution. The paper's time stepping
// is added.
#include <fmt/format.h>

#include <complex>
#include <numbers>

#include "figures.hpp"
#include "jl14.hpp"
#include "motion.hpp"
#include "readings.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/app/results/record.hpp"
#include "wavebalance/report/rule.hpp"
#include "wavebalance/solvers/collocation/exact_near_response.hpp"
#include "wavebalance/solvers/flow/periodic_flow.hpp"

namespace wavebalance::jl14 {
namespace {

app::Response by_stepping(const app::Scene& scene) {
  app::ResponseOptions options;
  options.structure_points = scene.analysis.output_points;
  app::Response motion = app::flow_response(scene, app::make_model(scene), options);
  if (!motion.converged) throw report::NotConverged("time stepping: " + motion.status);
  return motion;
}

/// From rest, as the paper begins. The load is at the contact: what a pole makes of its cosine is taken away.
solvers::TimeSteppingResult from_rest(const app::Scene& scene, int max_periods) {
  const solvers::CondensedProblem problem = app::make_problem(scene);
  const solvers::ContactDynamics dynamics(problem.structure());
  const double omega = 2.0 * std::numbers::pi * problem.frequency();
  Eigen::VectorXcd states(dynamics.poles().size());
  for (std::size_t i = 0; i < dynamics.poles().size(); ++i) {
    const solvers::ContactPole& pole = dynamics.poles()[i];
    states[Eigen::Index(i)] = scene.forcing.amplitude * pole.left[0] * pole.exponent /
                              (pole.exponent * pole.exponent + omega * omega);
  }
  solvers::TimeSteppingOptions options;
  options.max_periods = max_periods;
  return solvers::integrate_by_events(solvers::exact_problem(problem, app::make_laws(scene), dynamics),
                                      options, {}, states)
      .stepping;
}

/// Both cases with a part of their damping: is it the damping that ends the transient?
void state_transient(report::Artefact& artefact) {
  constexpr double share = 1.0 / report::parameter_factor;
  constexpr int longer = static_cast<int>(report::similar_factor);
  std::vector<report::Verdict> parts;
  std::string text;
  for (const char* name : {"case1.toml", "case2.toml"}) {
    const auto scene = artefact.scene(name);
    const int periods = from_rest(scene, 2000).periods;
    const auto weak_scene = artefact.scene(
        name, {fmt::format("structure.stiffness_damping={}", share * scene.structure.stiffness_damping)});
    const auto weak = from_rest(weak_scene, longer * periods);
    parts.push_back(report::plain(weak.status != solvers::TimeSteppingStatus::converged));
    text += fmt::format("{}{} periods at {:g} Hz; with less damping the last two of {} differ by {}",
                        text.empty() ? "" : ". ", periods, scene.forcing.frequency, weak.periods,
                        report::number(weak.period_error.back()));
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
  artefact.statement(statement);
}

void state_repetition(report::Artefact& artefact, const app::Scene& scene, const app::Response& stepping) {
  artefact.check(
      {"section 4",
       "the solution is deemed to have converged to its periodic state when the rms of the relative error "
       "between the tip displacements for the i and i − 1 periods is below $10^{-7}$",
       fmt::format("reached within {} periods", scene.analysis.max_periods),
       fmt::format("{} after {} periods", report::number(stepping.residual), stepping.iterations),
       stepping.residual < 1e-7});
}

/// Two methods: from event to event in time, and all of the period at once.
void note_agreement(report::Artefact& artefact, const app::Scene& scene, const app::Response& stepping,
                    const app::Response& exact) {
  const auto distance = [](const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
    return report::number(app::relative_rms_error(a, b));
  };
  artefact.note(fmt::format(
      "Time stepping differs from the exact solution by {} in the tip displacements (relative rms), {} in the tip "
      "velocities, {} in the contact forces and {} in the energies.",
      distance(stepping.displacement(), exact.displacement()),
      distance(stepping.velocity(), exact.velocity()), distance(stepping.force(), exact.force()),
      distance(app::system_energy(scene, stepping.structure), app::system_energy(scene, exact.structure))));
}

void note_exact(report::Artefact& artefact, const app::Response& exact) {
  artefact.note(fmt::format(
      "Event-driven collocation represents the contact force by polynomials between the instants at which contact "
      "begins and ends: {} unknowns and {} Newton steps from a harmonic balance with {} functions. The error of the tip "
      "displacement is estimated at {} (relative rms). Other nodes and the energy are summed from {} harmonics; the "
      "rest moves the tip by {}.",
      exact.unknowns, exact.iterations, exact.start_functions,
      report::number(exact.exact->motion.estimated_error), exact.structure_harmonics,
      report::number(exact.structure_left_out)));
  artefact.note(fmt::format("Largest displacement {} mm, in contact for {} of the period.",
                            report::number(1e3 * exact.displacement().maxCoeff(), 7),
                            report::percent(app::contact_fraction(exact.contacts), 4)));
}

}  // namespace

void reference(report::Artefact& artefact, int case_number) {
  const auto scene = artefact.scene(fmt::format("reference_case{}.toml", case_number));
  const auto stepped_scene = artefact.scene(fmt::format("stepping_case{}.toml", case_number));
  const auto exact = exact_solution(scene, scene.analysis.output_points);
  const auto stepping = by_stepping(stepped_scene);
  const std::string units = "SI; a column's name ends in its unit; time_fraction in periods";
  auto table = app::response_table(exact.contacts);
  table.add_column("system_energy_J", app::system_energy(scene, exact.structure));
  artefact.data(table, units);
  artefact.more_data("nodes", node_columns(exact.structure),
                     "displacements of the nodes in m; time_fraction in periods");
  artefact.more_data("time_stepping", app::response_table(stepping.contacts), units);
  artefact.caption(fmt::format(
      "The exact periodic solution of the bar, the reference of Figs. 6-11, and the last of {} periods of time stepping, "
      "the reference of the paper.",
      stepping.iterations));
  state_repetition(artefact, stepped_scene, stepping);
  note_agreement(artefact, stepped_scene, stepping, exact);
  if (case_number == 2) state_transient(artefact);
  note_exact(artefact, exact);
}

}  // namespace wavebalance::jl14
