#include "scene/keys/key_tables.hpp"
#include "scene/keys/law_keys.hpp"

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

/// The key of a law's parameter among the values of a part of the scene, [contact] or one of its pairs.
template <class Part>
SceneKey law_key(std::string_view section, const SharedParameter& parameter, Part part) {
  SceneKey key = key_of_parameter(section, parameter);
  const contact::LawParameter& first = parameter.first;
  key.get = [=, &first](const Scene& scene) { return value_in(part(scene).values, first); };
  key.set = [=, &first](Scene& scene, const SceneValue& value) {
    set_value(part(scene).values, first, value);
  };
  return key;
}

void add_law_keys(std::vector<SceneKey>& keys) {
  for (const SharedParameter& parameter : law_parameters()) {
    SceneKey key = law_key("contact", parameter, contact_part);
    if (!parameter.first.may_lack) or_in_pairs(key);
    only_with(law_is(parameter.laws))(key);
    if (parameter.first.name == "gap") single_or_list(get_gap, set_gap)(key);
    keys.push_back(std::move(key));
  }
}

/// The keys of a pair's law, with the defaults of [contact].
void add_law_keys_of_pair(std::vector<SceneKey>& keys, std::size_t index) {
  const auto part = [index](auto& scene) -> auto& { return scene.contact.pairs[index]; };
  for (const SharedParameter& parameter : law_parameters()) {
    SceneKey key = law_key("contact.pairs", parameter, part);
    const contact::LawParameter& first = parameter.first;
    const bool gap = first.name == "gap";
    if (gap) {
      key.get = [=](const Scene& scene) { return SceneValue(part(scene).gap); };
      key.set = [=](Scene& scene, const SceneValue& value) { part(scene).gap = std::get<double>(value); };
    }
    derived("as in [contact]", [=, &first](const Scene& scene) {
      return gap ? SceneValue(scene.contact.gap) : value_in(scene.contact.values, first);
    })(key);
    keys.push_back(std::move(key));
  }
}

/// The weights of one or two degrees of freedom; none of others.
std::vector<double> default_weights(const std::vector<int>& dofs) {
  if (dofs.empty()) return {};
  return dofs.size() == 1 ? std::vector<double>{1.0} : std::vector<double>{1.0, -1.0};
}

std::vector<std::string_view> with_friction() {
  return law_names([](const contact::LawEntry& law) { return law.acts_over_period; });
}

std::vector<std::string_view> with_tangent() {
  return law_names([](const contact::LawEntry& law) { return law.acts_over_period || law.acts_in_plane; });
}

}  // namespace

void add_contact_keys(std::vector<SceneKey>& keys) {
  static const std::string law_help =
      "contact force on each contact degree of freedom (bar: the tip; blade: corner nodes of "
      "the tip, radially) as a function of its displacement u towards the obstacle and, for "
      "damped laws, its velocity v: " +
      forces_text();
  const Section contact(keys, "contact", contact_part);
  contact(&Contact::law, "law", "", law_help,
          one_of(law_names([](const contact::LawEntry&) { return true; })), optional);
  add_law_keys(keys);
  contact(&Contact::tangent, "tangent", "",
          "tangential direction in which the corner nodes of a blade's tip rub: x or y", optional,
          only_with(structure_is({"blade"}) && law_is(with_friction())));
  contact(&Contact::form, "form", "",
          "unknown of the contact problem: the displacement, or for stiff and rigid laws the contact force",
          optional, only_with(of_responses() && by_balance()));
  contact(
      &Contact::mass, "mass", "",
      "mass of the contact nodes: keep it, or redistribute it to the rest of the structure, "
      "which rigid contact requires; automatic redistributes it for a rigid law, but not in "
      "nonlinear modes or for exact solutions with rigid friction",
      optional,
      only_with(analysis_is({"forced_response", "frequency_sweep", "amplitude_sweep", "nonlinear_mode"})));
}

std::vector<SceneKey> pair_keys(std::size_t index) {
  std::vector<SceneKey> keys;
  const auto part = [index](auto& scene) -> auto& { return scene.contact.pairs[index]; };
  const Section pair(keys, "contact.pairs", part);
  pair(&ContactPair::dofs, "dofs", "",
       "degrees of freedom whose weighted sum is the contact displacement, as rows counted from "
       "1 or with dof_map \"node 1042 z\": two facing nodes, or the components along a surface "
       "normal",
       within(1, 100'000'000), named_dofs);
  pair(&ContactPair::coefficients, "coefficients", "", "one weight for each of them", within(-1e9, 1e9),
       derived("[1.0] for one of dofs, [1.0, -1.0] for two",
               [=](const Scene& scene) { return default_weights(part(scene).dofs); }));
  const auto add_tangent = [&](std::vector<int> ContactPair::*dofs, std::vector<double> ContactPair::*weights,
                               std::string_view name, std::string_view weights_name, std::string_view help,
                               const std::vector<std::string_view>& laws) {
    pair(dofs, name, "", help, within(1, 100'000'000), named_dofs,
         none_by_default(std::vector<std::int64_t>()));
    pair(weights, weights_name, "", "one weight for each of them", within(-1e9, 1e9),
         derived("as coefficients", [=](const Scene& scene) { return default_weights(part(scene).*dofs); }));
    for (auto key = keys.end() - 2; key != keys.end(); ++key) key->laws = laws;
  };
  add_tangent(&ContactPair::tangent, &ContactPair::tangent_coefficients, "tangent", "tangent_coefficients",
              "tangential direction of a law with friction; dofs is then the normal direction, and "
              "without tangent it is the sliding direction of a slider with a constant limit; for a "
              "ring, the y direction, perpendicular to dofs (x) and of equal weight",
              with_tangent());
  add_tangent(&ContactPair::second_tangent, &ContactPair::second_tangent_coefficients, "second_tangent",
              "second_tangent_coefficients", "second tangential direction of a contact that slips in a plane",
              with_friction());
  pair(&ContactPair::side, "side", "",
       "side of the obstacle: contact begins above gap, below -gap (negative), or at both",
       derived("\"positive\"", [](const Scene&) { return name_of(ObstacleSide::positive); }));
  pair(&ContactPair::law, "law", "", "contact law of this pair",
       one_of(law_names([](const contact::LawEntry& law) { return law.name != no_law; })),
       derived("as in [contact]", [](const Scene& scene) { return scene.contact.law; }));
  pair(&ContactPair::name, "name", "", "name of the contact in texts and pictures", none_by_default());
  pair(&ContactPair::unit, "unit", "",
       "unit of its displacement: rad where dofs are rotations, which a dof_map says otherwise",
       one_of({"rad"}), none_by_default());
  add_law_keys_of_pair(keys, index);
  return keys;
}

}  // namespace wavebalance::app
