#include <algorithm>
#include <stdexcept>
#include <string>

#include "compose/scene_rules.hpp"
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

/// A nonlinear mode is a free motion that begins where a contact touches.
void check_law_of_mode(const Document& document, const std::string& law) {
  const std::string expected = "; expected " + alternatives(laws_of_modes());
  if (is_damped(law))
    fail_rule(document, {"contact.law"},
              "not with a nonlinear mode: the law \"" + law +
                  "\" takes energy from a free motion, which is then not periodic" + expected);
  if (acts_on_both_sides(law))
    fail_rule(document, {"contact.law"},
              "not with a nonlinear mode, which begins where a contact touches" + expected);
}

}  // namespace

void check_laws(const Document& document, const Scene& scene) {
  const std::vector<SceneContact> contacts = contacts_of(scene);
  check_laws_exist(document, contacts);
  for (const SceneContact& contact : contacts) {
    if (scene.analysis.type == AnalysisType::nonlinear_mode) check_law_of_mode(document, contact.law);
    if (is_damped(contact.law)) check_velocity(document, scene, contact.law);
  }
  check_form(document, scene);
}

}  // namespace wavebalance::app
