#include "wavebalance/solvers/exact/exact_curve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "constants.hpp"
#include "support/impact_scenes.hpp"
#include "support/refusal.hpp"
#include "support/small_problems.hpp"
#include "wavebalance/solvers/impacts/impact_response.hpp"

namespace wavebalance::solvers {
namespace {

using testing::cosine_load, testing::impact_oscillator, testing::ImpactScene, testing::lumped_bar,
    testing::oscillator_between_stops, testing::two_masses_with_impacts;
using Type = SpecialPointType;

/// A structure with impacts, whose curves start where it settles.
class TracedImpacts {
 public:
  explicit TracedImpacts(ImpactScene scene)
      : scene_(std::move(scene)),
        structure_(scene_.structure()),
        dynamics_(structure_),
        problem_(testing::fourier_pair(7, 32), structure_, cosine_load()) {}

  PhaseFamily family(double frequency, SweepParameter parameter = SweepParameter::frequency) {
    problem_.set_frequency(frequency);
    return {problem_, scene_.laws(), dynamics_, parameter};
  }
  /// Over the angular frequency.
  ExactCurve over_omega(double from, double to, ExactCurveOptions options = {}) {
    options.from = from / two_pi;
    options.to = to / two_pi;
    const PhaseFamily over = family(options.from);
    const ImpactResponse first = impact_response(over.at(options.from));
    return exact_curve(over, first.motion, options);
  }
  const ContactDynamics& dynamics() const { return dynamics_; }

