// Exact motions by the map of the flow against event-driven integrations and the equations of phases.
#include "wavebalance/solvers/flow/exact_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>

#include "campaign.hpp"
#include "support/friction_motions.hpp"
#include "support/friction_table.hpp"
#include "support/oracle_check.hpp"
#include "support/phase_cases.hpp"
#include "support/random_friction.hpp"

namespace wavebalance::solvers {
namespace {

using testing::FrictionMotion, testing::FrictionOracle, testing::FrictionRow, testing::FrictionScene;

double work_of(const PhaseMotion& motion) {
  double work = 0.0;
  for (const FrictionCycle& cycle : friction_cycles(motion)) work += cycle.work;
  return work;
}

TEST(ExactMotion, HaveTheHarmonicTheWorkAndTheMultipliersOfExactMotions) {
  constexpr int points = 16384;
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(points, 0.0, 1.0 - 1.0 / points);
  for (const FrictionRow& row : testing::friction_rows()) {
    const bool in_plane = row.scene.laws.front().tangents() > 1;
    const PhaseMotion motion =
        FrictionMotion(row.scene, {.tolerance = 1e-10}, 63, in_plane ? 512 : 1024).phases.motion;
    ASSERT_EQ(to_string(motion.status), "converged") << row.name;
    EXPECT_LE(motion.unknowns, 400) << row.name;
    const double digits = in_plane ? 1e-8 : 1e-9;
    const Eigen::VectorXd samples = motion.displacement(times).row(row.compared);
    EXPECT_LE(std::abs(testing::first_harmonic(samples) - exact_of(row)), digits * row.amplitude) << row.name;
    EXPECT_NEAR(work_of(motion), row.work, digits * row.work) << row.name;
    EXPECT_EQ(motion.count_unstable(), 0) << row.name;
    if (row.largest == 0.0) continue;  // not known
    const Eigen::VectorXcd multipliers = motion.multipliers();
    // The last digit of the beams' rows is that of matrix exponentials with fast poles.
    const double allowed = row.name.starts_with("beam") ? 2e-8 : 1e-8;
    EXPECT_NEAR(std::abs(multipliers[0]), row.largest, allowed) << row.name;
    EXPECT_NEAR(std::abs(multipliers[1]), row.second, allowed) << row.name;
  }
}

TEST(ExactMotion, BeginAndEndAtTheInstantsOfTheExactMotion) {
  const PhaseMotion motion = FrictionMotion(testing::lift_off(2.0, 2.0, 0.6, 0.5, 3.0)).phases.motion;
  ASSERT_TRUE(motion.converged());
  ASSERT_EQ(motion.friction.size(), 1u);
  const std::vector<FrictionPart>& parts = motion.friction[0].parts;
  ASSERT_EQ(parts.size(), 3u);
  using State = FrictionPart::State;
  const State states[] = {State::slip, State::open, State::stick};
  const double begins[] = {0.280840393, 0.299434949, 0.951154093};
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(parts[std::size_t(i)].state, states[i]);
    EXPECT_NEAR(parts[std::size_t(i)].begin, begins[i], 1e-9);
  }
  EXPECT_EQ(parts[0].sign, -1.0);
  const std::vector<FrictionCycle> cycles = friction_cycles(motion);
  ASSERT_EQ(cycles.size(), 1u);
  EXPECT_NEAR(cycles[0].stick_share, 0.3296863, 1e-8);
  EXPECT_NEAR(cycles[0].slip_share, 0.018594557, 1e-8);
  EXPECT_NEAR(cycles[0].open_share, 0.651719143, 1e-8);
}

// Forces over the period by the law's own samples, which are of second order.
TEST(ExactMotion, HaveTheForcesOfTheLawAlongThem) {
  constexpr int points = 1 << 15;
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(points, 0.0, 1.0 - 1.0 / points);
  for (const FrictionScene& scene :
       {testing::lift_off(1.0, 1.0, 0.6, 0.5, 2.4), testing::chain_of_three(3.0, 0.85)}) {
    const PhaseMotion motion = FrictionMotion(scene).phases.motion;
    ASSERT_TRUE(motion.converged());
    const Eigen::MatrixXd force = motion.force(times);
    EXPECT_LE((scene.contact_laws().force(motion.displacement(times)) - force).norm(), 1e-7 * force.norm());
  }
}

// Where R_0 > 0 the velocity jumps as slip begins.
TEST(ExactMotion, HaveTheForcesOfTheLawAtContactsWithoutMass) {
  constexpr int points = 1 << 15;
  FrictionScene scene{testing::with_massless_contacts(), {}, 8.0};
  scene.laws = {contact::CoulombLaw({0.5, 200.0, 0.4}), contact::CoulombLaw({0.5, 300.0, 0.2})};
  const FrictionMotion found(scene);
  ASSERT_TRUE(found.response.converged());
  const PhaseMotion& motion = found.phases.motion;
  ASSERT_EQ(to_string(motion.status), "converged");
  for (const FrictionCycle& cycle : friction_cycles(motion)) EXPECT_GT(cycle.slip_share, 0.0);
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(points, 0.0, 1.0 - 1.0 / points);
  const Eigen::MatrixXd force = motion.force(times);
  EXPECT_LE((scene.contact_laws().force(motion.displacement(times)) - force).norm(), 1e-6 * force.norm());
  EXPECT_EQ(motion.count_unstable(), 0);
}

TEST(ExactMotion, TheEstimatedErrorIsAboveTheError) {
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(512, 0.0, 1.0 - 1.0 / 512);
  for (const FrictionRow& row : testing::friction_rows()) {
    if (row.scene.laws.front().tangents() > 1) continue;
    const PhaseMotion exact = FrictionMotion(row.scene, {.tolerance = 1e-10, .nodes = 16}).phases.motion;
    for (const double tolerance : {1e-3, 1e-5, 1e-7}) {
      const PhaseMotion motion =
          FrictionMotion(row.scene, {.tolerance = tolerance, .nodes = 4}).phases.motion;
      ASSERT_EQ(to_string(motion.status), "converged") << row.name;
      EXPECT_LE(motion.estimated_error, tolerance);
      const Eigen::MatrixXd u = exact.displacement(times);
      EXPECT_LE((motion.displacement(times) - u).norm() / u.norm(), motion.estimated_error + 1e-10)
          << row.name << ' ' << tolerance;
    }
  }
}

// The response of the structure with the spring of a contact that never slips.
TEST(ExactMotion, OfAContactThatSticksAlwaysIsTheMotionWithItsSpring) {
  const FrictionScene scene = testing::rubbing_masses(1.0, 2.0, 100.0, 1.1);
  const FrictionMotion found(scene);
  ASSERT_TRUE(found.phases.motion.converged());
  const Eigen::Matrix2cd stiffness =
      Eigen::Matrix2cd(Eigen::MatrixXd(scene.structure.stiffness)) +
      std::complex<double>(0.0, scene.omega) * Eigen::MatrixXd(scene.structure.damping) -
      scene.omega * scene.omega * Eigen::Matrix2d::Identity() + Eigen::Matrix2d{{2.0, 0.0}, {0.0, 0.0}};
  const Eigen::Vector2cd exact = stiffness.inverse() * Eigen::Vector2cd(0.0, 1.0);
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(64, 0.0, 1.0 - 1.0 / 64);
  const Eigen::VectorXd samples = found.phases.motion.displacement(times).row(0);
  EXPECT_LE(std::abs(testing::first_harmonic(samples) - std::conj(exact[0])), 1e-11 * std::abs(exact[0]));
  EXPECT_TRUE(found.phases.motion.friction[0].always_sticks());
  EXPECT_LE(std::abs(found.phases.motion.multipliers()[0]), 1.0);
}

// Slip begins exactly at the load (L / k_t) |1 + k_t - omega^2 + i c omega|.
TEST(ExactMotion, SlipJustAboveTheLoadAtWhichItBegins) {
  constexpr double first_slip = 1.7976408151;  // at omega = 0.45
  const PhaseMotion stuck =
      FrictionMotion(testing::slider_on_oscillator(0.9999 * first_slip, 1.0, 0.45)).phases.motion;
  ASSERT_TRUE(stuck.converged());
  EXPECT_TRUE(stuck.friction[0].always_sticks());
  for (const double above : {1e-2, 1e-3, 1e-4}) {
    const PhaseMotion slips =
        FrictionMotion(testing::slider_on_oscillator((1.0 + above) * first_slip, 1.0, 0.45)).phases.motion;
    ASSERT_EQ(to_string(slips.status), "converged") << above;
    EXPECT_EQ(slips.friction[0].parts.size(), 4u) << above;
    EXPECT_GT(work_of(slips), 0.0);
    EXPECT_LE(work_of(slips), 10.0 * above);
  }
}

TEST(ExactMotion, OfOneCoefficientOfZeroAreThoseWithoutFriction) {
  FrictionScene scene = testing::lift_off(2.0, 2.0, 0.6, 0.5, 3.0);
  scene.laws = {contact::CoulombLaw({0.0, 5.0, 0.6}, contact::LinearLaw(21.0, 0.0))};
  const FrictionMotion found(scene);
  ASSERT_EQ(to_string(found.phases.motion.status), "converged");
  const ContactLaws apart(std::vector<AnyContactLaw>{contact::LinearLaw(21.0, -0.6 / 21.0), AnyContactLaw()});
  const PhaseMotion exact =
      contact_phases(phases_problem(found.problem, apart, found.dynamics),
                     found.phases.motion.displacement(Eigen::VectorXd::LinSpaced(256, 0.0, 255.0 / 256)));
  ASSERT_TRUE(exact.converged());
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(128, 0.0, 127.0 / 128);
  const Eigen::MatrixXd u = exact.displacement(times);
  EXPECT_LE((found.phases.motion.displacement(times) - u).norm(), 1e-9 * u.norm());
}

TEST(ExactMotion, ComeBackAfterAPeriodOfTheEventDrivenMotionWithItsMultipliers) {
  for (const FrictionRow& row : testing::friction_rows()) {
    // The exponentials of the beam, whose fastest pole decays within 1e-6 of the period, lose digits.
    if (row.scene.laws.front().tangents() > 1 || row.name.starts_with("beam")) continue;
    FrictionMotion found(row.scene);
    ASSERT_EQ(to_string(found.phases.motion.status), "converged") << row.name;
    const testing::OracleCheck checked = testing::check(found.scene, found.problem, found.phases.motion);
    EXPECT_LE(checked.change, 1e-10) << row.name;
    EXPECT_LE(checked.multipliers, 1e-10) << row.name;
  }
}

// The equations of phases share the poles with the flow, and no equation. Every other stop has a dashpot,
// does not pull, or both.
TEST(ExactMotion, OfElasticContactAreThoseOfThePhasesWithTheirMultipliers) {
  std::mt19937 generator(11);
  int found = 0;
  for (int trial = 0; trial < 12; ++trial) {
    testing::RandomCase random(generator, 1 + trial % 4);
    if (trial % 3 > 0) {
      std::vector<AnyContactLaw> damped;
      for (int c = 0; c < random.structure.contacts(); ++c) {
        const double gap = random.laws[c].gap(), stiffness = random.laws[c].tangent(2.0 * gap),
                     dashpot = 0.02 * stiffness / random.frequency;
        if (trial % 3 == 1)
          damped.emplace_back(testing::DampedStop{stiffness, dashpot, gap});
        else
          damped.emplace_back(testing::PushingStop{stiffness, dashpot, gap});
      }
      random.laws = ContactLaws(std::move(damped));
    }
    CondensedProblem problem(testing::fourier_pair(127, 512), random.structure, testing::cosine_load());
    problem.set_frequency(random.frequency);
    const ContactDynamics dynamics(random.structure);
    const PeriodicResponse response = forced_response(problem, random.laws, {});
    const PhaseMotion phases =
        response_phases(problem, random.laws, response, dynamics, {.tolerance = 1e-11}).motion;
    if (!phases.converged() || phases.phases.empty()) continue;
    ++found;
    const PhaseMotion motion =
        response_phases(problem, random.laws, response, dynamics, {.tolerance = 1e-10}, flow_motion).motion;
    ASSERT_EQ(to_string(motion.status), "converged") << trial;
    const Eigen::VectorXd times = testing::uniform_times(256);
    EXPECT_LE(testing::distance(motion.displacement(times), phases.displacement(times)), 1e-9) << trial;
    testing::expect_same(motion.multipliers(), phases.multipliers(), 1e-7);
    EXPECT_EQ(contact_stiffness(motion).status, StabilityStatus::unsupported_law);
    ASSERT_EQ(motion.phases.size(), phases.phases.size()) << trial;
    for (std::size_t i = 0; i < phases.phases.size(); ++i) {
      EXPECT_EQ(motion.phases[i].contact, phases.phases[i].contact);
      EXPECT_EQ(motion.phases[i].piece, phases.phases[i].piece);
      EXPECT_NEAR(motion.phases[i].begin, phases.phases[i].begin, 1e-8);
      EXPECT_NEAR(motion.phases[i].end, phases.phases[i].end, 1e-8);
    }
  }
  EXPECT_GE(found, 8);
}

TEST(ExactMotion, AreRefusedWithTheReason) {
  using enum PhasesStatus;
  const FrictionScene plane = testing::slip_in_a_plane(0.4, 1.1);
  const FrictionMotion elastic(plane, {}, 15, 64);
  const double rigid = std::numeric_limits<double>::infinity();
  const ContactLaws laws(std::vector<AnyContactLaw>{contact::CoulombLaw({1.0, rigid, 0.4, 2})});
  EXPECT_EQ(flow_motion(phases_problem(elastic.problem, laws, elastic.dynamics), Eigen::MatrixXd::Ones(2, 64),
                        {}, Eigen::MatrixXd::Zero(2, 64))
                .status,
            slip_in_a_plane);
  const FrictionScene chain = testing::chain_of_three(3.0, 0.85);
  FrictionScene loss = chain;
  loss.structure.loss_factor = 0.01;
  EXPECT_EQ(FrictionMotion(loss, {}, 15, 64).phases.motion.status, structural_damping);
  EXPECT_EQ(FrictionMotion(chain, {.max_operations = 1.0}, 15, 64).phases.motion.status, too_many_phases);
  EXPECT_EQ(
      FrictionMotion(chain, {.observer = [](const Progress&) { return false; }}, 15, 64).phases.motion.status,
      cancelled);
}

// Phases of too few nodes miss the tolerance, so that the flow is tried, too.
TEST(ExactMotion, IsCancelledWhereTheSecondSearchIs) {
  std::mt19937 generator(11);
  const testing::RandomCase random(generator, 1);
  CondensedProblem problem(testing::fourier_pair(127, 512), random.structure, testing::cosine_load());
  problem.set_frequency(random.frequency);
  const ContactDynamics dynamics(random.structure);
  const PeriodicResponse response = forced_response(problem, random.laws, {});
  ContactPhasesOptions options{.tolerance = 1e-12, .nodes = 6, .max_nodes = 6, .max_panels = 1};
  const auto status = [&] {
    return response_phases(problem, random.laws, response, dynamics, options, exact_motion).motion.status;
  };
  EXPECT_EQ(to_string(status()), "converged");
  options.observer = [](const Progress& progress) { return progress.phase != "exact motion"; };
  EXPECT_EQ(to_string(status()), "cancelled");
}

TEST(ExactMotion, BadInputIsRefusedByName) {
  const FrictionScene chain = testing::chain_of_three(3.0, 0.85);
  const FrictionMotion found(chain, {}, 15, 64);
  const PhasesProblem problem = phases_problem(found.problem, chain.contact_laws(), found.dynamics);
  const Eigen::MatrixXd start = Eigen::MatrixXd::Ones(2, 64);
  EXPECT_THROW(flow_motion(problem, Eigen::MatrixXd::Ones(1, 64)), std::invalid_argument);
  EXPECT_THROW(flow_motion(problem, Eigen::MatrixXd::Ones(2, 7)), std::invalid_argument);
  EXPECT_THROW(flow_motion(problem, std::nan("") * start), std::invalid_argument);
  EXPECT_THROW(flow_motion(problem, start, {.tolerance = 0.0}), std::invalid_argument);
  EXPECT_THROW(contact_phases(problem, start), std::invalid_argument);
  EXPECT_THROW(friction_cycles(PhaseMotion()), std::invalid_argument);
}

struct Campaign {
  int balances = 0, converged = 0, stuck = 0, wrong = 0;
  double worst = 0.0, worst_multiplier = 0.0;

