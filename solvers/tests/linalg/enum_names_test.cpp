#include <gtest/gtest.h>

#include <set>

#include "enumerators.hpp"
#include "linalg/enum_table.hpp"
#include "wavebalance/solvers/branches/branches.hpp"
#include "wavebalance/solvers/collocation/collocation_motion.hpp"
#include "wavebalance/solvers/modes/elastic_mode.hpp"
#include "wavebalance/solvers/period/time_stepping.hpp"
#include "wavebalance/solvers/response/refinement.hpp"

namespace wavebalance::solvers {
namespace {

template <class Enum>
class EnumNames : public ::testing::Test {};

using NamedEnums = ::testing::Types<BackboneStatus, BranchEnd, ContactForm, ModeStatus, ExactStatus,
                                    RefinementStatus, SolveStatus, SpecialPointType, StabilityStatus,
                                    Strategy, SweepStatus, TimeSteppingStatus>;
TYPED_TEST_SUITE(EnumNames, NamedEnums);

TYPED_TEST(EnumNames, EveryEnumeratorHasANameOfItsOwn) {
  std::set<std::string_view> names{"", "unknown"};
  for (const TypeParam value : enumerators<TypeParam>())
    EXPECT_TRUE(names.insert(to_string(value)).second) << to_string(value);
  EXPECT_GE(names.size(), 4u);
}

enum class Fruit { apple, pear, plum };

TEST(EnumTable, AValueWithoutARowIsUnknown) {
  const auto name = [](Fruit fruit) {
    return detail::name_in<Fruit>({{Fruit::apple, "apple"}, {Fruit::pear, "pear"}}, fruit);
  };
  EXPECT_EQ(enumerators<Fruit>().size(), 3u);
  EXPECT_EQ(name(Fruit::pear), "pear");
  EXPECT_EQ(name(Fruit::plum), "unknown");
}

}  // namespace
}  // namespace wavebalance::solvers
