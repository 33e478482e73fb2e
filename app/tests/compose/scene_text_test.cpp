// Names of the choices of a scene.
#include <gtest/gtest.h>

#include "enumerators.hpp"
#include "scene/enum_names.hpp"

namespace {

using namespace wavebalance::app;

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