  void add(int seed, const FrictionScene& scene) {
    FrictionMotion found(scene);
    if (!found.response.converged()) return;
    ++balances;
    const PhaseMotion& motion = found.phases.motion;
    if (!motion.converged())
      std::printf("%d %s error %.1e\n", seed, to_string(motion.status).data(), motion.estimated_error);
    if (!motion.converged()) return;
    ++converged;
    const bool sticks = std::any_of(motion.friction.begin(), motion.friction.end(),
                                    [](const FrictionAlong& one) { return one.always_sticks(); });
    stuck += sticks ? 1 : 0;
    const testing::OracleCheck checked = testing::check(found.scene, found.problem, found.phases.motion);
    worst = std::max(worst, checked.change);
    if (!sticks) worst_multiplier = std::max(worst_multiplier, checked.multipliers);
    if (!(checked.change < 1e-9) || (!sticks && !(checked.multipliers < 1e-8))) {
      ++wrong;
      std::printf("%d change %.1e multipliers %.1e\n", seed, checked.change, checked.multipliers);
    }
  }

  void expect(double share) const {
    std::printf(
        "%d balances, %d exact motions, %d of them with contacts that stick always, worst %.1e, multipliers %.1e\n",
        balances, converged, stuck, worst, worst_multiplier);
    EXPECT_EQ(wrong, 0);
    EXPECT_GE(converged, share * balances);
  }
};

TEST(RandomExactMotions, OfFrictionComeBackAfterAPeriodOfTheEventDrivenMotion) {
  Campaign campaign;
  for (int seed = 1; seed <= campaign_seeds(10, 300); ++seed) {
    std::mt19937 generator(static_cast<unsigned>(seed));
    campaign.add(seed, testing::random_friction_scene(generator));
  }
  campaign.expect(0.98);
}

TEST(RandomExactMotions, OfFrictionBesideStopsComeBackAfterAPeriodOfTheEventDrivenMotion) {
  Campaign campaign;
  for (int seed = 1; seed <= campaign_seeds(10, 300); ++seed) {
    std::mt19937 generator(static_cast<unsigned>(seed));
    campaign.add(seed, testing::random_mixture(generator));
  }
  campaign.expect(0.98);
}

}  // namespace
}  // namespace wavebalance::solvers
