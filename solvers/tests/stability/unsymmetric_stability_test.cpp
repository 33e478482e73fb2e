#include "dense_algebra.hpp"
#include "support/compliance_errors.hpp"
#include "support/oscillator.hpp"
#include "support/refusal.hpp"
#include "support/runge_kutta.hpp"
#include "support/solved.hpp"
#include "support/unsymmetric_cases.hpp"
#include "testing.hpp"
#include "wavebalance/solvers/period/attractor_integration.hpp"
#include "wavebalance/solvers/stability/floquet_exponents.hpp"
#include "wavebalance/solvers/stability/monodromy.hpp"
#include "wavebalance/solvers/stability/unstable_multipliers.hpp"
#include "wavebalance/solvers/time/motion_evaluator.hpp"

// Structures without symmetry against matrix exponentials and integration in time.
namespace wavebalance::solvers {
namespace {

using Complex = std::complex<double>;

double unsymmetric_error(const LinearStructure& structure, double lowest = 0.0) {
  const auto errors = testing::compliance_errors(ContactDynamics(structure), structure, 1.0, lowest);
  return std::max(errors.sections, errors.poles);
}

TEST(UnsymmetricDynamics, AreTheCondensedCompliance) {
  std::mt19937 generator(41);
  for (int contacts = 1; contacts <= 3; ++contacts) {
    LinearStructure chain = testing::unsymmetric_chain(7, 0.3, 0.2, generator);
    chain.contact_directions = testing::random_directions(contacts, 7, generator);
    EXPECT_LT(unsymmetric_error(chain), 1e-9);
    chain.stiffness =
        Eigen::MatrixXd(Eigen::MatrixXd(chain.stiffness) -
                        Eigen::MatrixXd(chain.stiffness).col(0) * Eigen::RowVectorXd::Unit(7, 0))
            .sparseView();  // singular, so that the modes are found by the mass
    EXPECT_LT(unsymmetric_error(chain, 0.1), 1e-9);
  }
}

TEST(UnsymmetricDynamics, TakeContactsWithoutMass) {
  std::mt19937 generator(42);
  for (const bool damped : {false, true}) {
    LinearStructure chain = testing::unsymmetric_chain(5, 0.3, 0.2, generator);
    for (auto* matrix : {&chain.mass, &chain.damping}) {
      if (damped && matrix == &chain.damping) continue;
      Eigen::MatrixXd dense(*matrix);
      dense.row(4).setZero();
      dense.col(4).setZero();
      *matrix = dense.sparseView();
    }
    chain.contact_directions = contact_rows({4, 2}, 5);
    const ContactDynamics dynamics(chain);
    EXPECT_EQ(dynamics.constant()(0, 0) > 0.1, !damped);
    EXPECT_LT(unsymmetric_error(chain), 1e-9);
  }
}

TEST(UnsymmetricDynamics, OfAReducedStructureHaveItsStaticsAndLowHarmonics) {
  std::mt19937 generator(43);
  LinearStructure chain = testing::random_chain(60, generator);
  chain.contact_directions = contact_rows({59}, 60);
  Eigen::MatrixXd damping(chain.damping), stiffness(chain.stiffness);
  for (int i = 0; i + 1 < 60; ++i) {
    damping(i, i + 1) += 0.05;
    damping(i + 1, i) -= 0.05;
    stiffness(i, i + 1) += 0.02;
    stiffness(i + 1, i) -= 0.02;
  }
  chain.damping = damping.sparseView();
  chain.stiffness = stiffness.sparseView();
  const ContactDynamics reduced(chain, {.max_size = 20, .reduced_size = 30}), whole(chain);
  EXPECT_TRUE(reduced.reduced());
  const Eigen::VectorXd harmonics = Eigen::VectorXd::LinSpaced(6, 0.0, 0.25);
  const Eigen::MatrixXcd a = reduced.compliance(0.0, harmonics).compliance,
                         b = whole.compliance(0.0, harmonics).compliance;
  EXPECT_LT(std::abs(a(0, 0) - b(0, 0)), 1e-9 * std::abs(b(0, 0)));
  EXPECT_LT((a - b).cwiseAbs().maxCoeff(), 1e-4 * b.cwiseAbs().maxCoeff());
}

// Stiffnesses that are constant on intervals: the map over a period is a product of matrix exponentials.
struct ConstantStiffness {
  LinearStructure structure;
  PeriodicStiffness stiffness;
  Eigen::VectorXd strengths;
  double frequency;

