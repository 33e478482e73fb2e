#include "scene/keys/key_tables.hpp"

namespace wavebalance::app {
namespace {

SceneValue get_gap(const Scene& scene) {
  if (scene.contact.gaps.empty()) return scene.contact.gap;
  return scene.contact.gaps;
}

void set_gap(Scene& scene, const SceneValue& value) {
  Contact& contact = scene.contact;
  const auto* list = std::get_if<std::vector<double>>(&value);
  const bool one = list == nullptr || list->size() == 1;
  contact.gap = list == nullptr ? std::get<double>(value) : one ? list->front() : 0.0;
  contact.gaps = one ? std::vector<double>{} : *list;
}

inline constexpr auto more_of_contact = [](auto& scene) -> auto& { return scene.contact.more; };

/// The constants of the laws that LawConstants holds. `in_contact` makes the properties of a key of [contact]
/// from the laws that it belongs to, and is without effect in a pair.
template <class Part, class OfLaws, class Fallback>
void add_law_constants(const Section<Part>& key, OfLaws of_laws, Fallback fallback) {
  key(&LawConstants::slopes, "slopes", "N/m",
      "slopes of the bilinear law below and beyond the gap, of either sign; the force is 0 at u = 0",
      exactly(2), of_laws({"bilinear"}), fallback(&LawConstants::slopes));
  key(&LawConstants::cubic_stiffness, "cubic_stiffness", "N/m^3",
      "k3 of the cubic law, the force k3 u^3 of Duffing's spring: hardening above zero, softening below",
      of_laws({"cubic"}), fallback(&LawConstants::cubic_stiffness));
  key(&LawConstants::polynomial, "polynomial", "N/m, N/m^2, ...",
      "c_1, c_2, ... of the polynomial law, the force c_1 u + c_2 u^2 + ...", of_laws({"polynomial"}),
      fallback(&LawConstants::polynomial));
  key(&LawConstants::stiffness_below, "stiffness_below", "N/m",
      "slope of the clearance law on the negative side", positive, of_laws({"clearance"}),
      derived("stiffness", 0.0), fallback(&LawConstants::stiffness_below));
  key(&LawConstants::gap_below, "gap_below", "m",
      "gap of the clearance law on the negative side: u >= -gap_below", not_negative, of_laws({"clearance"}),
      derived("gap", -1.0), fallback(&LawConstants::gap_below));
  key(&LawConstants::table, "table", "",
      "CSV file of the table law: displacement in m, ascending, and force in N per row, between which the force is a "
      "monotone cubic and beyond which it has the last slope",
      path, of_laws({"table"}), fallback(&LawConstants::table));
  key(&LawConstants::hertz_stiffness, "hertz_stiffness", "N/m^power",
      "k of the Hunt-Crossley law, the force k d^power (1 + dissipation v) of the penetration d = u - gap and the "
      "velocity v, where that is not negative",
      positive, of_laws({"hunt_crossley"}), fallback(&LawConstants::hertz_stiffness));
  key(&LawConstants::power, "power", "", "exponent of the penetration; 3/2 for two spheres", within(1, 10),
      optional, of_laws({"hunt_crossley"}), fallback(&LawConstants::power));
  key(&LawConstants::dissipation, "dissipation", "s/m", "dissipation of the Hunt-Crossley law", not_negative,
      of_laws({"hunt_crossley"}), fallback(&LawConstants::dissipation));
  key(&LawConstants::damping, "damping", "N s/m",
      "damper of the Kelvin-Voigt law, the force stiffness d + damping v of the penetration d = u - gap > 0 and the "
      "velocity v, where that is not negative",
      not_negative, of_laws({"kelvin_voigt"}), fallback(&LawConstants::damping));
  key(&LawConstants::damping_depth, "damping_depth", "m",
      "penetration over which that damper rises smoothly to its full value; 0: at once, with a jump of the force",
      not_negative, optional, of_laws({"kelvin_voigt"}), fallback(&LawConstants::damping_depth));
}

}  // namespace

void add_contact_keys(std::vector<SceneKey>& keys) {
  const Section contact(keys, "contact", contact_part);
  contact(
      &Contact::law, "law", "",
      "force on each degree of freedom in contact (a bar: its tip; a blade: its tip's corner nodes, "
      "radially) by its displacement u towards the obstacle. Beyond the gap alone: constant (exp(exponent (u - "
      "gap)) - 1), stiffness (u - gap), rigid: whatever keeps u at the gap, and the damped hunt_crossley and "
      "kelvin_voigt. Everywhere: bilinear, cubic, polynomial, table. On both sides: clearance",
      optional);
  contact(&Contact::constant, "constant", "N", "a_c of the exponential law", positive, or_in_pairs,
          only_with(law_is({"exponential"})));
  contact(&Contact::exponent, "exponent", "1/m", "alpha of the exponential law", positive, or_in_pairs,
          only_with(law_is({"exponential"})));
  contact(&Contact::stiffness, "stiffness", "N/m",
          "slope of the linear law, of the clearance and of the spring of the Kelvin-Voigt law", positive,
          or_in_pairs, only_with(law_is({"linear", "clearance", "kelvin_voigt"})));
  contact(
      &Contact::gap, "gap", "m",
      "displacement towards the obstacle at which contact starts, or the slope of the bilinear law changes; a "
      "list has one for each degree of freedom in contact",
      single_or_list(get_gap, set_gap), or_in_pairs,
      only_with(law_is(
          {"exponential", "linear", "rigid", "bilinear", "clearance", "hunt_crossley", "kelvin_voigt"})));
  add_law_constants(
      Section(keys, "contact", more_of_contact),
      [](std::vector<std::string_view> laws) {
        return [belongs = only_with(law_is(std::move(laws)))](SceneKey& key) {
          or_in_pairs(key);
          belongs(key);
        };
      },
      [](auto) { return [](SceneKey&) {}; });
  const Condition balanced = analysis_is({"forced_response", "frequency_sweep", "amplitude_sweep"});
  contact(
      &Contact::form, "form", "",
      "unknown in which contact is solved: the displacement, or for stiff and rigid laws the contact force",
      optional, only_with(balanced));
  contact(
      &Contact::mass, "mass", "",
      "mass of the contacts: keep it, or redistribute it to the rest of the structure, without which a "
      "rigid obstacle leaves a continuum of motions; automatic redistributes it for a rigid law, but not "
      "in nonlinear modes",
      optional,
      only_with(analysis_is({"forced_response", "frequency_sweep", "amplitude_sweep", "nonlinear_mode"})));
}

std::vector<SceneKey> pair_keys(std::size_t index) {
  std::vector<SceneKey> keys;
  const auto part = [index](auto& scene) -> auto& { return scene.contact.pairs[index]; };
  const Section pair(keys, "contact.pairs", part);
  const auto of_contact = [](auto Contact::*member) {
    return derived("that of [contact]", [=](const Scene& scene) { return value_of(scene.contact.*member); });
  };
  pair(
      &ContactPair::dofs, "dofs", "",
      "degrees of freedom whose weighted sum is the displacement in contact, rows of the matrices counted from "
      "1 or with dof_map \"node 1042 z\": two nodes that face each other, or the components along the normal of "
      "a surface",
      within(1, 100'000'000), named_dofs);
  pair(&ContactPair::coefficients, "coefficients", "", "their weights, one for each", within(-1e9, 1e9),
       derived("[1.0] for one of dofs, [1.0, -1.0] for two", [=](const Scene& scene) {
         return part(scene).dofs.size() == 1 ? std::vector<double>{1.0} : std::vector<double>{1.0, -1.0};
       }));
  pair(&ContactPair::side, "side", "",
       "where the obstacle stands: the displacement may exceed gap, or -gap on the negative side, or both",
       derived("\"positive\"", [](const Scene&) { return name_of(ObstacleSide::positive); }));
  pair(&ContactPair::law, "law", "", "contact law of this pair",
       one_of({"exponential", "linear", "bilinear", "cubic", "polynomial", "clearance", "table",
               "hunt_crossley", "kelvin_voigt"}),
       of_contact(&Contact::law));
  pair(&ContactPair::constant, "constant", "N", "a_c of its exponential law", positive,
       of_contact(&Contact::constant));
  pair(&ContactPair::exponent, "exponent", "1/m", "alpha of its exponential law", positive,
       of_contact(&Contact::exponent));
  pair(&ContactPair::stiffness, "stiffness", "N/m",
       "slope of its linear law, clearance or Kelvin-Voigt spring", positive,
       of_contact(&Contact::stiffness));
  pair(&ContactPair::gap, "gap", "m", "displacement towards its obstacle at which contact starts",
       of_contact(&Contact::gap));
  const auto more = [index](auto& scene) -> auto& { return scene.contact.pairs[index].more; };
  add_law_constants(
      Section(keys, "contact.pairs", more), [](std::vector<std::string_view>) { return [](SceneKey&) {}; },
      [](auto LawConstants::*member) {
        return derived("that of [contact]",
                       [=](const Scene& scene) { return value_of(scene.contact.more.*member); });
      });
  return keys;
}

}  // namespace wavebalance::app
