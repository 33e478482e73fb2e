#include "wavebalance/solvers/exact/exact_curve.hpp"

#include "support/collocation_cases.hpp"
#include "support/duffing_spring.hpp"
#include "support/refusal.hpp"
#include "testing.hpp"
#include "wavebalance/solvers/collocation/exact_near_response.hpp"
#include "wavebalance/solvers/response/forced_response.hpp"

namespace wavebalance::solvers {
namespace {

using testing::cosine_load, testing::distance, testing::LinearContact, testing::RandomCase,
    testing::uniform_times, testing::unit_oscillator;
using Type = SpecialPointType;

/// A structure against its contacts, whose curves start near a balance.
class Traced {
 public:
  Traced(const LinearStructure& structure, ContactLaws laws, double frequency)
      : structure_(structure),
        laws_(std::move(laws)),
        dynamics_(structure_),
        problem_(testing::fourier_pair(63, 256), structure_, cosine_load()) {
    problem_.set_frequency(frequency);
  }

  ExactCurve over_frequency(double from, double to, ExactCurveOptions options = {}) {
    problem_.set_frequency(from);
    return curve(SweepParameter::frequency, from, to, std::move(options));
  }
  ExactCurve over_load(double from, double to) {
    problem_.set_load_scale(from);
    return curve(SweepParameter::load_scale, from, to, {});
  }
  ProblemFamily family(SweepParameter parameter) const { return {problem_, laws_, dynamics_, parameter}; }
  ExactSolution first() {
    const PeriodicResponse response = forced_response(problem_, laws_, {});
    return exact_near_response(problem_, laws_, response, dynamics_).motion;
  }
  CondensedProblem& problem() { return problem_; }

 private:
  ExactCurve curve(SweepParameter parameter, double from, double to, ExactCurveOptions options) {
    options.from = from;
    options.to = to;
    return exact_curve(family(parameter), first(), options);
  }

  LinearStructure structure_;
  ContactLaws laws_;
  ContactDynamics dynamics_;
  CondensedProblem problem_;
};

std::vector<std::pair<Type, double>> listed(const ExactCurve& curve) {
  std::vector<std::pair<Type, double>> list;
  for (const ExactEvent& event : curve.events) list.emplace_back(event.type, event.value);
  return list;
}

void expect_list(const ExactCurve& curve, std::vector<std::pair<Type, double>> expected, double tolerance) {
  const auto found = listed(curve);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].first, expected[i].first) << to_string(found[i].first) << " " << found[i].second;
    EXPECT_NEAR(found[i].second, expected[i].second, tolerance * expected[i].second);
  }
}

/// Properties of every curve that runs through its interval.
void expect_curve(const ExactCurve& curve) {
  EXPECT_EQ(curve.status, SweepStatus::reached_end);
  int folds = 0;
  for (const ExactEvent& event : curve.events) {
    folds += event.type == Type::fold;
    if (event.type == Type::grazing) continue;
    EXPECT_NEAR(std::abs(event.multiplier), 1.0, 1e-8) << to_string(event.type) << " " << event.value;
    if (event.type == Type::fold || event.type == Type::branch) {
      EXPECT_NEAR(event.multiplier.real(), 1.0, 1e-8);
    } else if (event.type == Type::period_doubling) {
      EXPECT_NEAR(event.multiplier.real(), -1.0, 1e-8);
    }
  }
  EXPECT_EQ(folds % 2, 0);
}

TEST(ExactCurve, OfTheBarHasTheFoldsAndTheGrazingThatShootingHas) {
  const testing::Jl14Case& bar = testing::jl14_case_2;
  Traced traced(bar.structure(), bar.law, bar.frequency_hz);
  const ExactCurve curve = traced.over_frequency(1250.0, 1400.0);
  expect_curve(curve);
  // From shooting in another language, to its ten digits. The lower fold is 0.002 Hz from grazing.
  expect_list(curve, {{Type::fold, 1337.739426}, {Type::fold, 1315.015091}, {Type::grazing, 1315.017281}},
              1e-9);
}

TEST(ExactCurve, HasTheSameSpecialPointsFromEitherEnd) {
  for (const double stiffness : {4.0, 100.0}) {
    Traced traced(unit_oscillator(0.05, 0.15), LinearContact{stiffness, 1.0}, 0.1);
    const ExactCurve up = traced.over_frequency(0.1, 0.35), down = traced.over_frequency(0.35, 0.1);
    expect_curve(up);
    expect_curve(down);
    auto reversed = listed(down);
    std::reverse(reversed.begin(), reversed.end());
    EXPECT_GE(reversed.size(), 4u);
    expect_list(up, reversed, 1e-11);
  }
}

// Between the folds a multiplier lies outside the unit circle.
TEST(ExactCurve, CountsItsUnstableMultipliers) {
  Traced traced(unit_oscillator(0.05, 0.15), LinearContact{4.0, 1.0}, 0.1);
  const ExactCurve curve = traced.over_frequency(0.1, 0.35);
  int unstable = 0;
  for (const ExactPoint& point : curve.points) {
    if ((point.multipliers.array().abs() - 1.0).abs().minCoeff() < 1e-4) continue;
    EXPECT_EQ(point.motion.count_unstable(), point.unstable) << point.value;
    unstable += point.unstable;
  }
  EXPECT_GE(unstable, 3);
}

