#include "stability/floquet_determinant.hpp"
#include "stability/harmonic_map.hpp"
#include "support/oscillator.hpp"
#include "support/rigid_law.hpp"
#include "support/solved.hpp"
#include "support/stability_cases.hpp"
#include "testing.hpp"
#include "wavebalance/solvers/stability/monodromy.hpp"

namespace wavebalance::solvers {
namespace {

using Complex = std::complex<double>;

// prod (z - mu_j) / (z - exp(lambda_j T)), as a logarithm.
Complex log_quotient(const ContactDynamics& dynamics, const Eigen::VectorXcd& multipliers, Complex sigma,
                     double period) {
  const Complex z = std::exp(sigma * period);
  Complex sum = 0.0;
  for (const Complex multiplier : multipliers) sum += std::log(1.0 - multiplier / z);
  for (const ContactPole& pole : dynamics.poles()) {
    sum -= std::log(1.0 - std::exp(pole.exponent * period) / z);
    if (pole.exponent.imag() != 0.0) sum -= std::log(1.0 - std::exp(std::conj(pole.exponent) * period) / z);
  }
  return sum;
}

// The trace of what the determinant leaves out, the harmonics beyond H: the first order of log Delta. All
// harmonics of 1 / (s - lambda) sum to (T / 2) coth((sigma - lambda) T / 2).
Complex omitted_trace(const ContactDynamics& dynamics, const PeriodicStiffness& stiffness, double omega,
                      Complex sigma, int harmonics) {
  const Eigen::VectorXd orders = Eigen::VectorXd::LinSpaced(2 * harmonics + 2, -harmonics - 1, harmonics);
  Eigen::MatrixXcd kept =
      dynamics.compliance(sigma.real(), (sigma.imag() + omega * orders.array()).matrix()).compliance;
  kept.row(0) *= 2.0 * sigma.imag() / omega;
  const double half_period = std::numbers::pi / omega;
  Complex sum = 0.0;
  for (const ContactInterval& interval : stiffness.intervals) {
    double impulse = 0.0;  // integral of D, by Simpson's rule
    constexpr int parts = 2000;
    for (int l = 0; l <= parts; ++l)
      impulse += (l == 0 || l == parts ? 1.0
                  : l % 2 == 0         ? 2.0
                                       : 4.0) *
                 interval.length() / (3.0 * parts) *
                 stiffness.tangent(interval.contact, interval.begin + interval.length() * l / parts);
    Complex all = 0.0;
    for (const ContactPole& pole : dynamics.poles()) {
      const Complex square = pole.residue * pole.shape[interval.contact] * pole.shape[interval.contact];
      all += square * half_period / std::tanh((sigma - pole.exponent) * half_period);
      if (pole.exponent.imag() != 0.0)
        all += std::conj(square) * half_period / std::tanh((sigma - std::conj(pole.exponent)) * half_period);
    }
    sum += impulse * (all - kept.col(interval.contact * (dynamics.contacts() + 1)).sum());
  }
  return sum;
}

// |exp(a - b) - 1|, which is small where determinants agree.
double mismatch(Complex a, Complex b) { return std::abs(std::exp(a - b) - 1.0); }

TEST(FloquetDeterminant, IsTheQuotientOfTheCharacteristicPolynomialsForOneToSixContacts) {
  std::mt19937 generator(11);
  for (int contacts = 1; contacts <= 6; ++contacts)
    for (int trial = 0; trial < 2; ++trial) {
      const testing::RandomStiffness random(generator, contacts);
      const ContactDynamics dynamics(random.structure);
      const Eigen::VectorXcd multipliers = monodromy(dynamics, random.stiffness, random.frequency);
      const double period = 1.0 / random.frequency;
      for (const Complex sigma :
           {Complex(0.0), Complex(0.0, std::numbers::pi / period), Complex(0.2 / period, 1.1 / period)}) {
        const Complex exact = log_quotient(dynamics, multipliers, sigma, period);
        const auto error = [&](int harmonics) {
          FloquetDeterminant determinant(dynamics, random.stiffness, random.frequency,
                                         Truncation{harmonics, {}});
          return mismatch(determinant(sigma).log +
                              omitted_trace(dynamics, random.stiffness, two_pi / period, sigma, harmonics),
                          exact);
        };
        const double coarse = error(63), fine = error(127);
        EXPECT_LT(coarse, 2.5e-3) << contacts << ' ' << sigma;
        EXPECT_LT(fine, 0.35 * coarse + 1e-5) << contacts << ' ' << sigma;  // of second order in 1 / H
      }
    }
}

TEST(FloquetDeterminant, HasTheDerivativeOfItsLogarithm) {
  std::mt19937 generator(12);
  const testing::RandomStiffness random(generator, 3);
  const ContactDynamics dynamics(random.structure);
  FloquetDeterminant determinant(dynamics, random.stiffness, random.frequency, Truncation{20, {}});
  const Complex sigma(0.03, 0.2);
  const double step = 1e-5;
  const Complex along = (determinant(sigma + step).log - determinant(sigma - step).log) / (2.0 * step);
  EXPECT_LT(std::abs(determinant(sigma).derivative - along), 1e-6 * std::abs(along));
}

TEST(FloquetDeterminant, IsRealAtBothEndsOfTheHalfCircleWithTheSignsOfItsSmoothOne) {
  std::mt19937 generator(13);
  for (int trial = 0; trial < 20; ++trial) {
    const testing::RandomStiffness random(generator, 1 + trial % 4);
    const ContactDynamics dynamics(random.structure);
    FloquetDeterminant determinant(dynamics, random.stiffness, random.frequency, Truncation{20, {}});
    const double half = 0.5 * determinant.angular_frequency();
    for (const Complex sigma : {Complex(0.0), Complex(0.0, half)}) {
      const Complex direction = std::polar(1.0, determinant(sigma).log.imag());
      EXPECT_NEAR(direction.imag(), 0.0, 1e-9);
      const HarmonicMaps maps = harmonic_maps(determinant);
      EXPECT_EQ(sigma == 0.0 ? maps.at_zero.sign : maps.at_half.sign, direction.real() > 0.0 ? 1 : -1);
    }
  }
}

TEST(UnstableMultipliers, AreAsManyAsThoseOfTheMonodromyOutsideTheCircle) {
  std::mt19937 generator(14);
  StabilityOptions options{.harmonics = 31, .max_states = 0};  // a count by the monodromy would prove nothing
  int unstable = 0, near = 0;
  for (int trial = 0; trial < 30; ++trial) {
    const testing::RandomStiffness random(generator, 1 + trial % 6);
    const ContactDynamics dynamics(random.structure);
    const Eigen::VectorXcd multipliers = monodromy(dynamics, random.stiffness, random.frequency);
    if (((multipliers.cwiseAbs().array() - 1.0).abs() < 0.01).any()) {
      ++near;
      continue;
    }
    const auto found = unstable_multipliers(dynamics, random.stiffness, random.frequency, options);
    ASSERT_EQ(found.status, StabilityStatus::converged);
    EXPECT_EQ(found.count, (multipliers.cwiseAbs().array() > 1.0).count()) << trial;
    unstable += found.count > 0 ? 1 : 0;
  }
  EXPECT_GE(unstable, 5);
  EXPECT_LE(near, 10);
}

// Two nearly equal oscillators: the argument turns by 2 pi near the axis within a small part of the range.
TEST(UnstableMultipliers, OfTwoEqualMultipliersBesideTheCircleAreNone) {
  const Eigen::Matrix2d springs{{1.0, -1e-4}, {-1e-4, 1.0}};
  LinearStructure structure = testing::structure(Eigen::Matrix2d::Identity(), 0.004 * springs, springs,
                                                 Eigen::Vector2d(1.0, 0.0), contact_rows({0, 1}, 2));
  const ContactDynamics dynamics(structure);
  StabilityOptions options{.harmonics = 31};
  for (const double stop : {0.2, 0.5, 1.0, 1.5}) {
    PeriodicStiffness stiffness;
    stiffness.intervals = {{0, 0.1, 0.36}, {1, 0.1, 0.36}};
    stiffness.tangent = [stop](int, double) { return stop; };
    for (const double frequency : {0.25, 0.267, 0.28, 0.3}) {
      const auto multipliers = monodromy(dynamics, stiffness, frequency);
      const auto found = unstable_multipliers(dynamics, stiffness, frequency, options);
      EXPECT_EQ(found.count, (multipliers.cwiseAbs().array() > 1.0).count()) << stop << ' ' << frequency;
    }
  }
}

TEST(FloquetExponents, AreThoseOfTheMonodromyWithTheirModes) {
  std::mt19937 generator(15);
  for (int contacts = 1; contacts <= 4; ++contacts) {
    const testing::RandomStiffness random(generator, contacts);
    const ContactDynamics dynamics(random.structure);
    const Eigen::VectorXcd multipliers = monodromy(dynamics, random.stiffness, random.frequency);
    FloquetOptions options;
    options.stability.harmonics = 63;
    const auto exponents = floquet_exponents(dynamics, random.stiffness, random.frequency, options);
    ASSERT_EQ(exponents.status, StabilityStatus::converged);
    ASSERT_FALSE(exponents.values.empty());
    EXPECT_NEAR(std::abs(exponents.values[0].multiplier), std::abs(multipliers[0]), 1e-4);
    const auto counted =
        unstable_multipliers(dynamics, random.stiffness, random.frequency, options.stability);
    if (counted.leading_error > 0.0) {
      EXPECT_LE(std::abs(counted.leading - exponents.values[0].multiplier), counted.leading_error);
    }
    for (const FloquetExponent& value : exponents.values) {
      EXPECT_LT((multipliers.array() - value.multiplier).abs().minCoeff(), 1e-3) << contacts;
      EXPECT_NEAR(value.displacement.cwiseAbs().maxCoeff(), 1.0, 1e-12);
    }
  }
}

// The force of a mode is the contact's stiffness times its displacement, summed here over many instants.
TEST(FloquetExponents, ModesSatisfyTheLawOfTheContact) {
  std::mt19937 generator(16);
  const testing::RandomStiffness random(generator, 1);
  FloquetOptions options;
  options.stability.harmonics = 127;
  const auto exponents =
      floquet_exponents(ContactDynamics(random.structure), random.stiffness, random.frequency, options);
  ASSERT_FALSE(exponents.values.empty());
  const FloquetExponent& leading = exponents.values[0];
  constexpr int points = 20000;
  const ContactInterval& interval = random.stiffness.intervals[0];
  for (const int n : {-3, 0, 1, 5}) {
    Complex sum = 0.0;
    for (int l = 0; l < points; ++l) {
      const double time = interval.begin + interval.length() * (l + 0.5) / points;
      Complex displacement = 0.0;
      for (int m = -127; m <= 127; ++m)
        displacement += leading.displacement(0, m + 127) * std::polar(1.0, two_pi * m * time);
      sum += interval.length() / points * random.stiffness.tangent(0, time) * displacement *
             std::polar(1.0, -two_pi * n * time);
    }
    EXPECT_LT(std::abs(sum - leading.force(0, n + 127)), 1e-4 * leading.force.cwiseAbs().maxCoeff()) << n;
  }
}

TEST(FloquetExponents, AreFollowedFromTheStartsGiven) {
  std::mt19937 generator(17);
  const testing::RandomStiffness random(generator, 2);
  const ContactDynamics dynamics(random.structure);
  FloquetOptions options;
  options.stability.harmonics = 31;
  const auto all = floquet_exponents(dynamics, random.stiffness, random.frequency, options);
  ASSERT_GE(all.values.size(), 2u);
  options.starts = {1.02 * all.values[1].exponent};
  const auto one = floquet_exponents(dynamics, random.stiffness, random.frequency, options);
  ASSERT_EQ(one.values.size(), 1u);
  EXPECT_LT(std::abs(one.values[0].exponent - all.values[1].exponent), 1e-8 * random.frequency);
  EXPECT_LT(one.evaluations, 12);
}

TEST(FloquetExponents, WithoutContactAreThoseOfTheStructure) {
  const LinearStructure structure = testing::unit_oscillator(0.1, 1.0);
  const ContactDynamics dynamics(structure);
  FloquetOptions options;
  options.stability.harmonics = 5;
  const double frequency = 0.3;
  const auto exponents = floquet_exponents(dynamics, PeriodicStiffness{}, frequency, options);
  ASSERT_EQ(exponents.values.size(), 1u);
  const Complex exact(-0.05, -std::sqrt(1.0 - 0.0025));
  EXPECT_LT(std::abs(std::exp(exact / frequency) - exponents.values[0].multiplier), 1e-9);
  EXPECT_TRUE(exponents.values[0].displacement.isZero(0.0));
  EXPECT_EQ(unstable_multipliers(dynamics, PeriodicStiffness{}, frequency, options.stability).count, 0);
}

// A contact on a light mass whose spring is as stiff as the contact: beyond the harmonics the compliance does
// not decay before the mode of the light mass, at harmonic 140.
TEST(FloquetExponents, OfAContactOnASpringAreThoseOfTheMonodromyInFewHarmonics) {
  const Eigen::Matrix2d springs{{6.0, -5.0}, {-5.0, 5.0}};
  const Eigen::Matrix2d mass = Eigen::Vector2d(1.0, 1e-4).asDiagonal();
  const LinearStructure structure = testing::structure(mass, 1e-3 * springs + 0.1 * mass, springs,
                                                       Eigen::Vector2d(1.0, 0.0), contact_rows({1}, 2));
  PeriodicStiffness stiffness;
  stiffness.intervals = {{0, 0.1, 0.5}};
  stiffness.tangent = [](int, double) { return 5.0; };
  const ContactDynamics dynamics(structure);
  FloquetOptions options;
  options.stability.harmonics = 15;
  options.max_raise = 1;
  const Eigen::VectorXcd multipliers = monodromy(dynamics, stiffness, 0.25);
  const auto exponents = floquet_exponents(dynamics, stiffness, 0.25, options);
  ASSERT_EQ(exponents.status, StabilityStatus::converged);
  ASSERT_FALSE(exponents.values.empty());
  EXPECT_EQ(exponents.harmonics, 15);
  EXPECT_NEAR(std::abs(exponents.values[0].multiplier), std::abs(multipliers[0]), 2e-3);
  const auto found = unstable_multipliers(dynamics, stiffness, 0.25, options.stability);
  EXPECT_EQ(found.harmonics, 15);
  EXPECT_EQ(found.count, (multipliers.cwiseAbs().array() > 1.0).count());
}

// Negative damping makes the structure itself unstable: its own exponents are poles inside the contour.
// The low modes and static residuals of a bar of 600 elements carry the multipliers outside the circle.
TEST(UnstableMultipliers, OfAReducedBarAreThoseOfTheWholeOne) {
  LinearStructure bar = testing::jl14_bar(600, 5e-7);
  bar.contact_directions = contact_rows({599, 311}, bar.size());
  const ContactDynamics reduced(bar, {.max_size = 100, .reduced_size = 40}), whole(bar, {.max_size = 600});
  ASSERT_TRUE(reduced.reduced());
  ASSERT_FALSE(whole.reduced());
  const PeriodicStiffness stiffness = testing::PrescribedStiffness::stiffness();
  FloquetOptions options;
  options.stability.harmonics = 31;
  int unstable = 0;
  for (const double frequency : {1100.0, 1550.0, 2650.0, 3150.0}) {
    SCOPED_TRACE(frequency);
    const auto expected = unstable_multipliers(whole, stiffness, frequency, options.stability);
    const auto found = unstable_multipliers(reduced, stiffness, frequency, options.stability);
    ASSERT_EQ(expected.status, StabilityStatus::converged);
    ASSERT_EQ(found.status, StabilityStatus::converged);
    EXPECT_EQ(found.count, expected.count);
    unstable += expected.count;
    const auto a = floquet_exponents(reduced, stiffness, frequency, options).values;
    const auto b = floquet_exponents(whole, stiffness, frequency, options).values;
    ASSERT_FALSE(a.empty() || b.empty());
    EXPECT_LT(std::abs(a.front().multiplier - b.front().multiplier), 1e-4);
  }
  EXPECT_GE(unstable, 4);
}

TEST(UnstableMultipliers, IncludeThoseOfAnUnstableStructure) {
  LinearStructure structure = testing::unit_oscillator(-0.1, 1.0);
  const ContactDynamics dynamics(structure);
  StabilityOptions options{.harmonics = 31};
  EXPECT_EQ(unstable_multipliers(dynamics, PeriodicStiffness{}, 0.3, options).count, 2);
  PeriodicStiffness stiffness;
  stiffness.intervals = {{0, 0.2, 0.5}};
  stiffness.tangent = [](int, double) { return 0.5; };
  const Eigen::VectorXcd multipliers = monodromy(dynamics, stiffness, 0.3);
  EXPECT_EQ(unstable_multipliers(dynamics, stiffness, 0.3, options).count,
            (multipliers.cwiseAbs().array() > 1.0).count());
}

TEST(UnstableMultipliers, OfAMotionInSplinesAreThoseInHarmonics) {
  const LinearStructure structure = testing::unit_oscillator(0.1, 0.8);
  const ContactLaws laws = testing::LinearContact{10.0, 0.1};
  for (const double omega : {2.0, 2.5}) {
    CondensedProblem fourier = testing::fourier_problem(structure, 127, 1024);
    CondensedProblem splines(testing::make_pair(testing::CubicBasis{128}, testing::CubicBasis{128}, 1024),
                             structure, testing::cosine_load());
    std::vector<FloquetExponents> exponents;
    for (CondensedProblem* problem : {&fourier, &splines}) {
      problem->set_frequency(omega / two_pi);
      const PeriodicResponse response = testing::solved_response(*problem, laws);
      const auto found = unstable_multipliers(*problem, laws, response);
      EXPECT_EQ(found.status, StabilityStatus::converged);
      EXPECT_EQ(found.count, omega == 2.0 ? 0 : 1);
      exponents.push_back(floquet_exponents(ContactDynamics(structure), *problem, laws, response));
      ASSERT_FALSE(exponents.back().values.empty());
    }
    EXPECT_LT(std::abs(exponents[0].values[0].multiplier - exponents[1].values[0].multiplier), 2e-3);
  }
}

TEST(UnstableMultipliers, OfAMotionInTheForceFormAreThoseOfTheDisplacementForm) {
  CondensedProblem problem = testing::fourier_problem(testing::jl14_case_2.structure(), 63, 512, 1275.0);
  const ContactLaws laws = testing::jl14_case_2.law;
  const ContactDynamics dynamics(problem.structure());
  std::vector<Complex> multipliers;
  for (const ContactForm form : {ContactForm::displacement, ContactForm::force}) {
    ForcedResponseOptions options;
    options.form = form;
    const PeriodicResponse response = testing::solved_response(problem, laws, options);
    EXPECT_EQ(unstable_multipliers(dynamics, problem, laws, response).count, 0);
    const auto exponents = floquet_exponents(dynamics, problem, laws, response);
    ASSERT_FALSE(exponents.values.empty());
    multipliers.push_back(exponents.values[0].multiplier);
  }
  EXPECT_LT(std::abs(multipliers[0] - multipliers[1]), 5e-3);
}

}  // namespace
}  // namespace wavebalance::solvers
