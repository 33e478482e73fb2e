#include "branches/perturbation.hpp"
#include "support/oscillator.hpp"
#include "support/refusal.hpp"
#include "support/small_problems.hpp"
#include "support/solved.hpp"
#include "testing.hpp"
#include "wavebalance/contact/rigid_law.hpp"
#include "wavebalance/solvers/branches/branches.hpp"
#include "wavebalance/solvers/branches/subharmonic_response.hpp"
#include "wavebalance/solvers/modes/elastic_mode.hpp"
#include "wavebalance/solvers/response/motion_periods.hpp"
#include "wavebalance/solvers/response/refinement.hpp"

// Samples at the middles of the intervals, t_l = (l + 1/2) / N.
namespace wavebalance::solvers {
namespace {

using testing::CubicBasis;
using testing::HaarBasis;
using testing::make_pair;
using Complex = std::complex<double>;
using spectral::FourierBasis;

struct Bases {
  const char* name;
  AnyTimeBasis trial, weight;
  Formulation formulation;
};

std::vector<Bases> all_bases() {
  const FourierBasis sines(8, spectral::Nyquist::sine);
  std::vector<Bases> all{{"Haar:Fourier", HaarBasis{8}, sines, Formulation::distributional},
                         {"Haar:odd Fourier", HaarBasis{7}, FourierBasis(7), Formulation::distributional},
                         {"Fourier:Haar", sines, HaarBasis{8}, Formulation::strong}};
  for (const auto formulation : {Formulation::strong, Formulation::weak, Formulation::distributional}) {
    all.push_back({"cubic:cubic", CubicBasis{8}, CubicBasis{8}, formulation});
    all.push_back({"Fourier:Fourier", FourierBasis(8), FourierBasis(8), formulation});
    all.push_back({"cubic:Fourier", CubicBasis{8}, FourierBasis(8), formulation});
  }
  return all;
}

TimePair pair_of(const Bases& bases, int points, double sample_offset) {
  return make_pair(bases.trial, bases.weight, points, bases.formulation, InnerProducts::quadrature,
                   NyquistCoefficient::keep, sample_offset);
}

// The middles are the points that 2N left ends have more than N.
TEST(SampleOffset, SumsOverMiddlesAndLeftEndsAreTogetherThoseOfTwiceAsManyPoints) {
  Eigen::VectorXcd harmonics(4);
  harmonics << 0.7, Complex(1.0, -0.4), 0.0, Complex(0.2, 0.3);
  for (const Bases& bases : all_bases())
    for (const int points : {2 * bases.trial.functions(), 8 * bases.trial.functions()}) {
      SCOPED_TRACE(bases.name + std::string(", N ") + std::to_string(points));
      const TimePair fine = pair_of(bases, 2 * points, 0.0);
      const TimePair left = pair_of(bases, points, 0.0), middle = pair_of(bases, points, 0.5);
      for (int d = 0; d <= 2; ++d) {
        const Eigen::VectorXcd mean = 0.5 * (left.symbol(d) + middle.symbol(d));
        EXPECT_LE((mean - fine.symbol(d)).norm(), 1e-13 * fine.symbol(d).norm()) << "derivative " << d;
      }
      const Eigen::VectorXcd mean = 0.5 * (left.load(harmonics) + middle.load(harmonics));
      EXPECT_LE((mean - fine.load(harmonics)).norm(), 1e-13 * mean.norm());
    }
}

TEST(SampleOffset, DoesNotChangeTheLinearPartsOfHarmonicBalance) {
  for (const int functions : {7, 8})
    for (const int points : {30, 64}) {
      const TimePair left = testing::fourier_pair(functions, points);
      const TimePair middle = testing::fourier_pair(functions, points, NyquistCoefficient::keep, 0.5);
      for (int d = 0; d <= 2; ++d)
        EXPECT_LE((left.symbol(d) - middle.symbol(d)).norm(), 1e-14 * left.symbol(d).norm());
      EXPECT_LE((left.load(testing::cosine_load()) - middle.load(testing::cosine_load())).norm(), 1e-15);
    }
}

TEST(SampleOffset, DoesNotMoveExactInnerProducts) {
  const auto exact = [](double sample_offset) {
    return make_pair(HaarBasis{8}, FourierBasis(8, spectral::Nyquist::sine), 32, Formulation::distributional,
                     InnerProducts::exact, NyquistCoefficient::keep, sample_offset);
  };
  for (int d = 0; d <= 2; ++d) EXPECT_EQ(exact(0.0).symbol(d), exact(0.5).symbol(d));
  EXPECT_EQ(exact(0.0).load(testing::cosine_load()), exact(0.5).load(testing::cosine_load()));
}

TEST(SampleOffset, IsHalfOrNothing) {
  for (const double wrong : {0.25, 1.0, -0.5, std::nan("")})
    EXPECT_NE(testing::refusal([&] {
                testing::fourier_pair(7, 32, NyquistCoefficient::keep, wrong);
              }).find("it must be 0 or 0.5"),
              std::string::npos)
        << wrong;
}

TEST(SampleOffset, RefusesANyquistCoefficientThatVanishesAtTheMiddles) {
  const auto middles = [](const AnyTimeBasis& trial, const AnyTimeBasis& weight, int points,
                          NyquistCoefficient nyquist, InnerProducts products = InnerProducts::quadrature) {
    return make_pair(trial, weight, points, Formulation::distributional, products, nyquist, 0.5);
  };
  const FourierBasis fourier(8);
  using enum NyquistCoefficient;
  for (const AnyTimeBasis& trial :
       {AnyTimeBasis(fourier), AnyTimeBasis(CubicBasis{8}), AnyTimeBasis(HaarBasis{8})})
    EXPECT_NE(testing::refusal([&] {
                middles(trial, fourier, 8, keep);
              }).find("vanishes at the middles of 8 intervals"),
              std::string::npos);
  EXPECT_NE(testing::refusal([&] {
              middles(HaarBasis{8}, fourier, 64, keep);
            }).find("the Nyquist coefficient of the 8 functions dropped"),
            std::string::npos);
  EXPECT_NO_THROW(middles(HaarBasis{8}, FourierBasis(8, spectral::Nyquist::sine), 64, keep));
  EXPECT_NO_THROW(middles(fourier, fourier, 8, drop));
  EXPECT_NO_THROW(middles(fourier, fourier, 16, keep));
  EXPECT_NO_THROW(middles(fourier, fourier, 8, keep, InnerProducts::exact));
  EXPECT_NO_THROW(make_pair(FourierBasis(7), FourierBasis(7), 7));
}

TEST(SampleOffset, IsRefusedByModesAndByRefinements) {
  const TimePair middle = testing::fourier_pair(7, 32, NyquistCoefficient::keep, 0.5);
  EXPECT_NE(
      testing::refusal([&] { require_free_motions(middle); }).find("sample_offset of 0.5; it must be 0"),
      std::string::npos);
  const auto problem = [](int functions, int points) {
    CondensedProblem made(testing::fourier_pair(functions, points, NyquistCoefficient::keep, 0.5),
                          testing::jl14_bar(3, 1e-4), testing::cosine_load());
    made.set_frequency(150.0);
    return made;
  };
  EXPECT_NE(testing::refusal([&] {
              response_to_tolerance(problem, testing::jl14_case_1.law, {});
            }).find("sample_offset of 0.5; it must be 0"),
            std::string::npos);
}

// A load of `periods` periods that is `advance` (periods of the motion) ahead of a cosine.
CondensedProblem problem_of(TimePair pair, const LinearStructure& structure, double frequency,
                            double advance = 0.0, int periods = 1) {
  Eigen::VectorXcd load = Eigen::VectorXcd::Zero(periods + 1);
  load[periods] = std::polar(1.0, two_pi * periods * advance);
  CondensedProblem problem(std::move(pair), structure, load);
  problem.set_frequency(frequency / periods);
  return problem;
}

constexpr int offset_points = 256;

TimePair harmonics_at(double sample_offset, int periods = 1) {
  return testing::fourier_pair(62 * periods + 1, offset_points * periods, NyquistCoefficient::keep,
                               sample_offset);
}

void expect_later(const PeriodicStiffness& later, const PeriodicStiffness& stiffness, double by) {
  ASSERT_EQ(later.intervals.size(), stiffness.intervals.size());
  for (std::size_t i = 0; i < later.intervals.size(); ++i) {
    EXPECT_NEAR(std::remainder(later.intervals[i].begin - stiffness.intervals[i].begin - by, 1.0), 0.0, 1e-9);
    EXPECT_NEAR(later.intervals[i].length(), stiffness.intervals[i].length(), 1e-9);
  }
}

// Harmonics shift with the time: what is sampled at the middles under a cosine is what is sampled at the left
// ends under a load that is half a sample ahead.
TEST(SampleOffset, OfHarmonicBalanceIsAShiftOfTheLoad) {
  const auto& scene = testing::jl14_case_2;
  const LinearStructure bar = testing::jl14_bar(25, 5e-6);
  CondensedProblem middle = problem_of(harmonics_at(0.5), bar, 1275.0);
  CondensedProblem ahead = problem_of(harmonics_at(0.0), bar, 1275.0, 0.5 / offset_points);
  const ContactDynamics dynamics(bar);
  for (const auto form : {ContactForm::displacement, ContactForm::force}) {
    ForcedResponseOptions options;
    options.form = form;
    const auto u = testing::solved_response(middle, scene.law, options),
               v = testing::solved_response(ahead, scene.law, options);
    ASSERT_GT(u.contact_force.maxCoeff(), 0.0);
    EXPECT_LE((u.displacement - v.displacement).norm(), 1e-9 * u.displacement.norm());
    EXPECT_LE((u.contact_force - v.contact_force).norm(), 1e-7 * u.contact_force.norm());
    expect_later(contact_stiffness(middle, scene.law, u), contact_stiffness(ahead, scene.law, v),
                 0.5 / offset_points);
    EXPECT_EQ(unstable_multipliers(dynamics, middle, scene.law, u).count,
              unstable_multipliers(dynamics, ahead, scene.law, v).count);
  }
}

// Cubics through the samples, and lines through samples of Haar functions, begin where the samples do.
TEST(SampleOffset, IntervalsOfContactAreThoseOfTheTimesOfTheSamples) {
  const LinearStructure bar = testing::jl14_bar(25, 5e-6);
  const auto& law = testing::jl14_case_2.law;
  for (const AnyTimeBasis& trial : {AnyTimeBasis(CubicBasis{64}), AnyTimeBasis(HaarBasis{64})}) {
    const auto intervals = [&](double sample_offset) {
      auto problem = problem_of(make_pair(trial, FourierBasis(64), 1024, Formulation::distributional,
                                          InnerProducts::quadrature, NyquistCoefficient::drop, sample_offset),
                                bar, 1275.0);
      return contact_stiffness(problem, law, forced_response(problem, law, {})).intervals;
    };
    const auto left = intervals(0.0), middle = intervals(0.5);
    ASSERT_EQ(left.size(), 1u);
    ASSERT_EQ(middle.size(), 1u);
    const double half_a_sample = 0.5 / 1024;
    EXPECT_NEAR(left[0].length(), middle[0].length(), 1.1 * 2.0 / 1024);
    const bool smooth = trial.pointwise_derivatives() > 0;
    EXPECT_NEAR(left[0].begin, middle[0].begin, (smooth ? 0.2 : 2.0) * half_a_sample);
  }
}

// The motions of a perturbation at the middles are the additional ones of twice as many left ends.
TEST(SampleOffset, PerturbationsAreThoseAtTheTimesOfTheSamples) {
  FloquetExponent exponent;
  exponent.multiplier = -1.0;
  exponent.displacement = Eigen::MatrixXcd::Zero(1, 5);
  exponent.displacement << Complex(0.1, 0.3), Complex(-0.2, 0.1), 0.4, Complex(0.5, -0.1), 0.2;
  exponent.force = 7.0 * exponent.displacement;
  const Eigen::VectorXd fine = perturbation(exponent, 2, testing::fourier_pair(31, 128)).displacement;
  const Eigen::VectorXd left = perturbation(exponent, 2, testing::fourier_pair(31, 64)).displacement;
  const Eigen::VectorXd middle =
      perturbation(exponent, 2, testing::fourier_pair(31, 64, NyquistCoefficient::keep, 0.5)).displacement;
  const auto along = [](const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
    return std::abs(a.dot(b)) / (a.norm() * b.norm());
  };
  EXPECT_NEAR(along(middle, fine(Eigen::seqN(1, 64, 2))), 1.0, 1e-12);
  EXPECT_NEAR(along(left, fine(Eigen::seqN(0, 64, 2))), 1.0, 1e-12);
  EXPECT_LT(along(middle, left), 0.999);
}

}  // namespace
}  // namespace wavebalance::solvers