TEST(ExactCurve, EndsBehindItsStartWhereItTurns) {
  Traced traced(unit_oscillator(0.05, 0.15), LinearContact{4.0, 1.0}, 0.1);
  const ExactCurve whole = traced.over_frequency(0.1, 0.35);
  ExactCurveOptions options{.behind = 0.16};
  const ExactCurve part = traced.over_frequency(0.17, 0.19, options);
  ASSERT_FALSE(part.points.empty());
  EXPECT_NE(part.status, SweepStatus::lost);
  EXPECT_NEAR(part.points.back().value, part.status == SweepStatus::returned ? 0.16 : 0.19, 1e-9);
  EXPECT_THROW(traced.over_frequency(0.17, 0.19, {.behind = 0.18}), std::invalid_argument);
}

TEST(ExactCurve, GrazesOverTheLoadWhereTheFreeMotionReachesTheGap) {
  Traced traced(unit_oscillator(0.05, 0.15), LinearContact{4.0, 1.0}, 0.14);
  const double free = traced.problem().linear_response().maxCoeff();
  const ExactCurve curve = traced.over_load(0.5, 3.0);
  expect_curve(curve);
  ASSERT_GE(curve.events.size(), 1u);
  EXPECT_EQ(curve.events.front().type, Type::grazing);
  const double amplitude =
      0.15 / std::abs(std::complex<double>(1.0 - std::pow(two_pi * 0.14, 2), 0.05 * two_pi * 0.14));
  EXPECT_NEAR(curve.events.front().value, 1.0 / amplitude, 1e-12);
  EXPECT_GT(free, 0.9 * amplitude);  // of samples
}

TEST(ExactCurve, OfRandomStructuresConsistsOfMotionsThatCollocationFindsWithoutIt) {
  std::mt19937 generator(29);
  for (int trial = 0; trial < 12; ++trial) {
    const RandomCase random(generator, 1 + trial % 3);
    Traced traced(random.structure, random.laws, random.frequency);
    const ExactCurve curve = traced.over_frequency(0.7 * random.frequency, 1.4 * random.frequency);
    expect_curve(curve);
    const ProblemFamily family = traced.family(SweepParameter::frequency);
    for (std::size_t i = 3; i < curve.points.size(); i += 20) {
      const ExactPoint& point = curve.points[i];
      testing::expect_motion(point.motion, random.laws, 1e-7);
      const Eigen::MatrixXd own = point.motion.displacement(uniform_times(256));
      const ExactSolution alone = collocation_motion(family.at(point.value), own);
      ASSERT_TRUE(alone.converged()) << trial << ": " << point.value;
      EXPECT_LT(distance(alone.displacement(uniform_times(256)), own), 1e-8) << point.value;
    }
  }
}

TEST(ExactCurve, TurnsWithALawThatAlwaysActs) {
  Traced traced(unit_oscillator(0.02, 0.1), testing::DuffingSpring{.cubic = 0.1}, 0.05);
  const ExactCurve curve = traced.over_frequency(0.05, 0.4);
  expect_curve(curve);
  ASSERT_EQ(curve.events.size(), 2u);
  EXPECT_GT(curve.events[0].value, curve.events[1].value);
}

TEST(ExactCurve, TakesContactsThatGrazeTogether) {
  LinearStructure structure = unit_oscillator(0.05, 0.15);
  structure.contact_directions = Eigen::Vector2d(1.0, -1.0).sparseView();
  Traced traced(structure, LinearContact{4.0, 1.0}, 0.1);
  const ExactCurve curve = traced.over_frequency(0.1, 0.35);
  expect_curve(curve);
  int grazings = 0;
  for (const ExactEvent& event : curve.events) grazings += event.type == Type::grazing;
  EXPECT_EQ(grazings, 2);
}

TEST(ExactCurve, IsEndedByItsObserverAndByItsLimits) {
  Traced traced(unit_oscillator(0.05, 0.15), LinearContact{4.0, 1.0}, 0.1);
  ExactCurveOptions options;
  options.observer = [](const Progress& progress) { return progress.step < 5; };
  EXPECT_EQ(traced.over_frequency(0.1, 0.35, options).status, SweepStatus::cancelled);
  options.observer = {};
  options.max_points = 7;
  const ExactCurve few = traced.over_frequency(0.1, 0.35, options);
  EXPECT_EQ(few.status, SweepStatus::point_limit);
  EXPECT_EQ(few.points.size(), 7u);
  options.exact.tolerance = 1e-30;
  options.exact.max_operations = 1.0;  // which allow no finer panels
  Traced touching(unit_oscillator(0.05, 0.15), LinearContact{4.0, 1.0}, 0.155);
  const ExactCurve rough = touching.over_frequency(0.155, 0.35, options);
  ASSERT_EQ(rough.points.size(), 7u);
  EXPECT_EQ(rough.points.front().motion.status, ExactStatus::tolerance_missed);
}

TEST(ExactCurve, RefusesOptionsOutOfRangeAndAFirstMotionThatIsNotKnown) {
  Traced traced(unit_oscillator(0.05, 0.15), LinearContact{4.0, 1.0}, 0.1);
  const ProblemFamily family = traced.family(SweepParameter::frequency);
  EXPECT_THROW(exact_curve(family, ExactSolution(), {.from = 0.1, .to = 0.2}), std::invalid_argument);
  const ExactSolution first = traced.first();
  EXPECT_THROW(exact_curve(family, first, {.from = 0.1, .to = 0.1}), std::invalid_argument);
  EXPECT_THROW(exact_curve(family, first, {.from = -0.1, .to = 0.2}), std::invalid_argument);
  EXPECT_THROW(exact_curve(family, first, {.from = 0.1, .to = 0.2, .first_step = 0.0}),
               std::invalid_argument);
  EXPECT_THROW(exact_curve(family, first, {.from = 0.1, .to = 0.2, .max_points = 0}), std::invalid_argument);
}

}  // namespace
}  // namespace wavebalance::solvers
