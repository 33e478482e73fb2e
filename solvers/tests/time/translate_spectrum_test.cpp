#include "wavebalance/solvers/time/translate_spectrum.hpp"

#include <gtest/gtest.h>

#include "support/small_problems.hpp"

namespace wavebalance::solvers {
namespace {

using spectral::FourierBasis;
using testing::CubicBasis;
using testing::HaarBasis;

// sum_j a_j g(t - j/M) at t = l/points, from samples of g on a grid that holds all differences.
Eigen::VectorXd direct_sum(const AnyTimeBasis& basis, const Eigen::VectorXd& a, int points, int derivative) {
  const int functions = basis.functions();
  const int fine = points * functions;
  const Eigen::VectorXd g = basis.samples(fine, derivative);
  Eigen::VectorXd values = Eigen::VectorXd::Zero(points);
  for (int l = 0; l < points; ++l)
    for (int j = 0; j < functions; ++j) values[l] += a[j] * g[(l * functions - j * points + fine) % fine];
  return values;
}

TEST(TrialEvaluator, EqualsTheSumOverTranslates) {
  std::mt19937 generator(1);
  for (const int functions : {7, 8})
    for (const AnyTimeBasis& basis :
         {AnyTimeBasis(FourierBasis(functions)), AnyTimeBasis(HaarBasis{functions}),
          AnyTimeBasis(CubicBasis{functions})})
      for (const int factor : {1, 4})
        for (int derivative = 0; derivative <= std::min(2, basis.pointwise_derivatives()); ++derivative) {
          const int points = factor * functions;
          const Eigen::VectorXd a = testing::random_vector(functions, generator);
          TrialEvaluator evaluate(basis, points, derivative);
          const Eigen::VectorXd expected = direct_sum(basis, a, points, derivative);
          EXPECT_LE((evaluate(translate_spectrum(a)) - expected).norm(), 1e-12 * expected.norm());
        }
}

TEST(TrialEvaluator, TakesFewerPointsThanFunctions) {
  std::mt19937 generator(2);
  const Eigen::VectorXd a = testing::random_vector(8, generator);
  for (const AnyTimeBasis& basis : {AnyTimeBasis(FourierBasis(8)), AnyTimeBasis(CubicBasis{8})}) {
    TrialEvaluator evaluate(basis, 4, 0);
    EXPECT_LE((evaluate(translate_spectrum(a)) - direct_sum(basis, a, 4, 0)).norm(), 1e-13 * a.norm());
  }
  TrialEvaluator odd(FourierBasis(8), 3, 1);
  EXPECT_LE((odd(translate_spectrum(a)) - direct_sum(FourierBasis(8), a, 3, 1)).norm(), 1e-12 * a.norm());
}

TEST(TrialEvaluator, RefusesPointsThatMissTheTranslates) {
  EXPECT_THROW(TrialEvaluator(HaarBasis{8}, 12, 0), std::invalid_argument);
  EXPECT_THROW(TrialEvaluator(HaarBasis{8}, 0, 0), std::invalid_argument);
}

TEST(TranslateSpectrum, ComesBackAsTheCoefficients) {
  std::mt19937 generator(3);
  for (const int functions : {1, 2, 7, 8}) {
    const Eigen::VectorXd a = testing::random_vector(functions, generator);
    EXPECT_LE((translate_coefficients(translate_spectrum(a), functions) - a).norm(), 1e-15 * functions);
  }
  EXPECT_THROW(translate_coefficients(Eigen::VectorXcd::Zero(5), 7), std::invalid_argument);
}

}  // namespace
}  // namespace wavebalance::solvers
