#include "wavebalance/solvers/impacts/impact_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "constants.hpp"
#include "impacts/impact_parts.hpp"
#include "linalg/multipliers.hpp"
#include "support/impact_table.hpp"
#include "support/refusal.hpp"

namespace wavebalance::solvers {
namespace {

using testing::ImpactScene, testing::impact_oscillator, testing::known_impacts, testing::KnownImpacts,
    testing::refusal;
using Complex = std::complex<double>;

// The first two digits of a table, from which Newton's method has its way to go.
std::vector<ImpactGuess> rough_start(const KnownImpacts& known) {
  std::vector<ImpactGuess> start;
  for (std::size_t i = 0; i < known.instants.size(); ++i)
    start.push_back({known.contacts[i], std::round(100.0 * known.instants[i]) / 100.0 / known.periods,
                     std::round(100.0 * known.impulses[i]) / 100.0});
  return start;
}

PhaseMotion motion_of_table(const KnownImpacts& known, const ContactDynamics& dynamics) {
  return impact_motion(over_periods(known.scene.problem(dynamics), known.periods), rough_start(known));
}

TEST(ImpactMotionTest, HasTheImpactsOfTheTable) {
  for (const KnownImpacts& known : known_impacts()) {
    const ContactDynamics dynamics(known.scene.structure());
    const PhaseMotion motion = motion_of_table(known, dynamics);
    ASSERT_EQ(motion.status, PhasesStatus::converged) << to_string(motion.status);
    ASSERT_EQ(motion.impacts.size(), known.instants.size());
    for (std::size_t i = 0; i < known.instants.size(); ++i) {
      EXPECT_NEAR(motion.impacts[i].time * known.periods, known.instants[i], 1e-9);
      EXPECT_NEAR(motion.impacts[i].velocity_before, known.velocities[i], 1e-9);
      EXPECT_NEAR(motion.impacts[i].impulse, known.impulses[i], 1e-9);
      EXPECT_EQ(motion.impacts[i].contact, known.contacts[i]);
    }
  }
}

TEST(ImpactMotionTest, HasTheMultipliersOfTheTable) {
  for (const KnownImpacts& known : known_impacts()) {
    const ContactDynamics dynamics(known.scene.structure());
    const Eigen::VectorXcd found = motion_of_table(known, dynamics).multipliers();
    for (const Complex expected : known.multipliers) {
      const double nearest = (found.array() - expected).abs().minCoeff();
      EXPECT_LE(nearest, 1e-8 * std::max(1.0, std::abs(expected)));
    }
  }
}

// One impact in n periods of an undamped oscillator, v before it [Shaw and Holmes 1983].
struct ClosedForm {
  double omega, restitution, periods, gap;

