#include "wavebalance/solvers/response/forced_response.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "constants.hpp"
#include "support/held_motion.hpp"
#include "support/small_problems.hpp"
#include "wavebalance/solvers/response/response_motion.hpp"
#include "wavebalance/solvers/time/translate_spectrum.hpp"

namespace wavebalance::solvers {
namespace {

using Complex = std::complex<double>;

// A law of a user's own: an elastic stop.
struct Stop {
  double force(double u) const { return u > 1e-3 ? 2e8 * (u - 1e-3) : 0.0; }
  double tangent(double u) const { return u >= 1e-3 ? 2e8 : 0.0; }
  double potential(double u) const { return u > 1e-3 ? 1e8 * (u - 1e-3) * (u - 1e-3) : 0.0; }
  double gap() const { return 1e-3; }
};

CondensedProblem case_1(int functions, int points) {
  CondensedProblem problem(testing::fourier_pair(functions, points), testing::jl14_case_1.structure(),
                           testing::cosine_load());
  problem.set_frequency(testing::jl14_case_1.frequency_hz);
  return problem;
}

TEST(ForcedResponse, WithoutContactIsTheComplexAmplitudeOfTheOscillator) {
  LinearStructure oscillator = testing::jl14_bar(1, 1e-3);
  const double mass = oscillator.mass.coeff(0, 0), stiffness = oscillator.stiffness.coeff(0, 0);
  CondensedProblem problem(testing::fourier_pair(5, 16), oscillator, testing::cosine_load());
  problem.set_frequency(600.0);
  const PeriodicResponse response = forced_response(problem, AnyContactLaw(), {});
  const double omega = two_pi * 600.0;
  const Complex amplitude =
      oscillator.load[0] / Complex(stiffness - omega * omega * mass, omega * 1e-3 * stiffness);
  ASSERT_TRUE(response.converged());
  EXPECT_EQ(response.iterations, 0);
  for (int l = 0; l < 16; ++l)
    EXPECT_NEAR(response.displacement[l], (amplitude * std::polar(1.0, two_pi * l / 16)).real(),
                1e-13 * std::abs(amplitude));
}

TEST(ForcedResponse, TakesALawOfTheUsersOwn) {
  CondensedProblem problem = case_1(63, 256);
  const PeriodicResponse response = forced_response(problem, Stop{}, {});
  ASSERT_TRUE(response.converged()) << to_string(response.status);
  EXPECT_GT(response.displacement.maxCoeff(), 1e-3);
  for (int l = 0; l < 256; ++l)
    EXPECT_DOUBLE_EQ(response.contact_force[l], Stop{}.force(response.displacement[l]));
  EXPECT_GT(response.contact_force.maxCoeff(), 0.0);
}

TEST(ForcedResponse, EveryRecordedFieldBelongsToTheSolution) {
  CondensedProblem problem = case_1(63, 256);
  const testing::ExponentialLaw law = testing::jl14_case_1.law;
  const PeriodicResponse response = forced_response(problem, law, {});
  ASSERT_TRUE(response.converged());
  EXPECT_EQ(response.frequency, 150.0);
  EXPECT_LE(response.residual, 1e-11);
  EXPECT_EQ(response.residual_history.back(), response.residual);
  EXPECT_EQ(static_cast<int>(response.residual_history.size()), response.iterations + 1);
  TrialEvaluator evaluate(problem.pair().trial(), 256, 0);
  EXPECT_LE((evaluate(response.coefficients) - response.displacement).norm(),
            1e-11 * response.displacement.norm());
  for (int l = 0; l < 256; ++l) {
    EXPECT_GE(response.contact_force[l], 0.0);
    EXPECT_EQ(response.contact_force[l] > 0.0, response.displacement[l] > law.start);
  }
}

// A stiff law makes much of a residual that is small beside the motion: at a tolerance of 1e-4 the force that
// makes the motion could be any other than the law's force at that motion.
TEST(ForcedResponse, TheForceOfAConvergedMotionIsThatOfItsLaw) {
  for (const double stiffening : {1.0, 1e2, 1e4}) {
    CondensedProblem problem = case_1(63, 256);
    testing::ExponentialLaw law = testing::jl14_case_1.law;
    law.constant *= stiffening;
    ForcedResponseOptions options;
    options.newton.tolerance = 1e-4;
    const PeriodicResponse response = forced_response(problem, law, options);
    ASSERT_TRUE(response.converged()) << stiffening << " " << to_string(response.status);
    Eigen::VectorXd product;
    problem.apply(response.contact_force, product);
    const Eigen::VectorXd& free = problem.contact_free_response();
    const Eigen::VectorXd motion = free - product;
    EXPECT_LE((motion - response.displacement).norm(), 1e-4 * (free.norm() + product.norm())) << stiffening;
    const Eigen::VectorXd held = testing::held_motion(problem, response);
    const Eigen::VectorXd law_force = held.unaryExpr([&](double u) { return law.force(u); });
    // Newton's bound of 1e-6 is on the force times the share that it has in the motion.
    const double share = product.norm() / (response.displacement.norm() + free.norm());
    EXPECT_LE((law_force - response.contact_force).cwiseAbs().maxCoeff(),
              2e-6 / share * response.contact_force.maxCoeff())
        << stiffening;
  }
}

TEST(ForcedResponse, StartedAtTheSolutionStays) {
  CondensedProblem problem = case_1(63, 256);
  const testing::ExponentialLaw law = testing::jl14_case_1.law;
  const PeriodicResponse first = forced_response(problem, law, {});
  const PeriodicResponse again = forced_response(problem, law, {}, first.displacement);
  EXPECT_TRUE(again.converged());
  EXPECT_LE(again.iterations, 1);
}

TEST(ForcedResponse, ContractsQuadraticallyOnceTheActiveSetStands) {
  CondensedProblem problem = case_1(63, 256);
  const PeriodicResponse response = forced_response(problem, testing::jl14_case_1.law, {});
  const auto& history = response.residual_history;
  ASSERT_GE(history.size(), 3u);
  const double last = history[history.size() - 1], before = history[history.size() - 2];
  EXPECT_LT(last, 10.0 * before * before + 1e-15);
}

TEST(ForcedResponse, SaysWhenIterationsRanOut) {
  CondensedProblem problem = case_1(63, 256);
  ForcedResponseOptions options;
  options.newton.max_iterations = 1;
  options.fallbacks = false;
  const PeriodicResponse response = forced_response(problem, testing::jl14_case_1.law, options);
  EXPECT_EQ(response.status, SolveStatus::iteration_limit);
  EXPECT_FALSE(response.converged());
  EXPECT_EQ(response.iterations, 1);
  EXPECT_GT(response.residual, 1e-11);
}

CondensedProblem stiff_haar_problem() {
  CondensedProblem problem(testing::make_pair(testing::HaarBasis{8}, spectral::FourierBasis(8), 256),
                           testing::jl14_case_2.structure(), testing::cosine_load());
  problem.set_frequency(1275.0);
  return problem;
}

TEST(ForcedResponse, ContinuationInTheGapFindsWhatNewtonDoesNot) {
  CondensedProblem problem = stiff_haar_problem();
  ForcedResponseOptions options;
  options.fallbacks = false;
  const PeriodicResponse plain = forced_response(problem, testing::jl14_case_2.law, options);
  EXPECT_EQ(plain.status, SolveStatus::stalled);
  EXPECT_EQ(plain.strategy, Strategy::none);
  const PeriodicResponse found = forced_response(problem, testing::jl14_case_2.law, {});
  EXPECT_TRUE(found.converged());
  EXPECT_EQ(found.strategy, Strategy::gap_continuation);
}

TEST(ForcedResponse, TellsItsObserverWhatTheValuesAre) {
  CondensedProblem problem = stiff_haar_problem();
  int newton = 0, continuation = 0;
  ForcedResponseOptions options;
  options.observer = [&](const Progress& progress) {
    const bool newton_step = progress.phase == "Newton";
    EXPECT_EQ(progress.measure, newton_step ? "relative residual" : "share of the residual");
    EXPECT_GE(progress.value, 0.0);
    return ++(newton_step ? newton : continuation) > 0;
  };
  ASSERT_TRUE(forced_response(problem, testing::jl14_case_2.law, options).converged());
  EXPECT_GT(newton, 3);
  EXPECT_GT(continuation, 3);
}

TEST(ForcedResponse, IsCancelledByItsObserverInNewtonAndInContinuation) {
  CondensedProblem problem = stiff_haar_problem();
  for (const std::string_view phase : {"Newton", "continuation"}) {
    int steps = 0;
    ForcedResponseOptions options;
    options.observer = [&](const Progress& progress) { return progress.phase != phase || ++steps < 3; };
    const PeriodicResponse stopped = forced_response(problem, testing::jl14_case_2.law, options);
    EXPECT_EQ(stopped.status, SolveStatus::cancelled) << phase;
    EXPECT_EQ(steps, 3) << phase;
  }
}

// A stop whose author divides zero by zero beyond it.
struct Undefined : Stop {
  double force(double u) const { return u > 1e-3 ? nan : 0.0; }
};

TEST(ForcedResponse, NamesTheContactAndTheDisplacementWhereALawReturnsNoNumber) {
  CondensedProblem problem = case_1(15, 64);
  try {
    forced_response(problem, AnyContactLaw(Undefined{}), {});
    FAIL() << "nothing thrown";
  } catch (const std::invalid_argument& error) {
    const std::string text = error.what();
    EXPECT_EQ(text.find("the law of contact 1 returned nan as its force at u = 0.0"), 0u) << text;
    EXPECT_NE(text.find(" m; it must return a number"), std::string::npos) << text;
  }
  const Eigen::VectorXd below = Eigen::VectorXd::Constant(4, 0.5e-3);
  EXPECT_NO_THROW(ContactLaws(AnyContactLaw(Undefined{})).require_numbers(2, below));
}

TEST(ForcedResponse, SaysWhenItsOperationsAreUsedUp) {
  CondensedProblem problem = stiff_haar_problem();
  ForcedResponseOptions options;
  options.newton.max_operations = 1.0;
  options.continuation.max_points = 1;
  options.settling.max_size = 0;  // no settling
  EXPECT_EQ(forced_response(problem, testing::jl14_case_2.law, options).status, SolveStatus::effort_limit);
}

TEST(ForcedResponse, RefusesOptionsOutOfRange) {
  CondensedProblem problem = case_1(7, 32);
  std::vector<ForcedResponseOptions> wrong(6);
  wrong[5].max_fallback_operations = 0.0;
  wrong[0].newton.max_iterations = -1;
  wrong[1].newton.tolerance = 0.0;
  wrong[2].newton.min_step = -1.0;
  wrong[3].continuation.max_operations = 0.0;
  wrong[4].continuation.max_points = 0;
  for (const ForcedResponseOptions& options : wrong)
    EXPECT_THROW(forced_response(problem, Stop{}, options), std::invalid_argument);
}

TEST(ForcedResponse, RefusesAGuessOfAnotherLengthAndAProblemWithoutFrequency) {
  CondensedProblem problem = case_1(7, 32);
  EXPECT_THROW(forced_response(problem, Stop{}, {}, Eigen::VectorXd::Zero(31)), std::invalid_argument);
  CondensedProblem fresh(testing::fourier_pair(7, 32), testing::jl14_bar(3, 1e-4), testing::cosine_load());
  EXPECT_THROW(forced_response(fresh, Stop{}, {}), std::invalid_argument);
  for (const double frequency : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()})
    EXPECT_THROW(problem.set_frequency(frequency), std::invalid_argument);
}

TEST(ForcedResponse, UndampedStructureAtItsNaturalFrequencyIsAnError) {
  LinearStructure oscillator = testing::jl14_bar(1, 0.0);
  oscillator.mass.coeffRef(0, 0) = 1.0;
  oscillator.stiffness.coeffRef(0, 0) = two_pi * two_pi * 4.0;
  CondensedProblem problem(testing::fourier_pair(3, 8), oscillator, testing::cosine_load());
  EXPECT_THROW(problem.set_frequency(2.0), SingularSystem);
  EXPECT_NO_THROW(problem.set_frequency(2.001));
}

// With Fourier functions on both sides the velocity of every degree of freedom is among the weights: what the
// load does in a period is dissipated, but for the sampled work of the contact, which is conservative.
TEST(StructureMotion, LoadWorkIsDissipatedAndTheContactDoesNone) {
  for (const auto& reference : {testing::jl14_case_1, testing::jl14_case_2}) {
    const int points = 1024;
    const LinearStructure bar = reference.structure();
    CondensedProblem problem(testing::fourier_pair(255, points), bar, testing::cosine_load());
    problem.set_frequency(reference.frequency_hz);
    const PeriodicResponse response = forced_response(problem, reference.law, {});
    const Motion field = structure_motion(problem, response, points);
    double work = 0.0, contact = 0.0;
    for (int l = 0; l < points; ++l) {
      work += std::cos(two_pi * l / points) * bar.load.dot(field.velocity.col(l));
      contact += response.contact_force[l] * field.velocity(bar.selected_dof(0), l);
    }
    const double dissipated = field.velocity.cwiseProduct(bar.damping * field.velocity).sum();
    EXPECT_NEAR(work - contact, dissipated, 1e-10 * std::abs(work));
    EXPECT_LE(std::abs(contact), 1e-3 * std::abs(work));
    EXPECT_LE((field.displacement.row(bar.selected_dof(0)).transpose() - response.displacement).norm(),
              1e-11 * response.displacement.norm());
  }
}

// Without load, damping or contact the energy of a free mode is constant; here the oscillator is driven far
// above its resonance, where E = (m omega^2 sin^2 + k cos^2) a^2 / 2.
TEST(StructureMotion, SystemEnergyIsThatOfTheOscillator) {
  const LinearStructure oscillator = testing::jl14_bar(1, 0.0);
  const double mass = oscillator.mass.coeff(0, 0), stiffness = oscillator.stiffness.coeff(0, 0);
  CondensedProblem problem(testing::fourier_pair(3, 8), oscillator, testing::cosine_load());
  problem.set_frequency(3000.0);
  const Motion field = structure_motion(problem, forced_response(problem, AnyContactLaw(), {}), 32);
  const double omega = two_pi * 3000.0, a = oscillator.load[0] / (stiffness - omega * omega * mass);
  const Eigen::VectorXd energy = system_energy(oscillator, AnyContactLaw(), field);
  double square = 0.0;
  for (int l = 0; l < 32; ++l) {
    const double c = std::cos(two_pi * l / 32), s = std::sin(two_pi * l / 32);
    const double expected = 0.5 * a * a * (mass * omega * omega * s * s + stiffness * c * c);
    EXPECT_NEAR(energy[l], expected, 1e-12 * mass * omega * omega * a * a);
    square += expected * expected / 32;
  }
  EXPECT_NEAR(energy_norm(oscillator, AnyContactLaw(), field), std::sqrt(square), 1e-12 * std::sqrt(square));
  // The contact's potential is added at the contact degree of freedom.
  const testing::ExponentialLaw law{1e3, 2.0, -1.0};
  const Eigen::VectorXd touched = system_energy(oscillator, law, field);
  EXPECT_NEAR(touched[3] - energy[3], law.potential(field.displacement(0, 3)), 1e-9 * touched[3]);
}

}  // namespace
}  // namespace wavebalance::solvers
