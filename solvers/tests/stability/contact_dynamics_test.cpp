#include "wavebalance/solvers/stability/contact_dynamics.hpp"
#include "support/compliance_errors.hpp"
#include "support/oscillator.hpp"
#include "support/stability_cases.hpp"
#include "testing.hpp"

namespace wavebalance::solvers {
namespace {

using Complex = std::complex<double>;

void expect_exact(const LinearStructure& structure, double size) {
  const ContactDynamics dynamics(structure);
  EXPECT_FALSE(dynamics.reduced());
  const testing::ComplianceErrors errors = testing::compliance_errors(dynamics, structure, size);
  EXPECT_LT(errors.sections, 1e-9);
  EXPECT_LT(errors.poles, 1e-7);
}

TEST(ContactDynamics, IsTheCondensedComplianceOfProportionallyDampedStructures) {
  std::mt19937 generator(21);
  for (int contacts = 1; contacts <= 3; ++contacts) {
    LinearStructure chain = testing::random_chain(7, generator);
    chain.contact_directions = testing::random_directions(contacts, 7, generator);
    expect_exact(chain, 1.0);
  }
  expect_exact(testing::jl14_bar(25, 5e-6), 8000.0);
}

TEST(ContactDynamics, IsTheCondensedComplianceWhereTheDampingCouplesTheModes) {
  std::mt19937 generator(22);
  LinearStructure chain = testing::random_chain(6, generator);
  chain.contact_directions = testing::random_directions(2, 6, generator);
  chain.damping.coeffRef(2, 2) += 0.4;
  expect_exact(chain, 1.0);
  chain.damping.coeffRef(2, 2) += 40.0;  // an overdamped mode
  expect_exact(chain, 1.0);
}

LinearStructure massless_tip(double stiffness_damping, double mass_damping) {
  std::mt19937 generator(23);
  LinearStructure chain = testing::random_chain(5, generator);
  Eigen::MatrixXd mass(chain.mass);
  mass.row(4).setZero();
  mass.col(4).setZero();
  chain.mass = mass.sparseView();
  chain.damping = stiffness_damping * chain.stiffness + mass_damping * chain.mass;
  chain.contact_directions = contact_rows({4, 2}, 5);
  return chain;
}

TEST(ContactDynamics, TakesContactsWithoutMass) {
  expect_exact(massless_tip(0.05, 0.0), 1.0);
  expect_exact(massless_tip(0.0, 0.05), 1.0);
  EXPECT_TRUE(ContactDynamics(massless_tip(0.05, 0.0)).constant().isZero(1e-12));
  EXPECT_GT(ContactDynamics(massless_tip(0.0, 0.05)).constant()(0, 0), 0.1);
  LinearStructure coupled = massless_tip(0.0, 0.05);  // no modes decouple its damping
  coupled.damping.coeffRef(1, 1) += 0.7;
  expect_exact(coupled, 1.0);
}

TEST(ContactDynamics, TakesFreeStructuresAndCriticalDamping) {
  LinearStructure free = testing::unit_oscillator(0.1, 1.0);
  free.stiffness.coeffRef(0, 0) = 0.0;
  const ContactDynamics drifting(free);
  const auto values = drifting.compliance(0.2, Eigen::VectorXd::Constant(1, 0.5));
  const Complex s(0.2, 0.5);
  EXPECT_LT(std::abs(values.compliance(0, 0) - 1.0 / (s * s + 0.1 * s)), 1e-14);
  expect_exact(testing::unit_oscillator(2.0, 1.0), 1.0);
}

TEST(ContactDynamics, HasTheExponentsOfTheOscillator) {
  const ContactDynamics dynamics(testing::unit_oscillator(0.1, 1.0));
  ASSERT_EQ(dynamics.poles().size(), 1u);
  EXPECT_LT(std::abs(dynamics.poles()[0].exponent - Complex(-0.05, std::sqrt(1.0 - 0.0025))), 1e-14);
}

TEST(ContactDynamics, OfAReducedBarHasItsLowModesAndStatics) {
  const LinearStructure bar = testing::jl14_bar(600, 5e-6);
  const ContactDynamics reduced(bar, {.max_size = 100, .reduced_size = 40}), whole(bar, {.max_size = 600});
  EXPECT_TRUE(reduced.reduced());
  EXPECT_FALSE(whole.reduced());
  Eigen::VectorXd harmonics = Eigen::VectorXd::LinSpaced(32, 0.0, 31.0) * two_pi * 1275.0;
  const auto a = reduced.compliance(0.0, harmonics), b = whole.compliance(0.0, harmonics);
  EXPECT_LT(std::abs(a.compliance(0, 0) - b.compliance(0, 0)), 1e-10 * std::abs(b.compliance(0, 0)));
  EXPECT_LT((a.compliance - b.compliance).cwiseAbs().maxCoeff(), 1e-6 * b.compliance.cwiseAbs().maxCoeff());
  EXPECT_LT((a.compliance.bottomRows(8) - b.compliance.bottomRows(8)).cwiseAbs().maxCoeff(),
            1e-2 * b.compliance.bottomRows(8).cwiseAbs().maxCoeff());
}

TEST(ContactDynamics, SaysWhatIsWrongWithAStructure) {
  LinearStructure bar = testing::jl14_bar(30, 5e-6);
  bar.stiffness *= -1.0;
  EXPECT_THROW(ContactDynamics(bar, {.max_size = 10}), std::invalid_argument);
  EXPECT_THROW(ContactDynamics(testing::jl14_bar(3, 0.0), {.max_size = 0}), std::invalid_argument);
  EXPECT_THROW(ContactDynamics(testing::jl14_bar(3, 0.0), {.reduced_size = -1}), std::invalid_argument);
}

}  // namespace
}  // namespace wavebalance::solvers
