#include "support/oscillator.hpp"
#include "support/refusal.hpp"
#include "support/small_problems.hpp"
#include "support/solved.hpp"
#include "testing.hpp"
#include "wavebalance/solvers/period/attractor_integration.hpp"
#include "wavebalance/solvers/stability/floquet_exponents.hpp"
#include "wavebalance/solvers/stability/monodromy.hpp"

namespace wavebalance::solvers {
namespace {

using Complex = std::complex<double>;
constexpr double eta = 0.1;

LinearStructure oscillator(double load = 1.0) {
  LinearStructure structure = testing::unit_oscillator(0.0, load);
  structure.loss_factor = eta;
  return structure;
}

// Sum over the load's harmonics of h_n / (1 - (n omega)^2 + i eta), real at n = 0.
double closed_form(const Eigen::VectorXcd& harmonics, double omega, double periods) {
  Complex sum = harmonics[0];
  for (Eigen::Index n = 1; n < harmonics.size(); ++n) {
    const double rate = omega * double(n);
    sum += harmonics[n] * std::polar(1.0, two_pi * double(n) * periods) / Complex(1.0 - rate * rate, eta);
  }
  return sum.real();
}

TEST(StructuralDamping, OfAnOscillatorHasTheClosedFormAtEveryHarmonic) {
  Eigen::VectorXcd harmonics(4);
  harmonics << 0.7, Complex(1.0, -0.3), 0.0, Complex(0.2, 0.4);
  for (const double omega : {0.3, 0.5, 1.0, 2.2}) {
    CondensedProblem problem(testing::fourier_pair(9, 32), oscillator(), harmonics);
    problem.set_frequency(omega / two_pi);
    for (int l = 0; l < 32; ++l)
      EXPECT_NEAR(problem.linear_response()[l], closed_form(harmonics, omega, l / 32.0), 1e-12) << omega;
  }
}

TEST(StructuralDamping, LeavesStaticAndAlternatingCoefficientsRealForEveryPair) {
  for (TimePair& pair : testing::pair_kinds(8, 32)) {
    const bool has_nyquist = pair.functions() % 2 == 0 && !pair.drops_nyquist();
    Eigen::VectorXcd harmonics(5);
    harmonics << 0.4, 1.0, Complex(0.1, 0.2), 0.3, Complex(0.0, 0.1);
    CondensedProblem problem(std::move(pair), oscillator(), harmonics);
    problem.set_frequency(0.21);
    const Eigen::MatrixXcd all = problem.full_coefficients(Eigen::VectorXd::Zero(problem.samples()));
    const double size = all.cwiseAbs().maxCoeff();
    EXPECT_NEAR(all(0, 0).imag(), 0.0, 1e-12 * size);
    EXPECT_NEAR(has_nyquist ? all(0, 4).imag() : 0.0, 0.0, 1e-10 * size);
  }
}

TEST(StructuralDamping, OfLocalFunctionsConvergesToTheClosedForm) {
  double before = 1.0;
  for (const int functions : {16, 32, 64}) {
    const testing::CubicBasis basis{functions};
    CondensedProblem problem(testing::make_pair(basis, basis, 8 * functions), oscillator(),
                             testing::cosine_load());
    problem.set_frequency(1.05 / two_pi);
    double error = 0.0;
    for (int l = 0; l < problem.points(); ++l)
      error =
          std::max(error, std::abs(problem.linear_response()[l] -
                                   closed_form(testing::cosine_load(), 1.05, double(l) / problem.points())));
    EXPECT_LT(error, 0.3 * before) << functions;
    before = error;
  }
  EXPECT_LT(before, 1e-3);
}

// Forces and motion of a stop balance at every harmonic with the complex stiffness, and the frequency
// derivative of the residual agrees with differences.
TEST(StructuralDamping, OfAnOscillatorAgainstAStopBalancesAtEveryHarmonic) {
  const ContactLaws laws = AnyContactLaw(testing::LinearContact{4.0, 0.5});
  CondensedProblem problem = testing::fourier_problem(oscillator(), 31, 256, 0.9 / two_pi);
  const PeriodicResponse response = testing::solved_response(problem, laws);
  EXPECT_GT(response.contact_force.maxCoeff(), 0.5);
  for (int n = 0; n <= 15; ++n) {
    Complex u = 0.0, f = 0.0;
    for (int l = 0; l < 256; ++l) {
      const Complex wave = std::polar(1.0 / 256.0, -two_pi * n * l / 256.0);
      u += response.displacement[l] * wave;
      f += response.contact_force[l] * wave;
    }
    const double rate = 0.9 * n;
    const Complex load = n == 1 ? 0.5 : 0.0;
    EXPECT_LT(std::abs(Complex(1.0 - rate * rate, n > 0 ? eta : 0.0) * u + f - load), 1e-9) << n;
  }
  const Eigen::VectorXd slope = problem.linear_response_slope();
  Eigen::VectorXd product_slope;
  problem.apply_slope(response.contact_force, product_slope);
  constexpr double step = 1e-6;
  problem.set_frequency(0.9 / two_pi + step);
  const Eigen::VectorXd ahead = problem.displacement(response.contact_force);
  problem.set_frequency(0.9 / two_pi - step);
  const Eigen::VectorXd behind = problem.displacement(response.contact_force);
  const Eigen::VectorXd expected = (ahead - behind) / (2.0 * step);
  EXPECT_LT((slope - product_slope - expected).norm(), 1e-6 * expected.norm());
}

TEST(StructuralDamping, HasNoEquationInTime) {
  const ContactLaws laws = AnyContactLaw(testing::LinearContact{4.0, 0.5});
  const auto refuses = [](const std::function<void()>& action) {
    return testing::refusal(action).find("structural damping has no equation in time") != std::string::npos;
  };
  const ContactDynamics dynamics(oscillator());
  EXPECT_TRUE(dynamics.structurally_damped());
  EXPECT_TRUE(refuses([&] { monodromy(dynamics, {}, 0.1); }));
  EXPECT_TRUE(refuses([&] { rigid_monodromy(dynamics, {}, 0.1); }));
  CondensedProblem problem = testing::fourier_problem(oscillator(), 31, 256, 0.9 / two_pi);
  const PeriodicResponse response = forced_response(problem, laws, {});
  const UnstableMultipliers count = unstable_multipliers(dynamics, problem, laws, response);
  EXPECT_EQ(count.status, StabilityStatus::structural_damping);
  EXPECT_EQ(count.count, -1);
  EXPECT_EQ(stability_signs(dynamics, problem, laws, response).status, StabilityStatus::structural_damping);
  EXPECT_EQ(floquet_exponents(dynamics, problem, laws, response).status, StabilityStatus::structural_damping);
  EXPECT_EQ(to_string(count.status), "structural_damping");
}

// By the viscous damping that damps each mode as much at its own frequency: without contact it is exact, and
// a start otherwise.
TEST(StructuralDamping, SettlesToTheMotionWithoutContactAndNearThatWithIt) {
  CondensedProblem problem = testing::fourier_problem(oscillator(), 31, 256, 1.02 / two_pi);
  const ContactLaws far = AnyContactLaw(testing::LinearContact{4.0, 1e3}),
                    near = AnyContactLaw(testing::LinearContact{4.0, 0.5});
  AttractorOptions settling;
  settling.steps = 256;
  const AttractorMotion without = settle(problem, far, settling);
  ASSERT_EQ(without.attractor_periods, 1);
  const Eigen::VectorXd free = problem.linear_response();
  EXPECT_LT((resample(without.last.displacement, 256, without.start) - free).norm(), 1e-4 * free.norm());
  const PeriodicResponse response = forced_response(problem, near, {});
  const AttractorMotion with = settle(problem, near, settling);
  ASSERT_EQ(with.attractor_periods, 1);
  EXPECT_LT((resample(with.last.displacement, 256, with.start) - response.displacement).norm(),
            0.1 * response.displacement.norm());
}

TEST(StructuralDamping, IsANumberFromZeroOn) {
  for (const double wrong : {-0.1, infinity, nan}) {
    LinearStructure structure = oscillator();
    structure.loss_factor = wrong;
    EXPECT_NE(testing::refusal([&] { structure.validate(); }).find("loss_factor"), std::string::npos);
  }
}

}  // namespace
}  // namespace wavebalance::solvers
