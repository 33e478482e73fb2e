#include "results/record_parts.hpp"

#include <numbers>

#include "files/missing.hpp"
#include "results/quantities.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/files/quantity_text.hpp"
#include "wavebalance/app/scene/contacts.hpp"
#include "wavebalance/solvers/flow/exact_motion.hpp"

namespace wavebalance::app {
namespace {

bool is_named(const FrictionMeasures& one) { return one.name != "contact " + std::to_string(one.number); }

Table table_of(const std::vector<FrictionMeasures>& contacts) {
  const bool named = std::ranges::any_of(contacts, is_named);
  std::vector<std::string> columns{"contact",       "friction_work_J", "stick_fraction", "slip_fraction",
                                   "open_fraction", "slip_m",          "wear_m3",        "history_dependent"};
  if (named) columns.emplace_back("name");
  Table table(columns);
  for (const FrictionMeasures& one : contacts) {
    std::vector<Cell> cells{std::int64_t{one.number}, one.work, one.stick_fraction, one.slip_fraction,
                            one.open_fraction,        one.slip, one.wear,           one.history_dependent};
    if (named) cells.emplace_back(one.name);
    table.append_row(std::move(cells));
  }
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
                          state_name(one.state[static_cast<std::size_t>(l)])});
      }
  return table;
}

// In time integration rigid friction begins at the structure's position, whatever `slider` is.
void warn_of_history(Record& record, const std::vector<FrictionMeasures>& contacts, bool in_time) {
  std::vector<std::string> stuck;  // by their names
  std::vector<int> numbers;        // of the others
  bool elastic = true;
  for (const FrictionMeasures& one : contacts)
    if (one.history_dependent) {
      if (is_named(one))
        stuck.push_back(one.name);
      else
        numbers.push_back(one.number);
      elastic = elastic && !one.law.rigid();
    }
  const std::size_t count = stuck.size() + numbers.size();
  if (count == 0) return;
  if (!numbers.empty()) stuck.insert(stuck.begin(), number_ranges(numbers));
  const char* ending = count == 1 ? "s" : "";
  const bool settable = elastic || !in_time;
  warn(record, "Contact{} {} neither slip{} nor open{}: the force depends on the history{}.",
       count == 1 ? "" : "s", fmt::join(stuck, ", "), ending, ending, settable ? ", which slider sets" : "");
}

/// The difference of the friction work from the work of the load less damping, an error of the
/// discretisation. Missing without slip, where the work is rounding, and for trial functions without
/// velocities.
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
  record.add("friction_energy_error", error);
  if (error > large)
    warn(record,
         "The energy dissipated by friction differs from load minus damping by {}. "
         "More time.functions and time.quadrature_points resolve stick and slip better.",
         percentage(error, 2));
}

/// Where contact lasts, and from when on, though no motion was found in which it does.
void warn_of_lasting_contact(Record& record, const solvers::ImpactResponse& response, double frequency) {
  using solvers::ExactStatus;
  const bool chatters = response.motion.status == ExactStatus::chattering;
  if (!chatters && response.motion.status != ExactStatus::lasting_contact) return;
  warn(record,
       "{} at contact {} {} after the start of the integration. Then the contact stays "
       "closed. No periodic motion with sustained contact was found.",
       chatters ? "Impacts follow each other ever faster and end" : "An impact without rebound occurs",
       response.chattering_contact + 1, quantity(response.chattering_end / frequency, "s", 6));
}

/// contact, begin, end (fractions of the motion's period): obstacles with impacts on which a contact rests.
Table lasting_table(const Scene& scene, const Response& response) {
  Table table({"contact", "begin", "end"});
  if (!response.exact) return table;
  const std::vector<SceneContact> contacts = contacts_of(scene);
  for (const solvers::ForceInterval& one : response.exact->motion.intervals)
    if (const SceneContact& contact = contacts.at(std::size_t(one.contact)); is_rigid(contact.law))
      table.append_row({std::int64_t{contact.number}, one.begin, one.end});
  return table;
}

/// The largest displacement of the contact with the largest force, at the samples and at its impacts.
double highest(const Response& response) {
  const double sampled = response.displacement().maxCoeff();
  const bool known = response.exact && response.exact->motion.parts;
  if (!known && !response.impacts) return sampled;
  const solvers::ExactSolution& motion = known ? response.exact->motion : response.impacts->motion;
  return std::max(sampled, highest_at_impacts(motion, response.contact));
}

