// Contacts along any directions: other coordinates change nothing, and one direction may have obstacles on
// both sides.

#include "dense_algebra.hpp"
#include "ll10_rod.hpp"
#include "support/condensation_cases.hpp"
#include "support/oscillator.hpp"
#include "support/small_problems.hpp"
#include "support/solved.hpp"
#include "testing.hpp"
#include "wavebalance/solvers/balance/contact_form.hpp"
#include "wavebalance/solvers/modes/nonlinear_mode.hpp"
#include "wavebalance/solvers/period/attractor_integration.hpp"
#include "wavebalance/solvers/response/response_motion.hpp"

namespace wavebalance::solvers {
namespace {

using testing::LinearContact;

constexpr double driven = 0.11;  // Hz, near the first resonance

// A chain of which two masses may touch each other, the last one an obstacle, and of which a weighted sum is
// limited on the negative side.
LinearStructure touching_chain() {
  std::mt19937 generator(21);
  LinearStructure chain = testing::random_chain(6, generator);
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(3, 6);
  rows(0, 4) = 1.0;
  rows(0, 1) = -1.0;
  rows(1, 5) = 1.0;
  rows.row(2) << -0.3, 0.0, -0.5, 0.2, 0.0, -0.4;
  chain.contact_directions = rows.sparseView();
  return chain;
}

// Stops at half of the motion that each contact has without them.
std::vector<AnyContactLaw> stops(CondensedProblem& problem) {
  std::vector<AnyContactLaw> laws;
  for (int c = 0; c < problem.contacts(); ++c) {
    const auto free = problem.linear_response().segment(c * problem.points(), problem.points());
    laws.emplace_back(LinearContact{1.0 + c, 0.5 * free.maxCoeff()});
  }
  return laws;
}

bool every_contact_presses(const Eigen::MatrixXd& force) {
  return (force.rowwise().maxCoeff().array() > 0.0).all();
}

Eigen::MatrixXd rotation(int size, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  const Eigen::MatrixXd random = Eigen::MatrixXd::NullaryExpr(size, size, [&] { return normal(generator); });
  return oracle::orthonormal_factor(random);
}

// A rotation, and a rotation of coordinates in other units.
std::vector<Eigen::MatrixXd> turns(int size) {
  return {rotation(size, 1),
          rotation(size, 2) * Eigen::VectorXd::LinSpaced(size, 0.5, 2.0).asDiagonal() * rotation(size, 3)};
}

double distance(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) { return (a - b).norm() / b.norm(); }

TEST(TurnedCoordinates, ChangeNoResponse) {
  const LinearStructure chain = touching_chain();
  for (const Eigen::MatrixXd& turn : turns(6))
    for (const TimePair& pair : testing::pair_kinds(16, 64)) {
      CondensedProblem problem(pair, chain, testing::cosine_load()),
          other(pair, testing::turned(chain, turn), testing::cosine_load());
      problem.set_frequency(driven);
      other.set_frequency(driven);
      const auto laws = stops(problem);
      const PeriodicResponse a = testing::solved_response(problem, laws),
                             b = testing::solved_response(other, laws);
      EXPECT_TRUE(every_contact_presses(by_contact(a.contact_force, 3)));
      EXPECT_LE(distance(b.displacement, a.displacement), 1e-9);
      EXPECT_LE(distance(b.contact_force, a.contact_force), 1e-8);
      const Motion whole = structure_motion(problem, a, 64), turned = structure_motion(other, b, 64);
      EXPECT_LE(distance(turn * turned.displacement, whole.displacement), 1e-9);
      EXPECT_LE(distance(chain.contact_directions * whole.displacement,
                         contact_motion(problem, a, laws, 64).displacement),
                1e-9);
      EXPECT_LE(distance(system_energy(other.structure(), laws, turned), system_energy(chain, laws, whole)),
                1e-9);
    }
}

// Two masses between obstacles for their relative motion.
LinearStructure between_obstacles(bool both) {
  std::mt19937 generator(22);
  LinearStructure chain = testing::random_chain(4, generator);
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(both ? 2 : 1, 4);
  rows.row(0) << 0.0, -1.0, 0.0, 1.0;
  if (both) rows.row(1) = -rows.row(0);
  chain.contact_directions = rows.sparseView();
  return chain;
}

// At the same time in contact: obstacles that press from both sides add up their stiffness.
TEST(ObstaclesOnBothSides, MayPressAtTheSameTime) {
  const LinearStructure chain = between_obstacles(true);
  LinearStructure stiffer = chain;
  const Eigen::MatrixXd rows(chain.contact_directions);
  stiffer.stiffness = (Eigen::MatrixXd(chain.stiffness) + 0.7 * rows.transpose() * rows).sparseView();
  CondensedProblem problem(testing::fourier_pair(15, 64), chain, testing::cosine_load()),
      linear(testing::fourier_pair(15, 64), stiffer, testing::cosine_load());
  problem.set_frequency(driven);
  linear.set_frequency(driven);
  const double preload = -2.0 * linear.linear_response().maxCoeff();
  for (const ContactForm form : {ContactForm::displacement, ContactForm::force}) {
    ForcedResponseOptions solver;
    solver.form = form;
    const PeriodicResponse response = testing::solved_response(problem, LinearContact{0.7, preload}, solver);
    EXPECT_GT(response.contact_force.minCoeff(), 0.0);
    EXPECT_LE(distance(response.displacement, linear.linear_response()), 1e-9) << to_string(form);
  }
}

// The rod between two rigid obstacles at equal gaps: the motion is symmetric, and stiffer than with one.
TEST(ObstaclesOnBothSides, HoldInNonlinearModes) {
  const testing::UnitRod rod(20);
  ModalModel both = rod.model;
  both.contact_shapes.resize(2, rod.model.modes());
  both.contact_shapes << rod.model.contact_shapes, -rod.model.contact_shapes;
  both.gaps = rod.model.gaps.replicate(2, 1);
  const NonlinearModeOptions options{.harmonics = 5, .samples = 20, .cosine_only = true};
  const NonlinearMode one_side(rod.model, options), two_sides(both, options);
  const double omega = 1.1 * two_sides.linear_omega();
  const ModePoint one = one_side.at_frequency_by_harmonic_continuation(omega),
                  two = two_sides.at_frequency_by_harmonic_continuation(omega);
  ASSERT_EQ(one.status, ModeStatus::converged);
  ASSERT_EQ(two.status, ModeStatus::converged) << to_string(two.status);
  EXPECT_LE(two.max_penetration, 1e-9);
  EXPECT_GE(two.min_force, 0.0);
  EXPECT_LT(two.energy_ratio, one.energy_ratio);
  EXPECT_GT(two.force.row(0).maxCoeff(), 0.0);
  for (int k = 0; k < 20; ++k)
    EXPECT_NEAR(two.force(1, k), two.force(0, (k + 10) % 20), 1e-8 * two.force.maxCoeff()) << k;
}

}  // namespace
}  // namespace wavebalance::solvers