  ConstantStiffness(std::mt19937& generator, int size, int contacts)
      : structure(testing::unsymmetric_chain(size, 0.15, 0.1, generator)), strengths(contacts) {
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    structure.contact_directions = testing::random_directions(contacts, size, generator);
    frequency = 0.05 + 0.25 * uniform(generator);
    for (int c = 0; c < contacts; ++c) {
      const double begin = uniform(generator);
      strengths[c] = 2.0 * uniform(generator);
      stiffness.intervals.push_back({c, begin, begin + 0.05 + 0.4 * uniform(generator)});
    }
    stiffness.tangent = [values = strengths](int contact, double) { return values[contact]; };
  }

  Eigen::VectorXcd multipliers() const {
    std::vector<double> ends{0.0, 1.0};
    for (const ContactInterval& interval : stiffness.intervals)
      for (const double time : {interval.begin, interval.end}) ends.push_back(time - std::floor(time));
    std::sort(ends.begin(), ends.end());
    Eigen::MatrixXd map = Eigen::MatrixXd::Identity(2 * structure.size(), 2 * structure.size());
    for (std::size_t i = 1; i < ends.size(); ++i) {
      const double middle = 0.5 * (ends[i - 1] + ends[i]);
      Eigen::VectorXd closed = Eigen::VectorXd::Zero(strengths.size());
      for (const ContactInterval& interval : stiffness.intervals)
        if (middle - interval.begin - std::floor(middle - interval.begin) < interval.length())
          closed[interval.contact] = strengths[interval.contact];
      const double length = (ends[i] - ends[i - 1]) / frequency;
      map = (oracle::exponential(length * testing::state_matrix(structure, closed)) * map).eval();
    }
    return oracle::eigenvalues(map);
  }
};

double distance_to(Complex value, const Eigen::VectorXcd& all) {
  return (all.array() - value).abs().minCoeff();
}

TEST(UnsymmetricStability, MultipliersAndCountsAreThoseOfMatrixExponentials) {
  std::mt19937 generator(44);
  int unstable = 0, stable = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const ConstantStiffness at(generator, 2 + trial % 4, 1 + trial % 2);
    const Eigen::VectorXcd exact = at.multipliers();
    const ContactDynamics dynamics(at.structure);
    const Eigen::VectorXcd found = monodromy(dynamics, at.stiffness, at.frequency);
    ASSERT_EQ(found.size(), exact.size());
    const double scale = exact.cwiseAbs().maxCoeff();
    for (const Complex multiplier : found) EXPECT_LT(distance_to(multiplier, exact), 1e-7 * scale) << trial;
    const double closest = (exact.cwiseAbs().array() - 1.0).abs().minCoeff();
    if (closest < 0.02) continue;
    StabilityOptions options{.harmonics = 40, .max_states = 0};  // by the determinant
    const UnstableMultipliers counted = unstable_multipliers(dynamics, at.stiffness, at.frequency, options);
    const auto outside = (exact.cwiseAbs().array() > 1.0).count();
    ASSERT_EQ(counted.status, StabilityStatus::converged) << trial;
    EXPECT_EQ(counted.count, outside) << trial;
    EXPECT_GT(counted.harmonics, 0);
    ++(outside > 0 ? unstable : stable);
    // The determinant itself does not vanish where the monodromy has no multiplier.
    FloquetOptions seeking;
    seeking.stability = options;
    seeking.max_exponents = 2;
    for (const FloquetExponent& value :
         floquet_exponents(dynamics, at.stiffness, at.frequency, seeking).values)
      EXPECT_LT(distance_to(value.multiplier, exact), 2e-2) << trial;
  }
  EXPECT_GE(unstable, 5);
  EXPECT_GE(stable, 5);
}

PeriodicStiffness without_contact() { return {}; }

int count_of(const testing::Rotor& rotor) {
  const UnstableMultipliers counted =
      unstable_multipliers(ContactDynamics(rotor.structure()), without_contact(), 0.2, {.harmonics = 9});
  EXPECT_EQ(counted.status, StabilityStatus::converged);
  return counted.count;
}

// z'' + c z' + (k - i p) z = 0 is stable if p^2 < c^2 k.
TEST(UnsymmetricStability, CirculatoryForcesMakeARotorFlutterBeyondItsDamping) {
  for (const double share : {0.0, 0.9, 0.99}) {
    const double limit = 0.05;
    EXPECT_EQ(count_of({.damping = 0.05, .gyroscopic = 0.0, .circulatory = share * limit}), 0) << share;
    EXPECT_EQ(count_of({.damping = 0.05, .gyroscopic = 0.0, .circulatory = (2.0 - share) * limit}),
              share < 1.0 ? 2 : 0)
        << share;
  }
}

// Gyroscopic forces g > 2 sqrt(-k) hold an undamped rotor that would diverge; damping destroys that
// [Thomson, Tait, Chetaev], and circulatory forces restore it.
TEST(UnsymmetricStability, GyroscopicStabilisationIsLostByDampingAndRestoredByCirculation) {
  const testing::Rotor undamped{.stiffness = -1.0, .damping = 0.0, .gyroscopic = 3.0};
  EXPECT_EQ(
      unstable_multipliers(ContactDynamics(undamped.structure()), without_contact(), 0.2, {.harmonics = 9})
          .status,
      StabilityStatus::undamped);
  EXPECT_EQ(count_of({.stiffness = -1.0, .damping = 0.0, .gyroscopic = 1.0, .circulatory = 0.01}), 2);
  EXPECT_EQ(count_of({.stiffness = -1.0, .damping = 0.05, .gyroscopic = 3.0}), 2);
  const testing::Rotor restored{.stiffness = -1.0, .damping = 0.05, .gyroscopic = 3.0, .circulatory = 0.05};
  const Eigen::MatrixXd states = testing::state_matrix(restored.structure(), Eigen::VectorXd::Zero(1));
  EXPECT_EQ(count_of(restored), (oracle::eigenvalues(states).real().array() > 0.0).count());
  EXPECT_EQ(count_of(restored), 0);
}

TEST(UnsymmetricStability, ARotorAgainstAStopMovesAndDeviatesAsIntegrationInTime) {
  const testing::LinearContact law{3.0, 0.1};
  for (const testing::Rotor& rotor : {testing::Rotor{.damping = 0.2, .gyroscopic = 0.4},
                                      testing::Rotor{.damping = 0.2, .circulatory = 0.05}})
    for (const double omega : {0.7, 1.4, 2.3}) {
      CondensedProblem problem = testing::fourier_problem(rotor.structure(), 127, 1024, omega / two_pi);
      const ContactLaws laws = AnyContactLaw(law);
      const PeriodicResponse response = testing::solved_response(problem, laws);
      EXPECT_GT(response.contact_force.maxCoeff(), 0.1) << omega;
      Eigen::Vector4d start = Eigen::Vector4d::Zero();
      const Eigen::MatrixXcd all = problem.full_coefficients(response.contact_force);
      const auto motion = MotionEvaluator(problem.pair().trial(), 128)(all.transpose(), problem.frequency());
      start << motion.displacement(0, 0), motion.displacement(1, 0), motion.velocity(0, 0),
          motion.velocity(1, 0);
      const Eigen::Matrix4d matrix = testing::state_matrix(rotor.structure(), Eigen::VectorXd::Zero(1));
      const auto rate = [&](double time, const Eigen::Vector4d& at) {
        Eigen::Vector4d result = matrix * at;
        result[2] += std::cos(omega * time) - law.force(at[0]);
        return result;
      };
      const testing::PeriodMap map(rate, start, two_pi / omega, 20000);
      EXPECT_LT((map.end - start).norm(), 2e-4 * start.norm()) << omega;
      const ContactDynamics dynamics(rotor.structure());
      const Eigen::VectorXcd found =
          monodromy(dynamics, contact_stiffness(problem, laws, response), problem.frequency());
      for (const Complex multiplier : found)
        EXPECT_LT(distance_to(multiplier, map.multipliers), 2e-3) << omega;
      EXPECT_EQ(unstable_multipliers(dynamics, problem, laws, response).count, map.unstable()) << omega;
    }
}

}  // namespace
}  // namespace wavebalance::solvers