void append_events(Record& record, const Response& response, double frequency) {
  if (!response.flow || !response.moves) return;
  const solvers::FlowMotion& flow = *response.flow;
  Table table({"time_fraction", "contact", "state", "impulse_Ns", "velocity_before_m_per_s"});
  for (const solvers::FlowEvent& one : flow.events) {
    const auto kind = flow.machines[std::size_t(one.contact)].law->kind(one.to);
    table.append_row(row_of(one.time * frequency, one.contact + 1, state_name(kind), one.impulse, one.speed));
  }
  for (std::size_t c = 0; c < flow.machines.size(); ++c) {
    const bool changes = std::ranges::any_of(
        flow.events, [&](const solvers::FlowEvent& one) { return one.contact == int(c); });
    if (!changes && flow.machines[c].law->kind(flow.states[c]) == solvers::ContactState::stick)
      warn(record,
           "Contact {} sticks all the time. Its position depends on the initial state: contacts at "
           "rest, the rest of the structure in its linear response.",
           c + 1);
  }
  if (flow.rests > 0)
    warn(record,
         "{} impacts of the period are slower than 1e-6 of the fastest one. They are taken "
         "without rebound: the contact stays closed.",
         flow.rests);
  if (!flow.events.empty())
    record.files.push_back(
        {"events.csv", csv_text(table), "events of a period: instants, new states, impulses"});
}

/// Where the contacts change their states without end.
void append_endless(Record& record, const Response& response, double frequency) {
  if (!response.flow || response.flow->ended != solvers::FlowStatus::endless_events) return;
  const solvers::FlowMotion& flow = *response.flow;
  if (flow.events.empty()) return;
  const solvers::FlowEvent& last = flow.events.back();
  const double instant = flow.stepping.periods / frequency + last.time;
  record.add("endless_contact", last.contact + 1);
  record.add(quantities::endless_time, instant);
  warn(record,
       "Contact {} changes its state without end in a vanishing time, {} after the start. "
       "The integration ends there.",
       last.contact + 1, quantity(instant, "s", 6));
}

}  // namespace

void append_friction(Record& record, const Scene& scene, const Response& response, double frequency) {
  if (!has_friction(scene)) return;
  const std::vector<FrictionMeasures> contacts = friction_measures(scene, response);
  const bool exact = is_exact(response) || response.flow;  // below which samples are not significant
  double work = 0.0, wear = 0.0;
  bool wears = false;
  for (const FrictionMeasures& one : contacts) {
    work += one.work;
    wear += one.wear;
    wears = wears || one.wears;
  }
  const bool known = !contacts.empty();
  record.add(quantities::friction_work, known ? work : missing);
  if (wears) record.add(quantities::wear, wear);
  record.add(quantities::friction, table_of(contacts));
  if (!known) return;
  if (frequency > 0.0)
    append_energy_error(
        record, exact ? missing : energy_error(contacts, response.contacts, response.periods / frequency));
  warn_of_history(record, contacts, response.flow.has_value());
  record.files.push_back({"friction.csv", csv_text(loops_of(contacts, response.contacts)),
                          "friction loops and the states of each contact"});
}

void append_equivalent_damping(Record& record, const Scene& scene, const StructureModel& model,
                               const Response& response) {
  if (!has_friction(scene)) return;
  // A surface that moves drives the structure, too.
  const std::vector<SceneContact> contacts = contacts_of(scene);
  const bool drives = std::ranges::any_of(contacts, [](const SceneContact& one) {
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
  record.add(quantities::equivalent_damping_ratio, ratio);
}

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
  record.add(quantities::impacts, known ? double(response.struck.size()) : missing);
  record.add(quantities::max_impulse, known ? impulse : missing);
  record.add(quantities::max_impact_velocity, known ? velocity : missing);
  record.add(quantities::impact_energy, known ? energy : missing);
  if (response.impacts && known && response.periods > 1)
    record.add(quantities::period_of_motion, response.periods);
  if (const Table lasting = lasting_table(scene, response); lasting.rows() > 0)
    record.add(quantities::lasting_contacts, lasting);
  if (response.impacts) warn_of_lasting_contact(record, *response.impacts, scene.forcing.frequency);
  if (known && !response.struck.empty())
    record.files.push_back({"impacts.csv", csv_text(impacts_table(scene, response.struck)),
                            "impacts of a period: instants, velocities, impulses, energies"});
}

}  // namespace wavebalance::app
