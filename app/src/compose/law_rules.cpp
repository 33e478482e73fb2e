
#include "compose/compose_parts.hpp"
#include "files/frequency_table.hpp"
#include "scene/keys/law_keys.hpp"
#include "scene/scene_keys_text.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/scene/contacts.hpp"
#include "wavebalance/app/scene/scene_keys.hpp"
#include "wavebalance/contact/catalogue.hpp"

namespace wavebalance::app {
namespace {

/// An error at the key of a law's parameter, in the pair of the contact or in [contact].
[[noreturn]] void fail_law(const Document& document, const SceneContact& contact,
                           const std::string& parameter, const std::string& what) {
  const std::string key = parameter.empty() ? "law" : parameter;
  if (contact.pair) fail_rule(document, {pair_section(*contact.pair) + "." + key, "contact." + key}, what);
  fail_rule(document, {"contact." + key}, what);
}

std::string file_parameter(const contact::LawEntry& law) {
  for (const contact::LawParameter& one : law.parameters)
    if (one.kind == contact::LawParameter::Kind::file) return std::string(one.name);
  return {};
}

/// The laws of all contacts as they will be solved for, or an error at the key of the law that is none.
void check_laws_exist(const Document& document, const std::vector<SceneContact>& contacts) {
  const SceneContact* before = nullptr;
  for (const SceneContact& contact : contacts) {
    if (before != nullptr && contact.same_law(*before)) continue;
    before = &contact;
    const contact::LawEntry& law = contact::law_entry(contact.law);
    try {
      law.make(contact.values);
    } catch (const contact::LawFault& fault) {
      fail_law(document, contact, fault.parameter(), fault.what());
    } catch (const std::runtime_error& error) {
      fail_law(document, contact, file_parameter(law), error.what());
    }
  }
}

/// A law that acts on both sides acts twice where a pair has an obstacle on each.
void check_sides(const Document& document, const Scene& scene, const std::vector<SceneContact>& contacts) {
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const SceneContact& contact = contacts[i];
    const bool both = contact.pair && scene.contact.pairs[*contact.pair].side == ObstacleSide::both;
    if (!both || has_friction(contact.law) || make_laws(scene)[static_cast<int>(i)].unilateral()) continue;
    fail_rule(document, {pair_section(*contact.pair) + ".side"},
              "not with the law \"" + contact.law +
                  "\", which acts on both sides and would act twice; expected \"positive\" or \"negative\"");
  }
}

/// The velocity of a sum of trial functions needs their derivative at points.
void check_velocity(const Document& document, const Scene& scene, const std::string& law) {
  constexpr int any = 16;  // no matter how many
  const bool balanced =
      !integrates_in_time(scene.analysis.type) && scene.analysis.type != AnalysisType::nonlinear_mode;
  if (!balanced || scene.time.trial.empty()) return;
  if (make_basis(scene.time.trial, any).pointwise_derivatives() >= 1) return;
  fail_rule(
      document, {"time.trial", "contact.law"},
      "not with the law \"" + law + "\", whose force depends on the velocity: the functions \"" +
          scene.time.trial +
          "\" have no derivative at points; expected \"fourier\", \"bspline\" or a smoother Daubechies basis");
}

void check_form(const Document& document, const Scene& scene) {
  if (scene.contact.form != ContactForm::force || make_laws(scene).have_force_form()) return;
  fail_rule(
      document, {"contact.form"},
      "not with a law that depends on the velocity, or falls somewhere and acts below its gap; expected "
      "\"automatic\" or \"displacement\"");
}

void check_elastic_planes(const Document& document, const Scene& scene, const std::string& key,
                          const std::string& expected) {
  for (const SceneContact& contact : contacts_of(scene)) {
    if (!contact.pair || scene.contact.pairs[*contact.pair].second_tangent.empty()) continue;
    if (!has_friction(contact.law) || contact.values.contains("tangential_stiffness")) continue;
    fail_rule(
        document, {key, pair_section(*contact.pair) + ".second_tangent"},
        "not with rigid friction along two tangents; expected contact.tangential_stiffness, or " + expected);
  }
}

constexpr std::array<const char*, 4> keys_of_states{"surface_speed", "static_friction", "tangential_damping",
                                                    "normal_damping"};

/// Friction is solved by balances in the displacement form, and exactly.
void check_friction_analysis(const Document& document, const Scene& scene) {
  const AnalysisType type = scene.analysis.type;
  if (type == AnalysisType::nonlinear_mode && names_friction_of_states(scene.contact))
    fail_rule(document, {"analysis.type", "contact.law"},
              "not with contact." + std::string(keys_of_states[0]) +
                  ", static_friction above friction, tangential_damping or normal_damping; expected another "
                  "analysis");
  if (type == AnalysisType::nonlinear_mode) return;
  const bool sweeps = is_sweep(type);
  if (names_friction_of_states(scene.contact) && !sweeps && !scene.time.trial.empty())
    fail_rule(document, {"time.trial", "contact.law"},
              "not with friction of surface_speed, static_friction, tangential_damping or normal_damping, "
              "whose motions are solved for from event to event; expected none");
  if (kind_of(type).motions_by != MotionsBy::equations)
    check_elastic_planes(document, scene, "analysis.type", "\"forced_response\"");
  if (solves_exactly(scene)) check_elastic_planes(document, scene, "time.method", "\"balance\"");
  if (scene.analysis.exact) check_elastic_planes(document, scene, "analysis.exact", "false");
}

/// A ring and a periodic stiffness are solved by balances in the displacement form, and by events.
void check_coupled_analysis(const Document& document, const Scene& scene) {
  const bool mode = scene.analysis.type == AnalysisType::nonlinear_mode;
  if (mode && names_plane(scene.contact))
    fail_rule(document, {"analysis.type", "contact.law"}, "not with a ring; expected another analysis");
  if (!names_signal(scene.contact)) return;
  const std::string stiffness = "not with a periodic stiffness, ";
  if (mode || scene.analysis.type == AnalysisType::limit_cycle)
    fail_rule(document, {"analysis.type", "contact.law"},
              stiffness + "which has the period of a load; expected another analysis");
  if (is_over_amplitude(scene.analysis))
    fail_rule(document, {"analysis.type", "contact.law"},
              stiffness +
                  "whose harmonics are no load that an amplitude scales; expected a sweep over the "
                  "frequency, or a study over stiffness_harmonics or the amplitude");
  if (scene.structure.loss_factor > 0.0)
    fail_rule(
        document, {"structure.loss_factor"},
        stiffness + "whose motion is no sum of harmonics that each have a stiffness; expected 0, or damping");
}

/// A periodic stiffness is one of [[contact.pairs]].
void check_signal(const Document& document, const SceneContact& contact) {
  if (!contact.pair)
    fail_rule(document, {"contact.law"},
              "acts between degrees of freedom; expected [[contact.pairs]] with dofs, one or two of them");
}

/// Rigid friction that is integrated in time begins at rest where the structure is.
void check_sliders(const Document& document, const std::vector<SceneContact>& contacts) {
  for (const SceneContact& contact : contacts)
    if (has_friction(contact.law) && contact.values.contains("slider") &&
        !contact.values.contains("tangential_stiffness"))
      fail_law(
          document, contact, "slider",
          "not with friction without contact.tangential_stiffness, which is rigid: in time it begins where "
          "the structure is; expected none, or contact.tangential_stiffness");
}

/// Balances solve rigid friction in the form of the force, at contacts without mass.
void check_rigid_friction(const Document& document, const Scene& scene) {
  if (!names_rigid_friction(scene.contact)) return;
  const std::string rigid = "not with friction without contact.tangential_stiffness, which is rigid: ";
  if (scene.analysis.type == AnalysisType::nonlinear_mode)
    fail_rule(document, {"analysis.type", "contact.law"},
              rigid + "a mode begins with contacts that stick; expected contact.tangential_stiffness");
  if (integrates_in_time(scene.analysis.type) || moves_by_events(scene))
    return check_sliders(document, contacts_of(scene));
  if (!make_laws(scene).have_force_form())
    fail_rule(document, {"contact.tangential_stiffness", "contact.law"},
              rigid +
                  "rigid friction is solved in the force form, which another law here does not support: it "
                  "is rate-dependent, or not monotone and acts below its gap; expected "
                  "contact.tangential_stiffness");
  if (scene.contact.form == ContactForm::displacement)
    fail_rule(document, {"contact.form"},
              rigid + "its force is no function of the displacement; expected \"automatic\" or \"force\"");
}

/// Rules between the keys of friction without steps over samples.
void check_friction_of_states(const Document& document, const Scene& scene, const SceneContact& contact) {
  const auto given = [&](const char* key) { return contact::number_or(contact.values, key, 0.0); };
  const double friction = given("friction"), at_rest = given("static_friction");
  const bool rigid = !contact.values.contains("tangential_stiffness");
  if (contact.values.contains("static_friction") && at_rest < friction)
    fail_law(document, contact, "static_friction", "expected at least friction = " + toml_text(friction));
  if (rigid && given("tangential_damping") > 0.0)
    fail_law(document, contact, "tangential_damping",
             "not without contact.tangential_stiffness, the spring beside it; expected 0, or one");
  if (rigid && at_rest > friction &&
      (scene.structure.massless_tip || scene.contact.mass == ContactMass::redistribute))
    fail_law(document, contact, "static_friction",
             "not with rigid friction at a contact without mass, which would jump by an unknown distance; "
             "expected contact.tangential_stiffness, or a contact that keeps its mass");
  if (!contact.pair || scene.contact.pairs[*contact.pair].second_tangent.empty()) return;
  for (const char* key : keys_of_states)
    if (given(key) != 0.0)
      fail_law(document, contact, key, "not with two tangents; expected none, or no second_tangent");
}

/// The directions of a contact with friction fit its law.
void check_friction_pair(const Document& document, const Scene& scene, const SceneContact& contact) {
  const contact::LawValues values = contact::complete_values(contact::law_entry(contact.law), contact.values);
  const double stiffness = contact::number_of(values, "normal_stiffness");
  const ContactPair* pair = contact.pair ? &scene.contact.pairs[*contact.pair] : nullptr;
  const std::string section = pair ? pair_section(*contact.pair) : "contact";
  const bool has_normal = pair ? !pair->tangent.empty() : scene.structure.type == StructureType::blade;
  if (has_normal && !(stiffness > 0.0))
    fail_rule(document, {section + ".normal_stiffness", "contact.normal_stiffness", section + ".tangent"},
              "the contact has a normal direction beside its tangent; expected a number in N/m, > 0");
  if (!has_normal && stiffness > 0.0)
    fail_rule(
        document, {section + ".normal_stiffness", "contact.normal_stiffness"},
        "the contact has no tangent beside the direction dofs, which is then the tangent itself; expected 0, or "
        "[[contact.pairs]] with tangent");
  for (const auto& [key, expected] : {std::pair{"normal_gap", "whose spring it would shift; expected 0"},
                                      {"normal_damping", "beside whose spring it would be; expected none"}})
    if (!has_normal && contact::number_or(values, key, 0.0) != 0.0)
      fail_law(document, contact, key,
               "the contact has no normal direction, " + std::string(expected) +
                   ", or [[contact.pairs]] with tangent");
  const bool grows = has_growing_normal_load(scene.contact);
  if (!has_normal && !grows && !(contact::number_of(values, "normal_load") > 0.0))
    fail_rule(
        document, {section + ".normal_load", "contact.normal_load"},
        "the contact has no normal direction, so that the limit is friction times normal_load; expected a number in N, > 0");
  if (pair && !has_normal && pair->side != ObstacleSide::positive)
    fail_rule(document, {section + ".side"},
              "a slider without a normal direction has no side; expected \"positive\"");
}

/// A weighted sum of degrees of freedom.
struct WeightedDofs {
  const std::vector<int>& dofs;
  const std::vector<double>& weights;

