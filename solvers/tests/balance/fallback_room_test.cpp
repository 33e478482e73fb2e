// A limit of operations, which no scene has as a key, leaves the fallbacks of Newton's method room.

#include <cstddef>

#include "support/friction_scenes.hpp"
#include "support/small_problems.hpp"
#include "support/solved.hpp"
#include "testing.hpp"

namespace wavebalance::solvers {
namespace {

using testing::FrictionScene;

// Unit masses that move along x and y between springs, each pressed against an obstacle along y on which it
// rubs along x; the last one is driven along both, with a phase.
FrictionScene random_chain_that_rubs(std::mt19937& generator) {
  std::uniform_real_distribution<double> any(0.0, 1.0);
  const int masses = 1 + int(10 * any(generator)), size = 2 * masses;
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(size, size);
  for (int i = 0; i < masses; ++i) {
    for (int d = 0; d < 2; ++d) {
      const int a = 2 * i + d, b = a + 2;
      stiffness(a, a) += 0.5 + 0.5 * any(generator);
      if (i + 1 == masses) continue;
      stiffness(a, a) += 2.0;
      stiffness(b, b) += 2.0;
      stiffness(a, b) = stiffness(b, a) = -2.0;
    }
    const double coupling = 0.3 * (any(generator) - 0.5);
    stiffness(2 * i, 2 * i + 1) += coupling;
    stiffness(2 * i + 1, 2 * i) += coupling;
  }
  const Eigen::MatrixXd damping = 0.05 * stiffness + 0.02 * Eigen::MatrixXd::Identity(size, size);
  const double mu = 0.2 + 0.6 * any(generator), normal_load = 0.5 * any(generator);
  const double normal = std::pow(10.0, 0.5 + 1.5 * any(generator));
  const double tangential = std::pow(10.0, 0.3 + 1.7 * any(generator));
  const contact::CoulombLaw law({mu, tangential, normal_load}, contact::LinearLaw(normal, 0.0));
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(size, size);
  for (int i = 0; i < masses; ++i) rows(2 * i, 2 * i + 1) = rows(2 * i + 1, 2 * i) = 1.0;
  const double amplitude = 0.5 + 2.0 * any(generator), omega = 0.4 + 1.6 * any(generator);
  Eigen::VectorXd load = Eigen::VectorXd::Zero(size), pressing = load, across = load;
  load[size - 2] = amplitude;
  load[1] += 0.5;
  across[size - 1] = 0.8 * amplitude;
  for (int i = 0; i < masses; ++i) pressing[2 * i + 1] = normal_load;
  FrictionScene scene =
      testing::friction_scene(Eigen::MatrixXd::Identity(size, size), damping, stiffness, rows, load, omega,
                              std::vector<contact::CoulombLaw>(static_cast<std::size_t>(masses), law));
  Eigen::VectorXcd constant(1), with_exact(2);
  constant << 1.0;
  with_exact << 0.0, std::polar(1.0, -1.0);
  scene.structure.forces.push_back({pressing, constant});
  scene.structure.forces.push_back({across, with_exact});
  return scene;
}

// An iteration with many contacts costs as much as several of these limits.
TEST(Fallbacks, HaveRoomForIterationsWhateverTheLimit) {
  std::mt19937 generator(44);
  const FrictionScene scene = random_chain_that_rubs(generator);
  CondensedProblem problem = testing::fourier_problem(scene.structure, 31, 256, scene.frequency());
  ForcedResponseOptions options;
  options.max_fallback_operations = 1.0;
  const PeriodicResponse response = testing::solved_response(problem, scene.contact_laws(), options);
  EXPECT_NE(response.strategy, Strategy::newton);
}

}  // namespace
}  // namespace wavebalance::solvers
