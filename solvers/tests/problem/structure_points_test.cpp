// Exact bifurcation and grazing points near a balance's: each once, as on the exact curve.
#include "wavebalance/solvers/problem/structure_points.hpp"

#include "support/oscillator.hpp"
#include "support/small_problems.hpp"
#include "support/solved.hpp"
#include "testing.hpp"

namespace wavebalance::solvers {
namespace {

using Type = SpecialPointType;
using Status = StructurePointStatus;

/// The oscillator with a stop that is four times as stiff: two folds and two grazings.
struct Swept {
  int functions = 31, samples = 256;
  double from = 0.1, to = 0.35;

  ContactProblem problem() const {
    return {testing::fourier_pair(functions, samples), testing::unit_oscillator(0.05, 0.15),
            testing::LinearContact{4.0, 1.0}};
  }
  FrequencySweep curve() const {
    FrequencySweepOptions options = testing::between(from, to);
    return problem().sweep(options);
  }
  ExactCurve exact() const {
    ExactCurveOptions options{.from = from, .to = to};
    return problem().exact_sweep(options);
  }
  StructurePoints points(const FrequencySweep& curve, const CurveStability& stability,
                         StructurePointsOptions options = {}) const {
    options.from = from;
    options.to = to;
    return structure_points([this] { return problem(); }, curve, stability.special_points, options);
  }
};

void expect_events(const StructurePoints& found, const ExactCurve& exact) {
  ASSERT_EQ(found.events.size(), exact.events.size());
  for (std::size_t i = 0; i < found.events.size(); ++i) {
    EXPECT_EQ(found.events[i].type, exact.events[i].type);
    EXPECT_NEAR(found.events[i].value, exact.events[i].value, 1e-9 * exact.events[i].value);
  }
}

TEST(StructurePoints, OfAWholeCurveAreKnownWithoutOneOfTheBalance) {
  const Swept swept;
  const StructurePoints found = swept.points(swept.curve(), {});
  expect_events(found, swept.exact());
  EXPECT_TRUE(found.whole);
  EXPECT_FALSE(found.apart);
  EXPECT_TRUE(found.passed_by.empty());
}

// Both folds lie at 0.1957 Hz and 0.1699 Hz. A curve that jumps from the upper branch to that without contact
// does not come near the first.
TEST(StructurePoints, SayWhichFoldsACurveThatJumpsPassesBy) {
  const Swept swept;
  FrequencySweep curve = swept.curve();
  bool high = false;
  std::erase_if(curve.points, [&](const SweepPoint& point) {
    high = high || point.max_displacement > 2.0;
    return high && (point.frequency < 0.2 || point.max_displacement > 1.0);
  });
  const StructurePoints found = swept.points(curve, {});
  EXPECT_TRUE(found.whole);
  ASSERT_FALSE(found.passed_by.empty());
  EXPECT_NEAR(found.events[found.passed_by.front()].value, 0.195691, 1e-6);
}

// Within 0.1 to 0.18 Hz the branch without contact is not connected with that through the first point.
TEST(StructurePoints, SayThatTheEndsOfACurveLieApart) {
  Swept below{31, 256, 0.1, 0.18};
  const FrequencySweep from_above = Swept{31, 256, 0.35, 0.18}.curve();
  FrequencySweep curve = below.curve();
  ASSERT_GT(curve.points.back().max_displacement, 1.1);
  ASSERT_LT(from_above.points.back().max_displacement, 1.0);
  EXPECT_FALSE(below.points(curve, {}).apart);
  curve.points.back() = from_above.points.back();
  const StructurePoints found = below.points(curve, {});
  EXPECT_TRUE(found.whole);
  EXPECT_TRUE(found.apart);
}

TEST(StructurePoints, AreTheSameOnAnyNumberOfThreads) {
  const Swept swept;
  const FrequencySweep curve = swept.curve();
  const CurveStability stability = swept.problem().stability(curve);
  // Too little work for the whole curve, and enough for stretches.
  StructurePointsOptions options{.reach = 0.01, .max_operations = 5e6};
  const StructurePoints one = swept.points(curve, stability, options);
  options.threads = 3;
  const StructurePoints three = swept.points(curve, stability, options);
  EXPECT_FALSE(one.whole);
  EXPECT_FALSE(one.events.empty());
  ASSERT_EQ(one.events.size(), three.events.size());
  for (std::size_t i = 0; i < one.events.size(); ++i) EXPECT_EQ(one.events[i].value, three.events[i].value);
}

// A balance has the bifurcation and grazing points of its samples. One that is made up is none of the
// structure.
TEST(StructurePoints, MarkThoseThatTheStructureDoesNotHaveAndThoseThatAreRepeated) {
  const Swept swept;
  const FrequencySweep curve = swept.curve();
  CurveStability stability = swept.problem().stability(curve);
  SpecialPoint doubling = stability.special_points[1], again = stability.special_points[0];
  doubling.type = Type::period_doubling;
  again.frequency *= 1.001;
  stability.special_points.push_back(doubling);
  stability.special_points.push_back(again);
  const StructurePoints found = swept.points(curve, stability);
  expect_events(found, swept.exact());
  const std::size_t count = found.of_balance.size();
  EXPECT_EQ(found.of_balance[count - 2].status, Status::none);
  EXPECT_EQ(found.of_balance[count - 1].status, Status::repeated);
  EXPECT_EQ(found.of_balance[0].status, Status::found);
  EXPECT_EQ(found.of_balance[0].event, found.of_balance[count - 1].event);
}

TEST(StructurePoints, BeyondTheLimitsAreNotSought) {
  const Swept swept;
  const FrequencySweep curve = swept.curve();
  const CurveStability stability = swept.problem().stability(curve);
  const StructurePoints one =
      swept.points(curve, stability, {.reach = 0.001, .max_segments = 1, .max_operations = 3e5});
  int sought = 0, left = 0;
  for (const NearStructurePoint& near : one.of_balance) ++(near.status == Status::not_sought ? left : sought);
  EXPECT_GT(sought, 0);
  EXPECT_GT(left, 0);
  const StructurePoints few = swept.points(curve, stability, {.max_operations = 1e3});
  EXPECT_TRUE(few.events.empty());
  for (const NearStructurePoint& near : few.of_balance) EXPECT_EQ(near.status, Status::not_known);
}

TEST(StructurePoints, StopWhereTheObserverSaysSo) {
  const Swept swept;
  const FrequencySweep curve = swept.curve();
  const CurveStability stability = swept.problem().stability(curve);
  StructurePointsOptions options;
  options.observer = [](const Progress&) { return false; };
  const StructurePoints found = swept.points(curve, stability, options);
  EXPECT_TRUE(found.cancelled);
  for (const NearStructurePoint& near : found.of_balance) EXPECT_EQ(near.status, Status::not_sought);
}

TEST(StructurePoints, RefuseOptionsOutOfRange) {
  const Swept swept;
  const FrequencySweep curve = swept.curve();
  const auto make = [&] { return swept.problem(); };
  for (const auto& [from, to, reach] : {std::tuple{0.0, 1.0, 0.1}, {0.1, -1.0, 0.1}, {0.1, 0.2, 0.0}})
    EXPECT_THROW(structure_points(make, curve, {}, {.from = from, .to = to, .reach = reach}),
                 std::invalid_argument);
}

}  // namespace
}  // namespace wavebalance::solvers
