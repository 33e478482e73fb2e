// Motions in time by events against event-driven integrations that share nothing with them.

#include "balance/free_contacts.hpp"
#include "linalg/index.hpp"
#include "support/friction_table.hpp"
#include "support/impact_scenes.hpp"
#include "support/small_problems.hpp"
#include "testing.hpp"
#include "wavebalance/contact/clearance_law.hpp"
#include "wavebalance/contact/linear_law.hpp"
#include "wavebalance/contact/rigid_law.hpp"
#include "wavebalance/solvers/flow/periodic_flow.hpp"

namespace wavebalance::solvers {
namespace {

using testing::FrictionRow;

/// A structure under its cosine load, with laws, and what its contacts need.
struct Vibrating {
  Vibrating(const LinearStructure& linear, ContactLaws laws, double frequency)
      : structure(linear), dynamics(structure), problem{dynamics, std::move(laws), {}, frequency} {
    Eigen::VectorXcd cosine = Eigen::VectorXcd::Zero(2);
    cosine[1] = 1.0;
    problem.linear_motion = detail::FreeContacts(structure, cosine, dynamics.holding()).at(frequency, 1.0);
  }
  FlowMotion motion(int points = 4096) const {
    TimeSteppingOptions options;
    options.output_points = points;
    options.period_tolerance = 1e-9;
    return integrate_by_events(problem, options);
  }

  LinearStructure structure;
  ContactDynamics dynamics;
  ExactProblem problem;
};

std::complex<double> first_harmonic(const Eigen::MatrixXd& displacement, Index row) {
  std::complex<double> sum = 0.0;
  const auto points = double(displacement.cols());
  for (Index k = 0; k < displacement.cols(); ++k)
    sum += displacement(row, k) * std::polar(2.0 / points, 2.0 * std::numbers::pi * double(k) / points);
  return sum;
}

// A slider, an elastic stop and a rigid one with a restitution of 0.7, each on one of three masses between
// springs.
Vibrating mixture(double omega) {
  const Eigen::Matrix3d stiffness{{2.0, -1.0, 0.0}, {-1.0, 2.0, -1.0}, {0.0, -1.0, 2.0}},
      unit = Eigen::Matrix3d::Identity();
  LinearStructure structure = testing::structure(unit, Eigen::Matrix3d(0.02 * stiffness + 0.02 * unit),
                                                 stiffness, Eigen::Vector3d(0.0, 1.0, 0.3), unit);
  return {structure,
          ContactLaws(std::vector<AnyContactLaw>{contact::CoulombLaw({1.0, 3.0, 0.4}),
                                                 contact::LinearLaw(4.0, 0.3), contact::RigidLaw(0.3, 0.7)}),
          omega / (2.0 * std::numbers::pi)};
}

TEST(ContactFlow, SettlesToTheExactMotionsOfFrictionAndTheirMultipliers) {
  constexpr double digits = 2e-9, harmonic = 2e-8;  // a harmonic of 4096 samples with kinks
  const std::vector<std::string> names{"Jenkins 5", "masses 4", "lift-off 3", "beam 2", "chain 2"};
  for (const FrictionRow& row : testing::friction_rows()) {
    if (std::find(names.begin(), names.end(), row.name) == names.end()) continue;
    const FlowMotion motion =
        Vibrating(row.scene.structure, row.scene.contact_laws(), row.scene.frequency()).motion();
    ASSERT_EQ(motion.stepping.status, TimeSteppingStatus::converged) << row.name;
    EXPECT_LT(motion.closed, 1e-11) << row.name;
    const auto found = first_harmonic(motion.stepping.contacts.displacement, row.compared);
    EXPECT_NEAR(std::abs(found), row.amplitude, harmonic * row.amplitude) << row.name;
    EXPECT_NEAR(std::abs(motion.multipliers[0]), row.largest, 10 * digits) << row.name;
    EXPECT_NEAR(std::abs(motion.multipliers[1]), row.second, 10 * digits) << row.name;
  }
}

// Instants by DOP853 with a tolerance of 1e-13 and events, after 150 periods.
TEST(ContactFlow, TakesLawsOfThreeKindsSideBySide) {
  const FlowMotion motion = mixture(1.3).motion(64);
  ASSERT_EQ(motion.stepping.status, TimeSteppingStatus::converged);
  constexpr std::array<double, 7> instants{0.08883868239, 0.26039026495, 0.30034908186, 0.48567138455,
                                           0.48770849867, 0.59455410218, 0.98189906715};
  constexpr std::array<int, 7> contacts{0, 1, 2, 1, 0, 0, 0};
  ASSERT_EQ(motion.events.size(), instants.size());
  for (std::size_t i = 0; i < instants.size(); ++i) {
    EXPECT_EQ(motion.events[i].contact, contacts[i]);
    EXPECT_NEAR(motion.events[i].time * 1.3 / (2.0 * std::numbers::pi), instants[i], 1e-9);
  }
  EXPECT_NEAR(motion.events[2].speed, 0.730811604448, 1e-9);
}

TEST(ContactFlow, TakesPerturbationsAlongAsDifferencesOfMotionsDo) {
  const Vibrating vibrating = mixture(1.05);
  ContactFlow flow(vibrating.problem);
  for (int n = 0; n < 200; ++n) ASSERT_EQ(flow.advance_period(), FlowStatus::converged);
  const Eigen::VectorXd state = flow.state();
  const std::vector<int> contacts = flow.contact_states();
  const Index size = state.size();
  flow.perturb(Eigen::MatrixXd::Identity(size, size));
  ASSERT_EQ(flow.advance_period(), FlowStatus::converged);
  const Eigen::MatrixXd map = flow.perturbation();
  flow.perturb(Eigen::MatrixXd(size, 0));
  const double step = 1e-6 * state.norm();
  for (Index i = 0; i < size; ++i) {
    Eigen::MatrixXd ends(size, 2);
    for (const int side : {0, 1}) {
      Eigen::VectorXd start = state;
      start[i] += side == 0 ? -step : step;
      flow.start(start, contacts);
      ASSERT_EQ(flow.advance_period(), FlowStatus::converged);
      ends.col(side) = flow.state();
    }
    EXPECT_LE(((ends.col(1) - ends.col(0)) / (2.0 * step) - map.col(i)).norm(), 1e-7 * map.norm());
  }
}

// Contact of 3e-3 of a radian, where points lie 2e-2 apart, wherever it lies among them.
TEST(ContactFlow, FindsATouchBetweenTwoOfItsPoints) {
  for (int k = 0; k < 24; ++k) {
    const testing::ImpactScene scene = testing::impact_oscillator(0.2, 0.0, 1.0, 1.2 + 0.02 * k);
    const double amplitude = std::abs(scene.free_amplitudes()[0]), depth = 1e-6 * amplitude;
    const FlowMotion motion =
        Vibrating(scene.structure(), contact::LinearLaw(1.0, amplitude - depth), scene.frequency())
            .motion(64);
    ASSERT_EQ(motion.stepping.status, TimeSteppingStatus::converged);
    ASSERT_EQ(motion.events.size(), 2u) << k;
    const double contact = std::abs(motion.events[1].time - motion.events[0].time) * scene.omega;
    EXPECT_NEAR(contact, 2.0 * std::sqrt(2e-6), 1e-5);
  }
}

// A ball in a sphere: a law of the user of three rows.
struct Sphere {
  static int rows() { return 3; }
  static double gap() { return 1.0; }
  double penetration(std::span<const double> u, std::span<double> slopes) const {
    double squared = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      squared += u[i] * u[i];
      slopes[i] = u[i];
    }
    return 0.5 * (squared - 1.0);
  }
  void closed(std::span<const double> u, std::span<double> force, std::span<double> slopes) const {
    const double r = std::hypot(u[0], u[1], u[2]);
    for (std::size_t i = 0; i < 3; ++i) {
      force[i] = stiffness * (1.0 - 1.0 / r) * u[i];
      for (std::size_t j = 0; j < 3; ++j)
        slopes[3 * i + j] = stiffness * ((i == j ? 1.0 - 1.0 / r : 0.0) + u[i] * u[j] / (r * r * r));
    }
  }
  double potential(std::span<const double> u) const {
    return 0.5 * stiffness * std::pow(std::max(0.0, std::hypot(u[0], u[1], u[2]) - 1.0), 2);
  }

