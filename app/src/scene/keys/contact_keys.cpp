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

}  // namespace

void add_contact_keys(std::vector<SceneKey>& keys) {
  const Section contact(keys, "contact", contact_part);
  contact(&Contact::law, "law", "",
          "force on each degree of freedom in contact (a bar: its tip; a blade: its tip's corner nodes, "
          "radially) once its displacement u exceeds the gap: constant (exp(exponent (u - gap)) - 1), "
          "stiffness (u - gap), or, rigid, whatever keeps u at the gap",
          optional);
  contact(&Contact::constant, "constant", "N", "a_c of the exponential law", positive, or_in_pairs,
          only_with(law_is({"exponential"})));
  contact(&Contact::exponent, "exponent", "1/m", "alpha of the exponential law", positive, or_in_pairs,
          only_with(law_is({"exponential"})));
  contact(&Contact::stiffness, "stiffness", "N/m", "slope of the linear law", positive, or_in_pairs,
          only_with(law_is({"linear"})));
  contact(&Contact::gap, "gap", "m",
          "displacement towards the obstacle at which contact starts; a list has one for each degree of "
          "freedom in contact",
          single_or_list(get_gap, set_gap), or_in_pairs,
          only_with(law_is({"exponential", "linear", "rigid"})));
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
  pair(&ContactPair::law, "law", "", "contact law of this pair", one_of({"exponential", "linear"}),
       of_contact(&Contact::law));
  pair(&ContactPair::constant, "constant", "N", "a_c of its exponential law", positive,
       of_contact(&Contact::constant));
  pair(&ContactPair::exponent, "exponent", "1/m", "alpha of its exponential law", positive,
       of_contact(&Contact::exponent));
  pair(&ContactPair::stiffness, "stiffness", "N/m", "slope of its linear law", positive,
       of_contact(&Contact::stiffness));
  pair(&ContactPair::gap, "gap", "m", "displacement towards its obstacle at which contact starts",
       of_contact(&Contact::gap));
  return keys;
}

}  // namespace wavebalance::app