  double factor() const { return 1.0 / (1.0 - omega * omega); }
  double cosine() const {
    const double period = two_pi * periods / omega;
    return std::sin(period) * (1.0 + restitution) / (1.0 - std::cos(period));
  }
  double sine() const { return (1.0 - restitution) / omega; }
  double discriminant() const {
    const double g = factor(), c = cosine(), s = sine();
    return g * g * c * c - (gap * gap - g * g) * s * s;
  }
  double velocity(double sign) const {
    const double c = cosine(), s = sine();
    return (-2.0 * c * gap + sign * 2.0 * std::sqrt(discriminant())) / (c * c + s * s);
  }
};

TEST(ImpactMotionTest, HasTheClosedFormOfShawAndHolmes) {
  const std::vector<ClosedForm> cases = {{3.7, 0.8, 2, 0.0},  {2.8, 0.8, 1, 0.0}, {2.0, 0.8, 1, 0.1},
                                         {2.6, 0.6, 1, 0.05}, {1.5, 0.7, 1, 0.2}, {4.2, 0.9, 2, 0.02}};
  for (const ClosedForm& known : cases) {
    const ImpactScene scene = impact_oscillator(0.0, known.gap, known.restitution, known.omega);
    const ContactDynamics dynamics(scene.structure());
    const PhasesProblem problem = over_periods(scene.problem(dynamics), int(known.periods));
    const double upper = known.velocity(1.0), lower = known.velocity(-1.0);
    int found = 0;
    for (int k = 0; k < 24; ++k)
      for (const double impulse : {0.5, 2.0, 6.0}) {
        const PhaseMotion motion = impact_motion(problem, {{0, k / 24.0, impulse}});
        if (!motion.converged()) continue;
        ++found;
        const double v = motion.impacts[0].velocity_before;
        EXPECT_LE(std::min(std::abs(v - upper), std::abs(v - lower)), 1e-12 * std::max(1.0, v));
        const Eigen::VectorXcd multipliers = motion.multipliers();
        EXPECT_NEAR(std::abs(multipliers.prod()), known.restitution * known.restitution, 1e-11);
      }
    EXPECT_GT(found, 0) << known.omega;
  }
}

TEST(ImpactMotionTest, HasTheSettledMotionOfTheImpactOscillatorOfCoco) {
  // Recipes for Continuation, example 15.2: from rest on, restitution 0.8; eight digits of its motion.
  const ImpactScene scene = impact_oscillator(0.1, 1.0, 0.8, 1.0);
  const ContactDynamics dynamics(scene.structure());
  const PhaseMotion motion = impact_motion(scene.problem(dynamics), {{0, 0.076 / two_pi, 3.0}});
  ASSERT_TRUE(motion.converged());
  EXPECT_NEAR(two_pi * motion.impacts[0].time, 0.07595216, 1e-8);
  EXPECT_NEAR(motion.impacts[0].velocity_before, 1.69573294, 1e-8);
  EXPECT_NEAR(motion.impacts[0].velocity_after, -1.35658635, 1e-8);
  EXPECT_NEAR(motion.impacts[0].impulse, 3.05231929, 1e-8);
  EXPECT_EQ(detail::count_outside(motion.multipliers()), 0);
}

TEST(ImpactMotionTest, MovesAsItsImpactsSay) {
  for (const KnownImpacts& known : known_impacts()) {
    const ContactDynamics dynamics(known.scene.structure());
    const PhaseMotion motion = motion_of_table(known, dynamics);
    for (const Impact& impact : motion.impacts) {
      constexpr double shortly = 1e-9;
      const Eigen::VectorXd times =
          Eigen::Vector3d(impact.time - shortly, impact.time, impact.time + shortly);
      const Eigen::MatrixXd u = motion.displacement(times), v = motion.velocity(times);
      const double speed = 20.0 * shortly * std::max(1.0, impact.velocity_before) * known.periods;
      EXPECT_NEAR(u(impact.contact, 1), known.scene.gaps[impact.contact], 1e-13);
      EXPECT_NEAR(v(impact.contact, 0), impact.velocity_before, 20.0 * speed);
      EXPECT_NEAR(v(impact.contact, 1), impact.velocity_after, 1e-12);
      EXPECT_NEAR(v(impact.contact, 2), impact.velocity_after, 20.0 * speed);
      EXPECT_NEAR(impact.velocity_after, -known.scene.restitution * impact.velocity_before, 1e-15);
    }
    const Eigen::VectorXd all = Eigen::VectorXd::LinSpaced(2001, 0.0, 1.0);
    const Eigen::MatrixXd u = motion.displacement(all);
    EXPECT_LE((u.colwise() - known.scene.gaps).maxCoeff(), 1e-12);
  }
}

// int load velocity dt = int velocity C velocity dt + what impacts take, of an oscillator.
TEST(ImpactMotionTest, BalancesItsEnergy) {
  for (const KnownImpacts& known : known_impacts()) {
    if (known.scene.mass.rows() > 1) continue;
    const ContactDynamics dynamics(known.scene.structure());
    const PhaseMotion motion = motion_of_table(known, dynamics);
    const double period = known.periods / known.scene.frequency();
    double work = 0.0, damped = 0.0;
    constexpr int panels = 200;
    const double root = std::sqrt(0.6);
    for (std::size_t i = 0; i < motion.impacts.size(); ++i) {
      const double begin = motion.impacts[i].time;
      const double end =
          i + 1 < motion.impacts.size() ? motion.impacts[i + 1].time : motion.impacts[0].time + 1.0;
      const double length = (end - begin) / panels;
      for (int k = 0; k < panels; ++k)
        for (const auto& [place, weight] :
             {std::pair{-root, 5.0 / 18.0}, std::pair{0.0, 8.0 / 18.0}, std::pair{root, 5.0 / 18.0}}) {
          const double time = begin + length * (k + 0.5 + 0.5 * place);
          const double v = motion.velocity(Eigen::VectorXd::Constant(1, time))(0, 0);
          work += weight * length * period * std::cos(two_pi * known.periods * time) * v;
          damped += weight * length * period * known.scene.damping(0, 0) * v * v;
        }
    }
    EXPECT_NEAR(work, damped + motion.energy_lost(), 1e-10 * std::max(1.0, motion.energy_lost()));
  }
}

TEST(ImpactMotionTest, RefusesMotionsThatPassTheObstacleOrArePulled) {
  const ImpactScene scene = impact_oscillator(0.05, 0.0, 0.8, 3.7);
  const ContactDynamics dynamics(scene.structure());
  const PhasesProblem problem = scene.problem(dynamics);
  const PhaseMotion none = impact_motion(problem, {});
  EXPECT_EQ(none.status, PhasesStatus::penetrating);
  EXPECT_NEAR(detail::impact_solution(problem, {}).penetration, std::abs(problem.contact_free(0, 1)), 1e-12);
  int refused = 0;
  for (int k = 0; k < 40; ++k) {
    const PhaseMotion motion =
        impact_motion(over_periods(problem, 3), {{0, k / 40.0, 1.0}, {0, 0.5 + k / 40.0, 0.2}});
    if (motion.converged()) {
      const Eigen::MatrixXd u = motion.displacement(Eigen::VectorXd::LinSpaced(3001, 0.0, 1.0));
      EXPECT_LE(u.maxCoeff(), 1e-12);
    } else {
      ++refused;
    }
  }
  EXPECT_GT(refused, 0);
}

TEST(ImpactMotionTest, HasNoImpactsWhereTheMotionWithoutContactStaysBelowTheGap) {
  const ImpactScene scene = impact_oscillator(0.1, 10.5, 0.8, 1.0);
  const ContactDynamics dynamics(scene.structure());
  const PhaseMotion motion = impact_motion(scene.problem(dynamics), {});
  EXPECT_TRUE(motion.converged());
  const Eigen::VectorXcd multipliers = motion.multipliers();
  ASSERT_EQ(multipliers.size(), 2);
  EXPECT_NEAR(std::abs(multipliers.prod()), std::exp(-0.1 * two_pi), 1e-14);
}

TEST(ImpactMotionTest, NamesWhatIsWrongWithItsInput) {
  const ImpactScene scene = impact_oscillator(0.1, 1.0, 0.8, 1.0);
  const ContactDynamics dynamics(scene.structure());
  const PhasesProblem good = scene.problem(dynamics);
  const auto words = [&](double restitution, double gap, double frequency, int contact) {
    const PhasesProblem bad{dynamics, testing::Obstacle(gap, restitution), good.contact_free, frequency};
    return refusal([&] { impact_motion(bad, {{contact, 0.1, 1.0}}); });
  };
  EXPECT_EQ(words(1.5, 1.0, 1.0, 0), "impact_motion: restitution is 1.5; it must be in 0..1");
  EXPECT_EQ(words(-0.1, 1.0, 1.0, 0), "impact_motion: restitution is -0.1; it must be in 0..1");
  EXPECT_EQ(words(nan, 1.0, 1.0, 0), "impact_motion: restitution is nan; it must be in 0..1");
  EXPECT_EQ(words(0.8, infinity, 1.0, 0), "impact_motion: a gap is not finite; all must be");
  EXPECT_EQ(words(0.8, 1.0, 0.0, 0), "impact_motion: frequency is 0; it must be positive and finite");
  EXPECT_EQ(words(0.8, 1.0, 1.0, 3), "impact_motion: contact is 3; it must be a contact of the structure");
}

TEST(ImpactMotionTest, RefusesContactsWithoutMassAndStructuralDamping) {
  ImpactScene scene = testing::two_masses_with_impacts(0.3, 0.7, 1.6);
  scene.mass(0, 0) = 0.0;
  scene.damping.setZero();
  const ContactDynamics massless(scene.structure());
  EXPECT_EQ(
      refusal([&] { impact_motion(scene.problem(massless), {}); }),
      "impact_motion: contact 0 has no mass, so that an impact there has no impulse; it must have mass");
  LinearStructure structural = impact_oscillator(0.1, 1.0, 0.8, 1.0).structure();
  structural.loss_factor = 0.1;
  const ContactDynamics damped(structural);
  EXPECT_NE(refusal([&] {
              impact_motion(impact_oscillator(0.1, 1.0, 0.8, 1.0).problem(damped), {});
            }).find("structural damping"),
            std::string::npos);
}

}  // namespace
}  // namespace wavebalance::solvers
