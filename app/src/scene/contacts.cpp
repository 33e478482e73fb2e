#include "wavebalance/app/scene/contacts.hpp"

#include <algorithm>
#include <cstdlib>
#include <numbers>

#include "files/frequency_table.hpp"
#include "wavebalance/contact/catalogue.hpp"
#include "wavebalance/solvers/structure/periodic_force.hpp"

namespace wavebalance::app {

namespace {

void add_tangents(const ContactPair& pair, std::size_t index, const std::string& name,
                  std::vector<SceneContact>& contacts) {
  if (reads_signal(pair.law)) contacts.push_back({.pair = index, .place = 1, .name = name, .law = pair.law});
  int place = 0;
  const auto add = [&](const std::vector<int>& dofs, const std::vector<double>& coefficients) {
    if (!dofs.empty())
      contacts.push_back({.dofs = dofs,
                          .coefficients = coefficients,
                          .pair = index,
                          .place = ++place,
                          .name = name,
                          .law = pair.law});
  };
  add(pair.tangent, pair.tangent_coefficients);
  add(pair.second_tangent, pair.second_tangent_coefficients);
}

// Each corner node radially and, with friction, along its tangent.
std::vector<SceneContact> tip_contacts(const Scene& scene) {
  const int directions = has_friction(scene.contact.law) ? 2 : 1;
  std::vector<SceneContact> contacts;
  for (int i = 0; i < tip_corners(scene.structure.blade); ++i)
    for (int place = 0; place < directions; ++place) contacts.push_back({.place = place});
  return contacts;
}

// Each first direction begins a contact.
void number_contacts(std::vector<SceneContact>& contacts) {
  for (std::size_t from = 0, to = 0, number = 1; from < contacts.size(); from = to, ++number) {
    for (to = from + 1; to < contacts.size() && contacts[to].place > 0;) ++to;
    for (std::size_t i = from; i < to; ++i) {
      contacts[i].number = static_cast<int>(number);
      contacts[i].directions = static_cast<int>(to - from);
    }
  }
}

std::vector<SceneContact> unnumbered_places(const Scene& scene) {
  const Structure& structure = scene.structure;
  if (structure.type == StructureType::bar) return std::vector<SceneContact>(1);
  if (structure.type == StructureType::blade) return tip_contacts(scene);
  std::vector<SceneContact> contacts;
  for (const int dof : structure.matrices.contact_dofs)
    contacts.push_back({.dofs = {std::abs(dof)}, .coefficients = {dof > 0 ? 1.0 : -1.0}});
  for (std::size_t i = 0; i < scene.contact.pairs.size(); ++i) {
    const ContactPair& pair = scene.contact.pairs[i];
    SceneContact one{
        .dofs = pair.dofs, .coefficients = pair.coefficients, .pair = i, .name = pair.name, .law = pair.law};
    if (pair.side != ObstacleSide::negative) contacts.push_back(one);
    if (pair.side != ObstacleSide::negative) add_tangents(pair, i, one.name, contacts);
    for (double& coefficient : one.coefficients) coefficient = -coefficient;
    if (pair.side == ObstacleSide::positive) continue;
    if (pair.side == ObstacleSide::both && !pair.name.empty()) one.name = "-" + pair.name;
    contacts.push_back(one);
    add_tangents(pair, i, one.name, contacts);
  }
  return contacts;
}

constexpr const char *growth_of_normal_load = "normal_load_speed2",
                     *table_of_normal_load = "normal_load_table";

// Through the rows of a table, which are read already where contact_tables_read() has done so.
double normal_load_in(const contact::LawValue& table, double frequency) {
  const auto* rows = std::get_if<std::vector<double>>(&table);
  if (rows == nullptr) return normal_load_in(read_normal_loads(std::get<std::string>(table)), frequency);
  const auto count = std::ssize(*rows) / 2;
  return solvers::FrequencyFactor{Eigen::VectorXd::Map(rows->data(), count),
                                  Eigen::VectorXd::Map(rows->data() + count, count)}
      .at(frequency);
}

// At a frequency of the load, Hz.
void set_normal_load(contact::LawValues& values, double frequency) {
  const double speed = 2.0 * std::numbers::pi * frequency;
  double added = contact::number_or(values, growth_of_normal_load, 0.0) * speed * speed;
  const auto table = values.find(table_of_normal_load);
  if (table != values.end()) added += normal_load_in(table->second, frequency);
  if (values.erase(growth_of_normal_load) + values.erase(table_of_normal_load) > 0)
    values.insert_or_assign("normal_load", contact::number_or(values, "normal_load", 0.0) + added);
}

// The number of tangents of a contact with friction.
int tangents_of(const Scene& scene, const SceneContact& contact) {
  if (!contact.pair) return 1;
  return scene.contact.pairs[*contact.pair].second_tangent.empty() ? 1 : 2;
}

std::string with_direction(const std::string& name, const SceneContact& contact) {
  const std::string direction = direction_name(contact);
  return name + (direction.empty() ? "" : " " + direction);
}

}  // namespace

bool is_signal(const SceneContact& contact) { return contact.place > 0 && reads_signal(contact.law); }

int tip_corners(const BladeStructure& blade) { return 2 * (blade.chord_elements + 1); }

std::vector<SceneContact> contact_places(const Scene& scene) {
  std::vector<SceneContact> contacts = unnumbered_places(scene);
  number_contacts(contacts);
  return contacts;
}

int contact_count(const Scene& scene) { return static_cast<int>(unnumbered_places(scene).size()); }

int whole_contact_count(const Scene& scene) {
  const std::vector<SceneContact> contacts = contact_places(scene);
  return contacts.empty() ? 0 : contacts.back().number;
}

std::string direction_name(const SceneContact& contact) {
  if (contact.directions == 1) return "";
  if (acts_in_plane(contact.law)) return contact.place == 0 ? "x" : "y";
  if (reads_signal(contact.law)) return contact.place == 0 ? "" : "stiffness";
  if (contact.place == 0) return "normal";
  return contact.directions == 2 ? "tangent" : "tangent " + std::to_string(contact.place);
}

bool has_directions(const std::vector<SceneContact>& contacts) {
  return std::ranges::any_of(contacts, [](const SceneContact& one) { return one.directions > 1; });
}

std::string whole_name_of(const SceneContact& contact) {
  return contact.name.empty() ? "contact " + std::to_string(contact.number) : contact.name;
}

std::string name_of(const SceneContact& contact) { return with_direction(whole_name_of(contact), contact); }

std::string number_text_of(const SceneContact& contact) {
  return with_direction("contact " + std::to_string(contact.number), contact);
}

std::vector<std::string> contact_labels(const Scene& scene) {
  std::vector<std::string> labels;
  bool named = false;
  for (const SceneContact& one : contact_places(scene)) {
    if (one.place == 0) labels.push_back(whole_name_of(one));
    named = named || !one.name.empty();
  }
  return named ? labels : std::vector<std::string>();
}

contact::LawValues law_values(const std::string& law, const contact::LawValues& values, double gap) {
  contact::LawValues taken;
  for (const contact::LawParameter& parameter : contact::law_entry(law).parameters) {
    if (parameter.name == "gap") taken.emplace("gap", gap);
    if (const auto given = values.find(parameter.name); given != values.end()) taken.insert(*given);
  }
  return taken;
}

double load_frequency(const Scene& scene) { return load_frequencies(scene).first; }

std::pair<double, double> load_frequencies(const Scene& scene) {
  if (varies_frequency(scene.analysis)) return {scene.analysis.frequency_from, scene.analysis.frequency_to};
  return {scene.forcing.frequency, scene.forcing.frequency};
}

std::vector<double> read_normal_loads(const std::string& file) {
  const Table table = read_frequency_table(file, "normal_load");
  std::vector<double> rows = table.numbers("frequency_Hz");
  const std::vector<double> loads = table.numbers("normal_load");
  for (const double load : loads)
    if (!(load >= 0.0))
      throw std::runtime_error(file + ": normal_load = " + std::to_string(load) + "; expected at least 0");
  rows.insert(rows.end(), loads.begin(), loads.end());
  return rows;
}

Contact with_tables_read(Contact contact) {
  const auto read = [](contact::LawValues& values) {
    const auto found = values.find(table_of_normal_load);
    if (found != values.end()) found->second = read_normal_loads(std::get<std::string>(found->second));
  };
  read(contact.values);
  for (ContactPair& pair : contact.pairs) read(pair.values);
  return contact;
}

bool has_growing_normal_load(const Contact& contact) {
  const auto grows = [](const std::string& law, const contact::LawValues& values) {
    return has_friction(law) && (contact::number_or(values, growth_of_normal_load, 0.0) > 0.0 ||
                                 values.contains(table_of_normal_load));
  };
  return grows(contact.law, contact.values) ||
         std::ranges::any_of(contact.pairs,
                             [&](const ContactPair& pair) { return grows(pair.law, pair.values); });
}

std::vector<SceneContact> contacts_of(const Scene& scene, std::optional<double> frequency) {
  std::vector<SceneContact> contacts = contact_places(scene);
  const Contact& contact = scene.contact;
  if (!contact.gaps.empty() && contact.gaps.size() != contacts.size())
    throw std::invalid_argument("contact.gap has " + std::to_string(contact.gaps.size()) +
                                " numbers; there must be one, or one for each of " +
                                std::to_string(contacts.size()) + " contacts");
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    SceneContact& one = contacts[i];
    const ContactPair* pair = one.pair ? &contact.pairs[*one.pair] : nullptr;
    if (!pair) one.law = contact.law;
    one.gap = pair ? pair->gap : contact.gaps.empty() ? contact.gap : contact.gaps[i];
    one.values = law_values(one.law, pair ? pair->values : contact.values, one.gap);
    if (!has_friction(one.law)) continue;
    one.values.insert_or_assign("tangents", double(tangents_of(scene, one)));
    set_normal_load(one.values, frequency.value_or(load_frequency(scene)));
  }
  return contacts;
}

bool has_damped_contact(const Scene& scene) {
  return std::ranges::any_of(contacts_of(scene), is_damped, &SceneContact::law);
}

bool has_friction(const Scene& scene) {
  const auto rubs = [](const std::string& law) { return has_friction(law); };
  return std::ranges::any_of(contacts_of(scene), rubs, &SceneContact::law);
}

double common_gap(const Scene& scene) {
  const std::vector<SceneContact> contacts = contacts_of(scene);
  const bool one = std::ranges::all_of(contacts, [&](const SceneContact& other) {
    return has_gap(other.law) && other.gap == contacts.front().gap;
  });
  return one && !contacts.empty() ? contacts.front().gap : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace wavebalance::app
