// Mistakes in the text of a scene, and changes of it.
#include <gtest/gtest.h>

#include "enumerators.hpp"
#include "scene/enum_names.hpp"
#include "support/scene_error.hpp"
#include "support/scene_texts.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"

namespace {

using namespace wavebalance::app;

TEST(SceneText, TextsWithoutTheirQuotesAreShownWithThem) {
  const auto allowed = [](const std::string& law) {
    const auto details = error_of(with(bar_scene, "law = \"exponential\"", "law = " + law));
    EXPECT_NE(details.allowed.find("not valid TOML"), std::string::npos) << details.allowed;
    return details.allowed;
  };
  for (const char* law : {"linear", "\"linear", "linear\""})
    EXPECT_NE(allowed(law).find("; a text stands between quotes, as in law = \"linear\""), std::string::npos)
        << law << ": " << allowed(law);
  const auto number = error_of(with(bar_scene, "gap = 1e-3", "gap = 1e-3.5"));
  EXPECT_EQ(number.allowed.find("between quotes"), std::string::npos) << number.allowed;
}

TEST(SceneText, OverridesMayHaveBlanksAroundTheirKeyAndValue) {
  const std::vector<std::string> overrides{" contact.gap = 2e-3 "};
  EXPECT_EQ(parse_scene(bar_scene, "case.toml", overrides).contact.gap, 2e-3);
}

template <class Enum>
class SceneEnum : public ::testing::Test {};

using SceneEnums =
    ::testing::Types<StructureType, SolidElement, Direction, TipPlace, ContactForm, ContactMass, ObstacleSide,
                     Formulation, InnerProducts, NyquistCoefficient, LoadKind, AnalysisType>;
TYPED_TEST_SUITE(SceneEnum, SceneEnums);

TYPED_TEST(SceneEnum, EveryEnumeratorHasAName) {
  EXPECT_EQ(wavebalance::enumerators<TypeParam>().size(), enum_names<TypeParam>.size());
  for (const TypeParam value : wavebalance::enumerators<TypeParam>())
    EXPECT_EQ(enum_value<TypeParam>(enum_name(value)), value);
}

}  // namespace
