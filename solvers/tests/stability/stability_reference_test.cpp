#include "linalg/multipliers.hpp"
#include "stability/monodromy_map.hpp"
#include "support/oscillator.hpp"
#include "support/rigid_law.hpp"
#include "support/solved.hpp"
#include "support/stability_cases.hpp"
#include "testing.hpp"
#include "wavebalance/solvers/response/response_motion.hpp"
#include "wavebalance/solvers/stability/monodromy.hpp"

namespace wavebalance::solvers {
namespace {

using Complex = std::complex<double>;

struct Resolution {
  int functions, points;
  double tolerance;
};

class CaseTwoStability : public ::testing::TestWithParam<Resolution> {};

// Against multipliers of a shooting computation.
TEST_P(CaseTwoStability, MultipliersAndCountsAreThoseOfShooting) {
  const Resolution& resolution = GetParam();
  CondensedProblem problem =
      testing::fourier_problem(testing::jl14_case_2.structure(), resolution.functions, resolution.points);
  const ContactDynamics dynamics(problem.structure());
  const ContactLaws laws = testing::jl14_case_2.law;
  const auto responses = testing::case_2_responses(problem);
  ASSERT_EQ(responses.size(), testing::case_2_curve.size());
  for (std::size_t i = 0; i < responses.size(); ++i) {
    const testing::StabilityPoint& point = testing::case_2_curve[i];
    SCOPED_TRACE(point.frequency);
    const FloquetExponents exponents = floquet_exponents(dynamics, problem, laws, responses[i]);
    ASSERT_EQ(exponents.status, StabilityStatus::converged);
    ASSERT_FALSE(exponents.values.empty());
    EXPECT_LT(std::abs(exponents.values[0].multiplier - point.multiplier), resolution.tolerance);
    const UnstableMultipliers unstable = unstable_multipliers(dynamics, problem, laws, responses[i]);
    EXPECT_EQ(unstable.status, StabilityStatus::converged);
    EXPECT_EQ(unstable.count, point.unstable);
    EXPECT_EQ(unstable.harmonics, resolution.functions / 2);  // by the determinant, not by the monodromy
    EXPECT_NEAR(unstable.winding, point.unstable, 1e-6);
    const StabilitySigns signs = stability_signs(dynamics, problem, laws, responses[i]);
    EXPECT_EQ(signs.fold, point.unstable == 1 ? -1 : 1);
    EXPECT_EQ(signs.flip, 1);
    const auto stiffness = contact_stiffness(problem, laws, responses[i]);
    ASSERT_EQ(stiffness.intervals.size(), 1u);
    EXPECT_NEAR(stiffness.intervals[0].length(), point.contact_fraction, resolution.tolerance);
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, CaseTwoStability,
                         ::testing::Values(Resolution{63, 256, 1.5e-3}, Resolution{127, 1024, 1.5e-4},
                                           Resolution{255, 4096, 2e-5}),
                         [](const auto& size) { return "M" + std::to_string(size.param.functions); });

class PrescribedStiffnessOfTwoContacts : public ::testing::TestWithParam<int> {};

TEST_P(PrescribedStiffnessOfTwoContacts, MultipliersAndCountsAreTheReference) {
  const ContactDynamics dynamics(testing::PrescribedStiffness::structure());
  const PeriodicStiffness stiffness = testing::PrescribedStiffness::stiffness();
  FloquetOptions options;
  options.stability.harmonics = GetParam();
  options.stability.max_states = 0;  // by the determinant, not by the monodromy
  const double tolerance = GetParam() == 31 ? 2e-4 : GetParam() == 63 ? 5e-5 : 5e-6;
  for (const testing::PrescribedStiffness& point : testing::prescribed_stiffness) {
    SCOPED_TRACE(point.frequency);
    const auto unstable = unstable_multipliers(dynamics, stiffness, point.frequency, options.stability);
    EXPECT_EQ(unstable.count, point.unstable);
    EXPECT_EQ(unstable.harmonics, GetParam());
    if (GetParam() != 31)  // the search from nothing would need most of the time of this suite
      options.starts = {std::log(point.multiplier) * point.frequency + Complex(1.0, 1.0)};
    const FloquetExponents exponents = floquet_exponents(dynamics, stiffness, point.frequency, options);
    ASSERT_EQ(exponents.status, StabilityStatus::converged);
    ASSERT_FALSE(exponents.values.empty());
    EXPECT_LT(std::abs(exponents.values[0].multiplier - point.multiplier), tolerance);
  }
}

INSTANTIATE_TEST_SUITE_P(Harmonics, PrescribedStiffnessOfTwoContacts, ::testing::Values(31, 63, 127));

TEST(Monodromy, OfPrescribedStiffnessIsTheReferenceTo1e9) {
  const ContactDynamics dynamics(testing::PrescribedStiffness::structure());
  const PeriodicStiffness stiffness = testing::PrescribedStiffness::stiffness();
  for (const testing::PrescribedStiffness& point : testing::prescribed_stiffness) {
    const Eigen::VectorXcd multipliers = monodromy(dynamics, stiffness, point.frequency);
    EXPECT_EQ((multipliers.cwiseAbs().array() > 1.0).count(), point.unstable);
    const Complex leading(multipliers[0].real(), std::abs(multipliers[0].imag()));
    EXPECT_LT(std::abs(leading - point.multiplier), 1e-9) << point.frequency;
  }
}

// Case 2 with the mass of its tip moved to its neighbour.
LinearStructure massless_tip() { return testing::massless_tip(testing::jl14_case_2.structure()); }

PeriodicStiffness rigid_contact(double stiffness) {
  PeriodicStiffness contact;
  contact.intervals = {{0, 0.06305798, 0.06305798 + 0.08197176}};  // of an event-driven computation
  contact.tangent = [stiffness](int, double) { return stiffness; };
  return contact;
}

TEST(RigidMonodromy, OfCaseTwoIsTheReference) {
  const ContactDynamics dynamics(massless_tip());
  const Eigen::VectorXcd multipliers = rigid_monodromy(dynamics, rigid_contact(0.0), 1275.0);
  EXPECT_NEAR(std::abs(multipliers[0]), 0.603281, 1e-6);
}

TEST(RigidMonodromy, OfAResponseIsNearTheReference) {
  CondensedProblem problem = testing::fourier_problem(massless_tip(), 255, 512, 1275.0);
  const ContactLaws rigid = testing::Rigid{testing::jl14_case_2.law.start};
  const PeriodicResponse response = testing::solved_response(problem, rigid);
  const PeriodicStiffness contact = contact_stiffness(problem, rigid, response);
  EXPECT_EQ(contact.status, StabilityStatus::no_finite_stiffness);
  const Eigen::VectorXcd multipliers = rigid_monodromy(ContactDynamics(massless_tip()), contact, 1275.0);
  EXPECT_NEAR(std::abs(multipliers[0]), 0.603281, 1.5e-2);  // the error of the instants in 255 functions
  const auto found = unstable_multipliers(problem, rigid, response);
  EXPECT_EQ(found.status, StabilityStatus::converged);
  EXPECT_EQ(found.count, 0);
}

// Penalties in N/m with the moduli of an event-driven computation, and the errors that motions in 511
// functions leave: harmonics resolve stiffer contact less.
TEST(RigidMonodromy, IsApproachedByThoseOfPenalties) {
  const ContactDynamics dynamics(massless_tip());
  struct Penalty {
    double stiffness, modulus, tolerance;
  };
  for (const auto& [penalty, modulus, tolerance] :
       {Penalty{1e10, 0.601686, 2e-4}, Penalty{1e11, 0.603213, 2e-3}}) {
    CondensedProblem problem = testing::fourier_problem(massless_tip(), 511, 8192, 1275.0);
    const ContactLaws laws = testing::LinearContact{penalty, testing::jl14_case_2.law.start};
    const PeriodicResponse response = testing::solved_response(problem, laws);
    const PeriodicStiffness contact = contact_stiffness(problem, laws, response);
    const auto multipliers = monodromy(dynamics, contact, 1275.0, {.nodes = 24, .max_segments = 4000});
    EXPECT_NEAR(std::abs(multipliers[0]), modulus, tolerance) << penalty;
  }
}

// With the mass of the tip there is none.
TEST(RigidMonodromy, IsTheLimitOfStiffContactWithoutMass) {
  const ContactDynamics dynamics(massless_tip());
  const double limit = std::abs(rigid_monodromy(dynamics, rigid_contact(0.0), 1275.0)[0]);
  const auto error = [&](double stiffness) {
    const auto multipliers =
        monodromy(dynamics, rigid_contact(stiffness), 1275.0, {.nodes = 24, .max_segments = 4000});
    return std::abs(std::abs(multipliers[0]) - limit);
  };
  const double soft = error(1e11), stiff = error(1e12);
  EXPECT_LT(soft, 5e-3);
  EXPECT_LT(stiff, 0.15 * soft);
  const ContactDynamics heavy(testing::jl14_case_2.structure());
  EXPECT_TRUE(std::isnan(rigid_monodromy(heavy, rigid_contact(0.0), 1275.0)[0].real()));
}

// m = k = 1, c = 0.1, a linear stop 10 at gap 0.1, 0.8 cos: multipliers of exact pieces.
struct OscillatorPoint {
  double omega;
  Complex first, second;
  double contact_fraction;
};

// Few of the 50 states of the overdamped bar are left after its free flight.
TEST(Monodromy, HasTheEigenvaluesOfTheWholeMap) {
  for (const testing::Jl14Case& one : {testing::jl14_case_1, testing::jl14_case_2}) {
    CondensedProblem problem = testing::fourier_problem(one.structure(), 63, 256, one.frequency_hz);
    const PeriodicResponse response = testing::solved_response(problem, one.law);
    const ContactDynamics dynamics(problem.structure());
    const PeriodicStiffness stiffness = contact_stiffness(problem, one.law, response);
    const Eigen::VectorXcd all = detail::map_multipliers(
                               monodromy_map(dynamics, stiffness, one.frequency_hz, {})),
                           found = monodromy(dynamics, stiffness, one.frequency_hz);
    ASSERT_EQ(found.size(), all.size());
    for (Eigen::Index i = 0; i < all.size(); ++i)
      EXPECT_NEAR(std::abs(found[i]), std::abs(all[i]), 1e-9 * std::max(std::abs(all[0]), 1e-9)) << i;
  }
}

TEST(Monodromy, OfTheOscillatorWithAStopIsExactTo1e6) {
  const std::array<OscillatorPoint, 4> points{
      {{2.0, {-0.25616405, 0.81534206}, {-0.25616405, -0.81534206}, 0.2265369217},
       {2.3, -1.77764006, -0.42806996, 0.2071673601},
       {2.5, -2.55458961, -0.30445895, 0.1863299386},
       {2.8, -2.56680525, -0.31128029, 0.1330697175}}};
  const LinearStructure structure = testing::unit_oscillator(0.1, 0.8);
  const ContactLaws laws = testing::LinearContact{10.0, 0.1};
  CondensedProblem problem = testing::fourier_problem(structure, 1023, 8192);
  const ContactDynamics dynamics(structure);
  for (const OscillatorPoint& point : points) {
    problem.set_frequency(point.omega / two_pi);
    const PeriodicResponse response = testing::solved_response(problem, laws);
    const PeriodicStiffness stiffness = contact_stiffness(problem, laws, response);
    ASSERT_EQ(stiffness.intervals.size(), 1u);
    EXPECT_NEAR(stiffness.intervals[0].length(), point.contact_fraction, 1e-6);
    Eigen::VectorXcd multipliers = monodromy(dynamics, stiffness, response.frequency);
    ASSERT_EQ(multipliers.size(), 2);
    if (multipliers[0].imag() < 0.0) multipliers.reverseInPlace();
    EXPECT_LT(std::abs(multipliers[0] - point.first), 1e-6) << point.omega;
    EXPECT_LT(std::abs(multipliers[1] - point.second), 1e-6) << point.omega;
  }
}

}  // namespace
}  // namespace wavebalance::solvers