  double stiffness;
};

// Along one line it is a stop on either side, in whichever direction the line points.
TEST(ContactFlow, TakesALawOfThreeRowsAsAStopAlongALine) {
  constexpr double frequency = 0.15, load = 0.9;
  const auto of = [&](int rows, ContactLaws laws) {
    const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(rows, rows);
    const Eigen::VectorXd along = Eigen::VectorXd::Constant(rows, load / std::sqrt(double(rows)));
    return Vibrating(testing::structure(unit, 0.1 * unit, unit, along, unit), std::move(laws), frequency)
        .motion(64);
  };
  const FlowMotion ball = of(3, Sphere{5.0}), line = of(1, contact::ClearanceLaw(5.0, 1.0));
  ASSERT_EQ(ball.stepping.status, TimeSteppingStatus::converged);
  ASSERT_EQ(ball.events.size(), 4u);
  for (Index row = 0; row < 3; ++row)
    EXPECT_LE((std::sqrt(3.0) * ball.stepping.contacts.displacement.row(row) -
               line.stepping.contacts.displacement.row(0))
                  .norm(),
              1e-8);
}

// A ball that is pressed to the stop bounces with 0.5 until it rests, and leaves where the load pulls.
TEST(ContactFlow, ComesToRestAfterFinitelyManyImpacts) {
  testing::ImpactScene scene = testing::impact_oscillator(0.1, 0.2, 0.5, 0.2);
  const FlowMotion motion =
      Vibrating(scene.structure(), contact::RigidLaw(0.2, 0.5), scene.frequency()).motion(256);
  ASSERT_EQ(motion.stepping.status, TimeSteppingStatus::converged);
  EXPECT_EQ(motion.rests, 1);
  const auto rest =
      std::find_if(motion.events.begin(), motion.events.end(), [](auto& e) { return e.to == 1; });
  ASSERT_NE(rest, motion.events.end());
  EXPECT_GT(rest - motion.events.begin(), 10);
  EXPECT_LE(motion.stepping.contacts.displacement.maxCoeff(), 0.2 + 1e-12);
}

}  // namespace
}  // namespace wavebalance::solvers