  double operator*(const WeightedDofs& other) const {
    double product = 0.0;
    for (std::size_t i = 0; i < dofs.size(); ++i)
      for (std::size_t j = 0; j < other.dofs.size(); ++j)
        if (dofs[i] == other.dofs[j]) product += weights[i] * other.weights[j];
    return product;
  }
  double cosine(const WeightedDofs& other) const {
    return (*this * other) / std::sqrt((*this * *this) * (other * other));
  }
};

/// Normal and tangents of a contact are independent directions.
void check_independent(const Document& document, const ContactPair& pair, const std::string& section) {
  constexpr double least = 1e-12;  // of the squared volume that unit vectors span
  if (pair.tangent.empty()) return;
  const WeightedDofs normal{pair.dofs, pair.coefficients}, first{pair.tangent, pair.tangent_coefficients},
      second{pair.second_tangent, pair.second_tangent_coefficients};
  const double a = normal.cosine(first);
  if (1.0 - a * a < least)
    fail_rule(document, {section + ".tangent"}, "is the direction of dofs, the normal; expected another one");
  if (pair.second_tangent.empty()) return;
  const double b = normal.cosine(second), c = first.cosine(second);
  if (1.0 + 2.0 * a * b * c - a * a - b * b - c * c < least * (1.0 - a * a))
    fail_rule(document, {section + ".second_tangent"},
              "is a direction of dofs and tangent; expected one that is independent of them");
}

/// The two directions of a ring are perpendicular and of equal weight, so that it is round.
void check_ring(const Document& document, const Scene& scene, const SceneContact& contact) {
  constexpr double rounding = 1e-9;
  if (!contact.pair)
    fail_rule(document, {"contact.law"},
              "acts along two directions of one contact; expected [[contact.pairs]] with dofs and tangent");
  const ContactPair& pair = scene.contact.pairs[*contact.pair];
  const std::string section = pair_section(*contact.pair);
  if (pair.side != ObstacleSide::positive)
    fail_rule(document, {section + ".side"}, "a ring is all around; expected \"positive\"");
  if (pair.tangent.empty())
    fail_rule(
        document, {section + ".tangent"},
        "missing: the second direction of the ring; expected the degrees of freedom of y beside dofs, of x");
  const WeightedDofs x{pair.dofs, pair.coefficients}, y{pair.tangent, pair.tangent_coefficients};
  if (std::abs(x * x - y * y) > rounding * (x * x))
    fail_rule(document, {section + ".tangent_coefficients", section + ".tangent"},
              "the sum of the squared weights differs from the one of coefficients, which makes the ring an "
              "ellipse; expected equal sums");
  if (std::abs(x.cosine(y)) > rounding)
    fail_rule(document, {section + ".tangent"},
              "is not perpendicular to the direction of dofs; expected one that is, since the ring is round");
}

/// Tangents belong to a law with friction or a ring, and a blade's is not radial.
void check_tangents(const Document& document, const Scene& scene) {
  if (scene.contact.tangent == Direction::z)
    fail_rule(document, {"contact.tangent"},
              "the tip's nodes meet the casing along z, the radial direction; expected \"x\" or \"y\"");
  for (std::size_t i = 0; i < scene.contact.pairs.size(); ++i) {
    const ContactPair& pair = scene.contact.pairs[i];
    if (has_friction(pair.law)) continue;
    const bool plane = acts_in_plane(pair.law);
    const std::string key =
        pair_section(i) + (pair.tangent.empty() || plane ? ".second_tangent" : ".tangent");
    if (plane && !pair.second_tangent.empty())
      fail_rule(document, {key}, "a ring has two directions, dofs and tangent; expected none");
    if (!plane && (!pair.tangent.empty() || !pair.second_tangent.empty()))
      fail_rule(document, {key, "contact.law"},
                "not with the law \"" + pair.law +
                    "\", which has no friction; expected none, or law = \"coulomb\"");
  }
}

/// Beside a rigid contact other laws are solved for from event to event.
void check_mixture(const Document& document, const Scene& scene) {
  if (!is_rigid(scene.contact.law) || has_impacts(scene.contact)) return;
  for (std::size_t i = 0; i < scene.contact.pairs.size(); ++i) {
    const std::string& law = scene.contact.pairs[i].law;
    if (is_rigid(law)) continue;
    fail_rule(document, {pair_section(i) + ".law", "contact.law"},
              std::string(has_friction(law) ? "friction" : "another law") +
                  " beside a rigid contact needs a law of impact; expected contact.restitution, or a stiff "
                  "\"linear\" law in place of contact.law = \"rigid\"");
  }
}

/// Normal loads that follow the frequency of the load belong to analyses that have one, which a table holds.
void check_normal_loads(const Document& document, const Scene& scene) {
  const auto check = [&](const std::string& section, const contact::LawValues& values) {
    const AnalysisType type = scene.analysis.type;
    const bool load = type != AnalysisType::nonlinear_mode && type != AnalysisType::limit_cycle;
    const std::string none = "analysis.type = \"" + name_of(type) +
                             "\" has no load whose frequency it follows; "
                             "expected normal_load alone";
    if (!load && contact::number_or(values, "normal_load_speed2", 0.0) > 0.0)
      fail_rule(document, {section + ".normal_load_speed2"}, none);
    if (!values.contains("normal_load_table")) return;
    if (!load) fail_rule(document, {section + ".normal_load_table"}, none);
    try {
      const std::string& file = contact::file_of(values, "normal_load_table");
      std::vector<double> places = read_normal_loads(file);
      places.resize(places.size() / 2);
      const auto [from, to] = load_frequencies(scene);
      require_frequencies(file, places, from, to);
    } catch (const std::runtime_error& error) {
      fail_rule(document, {section + ".normal_load_table"}, error.what());
    }
  };
  check("contact", scene.contact.values);
  for (std::size_t i = 0; i < scene.contact.pairs.size(); ++i)
    check(pair_section(i), scene.contact.pairs[i].values);
}

}  // namespace

void check_laws(const Document& document, const Scene& scene) {
  check_normal_loads(document, scene);
  check_mixture(document, scene);
  check_tangents(document, scene);
  const std::vector<SceneContact> contacts = contacts_of(scene);
  if (has_friction(scene)) check_friction_analysis(document, scene);
  if (names_coupled_rows(scene.contact)) check_coupled_analysis(document, scene);
  for (const SceneContact& contact : contacts) {
    if (has_friction(contact.law)) check_friction_pair(document, scene, contact);
    if (has_friction(contact.law)) check_friction_of_states(document, scene, contact);
    if (acts_in_plane(contact.law)) check_ring(document, scene, contact);
    if (reads_signal(contact.law)) check_signal(document, contact);
  }
  for (std::size_t i = 0; i < scene.contact.pairs.size(); ++i)
    if (has_friction(scene.contact.pairs[i].law))
      check_independent(document, scene.contact.pairs[i], pair_section(i));
  check_rigid_friction(document, scene);
  check_laws_exist(document, contacts);
  check_sides(document, scene, contacts);
  for (const SceneContact& contact : contacts)
    if (is_damped(contact.law)) check_velocity(document, scene, contact.law);
  check_form(document, scene);
}

}  // namespace wavebalance::app
