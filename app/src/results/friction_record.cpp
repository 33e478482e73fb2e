#include "results/friction_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "files/missing.hpp"
#include "results/quantities.hpp"
#include "results/summary_parts.hpp"
#include "wavebalance/app/analysis/friction_measures.hpp"
#include "wavebalance/app/files/table.hpp"
#include "wavebalance/app/scene/contacts.hpp"
#include "wavebalance/solvers/flow/exact_motion.hpp"

namespace wavebalance::app {
namespace {

std::string name_of_state(contact::FrictionState state) {
  if (state == contact::FrictionState::open) return "open";
  return state == contact::FrictionState::stick ? "stick" : "slip";
}

Table table_of(const std::vector<FrictionMeasures>& contacts) {
  Table table({"contact", "friction_work_J", "stick_fraction", "slip_fraction", "open_fraction", "slip_m",
               "wear_m3", "history_dependent"});
  for (const FrictionMeasures& one : contacts)
    table.append_row({std::int64_t{one.number}, one.period.work, one.stick_fraction, one.slip_fraction,
                      one.open_fraction, one.slip, one.wear, one.period.history_dependent});
  return table;
}

Table loops_of(const std::vector<FrictionMeasures>& contacts, const solvers::Motion& motion) {
  Table table({"time_fraction", "contact", "tangent", "displacement_m", "friction_force_N", "normal_force_N",
               "state"});
  const int points = motion.points();
  for (int l = 0; l < points; ++l)
    for (const FrictionMeasures& one : contacts)
      for (int i = 0; i < one.law.tangents(); ++i) {
        const int row = one.row + one.law.normal_rows() + i;
        const double normal =
            one.law.normal_rows() > 0 ? motion.force(one.row, l) : one.law.raw_normal_force(0.0);
        table.append_row({double(l) / points, std::int64_t{one.number}, std::int64_t{i + 1},
                          motion.displacement(row, l), motion.force(row, l), normal,
                          name_of_state(one.period.state[static_cast<std::size_t>(l)])});
      }
  return table;
}

// In time rigid friction begins where the structure is, whatever slider says.
void warn_of_history(Record& record, const std::vector<FrictionMeasures>& contacts, bool in_time) {
  std::vector<int> stuck;
  bool elastic = true;
  for (const FrictionMeasures& one : contacts)
    if (one.period.history_dependent) {
      stuck.push_back(one.number);
      elastic = elastic && !one.law.rigid();
    }
  if (stuck.empty()) return;
  const char* ending = stuck.size() == 1 ? "s" : "";
  const bool settable = elastic || !in_time;
  record.warnings.push_back(
      fmt::format("Contact{} {} neither slip{} nor open{}: the force there depends on the past{}.",
                  stuck.size() == 1 ? "" : "s", fmt::join(stuck, ", "), ending, ending,
                  settable ? ", and slider says from which position on" : ""));
}

/// The friction work beside the work that the contact forces take from the motion in a period, which is that
/// of the load less that of the damping: their difference is an error of the discretisation. Missing without
/// slip, where the work is the rounding of what is exchanged, and for trial functions without velocities.
double energy_error(const std::vector<FrictionMeasures>& contacts, const solvers::Motion& motion,
                    double period) {
  constexpr double rounding = 1e-12;
  double work = 0.0, power = 0.0, exchanged = 0.0;
  for (const FrictionMeasures& one : contacts) {
    work += one.period.work;
    const Eigen::MatrixXd powers = motion.force.middleRows(one.row, one.law.rows())
                                       .cwiseProduct(motion.velocity.middleRows(one.row, one.law.rows()));
    power += powers.sum() / motion.points();
    exchanged += powers.cwiseAbs().sum() / motion.points();
  }
  if (!(work > rounding * exchanged * period) || power == 0.0) return missing;
  return std::abs(power * period - work) / work;
}

void append_energy_error(Record& record, double error) {
  constexpr double large = 1e-3;
  record.summary.emplace_back(quantities::friction_energy_error, error);
  if (error > large)
    record.warnings.push_back(fmt::format(
        "The friction work and the work of the load less that of the damping differ by {:.2g} of it: more "
        "time.functions and time.quadrature_points resolve where the contacts stick and slip.",
        error));
}

// What the phases say is exact where samples are of second order.
void take_phases(std::vector<FrictionMeasures>& contacts, const Response& response) {
  if (contacts.empty() || !response.phases || response.phases->motion.parts == nullptr) return;
  for (const solvers::FrictionCycle& cycle : solvers::friction_cycles(response.phases->motion))
    for (FrictionMeasures& one : contacts) {
      if (one.row != cycle.row) continue;
      if (one.period.work > 0.0) one.wear *= cycle.work / one.period.work;
      one.period.history_dependent = cycle.stick_share == 1.0;
      one.period.work = cycle.work;
      one.slip = cycle.slip;
      one.stick_fraction = cycle.stick_share;
      one.slip_fraction = cycle.slip_share;
      one.open_fraction = cycle.open_share;
    }
}

// Between events contacts keep their states, so that the shares of these are exact.
void take_events(std::vector<FrictionMeasures>& contacts, const Response& response, double frequency) {
  if (!response.flow || !response.moves || response.attractor_periods != 1) return;
  const solvers::FlowMotion& flow = *response.flow;
  for (std::size_t c = 0; c < flow.machines.size(); ++c) {
    std::array<double, 4> shares{};
    const auto share = [&](int state) -> double& {
      return shares[std::size_t(flow.machines[c].law->kind(state))];
    };
    double since = 0.0;
    int state = flow.states[c];
    for (const solvers::FlowEvent& event : flow.events) {
      if (event.contact != int(c)) continue;
      share(state) += event.time * frequency - since;
      since = event.time * frequency;
      state = event.to;
    }
    share(state) += 1.0 - since;
    for (FrictionMeasures& one : contacts) {
      if (one.row != flow.machines[c].row) continue;
      one.stick_fraction = shares[std::size_t(solvers::ContactState::stick)];
      one.slip_fraction = shares[std::size_t(solvers::ContactState::slip)];
      one.open_fraction = shares[std::size_t(solvers::ContactState::open)];
    }
  }
}

}  // namespace

void append_friction(Record& record, const Scene& scene, const Response& response, double frequency) {
  if (!has_friction(scene)) return;
  std::vector<FrictionMeasures> contacts =
      friction_measures(scene, response.moves ? response.contacts : solvers::Motion{});
  const bool exact = is_by_phases(response);  // beside which samples say nothing
  if (exact) take_phases(contacts, response);
  take_events(contacts, response, frequency);
  double work = 0.0, wear = 0.0;
  bool wears = false;
  for (const FrictionMeasures& one : contacts) {
    work += one.period.work;
    wear += one.wear;
    wears = wears || one.wears;
  }
  const bool known = !contacts.empty();
  record.summary.emplace_back(quantities::friction_work, known ? work : missing);
  if (wears) record.summary.emplace_back(quantities::wear, wear);
  record.summary.emplace_back(quantities::friction, table_of(contacts));
  if (!known) return;
  if (frequency > 0.0)
    append_energy_error(record, exact || response.flow ? missing
                                                       : energy_error(contacts, response.contacts,
                                                                      response.periods / frequency));
  warn_of_history(record, contacts, response.flow.has_value());
  record.files.push_back({"friction.csv", csv_text(loops_of(contacts, response.contacts)),
                          "The loops of friction force and displacement, and what each contact does"});
}

void append_equivalent_damping(Record& record, const Scene& scene, const StructureModel& model,
                               const Response& response) {
  if (!has_friction(scene)) return;
  const auto* work = value_in<double>(record.summary, quantities::friction_work.name);
  const Eigen::MatrixXd& velocity = response.structure.velocity;
  double ratio = missing;
  if (work != nullptr && velocity.size() > 0) {
    const Eigen::MatrixXd momentum = model.structure.mass * velocity;
    const double energy = 0.5 * momentum.cwiseProduct(velocity).colwise().sum().maxCoeff();
    if (energy > 0.0) ratio = *work / response.periods / (4.0 * std::numbers::pi * energy);
  }
  record.summary.emplace_back(quantities::equivalent_damping_ratio, ratio);
}

}  // namespace wavebalance::app
