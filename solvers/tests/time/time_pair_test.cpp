#include "wavebalance/solvers/time/time_pair.hpp"

#include "support/refusal.hpp"
#include "support/small_problems.hpp"
#include "testing.hpp"

namespace wavebalance::solvers {
namespace {

using testing::CubicBasis;
using testing::HaarBasis;
using testing::make_pair;
using Complex = std::complex<double>;
using spectral::FourierBasis;
using spectral::Nyquist;

// A basis of given smoothness whose values do not matter.
struct Smoothness {
  double exponent;
  int derivatives;
  int functions() const { return 8; }
  Eigen::VectorXd samples(int points, int) const { return Eigen::VectorXd::Ones(points); }
  Complex fourier_coefficient(int n) const { return n == 0 ? 1.0 : 0.0; }
  double sobolev_exponent() const { return exponent; }
  int pointwise_derivatives() const { return derivatives; }
  bool band_limited() const { return false; }
};

Admissibility verdict(const AnyTimeBasis& trial, const AnyTimeBasis& weight,
                      Formulation formulation = Formulation::distributional,
                      InnerProducts products = InnerProducts::exact) {
  return admissibility(trial, weight, formulation, products);
}

TEST(TimePair, FourierSymbolIsThatOfTheDerivative) {
  for (const auto formulation : {Formulation::strong, Formulation::weak, Formulation::distributional})
    for (const auto products : {InnerProducts::quadrature, InnerProducts::exact})
      for (const int points : {9, 30, 64}) {
        const TimePair pair = make_pair(FourierBasis(9), FourierBasis(9), points, formulation, products);
        for (int d = 0; d <= 2; ++d)
          for (int k = 0; k <= 4; ++k) {
            const Complex expected = std::pow(Complex(0.0, two_pi * k), d) / 9.0;
            EXPECT_LE(std::abs(pair.symbol(d)[k] - expected), 200 * eps * std::pow(two_pi * 4, d))
                << "d " << d << " k " << k << " N " << points;
          }
      }
}

TEST(TimePair, NyquistCosineIsBlindToTheFirstDerivative) {
  const TimePair pair = make_pair(FourierBasis(8), FourierBasis(8), 32);
  EXPECT_NEAR(std::abs(pair.symbol(1)[4]), 0.0, 100 * eps);
  EXPECT_NEAR(pair.symbol(2)[4].real(), -std::pow(two_pi * 4, 2) / 16.0, 1e-11);
}

// \int p_i'' q_j over one cell is a difference of p_i', \int -p_i' q_j one of p_i.
TEST(TimePair, ExactHaarFourierSymbolIsThatOfTheCellIntegrals) {
  const int functions = 7;
  const FourierBasis fourier(functions);
  const TimePair pair =
      make_pair(HaarBasis{functions}, fourier, 28, Formulation::distributional, InnerProducts::exact);
  const auto weight_at = [&](int i, int node, int derivative) {
    return fourier.samples(functions, derivative)[(node - i + 2 * functions) % functions];
  };
  for (int k = 0; k <= functions / 2; ++k) {
    Complex first = 0.0, second = 0.0;
    for (int i = 0; i < functions; ++i) {
      const Complex phase = std::polar(1.0, -two_pi * k * i / functions);
      first -= phase * (weight_at(i, 1, 0) - weight_at(i, 0, 0));
      second += phase * (weight_at(i, 1, 1) - weight_at(i, 0, 1));
    }
    EXPECT_LE(std::abs(pair.symbol(1)[k] - first), 1e-13 * functions);
    EXPECT_LE(std::abs(pair.symbol(2)[k] - second), 1e-12 * functions * functions);
  }
}

// The rectangle rule integrates band-limited products exactly and spline products to the smoothness of the
// integrand: the three forms are one for the first, and approach each other with the points for the second.
TEST(TimePair, FormulationsApproachEachOtherWithThePoints) {
  double last = 1.0;
  for (const int points : {32, 64, 128}) {
    const TimePair strong = make_pair(CubicBasis{8}, CubicBasis{8}, points, Formulation::strong);
    const TimePair weak = make_pair(CubicBasis{8}, CubicBasis{8}, points, Formulation::weak);
    const double difference = (strong.symbol(2) - weak.symbol(2)).norm() / weak.symbol(2).norm();
    EXPECT_GT(difference, 1e-8);
    EXPECT_LT(difference, 0.3 * last);
    last = difference;
  }
}

TEST(TimePair, SineNyquistOfTheWeightSeesTheInertiaOfHaarFunctions) {
  const auto last = [](Nyquist nyquist) {
    const TimePair pair = make_pair(HaarBasis{8}, FourierBasis(8, nyquist), 256, Formulation::distributional,
                                    InnerProducts::exact);
    return std::abs(pair.symbol(2)[4]);
  };
  EXPECT_LT(last(Nyquist::cosine), 1e-12);
  EXPECT_GT(last(Nyquist::sine), 1.0);
}

TEST(TimePair, LoadIsProjectedByTheSameRuleAsTheInnerProducts) {
  Eigen::VectorXcd harmonics(4);
  harmonics << 0.7, Complex(1.0, -0.4), 0.0, Complex(0.2, 0.3);
  const auto value = [&](double t) {
    double sum = 0.0;
    for (int n = 0; n < 4; ++n) sum += (harmonics[n] * std::polar(1.0, two_pi * n * t)).real();
    return sum;
  };
  for (const auto products : {InnerProducts::quadrature, InnerProducts::exact}) {
    const TimePair pair = make_pair(FourierBasis(8), CubicBasis{8}, 32, Formulation::strong, products);
    const int rule = products == InnerProducts::quadrature ? 32 : 8192;
    const Eigen::VectorXcd load = pair.load(harmonics);
    const Eigen::VectorXd weight = CubicBasis{8}.samples(rule, 0);
    for (int k = 0; k <= 4; ++k) {
      Complex expected = 0.0;
      for (int i = 0; i < 8; ++i)
        for (int l = 0; l < rule; ++l)
          expected += std::polar(1.0 / rule, -two_pi * k * i / 8) * weight[l] *
                      value((double(l) + double(i) * rule / 8) / rule);
      EXPECT_LE(std::abs(load[k] - expected), 1e-12);
    }
  }
}

TEST(TimePair, ShiftPeriodIsOneForFiltersAndPointsPerTranslateOtherwise) {
  EXPECT_EQ(testing::fourier_pair(7, 30).shift_period(), 1);
  EXPECT_EQ(testing::fourier_pair(8, 32).shift_period(), 4);
  EXPECT_EQ(testing::fourier_pair(8, 30).shift_period(), 15);
  EXPECT_EQ(make_pair(HaarBasis{8}, FourierBasis(8), 64).shift_period(), 8);
}

TEST(Admissibility, AsksForASobolevSumAboveTwo) {
  EXPECT_FALSE(verdict(HaarBasis{}, HaarBasis{}).admissible);
  EXPECT_TRUE(verdict(HaarBasis{}, CubicBasis{}).admissible);
  EXPECT_TRUE(verdict(HaarBasis{}, FourierBasis(8)).admissible);
  EXPECT_FALSE(verdict(Smoothness{1.0, 0}, Smoothness{1.0, 0}).admissible) << "a sum of exactly 2";
  EXPECT_TRUE(verdict(Smoothness{1.415, 1}, Smoothness{1.415, 1}).admissible);
  const std::string reason = verdict(HaarBasis{}, Smoothness{1.415, 1}).reason;
  EXPECT_NE(reason.find("0.5"), std::string::npos) << reason;
  EXPECT_NE(reason.find("1.415"), std::string::npos) << reason;
  EXPECT_THROW(make_pair(HaarBasis{}, HaarBasis{}, 32), InadmissiblePair);
}

TEST(Admissibility, AsksForTheDerivativesThatTheFormulationSamples) {
  const auto sampled = [](const AnyTimeBasis& trial, const AnyTimeBasis& weight, Formulation formulation) {
    return verdict(trial, weight, formulation, InnerProducts::quadrature);
  };
  const Smoothness db6{1.415, 1};
  EXPECT_FALSE(sampled(HaarBasis{}, FourierBasis(8), Formulation::strong).admissible);
  EXPECT_FALSE(sampled(HaarBasis{}, FourierBasis(8), Formulation::weak).admissible);
  EXPECT_TRUE(sampled(HaarBasis{}, FourierBasis(8), Formulation::distributional).admissible);
  EXPECT_FALSE(sampled(FourierBasis(8), HaarBasis{}, Formulation::distributional).admissible);
  EXPECT_TRUE(sampled(FourierBasis(8), HaarBasis{}, Formulation::strong).admissible);
  EXPECT_FALSE(sampled(db6, db6, Formulation::strong).admissible);
  EXPECT_TRUE(sampled(db6, db6, Formulation::weak).admissible);
  EXPECT_FALSE(sampled(db6, db6, Formulation::distributional).admissible);
  const std::string reason = sampled(HaarBasis{}, FourierBasis(8), Formulation::strong).reason;
  EXPECT_NE(reason.find("derivative 2 of the trial"), std::string::npos) << reason;
}

TEST(TimePair, SaysWhichSizesDoNotFit) {
  const auto differ = testing::refusal([] { make_pair(FourierBasis(8), FourierBasis(9), 32); });
  EXPECT_NE(differ.find("has 8 functions and the weighting basis 9"), std::string::npos) << differ;
  const auto few = testing::refusal([] { make_pair(FourierBasis(9), FourierBasis(9), 8); });
  EXPECT_NE(few.find("quadrature_points is 8; at least as many as the 9"), std::string::npos) << few;
  const auto ragged = testing::refusal([] { make_pair(HaarBasis{8}, FourierBasis(8), 30); });
  EXPECT_NE(ragged.find("quadrature_points is 30; it must be a multiple of the 8"), std::string::npos)
      << ragged;
}

TEST(TimePair, ExactProductsOfTwoWaveletsAreAskedOfTheCaller) {
  TimePairOptions options;
  options.nyquist = NyquistCoefficient::keep;
  options.inner_products = InnerProducts::exact;
  options.quadrature_points = 32;
  const auto make = [&] { TimePair(CubicBasis{8}, CubicBasis{8}, options); };
  EXPECT_NE(testing::refusal(make).find("need exact_column"), std::string::npos);
  options.exact_column = [](int) { return Eigen::VectorXd::Ones(7); };
  EXPECT_NE(testing::refusal(make).find("returned 7 values; 8 functions"), std::string::npos);
  options.exact_column = [](int d) { return Eigen::VectorXd(Eigen::VectorXd::Unit(8, d)); };
  const TimePair pair(CubicBasis{8}, CubicBasis{8}, options);
  for (int k = 0; k <= 4; ++k)
    EXPECT_LE(std::abs(pair.symbol(2)[k] - std::polar(1.0, -two_pi * 2 * k / 8)), 10 * eps);
}

}  // namespace
}  // namespace wavebalance::solvers
