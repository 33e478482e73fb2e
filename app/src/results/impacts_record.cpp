#include "results/impacts_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "files/missing.hpp"
#include "results/quantities.hpp"
#include "wavebalance/app/analysis/measures.hpp"

namespace wavebalance::app {
namespace {

/// Where contact lasts, and from when on, though no motion was found in which it does.
void warn_of_lasting_contact(Record& record, const solvers::ImpactResponse& response, double frequency) {
  using solvers::PhasesStatus;
  const bool chatters = response.motion.status == PhasesStatus::chattering;
  if (!chatters && response.motion.status != PhasesStatus::lasting_contact) return;
  record.warnings.push_back(fmt::format(
      "{} at contact {} {:.6g} s after the start of the integration; then the contact stays closed. No periodic "
      "motion with this contact closed was found.",
      chatters ? "Impacts follow each other ever faster and end" : "An impact without rebound is pressed on",
      response.chattering_contact + 1, response.chattering_end / frequency));
}

/// contact, begin, end (fractions of the motion's period): obstacles with impacts on which a contact rests.
Table lasting_table(const Scene& scene, const Response& response) {
  Table table({"contact", "begin", "end"});
  if (!response.phases) return table;
  const std::vector<SceneContact> contacts = contacts_of(scene);
  for (const solvers::ContactPhase& one : response.phases->motion.phases)
    if (const SceneContact& contact = contacts.at(std::size_t(one.contact)); is_rigid(contact.law))
      table.append_row({std::int64_t{contact.number}, one.begin, one.end});
  return table;
}

/// The largest displacement of the leading contact, at the samples and at its impacts.
double highest(const Response& response) {
  const double sampled = response.displacement().maxCoeff();
  const bool known = response.phases && response.phases->motion.parts;
  if (!known && !response.impacts) return sampled;
  const solvers::PhaseMotion& motion = known ? response.phases->motion : response.impacts->motion;
  return std::max(sampled, highest_at_impacts(motion, response.contact));
}

}  // namespace

Table impacts_table(const Scene& scene, const std::vector<solvers::Impact>& impacts) {
  const std::vector<SceneContact> contacts = contacts_of(scene);
  Table table({"impact", "time_fraction", "contact", "velocity_before_m_per_s", "velocity_after_m_per_s",
               "impulse_Ns", "energy_lost_J"});
  std::int64_t number = 0;
  for (const solvers::Impact& one : impacts)
    table.append_row({++number, one.time, std::int64_t{contacts.at(std::size_t(one.contact)).number},
                      one.velocity_before, one.velocity_after, one.impulse, one.energy_lost});
  return table;
}

void append_events(Record& record, const Response& response, double frequency) {
  if (!response.flow || !response.moves) return;
  constexpr std::array<const char*, 4> names{"open", "closed", "stick", "slip"};
  const solvers::FlowMotion& flow = *response.flow;
  Table table({"time_fraction", "contact", "state", "impulse_Ns", "velocity_before_m_per_s"});
  for (const solvers::FlowEvent& one : flow.events) {
    const auto kind = flow.machines[std::size_t(one.contact)].law->kind(one.to);
    table.append_row({one.time * frequency, std::int64_t{one.contact + 1},
                      std::string(names[std::size_t(kind)]), one.impulse, one.speed});
  }
  for (std::size_t c = 0; c < flow.machines.size(); ++c) {
    const bool changes = std::any_of(flow.events.begin(), flow.events.end(),
                                     [&](const solvers::FlowEvent& one) { return one.contact == int(c); });
    if (!changes && flow.machines[c].law->kind(flow.states[c]) == solvers::ContactState::stick)
      record.warnings.push_back(fmt::format(
          "Contact {} sticks all the time. Where it sticks depends on the start: the contacts begin at rest, and the "
          "structure elsewhere in its motion without contact.",
          c + 1));
  }
  if (flow.rests > 0)
    record.warnings.push_back(fmt::format(
        "{} impacts of the period are slower than 1e-6 of the fastest and have no rebound, so that the contact rests.",
        flow.rests));
  if (!flow.events.empty())
    record.files.push_back({"events.csv", csv_text(table),
                            "the events of a period: instants, the states that begin there, impulses"});
}

/// Where the contacts change their states without end.
void append_endless(Record& record, const Response& response, double frequency) {
  if (!response.flow || response.flow->ended != solvers::FlowStatus::endless_events) return;
  const solvers::FlowMotion& flow = *response.flow;
  if (flow.events.empty()) return;
  const solvers::FlowEvent& last = flow.events.back();
  const double instant = flow.stepping.periods / frequency + last.time;
  record.summary.emplace_back(quantities::endless_contact, std::int64_t{last.contact + 1});
  record.summary.emplace_back(quantities::endless_time, instant);
  record.warnings.push_back(fmt::format(
      "Contact {} changes its state again and again in a vanishing time, {:.6g} s after the start of "
      "the integration, which ends there.",
      last.contact + 1, instant));
}

void append_impacts(Record& record, const Scene& scene, const Response& response) {
  append_endless(record, response, scene.forcing.frequency);
  append_events(record, response, scene.forcing.frequency);
  if (!response.impacts && response.struck.empty()) return;
  double impulse = 0.0, velocity = 0.0, energy = 0.0;
  for (const solvers::Impact& one : response.struck) {
    impulse = std::max(impulse, one.impulse);
    velocity = std::max(velocity, one.velocity_before);
    energy += one.energy_lost / response.periods;
  }
  const bool known = response.moves;
  // Samples miss the instants at which a contact is at its gap, and impacts have no force.
  for (Entry& entry : record.summary) {
    if (!response.forces_are_known() && entry.name == quantities::max_contact_force.name)
      entry.value = missing;
    if (known && entry.name == quantities::max_displacement.name) entry.value = highest(response);
  }
  record.summary.emplace_back(quantities::impacts, known ? double(response.struck.size()) : missing);
  record.summary.emplace_back(quantities::max_impulse, known ? impulse : missing);
  record.summary.emplace_back(quantities::max_impact_velocity, known ? velocity : missing);
  record.summary.emplace_back(quantities::impact_energy, known ? energy : missing);
  if (response.impacts && known && response.periods > 1)
    record.summary.emplace_back(quantities::period_of_motion, std::int64_t{response.periods});
  if (const Table lasting = lasting_table(scene, response); lasting.rows() > 0)
    record.summary.emplace_back(quantities::lasting_contacts, lasting);
  if (response.impacts) warn_of_lasting_contact(record, *response.impacts, scene.forcing.frequency);
  if (known && !response.struck.empty())
    record.files.push_back({"impacts.csv", csv_text(impacts_table(scene, response.struck)),
                            "the impacts of a period: instants, velocities, impulses and energies"});
}

void append_impacts(Record& record, const Sweep& sweep) {
  if (sweep.impacts.empty()) return;
  Summary& summary = record.summary;
  double impulse = sweep.curve.points.empty() ? missing : 0.0, speed = impulse;
  for (const PointImpacts& point : sweep.impacts.front()) {
    impulse = std::max(impulse, point.largest_impulse);
    speed = std::max(speed, point.largest_speed);
  }
  summary.emplace_back(quantities::max_impulse, impulse);
  summary.emplace_back(quantities::max_impact_velocity, speed);
  if (sweep.periods > 1) summary.emplace_back(quantities::period_of_motion, std::int64_t{sweep.periods});
}

}  // namespace wavebalance::app
