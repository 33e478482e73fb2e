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
    table.append_row({std::int64_t{one.number}, one.work, one.stick_fraction, one.slip_fraction,
                      one.open_fraction, one.slip, one.wear, one.history_dependent});
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
                          name_of_state(one.state[static_cast<std::size_t>(l)])});
      }
  return table;
}

// In time rigid friction begins where the structure is, whatever slider says.
void warn_of_history(Record& record, const std::vector<FrictionMeasures>& contacts, bool in_time) {
  std::vector<int> stuck;
  bool elastic = true;
  for (const FrictionMeasures& one : contacts)
    if (one.history_dependent) {
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
    work += one.work;
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

}  // namespace

void append_friction(Record& record, const Scene& scene, const Response& response, double frequency) {
  if (!has_friction(scene)) return;
  const std::vector<FrictionMeasures> contacts = friction_measures(scene, response);
  const bool exact = is_by_phases(response) || response.flow;  // beside which samples say nothing
  double work = 0.0, wear = 0.0;
  bool wears = false;
  for (const FrictionMeasures& one : contacts) {
    work += one.work;
    wear += one.wear;
    wears = wears || one.wears;
  }
  const bool known = !contacts.empty();
  record.summary.emplace_back(quantities::friction_work, known ? work : missing);
  if (wears) record.summary.emplace_back(quantities::wear, wear);
  record.summary.emplace_back(quantities::friction, table_of(contacts));
  if (!known) return;
  if (frequency > 0.0)
    append_energy_error(
        record, exact ? missing : energy_error(contacts, response.contacts, response.periods / frequency));
  warn_of_history(record, contacts, response.flow.has_value());
  record.files.push_back({"friction.csv", csv_text(loops_of(contacts, response.contacts)),
                          "The loops of friction force and displacement, and what each contact does"});
}

void append_equivalent_damping(Record& record, const Scene& scene, const StructureModel& model,
                               const Response& response) {
  if (!has_friction(scene)) return;
  // A surface that moves drives the structure, too.
  const std::vector<SceneContact> contacts = contacts_of(scene);
  const bool drives = std::any_of(contacts.begin(), contacts.end(), [](const SceneContact& one) {
    return contact::number_or(one.values, "surface_speed", 0.0) != 0.0;
  });
  const auto* work = value_in<double>(record.summary, quantities::friction_work.name);
  const Eigen::MatrixXd& velocity = response.structure.velocity;
  double ratio = missing;
  if (work != nullptr && velocity.size() > 0 && !drives) {
    const Eigen::MatrixXd momentum = model.structure.mass * velocity;
    const double energy = 0.5 * momentum.cwiseProduct(velocity).colwise().sum().maxCoeff();
    if (energy > 0.0) ratio = *work / response.periods / (4.0 * std::numbers::pi * energy);
  }
  record.summary.emplace_back(quantities::equivalent_damping_ratio, ratio);
}

}  // namespace wavebalance::app
