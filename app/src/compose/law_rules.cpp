#include <algorithm>
#include <stdexcept>
#include <string>

#include "compose/scene_rules.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/scene/scene_keys.hpp"

namespace wavebalance::app {
namespace {

/// The key of [contact] that a law which cannot be made is about.
std::string constant_of(ContactLawType law) {
  switch (law) {
    case ContactLawType::bilinear:
      return "slopes";
    case ContactLawType::cubic:
      return "cubic_stiffness";
    case ContactLawType::polynomial:
      return "polynomial";
    case ContactLawType::table:
      return "table";
    case ContactLawType::clearance:
      return "gap";
    default:
      return "law";
  }
}

/// The laws of all contacts as they will be solved for, or an error at the key of the law that is none.
void check_laws_exist(const Document& document, const Scene& scene) {
  const Contact& contact = scene.contact;
  try {
    make_laws(scene);
    return;
  } catch (const std::runtime_error& error) {  // of a file
    for (std::size_t i = 0; i < contact.pairs.size(); ++i)
      if (contact.pairs[i].law == ContactLawType::table)
        fail_rule(document, {pair_section(i) + ".table", "contact.table"}, error.what());
    fail_rule(document, {"contact.table"}, error.what());
  } catch (const std::invalid_argument& error) {
    for (std::size_t i = 0; i < contact.pairs.size(); ++i)
      fail_rule(document,
                {pair_section(i) + "." + constant_of(contact.pairs[i].law),
                 "contact." + constant_of(contact.pairs[i].law)},
                error.what());
    fail_rule(document, {"contact." + constant_of(contact.law)}, error.what());
  }
}

std::vector<ContactLawType> laws_of(const Contact& contact) {
  if (contact.pairs.empty()) return {contact.law};
  std::vector<ContactLawType> laws;
  for (const ContactPair& pair : contact.pairs) laws.push_back(pair.law);
  return laws;
}

/// The velocity of a sum of trial functions needs their derivative at points.
void check_velocity(const Document& document, const Scene& scene, ContactLawType law) {
  constexpr int any = 16;  // no matter how many
  const bool balanced =
      !integrates_in_time(scene.analysis.type) && scene.analysis.type != AnalysisType::nonlinear_mode;
  if (!balanced || scene.time.trial.empty()) return;
  if (make_basis(scene.time.trial, any).pointwise_derivatives() >= 1) return;
  fail_rule(
      document, {"time.trial", "contact.law"},
      "not with the law \"" + name_of(law) + "\", whose force depends on the velocity: the functions \"" +
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

}  // namespace

void check_laws(const Document& document, const Scene& scene) {
  check_laws_exist(document, scene);
  for (const ContactLawType law : laws_of(scene.contact)) {
    const bool mode = scene.analysis.type == AnalysisType::nonlinear_mode;
    if (mode && is_damped(law))
      fail_rule(document, {"contact.law"},
                "not with a nonlinear mode: the law \"" + name_of(law) +
                    "\" takes energy from a free motion, which is then not periodic; expected \"rigid\", "
                    "\"exponential\" or \"linear\"");
    if (mode && acts_on_both_sides(law))
      fail_rule(document, {"contact.law"},
                "not with a nonlinear mode, which begins where a contact touches; expected \"rigid\", "
                "\"exponential\" or \"linear\"");
    if (is_damped(law)) check_velocity(document, scene, law);
  }
  check_form(document, scene);
}

}  // namespace wavebalance::app
