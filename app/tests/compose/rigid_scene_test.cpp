#include <gtest/gtest.h>

#include "support/scene_error.hpp"
#include "support/scene_texts.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"

namespace {

using namespace wavebalance::app;

std::string rigid_scene(const std::string& more = "") {
  const std::string rigid = with(with(bar_scene, "\"exponential\"", "\"rigid\""), "exponent = 50.0", "");
  return with(rigid, "constant = 1e8  ", more + "# ");
}

TEST(RigidScene, MassAtARigidContactIsRefused) {
  EXPECT_TRUE(redistributes_mass(parse_scene(rigid_scene(), "case.toml", {})));
  EXPECT_FALSE(redistributes_mass(parse_scene(bar_scene, "case.toml", {})));
  expect_error(rigid_scene("mass = \"keep\""), 11, "contact.mass", "\"keep\"", "a continuum of motions");
  expect_error(with(rigid_scene(), "elements = 25", "elements = 1"), 7, "structure.elements", "1",
               "the tip's mass goes to a neighbour");
  EXPECT_NO_THROW(
      parse_scene(with(rigid_scene("mass = \"keep\""), "elements = 25", "massless_tip = true\nelements = 25"),
                  "case.toml", {}));
}

TEST(RigidScene, RigidContactHasNoDisplacementForm) {
  expect_error(rigid_scene("form = \"displacement\""), 11, "contact.form", "\"displacement\"",
               "no function of the displacement");
  EXPECT_EQ(parse_scene(rigid_scene("form = \"force\""), "case.toml", {}).contact.form, ContactForm::force);
}

}  // namespace