 private:
  ImpactScene scene_;
  LinearStructure structure_;
  ContactDynamics dynamics_;
  CondensedProblem problem_;
};

std::vector<double> places_of(const ExactCurve& curve, Type type) {
  std::vector<double> places;
  for (const ExactEvent& event : curve.events)
    if (event.type == type) places.push_back(event.value);
  return places;
}

TEST(ImpactCurveTest, BeginsToTouchWhereTheMotionWithoutContactReachesTheGap) {
  constexpr double damping = 0.1, gap = 2.0;
  const ImpactScene scene = impact_oscillator(damping, gap, 0.8, 0.5);
  const ExactCurve curve = TracedImpacts(scene).over_omega(0.5, 1.0);
  EXPECT_EQ(curve.status, SweepStatus::reached_end) << to_string(curve.status);
  // (1 - w^2)^2 + c^2 w^2 = 1 / gap^2
  const double half = 1.0 - 0.5 * damping * damping;
  const double expected = std::sqrt(half - std::sqrt(half * half - 1.0 + 1.0 / (gap * gap)));
  const std::vector<double> grazing = places_of(curve, Type::grazing);
  ASSERT_FALSE(grazing.empty());
  EXPECT_NEAR(two_pi * grazing.front(), expected, 1e-11);
  EXPECT_EQ(curve.points.front().motion.impacts.size(), 0u);
  EXPECT_EQ(curve.points.back().motion.impacts.size(), 1u);
}

TEST(ImpactCurveTest, BeginsToTouchAtTheLoadWhoseMotionReachesTheGap) {
  const ImpactScene scene = impact_oscillator(0.1, 2.0, 0.8, 0.9);
  TracedImpacts traced(scene);
  const double frequency = scene.frequency();
  const PhaseFamily family = traced.family(frequency, SweepParameter::load_scale);
  const double reach = std::abs(scene.free_amplitudes()[0]);
  const double from = 0.5 * 2.0 / reach, to = 2.0 * 2.0 / reach;
  const ExactCurve curve = exact_curve(family, impact_motion(family.at(from), {}), {.from = from, .to = to});
  EXPECT_EQ(curve.status, SweepStatus::reached_end) << to_string(curve.status);
  ASSERT_FALSE(places_of(curve, Type::grazing).empty());
  EXPECT_NEAR(places_of(curve, Type::grazing).front(), 2.0 / reach, 1e-12);
}

// One impact in a period of an oscillator without damping [Shaw and Holmes 1983].
TEST(ImpactCurveTest, HasTheClosedFormOfTheOscillatorWithoutDampingAtEveryPoint) {
  constexpr double gap = 0.0, restitution = 0.8;
  const ImpactScene scene = impact_oscillator(0.0, gap, restitution, 2.6);
  TracedImpacts traced(scene);
  const double from = scene.frequency();
  const PhaseFamily family = traced.family(from);
  const double reach = std::abs(scene.free_amplitudes()[0]), first_period = two_pi / scene.omega;
  const double turn = 0.5 * (1.0 + restitution) * std::sin(first_period) / (1.0 - std::cos(first_period)),
               rest = 0.5 * (1.0 - restitution) / scene.omega, speed = reach / std::hypot(turn, rest);
  const PhaseMotion first =
      impact_motion(family.at(from), {{0, std::atan2(rest, -turn) / two_pi, (1.0 + restitution) * speed}});
  ASSERT_TRUE(first.converged()) << to_string(first.status);
  const ExactCurve curve = exact_curve(family, first, {.from = from, .to = 3.0 / two_pi});
  ASSERT_EQ(curve.status, SweepStatus::reached_end) << to_string(curve.status);
  for (const ExactPoint& point : curve.points) {
    const double omega = two_pi * point.value, period = two_pi / omega,
                 amplitude = 1.0 / (1.0 - omega * omega);
    ASSERT_EQ(point.motion.impacts.size(), 1u);
    // v = velocity before: with s, c of the phase, u(0) = 0 and u'(0+) = -e v, u(T) = 0 and u'(T-) = v.
    const double v = point.motion.impacts[0].velocity_before;
    const double sum = 0.5 * v * (1.0 + restitution) * std::sin(period) / (1.0 - std::cos(period)),
                 difference = 0.5 * v * (1.0 - restitution) / omega;
    EXPECT_NEAR(std::hypot(sum, difference), std::abs(amplitude), 1e-11) << omega;
  }
}

TEST(ImpactCurveTest, PassesMotionsOfEachFrequency) {
  const ImpactScene scene = two_masses_with_impacts(0.3, 0.7, 0.8);
  TracedImpacts traced(scene);
  const ExactCurve curve = traced.over_omega(0.8, 2.0);
  EXPECT_GE(curve.points.size(), 10u);
  for (const ExactPoint& point : curve.points) {
    std::vector<ImpactGuess> start;
    for (const Impact& impact : point.motion.impacts)
      start.push_back({impact.contact, impact.time + 1e-6, impact.impulse * (1.0 + 1e-6)});
    const PhaseFamily family = traced.family(point.value);
    const int periods = static_cast<int>(std::lround(point.value / point.motion.frequency()));
    const PhaseMotion motion = impact_motion(over_periods(family.at(point.value), periods), start);
    ASSERT_TRUE(motion.converged()) << to_string(motion.status);
    ASSERT_EQ(motion.impacts.size(), point.motion.impacts.size());
    for (std::size_t i = 0; i < motion.impacts.size(); ++i)
      EXPECT_NEAR(motion.impacts[i].impulse, point.motion.impacts[i].impulse, 1e-9);
  }
}

TEST(ImpactCurveTest, HasTheMultiplierOfEachSpecialPointOnTheCircle) {
  int folds = 0, doublings = 0;
  for (const double gap : {0.1, 0.5})
    for (const double restitution : {0.7, 0.8}) {
      TracedImpacts traced(impact_oscillator(0.1, gap, restitution, 3.0));
      const ExactCurve curve = gap < 0.2 ? traced.over_omega(3.0, 1.2) : traced.over_omega(2.2, 1.2);
      for (const ExactEvent& event : curve.events) {
        if (event.type == Type::grazing) continue;
        EXPECT_NEAR(std::abs(event.multiplier), 1.0, 1e-7) << to_string(event.type);
        EXPECT_TRUE(event.motion.converged());
        const double real = event.multiplier.real();
        EXPECT_TRUE(event.type != Type::fold || std::abs(real - 1.0) < 1e-5) << real;
        EXPECT_TRUE(event.type != Type::period_doubling || std::abs(real + 1.0) < 1e-7) << real;
        folds += event.type == Type::fold;
        doublings += event.type == Type::period_doubling;
      }
    }
  EXPECT_GE(folds, 1);
  EXPECT_GE(doublings, 1);
}

TEST(ImpactCurveTest, FollowsTheMotionsOfTwoPeriodsFromADoubling) {
  ExactCurveOptions options;
  TracedImpacts traced(impact_oscillator(0.1, 0.1, 0.8, 3.0));
  const ExactCurve curve = traced.over_omega(3.0, 1.2);
  options.from = 3.0 / two_pi;
  options.to = 1.2 / two_pi;
  const PhaseFamily family = traced.family(options.from);
  int followed = 0;
  for (const ExactEvent& event : curve.events) {
    if (event.type != Type::period_doubling) continue;
    const double periods = std::round(event.value / event.motion.frequency());
    const ExactCurve doubled = doubled_curve(family, event, options);
    if (doubled.status == SweepStatus::no_start) continue;
    ++followed;
    EXPECT_GE(doubled.points.size(), 3u);
    EXPECT_NEAR(doubled.points.front().value, event.value, 1e-2 * event.value);
    for (const ExactPoint& point : doubled.points) {
      EXPECT_TRUE(point.motion.converged());
      EXPECT_NEAR(point.motion.frequency(), point.value / (2.0 * periods), 1e-12);
    }
  }
  EXPECT_GE(followed, 1);
}

// Of frequencies at which the structure settles to a stable motion of the curve's period, the curve has it.
TEST(ImpactCurveTest, PassesTheMotionsThatTheStructureSettlesTo) {
  const ImpactScene scene = oscillator_between_stops(0.2, 0.4, 0.7, 0.5);
  TracedImpacts traced(scene);
  const ExactCurve curve = traced.over_omega(0.7, 2.5);
  int compared = 0;
  for (std::size_t i = 0; i < curve.points.size(); i += 7) {
    const ExactPoint& point = curve.points[i];
    if (point.unstable != 0) continue;
    const ImpactResponse settled = impact_response(traced.family(point.value).at(point.value));
    if (settled.load_periods != 1 || settled.motion.impacts.size() != point.motion.impacts.size()) continue;
    ++compared;
    EXPECT_NEAR(settled.motion.energy_lost(), point.motion.energy_lost(), 1e-8) << point.value;
  }
  EXPECT_GE(compared, 3);
}

TEST(ImpactCurveTest, FollowsABarOfManyModes) {
  const ImpactScene scene = lumped_bar(30, 0.5, 0.02, 0.8, 0.6, 0.6);
  const ExactCurve curve = TracedImpacts(scene).over_omega(0.6, 1.0);
  EXPECT_EQ(curve.status, SweepStatus::reached_end) << to_string(curve.status);
  for (const ExactPoint& point : curve.points) EXPECT_TRUE(point.motion.converged());
  for (const ExactEvent& event : curve.events)
    EXPECT_TRUE(event.type == Type::grazing || std::abs(std::abs(event.multiplier) - 1.0) < 1e-6);
}

TEST(ImpactCurveTest, StopsWhereItsObserverSaysSo) {
  ExactCurveOptions options;
  options.observer = [](const Progress& progress) { return progress.step < 4; };
  const ExactCurve curve = TracedImpacts(impact_oscillator(0.1, 0.5, 0.8, 1.2)).over_omega(1.2, 3.2, options);
  EXPECT_EQ(curve.status, SweepStatus::cancelled);
  EXPECT_EQ(curve.points.size(), 4u);
}

TEST(ImpactCurveTest, RefusesOptionsOutOfRangeAndAMotionThatIsNotKnown) {
  TracedImpacts traced(impact_oscillator(0.1, 0.5, 0.8, 1.2));
  const double from = 1.2 / two_pi;
  const PhaseFamily family = traced.family(from);
  const PhaseMotion first = impact_response(family.at(from)).motion;
  const auto words = [&](const PhaseMotion& motion, const ExactCurveOptions& options) {
    return testing::refusal([&] { exact_curve(family, motion, options); });
  };
  EXPECT_EQ(words(first, {.from = 0.25, .to = 0.25}), "exact_curve: from and to are the same");
  EXPECT_EQ(words({}, {.from = from, .to = 0.3}),
            "exact_curve: first has the status not_found; it must be a motion");
  EXPECT_EQ(exact_curve(family, first, {.from = 0.6, .to = 0.7}).start, PhasesStatus::not_found);
}

}  // namespace
}  // namespace wavebalance::solvers
