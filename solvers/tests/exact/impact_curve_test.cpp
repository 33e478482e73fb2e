#include "wavebalance/solvers/exact/exact_curve.hpp"

#include "support/impact_scenes.hpp"
#include "support/refusal.hpp"
#include "support/small_problems.hpp"
#include "testing.hpp"
#include "wavebalance/solvers/impacts/impact_response.hpp"

namespace wavebalance::solvers {
namespace {

using testing::cosine_load, testing::impact_oscillator, testing::ImpactScene,
    testing::two_masses_with_impacts;

/// A structure with impacts, whose curves start at its attractor.
class TracedImpacts {
 public:
  explicit TracedImpacts(ImpactScene scene)
      : scene_(std::move(scene)),
        structure_(scene_.structure()),
        dynamics_(structure_),
        problem_(testing::fourier_pair(7, 32), structure_, cosine_load()) {}

  ProblemFamily family(double frequency) {
    problem_.set_frequency(frequency);
    return {problem_, scene_.laws(), dynamics_, SweepParameter::frequency};
  }
  /// Over the angular frequency.
  ExactCurve over_omega(double from, double to, ExactCurveOptions options = {}) {
    options.from = from / two_pi;
    options.to = to / two_pi;
    const ProblemFamily over = family(options.from);
    const ImpactResponse first = impact_response(over.at(options.from));
    return exact_curve(over, first.motion, options);
  }

 private:
  ImpactScene scene_;
  LinearStructure structure_;
  ContactDynamics dynamics_;
  CondensedProblem problem_;
};

TEST(ImpactCurveTest, PassesMotionsOfEachFrequency) {
  const ImpactScene scene = two_masses_with_impacts(0.3, 0.7, 0.8);
  TracedImpacts traced(scene);
  const ExactCurve curve = traced.over_omega(0.8, 2.0);
  EXPECT_GE(curve.points.size(), 10u);
  for (const ExactPoint& point : curve.points) {
    std::vector<ImpactGuess> start;
    for (const Impact& impact : point.motion.impacts)
      start.push_back({impact.contact, impact.time + 1e-6, impact.impulse * (1.0 + 1e-6)});
    const ProblemFamily family = traced.family(point.value);
    const int periods = static_cast<int>(std::lround(point.value / point.motion.frequency()));
    const ExactSolution motion = impact_motion(over_periods(family.at(point.value), periods), start);
    ASSERT_TRUE(motion.converged()) << to_string(motion.status);
    ASSERT_EQ(motion.impacts.size(), point.motion.impacts.size());
    for (std::size_t i = 0; i < motion.impacts.size(); ++i)
      EXPECT_NEAR(motion.impacts[i].impulse, point.motion.impacts[i].impulse, 1e-9);
  }
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
  const ProblemFamily family = traced.family(from);
  const ExactSolution first = impact_response(family.at(from)).motion;
  const auto words = [&](const ExactSolution& motion, const ExactCurveOptions& options) {
    return testing::refusal([&] { exact_curve(family, motion, options); });
  };
  EXPECT_EQ(words(first, {.from = 0.25, .to = 0.25}), "exact_curve: from and to are the same");
  EXPECT_EQ(words({}, {.from = from, .to = 0.3}),
            "exact_curve: first has the status not_found; it must be a motion");
  EXPECT_EQ(exact_curve(family, first, {.from = 0.6, .to = 0.7}).start, ExactStatus::not_found);
}

}  // namespace
}  // namespace wavebalance::solvers
