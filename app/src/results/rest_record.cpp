#include "results/record_parts.hpp"

#include "files/missing.hpp"
#include "matrices/structure_facts.hpp"
#include "results/quantities.hpp"
#include "wavebalance/app/compose/outputs.hpp"
#include "wavebalance/app/files/quantity_text.hpp"
#include "wavebalance/app/scene/contacts.hpp"

namespace wavebalance::app {
namespace {

std::vector<std::string> names_of(const Scene& scene) {
  if (scene.structure.type == StructureType::matrices) return contact_names(scene);
  return std::vector<std::string>(std::size_t(contact_count(scene)));
}

/// "contact 2 (-node 18 z): 5.28 mm, 0.28 mm past its gap of 5 mm, 281 N".
std::string contact_text(const SceneContact& contact, const std::string& name, const std::string& unit,
                         double displacement, double force) {
  std::string text =
      fmt::format("{}{}: {}", name_of(contact), name.empty() || name == contact.name ? "" : " (" + name + ")",
                  quantity(displacement, unit));
  if (has_gap(contact.law)) {
    const double past = displacement - contact.gap;
    text += fmt::format(", {} {} its gap of {}", quantity(std::abs(past), unit),
                        past < 0.0 ? "short of" : "past", quantity(contact.gap, unit));
  }
  return text + ", " + quantity(force, force_unit(unit));
}

// A contact is closed where its first direction, its normal one where it has tangents, has a force. One with
// friction under a constant normal load never opens, and one in a ring has a force of either sign along both.
bool is_closed(const SceneContact& contact, const double* force) {
  if (contact.place > 0) return false;
  if (acts_in_plane(contact.law)) return force[0] != 0.0 || force[1] != 0.0;
  return force[0] > 0.0 || (has_friction(contact.law) && contact.directions == 1);
}

}  // namespace

std::int64_t closed_contacts(const Scene& scene, const std::vector<double>& forces) {
  const std::vector<SceneContact> contacts = contacts_of(scene);
  std::int64_t closed = 0;
  for (std::size_t i = 0; i < contacts.size() && i < forces.size(); ++i)
    closed += is_closed(contacts[i], &forces[i]);
  return closed;
}

void append_rest(Record& record, const Scene& scene, const StructureModel& model) {
  const std::optional<RestState> rest = rest_state(scene, model);
  if (!rest || rest->trivial()) return;
  if (!rest->converged) {
    record.add("rest_status", rest->status);
    return;
  }
  const std::vector<SceneContact> contacts = contacts_of(scene);
  const bool directed = has_directions(contacts), named = !contact_labels(scene).empty();
  std::vector<Summary> rows;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (is_signal(contacts[i])) continue;
    Summary& row = rows.emplace_back(Summary{{"contact", contacts[i].number}});
    if (directed) row.emplace_back("direction", direction_name(contacts[i]));
    row.emplace_back("displacement_m", rest->displacement[Eigen::Index(i)]);
    row.emplace_back("gap_m", has_gap(contacts[i].law) ? contacts[i].gap : missing);
    row.emplace_back("contact_force_N", rest->force[Eigen::Index(i)]);
    if (named) row.emplace_back("name", whole_name_of(contacts[i]));
  }
  record.add("at_rest", table_of(rows));
}

std::string rest_lines(const Scene& scene) {
  constexpr std::size_t shown = 8;
  const std::optional<RestState> rest = rest_state(scene);
  if (!rest || rest->trivial()) return "";
  if (!rest->converged) return "at rest    not found: " + rest->status + "\n";
  const std::vector<SceneContact> contacts = contacts_of(scene);
  const std::vector<std::string> names = names_of(scene);
  const std::int64_t closed = closed_contacts(scene, {rest->force.begin(), rest->force.end()});
  std::string text = fmt::format("at rest    {} of {} contacts {} under the static loads\n", closed,
                                 whole_contact_count(scene), closed == 1 ? "is closed" : "are closed");
  for (std::size_t i = 0; i < std::min(shown, contacts.size()); ++i)
    if (!is_signal(contacts[i]))
      text += "           " +
              contact_text(contacts[i], names[i], displacement_unit(scene, contacts[i]),
                           rest->displacement[Eigen::Index(i)], rest->force[Eigen::Index(i)]) +
              "\n";
  if (contacts.size() > shown)
    text += fmt::format("           and {} more, all in summary.json of a run\n", contacts.size() - shown);
  return text;
}

}  // namespace wavebalance::app
