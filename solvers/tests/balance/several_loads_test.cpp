#include "dense_system.hpp"
#include "support/oscillator.hpp"
#include "support/refusal.hpp"
#include "support/small_problems.hpp"
#include "support/solved.hpp"
#include "testing.hpp"
#include "wavebalance/solvers/period/attractor_integration.hpp"

namespace wavebalance::solvers {
namespace {

using Complex = std::complex<double>;
using testing::LinearContact;
using testing::Oscillator;

constexpr int load_points = 256;

// A static force of 20 N and a third harmonic of 30 N, 40 degrees ahead, in addition to the oscillator's
// cosine.
LinearStructure driven_oscillator(const Oscillator& oscillator) {
  LinearStructure structure = oscillator.structure();
  Eigen::VectorXcd series = Eigen::VectorXcd::Zero(4);
  series[0] = 20.0;
  series[3] = std::polar(30.0, 40.0 * two_pi / 360.0);
  structure.forces = {{Eigen::VectorXd::Ones(1), series}};
  return structure;
}

double driven_displacement(const Oscillator& oscillator, double periods) {
  const double omega = 3.0 * two_pi * oscillator.frequency;
  const Complex third =
      std::polar(30.0, 40.0 * two_pi / 360.0) /
      Complex(oscillator.stiffness - omega * omega * oscillator.mass, omega * oscillator.damping);
  return 20.0 / oscillator.stiffness + oscillator.steady_displacement(periods / oscillator.frequency) +
         std::real(third * std::polar(1.0, 3.0 * two_pi * periods));
}

TEST(SeveralLoads, OnALinearOscillatorGiveItsClosedFormInEverySolver) {
  const Oscillator oscillator;
  const LinearStructure structure = driven_oscillator(oscillator);
  CondensedProblem problem = testing::fourier_problem(structure, 9, load_points, oscillator.frequency);
  const TimeSteppingResult stepped =
      testing::stepped_motion(structure, AnyContactLaw(), oscillator.frequency, load_points);
  const double scale = std::abs(oscillator.amplitude());
  for (int l = 0; l < load_points; ++l) {
    const double expected = driven_displacement(oscillator, double(l) / load_points);
    EXPECT_NEAR(problem.linear_response()[l], expected, 1e-13 * scale);
    EXPECT_NEAR(stepped.contacts.displacement(0, l), expected, 1e-5 * scale);
  }
}

// x = x_b + the relative motion: amplitude sqrt(k^2 + (c w)^2) / |k - m w^2 + i c w| of the base's.
TEST(SeveralLoads, OfAMovingBaseTransmitItByTheClosedForm) {
  const Oscillator oscillator{.load = 0.0};
  LinearStructure structure = oscillator.structure();
  Eigen::VectorXcd base = Eigen::VectorXcd::Zero(2);
  base[1] = 1e-3;
  structure.forces = {{Eigen::VectorXd::Constant(1, oscillator.stiffness), base, 0},
                      {Eigen::VectorXd::Constant(1, oscillator.damping), base, 1}};
  CondensedProblem problem = testing::fourier_problem(structure, 5, load_points);
  for (const double frequency : {7.0, 25.0, 60.0}) {
    problem.set_frequency(frequency);
    const double omega = two_pi * frequency;
    const Complex spring(oscillator.stiffness, omega * oscillator.damping);
    const Complex x = 1e-3 * spring / (spring - omega * omega * oscillator.mass);
    for (int l = 0; l < load_points; ++l)
      EXPECT_NEAR(problem.linear_response()[l], std::real(x * std::polar(1.0, two_pi * l / load_points)),
                  1e-14 * std::abs(x) + 1e-18);
  }
}

// Random chain with forces of three derivatives and a static part, in every kind of pair.
LinearStructure driven_chain(std::mt19937& generator) {
  LinearStructure chain = testing::random_chain(5, generator);
  chain.contact_directions = contact_rows({1, 4}, 5);
  for (int d = 0; d < 3; ++d) {
    Eigen::VectorXcd series = testing::random_vector(4, generator).cast<Complex>();
    series += Complex(0.0, 1.0) * testing::random_vector(4, generator);
    series[0] = series[0].real();
    chain.forces.push_back({testing::random_vector(5, generator), series, d});
  }
  return chain;
}

TEST(SeveralLoads, HaveSlopesByFrequencyAndScaleOfTheDifferenceQuotients) {
  std::mt19937 generator(11);
  const LinearStructure chain = driven_chain(generator);
  const double frequency = 0.13, h = 1e-6;
  for (TimePair& pair : testing::pair_kinds(16, 64)) {
    CondensedProblem problem(std::move(pair), chain, testing::cosine_load());
    problem.set_load_scale(0.7);
    const auto at = [&](double f, double scale) {
      problem.set_frequency(f);
      problem.set_load_scale(scale);
      return problem.linear_response();
    };
    const Eigen::VectorXd by_frequency = (at(frequency + h, 0.7) - at(frequency - h, 0.7)) / (2.0 * h);
    const Eigen::VectorXd by_scale = at(frequency, 1.7) - at(frequency, 0.7);
    at(frequency, 0.7);
    const Eigen::VectorXd found = problem.linear_response_slope();
    EXPECT_LE((found - by_frequency).norm(), 1e-6 * found.norm());
    EXPECT_LE((problem.linear_response_by_scale() - by_scale).norm(), 1e-12 * by_scale.norm());
  }
}

TEST(SeveralLoads, GiveTheMotionOfTheAssembledSystemWithContactInEveryKindOfPair) {
  std::mt19937 generator(12);
  const LinearStructure chain = driven_chain(generator);
  const double frequency = 0.11, scale = 0.6;
  constexpr int functions = 16, samples = 64;
  const std::vector<TimePair> pairs = testing::pair_kinds(functions, samples);
  for (const TimePair& pair : pairs) {
    if (pair.drops_nyquist()) continue;
    CondensedProblem problem(pair, chain, testing::cosine_load());
    problem.set_load_scale(scale);
    problem.set_frequency(frequency);
    const LinearContact law{4.0, 0.3 * problem.linear_response().maxCoeff()};
    const PeriodicResponse response = testing::solved_response(problem, ContactLaws(law));
    EXPECT_GT(response.contact_force.maxCoeff(), 0.0);
    TimePairOptions options{pair.formulation(), pair.inner_products(), pair.points()};
    options.sample_offset = pair.first_sample() * pair.points();
    const auto discretised = [&](const Eigen::VectorXcd& harmonics) {
      return dense::discretise(pair.trial(), pair.weight(), options, harmonics);
    };
    dense::DenseSystem oracle(chain, ContactLaws(law), discretised(scale * testing::cosine_load()));
    for (const PeriodicForce& force : chain.forces) {
      Eigen::VectorXcd amplitudes = force.amplitudes(frequency);
      amplitudes.tail(amplitudes.size() - 1) *= scale;
      oracle.add_load(force.shape, discretised(amplitudes).load);
    }
    oracle.set_frequency(frequency);
    const Eigen::VectorXd expected =
        oracle.contact_displacement(oracle.forced_response(response.contact_force));
    EXPECT_LE((problem.displacement(response.contact_force) - expected).norm(), 1e-10 * expected.norm());
    EXPECT_LE(oracle.relative_residual(oracle.forced_response(response.contact_force)), 1e-9);
  }
}

TEST(SeveralLoads, AScaleThatIsNotFiniteIsRefused) {
  CondensedProblem problem = testing::fourier_problem(Oscillator{}.structure(), 3, 8);
  EXPECT_EQ(testing::refusal([&] { problem.set_load_scale(std::nan("")); }),
            "CondensedProblem::set_load_scale: scale is nan; it must be finite");
}

}  // namespace
}  // namespace wavebalance::solvers
