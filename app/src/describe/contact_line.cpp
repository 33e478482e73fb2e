#include "describe/contact_line.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "files/number_text.hpp"
#include "wavebalance/app/compose/outputs.hpp"
#include "wavebalance/app/files/quantity_text.hpp"
#include "wavebalance/app/scene/contacts.hpp"
#include "wavebalance/contact/catalogue.hpp"

namespace wavebalance::app {
namespace {

/// How many directions have an obstacle on either side; empty without any.
std::string sides_text(const Scene& scene) {
  const auto& pairs = scene.contact.pairs;
  const auto both =
      std::ranges::count_if(pairs, [](const auto& one) { return one.side == ObstacleSide::both; });
  if (both == 0) return "";
  return "; two contacts for each of the " + count_text(both, "direction") + " with obstacles on both sides";
}

std::string contact_place(const Scene& scene) {
  const StructureType type = scene.structure.type;
  if (type == StructureType::bar) return "at the tip";
  if (!scene.contact.pairs.empty()) return "at " + count_text(whole_contact_count(scene), "contact");
  if (type == StructureType::blade && has_friction(scene))
    return "at " + count_text(tip_corners(scene.structure.blade), "node") +
           " along the tip, radially and along " + name_of(scene.contact.tangent);
  const std::string count = count_text(contact_count(scene), "degree") + " of freedom";
  return "at " + count + (type == StructureType::blade ? " along the tip, radially" : "");
}

/// "gap 0.1 m on either side", or both gaps where they differ; empty for a contact with one gap.
std::string two_gaps_text(const SceneContact& contact, const std::string& unit) {
  const contact::LawValues values = contact::complete_values(contact::law_entry(contact.law), contact.values);
  if (!values.contains("gap_below")) return "";
  const double below = contact::number_of(values, "gap_below");
  if (below == contact.gap) return "gap " + quantity(below, unit) + " on either side";
  return "gaps " + quantity(contact.gap, unit) + " above and " + quantity(below, unit) + " below";
}

/// Where laws without a gap act.
std::string acting_text(const std::vector<SceneContact>& contacts) {
  const auto frictional = [](const SceneContact& one) { return has_friction(one.law); };
  const auto opens = [&](const SceneContact& one) { return frictional(one) && one.directions > 1; };
  if (std::ranges::none_of(contacts, frictional)) return "which acts everywhere";
  if (std::ranges::all_of(contacts, opens)) return "open where the normal force is 0";
  if (std::ranges::any_of(contacts, opens))
    return "open where the normal force is 0, if it has a normal direction";
  return std::ranges::all_of(contacts, frictional) ? "always closed" : "which acts everywhere";
}

std::string gap_text(const std::vector<SceneContact>& contacts, const std::string& unit) {
  std::vector<double> gaps;
  for (const SceneContact& one : contacts)
    if (has_gap(one.law) || acts_in_plane(one.law)) gaps.push_back(one.gap);
  if (gaps.empty()) return acting_text(contacts);
  const auto same = [&](const SceneContact& one) { return one.same_law(contacts.front()); };
  if (std::ranges::all_of(contacts, same))
    if (const std::string both = two_gaps_text(contacts.front(), unit); !both.empty()) return both;
  const auto [least, most] = std::minmax_element(gaps.begin(), gaps.end());
  if (*least == *most) return "gap " + quantity(*least, unit);
  return "gaps " + quantity(*least, unit) + " to " + quantity(*most, unit);
}

std::string law_text(const std::vector<SceneContact>& contacts) {
  if (std::ranges::all_of(contacts, [](const SceneContact& one) { return is_rigid(one.law); }))
    return contacts.front().values.contains("restitution") ? "impacts against a rigid obstacle"
                                                           : "rigid obstacle";
  std::vector<std::string> names;
  for (const SceneContact& one : contacts)
    if (std::ranges::find(names, one.law) == names.end()) names.push_back(one.law);
  return fmt::format("{} law{}", fmt::join(names, " and "), names.size() == 1 ? "" : "s");
}

}  // namespace

std::string contact_line(const Scene& scene) {
  if (scene.contact.law == no_law) return "contact    none: the problem is linear\n";
  const std::vector<SceneContact> contacts = contacts_of(scene);
  const std::string unit = displacement_unit(scene);
  return "contact    " + law_text(contacts) + " " + contact_place(scene) + ", " + gap_text(contacts, unit) +
         sides_text(scene) +
         (unit == "rad" ? "; between rotations: forces in N m, stiffnesses in N m/rad\n" : "\n");
}

}  // namespace wavebalance::app
