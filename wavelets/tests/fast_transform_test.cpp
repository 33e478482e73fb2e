#include "wavebalance/wavelets/fast_transform.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "constants.hpp"
#include "wavebalance/wavelets/filter.hpp"
#include "wavebalance/wavelets/periodic_basis.hpp"

namespace wavebalance::wavelets {
namespace {

TEST(FastWaveletTransform, OfHaarIsSumsAndDifferences) {
  const FastWaveletTransform transform(daubechies_filter(2));
  const Eigen::VectorXd result = transform.analysis(Eigen::Vector4d(1, 2, 4, 8), 2);
  const double r = std::sqrt(2.0);
  EXPECT_LT((result - Eigen::Vector4d(7.5, -4.5, -1 / r, -4 / r)).cwiseAbs().maxCoeff(), 16 * eps);
}

TEST(FastWaveletTransform, LeavesNoDetailOfAConstant) {
  for (const int length : {2, 6, 12, 40}) {
    const FastWaveletTransform transform(daubechies_filter(length));
    const Eigen::VectorXd result = transform.analysis(Eigen::VectorXd::Ones(32), 5);
    EXPECT_NEAR(result[0], std::sqrt(32.0), 64 * eps);
    EXPECT_LT(result.tail(31).cwiseAbs().maxCoeff(), 64 * eps) << length;
  }
}

TEST(FastWaveletTransform, LeavesNoDetailOfAPolynomialAwayFromTheWrap) {
  for (const int length : {4, 8, 12}) {
    const FastWaveletTransform transform(daubechies_filter(length));
    Eigen::VectorXd signal(64);
    for (int k = 0; k < 64; ++k) signal[k] = std::pow(k / 64.0, length / 2 - 1);
    const Eigen::VectorXd detail = transform.analysis(signal, 1).tail(32);
    EXPECT_LT(detail.head(32 - length / 2 + 1).cwiseAbs().maxCoeff(), 64 * eps) << length;
    EXPECT_GT(detail.cwiseAbs().maxCoeff(), 1e-2);
  }
}

// The scaling function of the coarser level, written in the finer one, is one column of the synthesis.
TEST(FastWaveletTransform, IsTheTwoScaleRelationOfThePeriodizedFunctions) {
  for (const int length : {2, 6, 20})
    for (const int level : {1, 2, 4}) {
      const auto phi = ScalingFunction::daubechies(length);
      const int fine = 1 << level, points = 8 * fine;
      const Eigen::VectorXd g = PeriodicBasis(phi, level).samples(points, 0) * std::sqrt(fine);
      const Eigen::VectorXd coarse = PeriodicBasis(phi, level - 1).samples(points, 0) * std::sqrt(fine / 2);
      const FastWaveletTransform transform(phi.filter());
      const Eigen::VectorXd s = transform.synthesis(Eigen::VectorXd::Unit(fine, 0), 1);
      Eigen::VectorXd sum = Eigen::VectorXd::Zero(points);
      for (int k = 0; k < fine; ++k)
        for (int l = 0; l < points; ++l) sum[l] += s[k] * g[(l - 8 * k + points) % points];
      EXPECT_LT((sum - coarse).cwiseAbs().maxCoeff(), 512 * eps) << phi.name() << " level " << level;
    }
}

TEST(FastWaveletTransform, OfNoLevelsIsTheIdentity) {
  const FastWaveletTransform transform(daubechies_filter(6));
  const Eigen::VectorXd signal = Eigen::VectorXd::LinSpaced(7, 0, 1);
  EXPECT_EQ(transform.analysis(signal, 0), signal);
  EXPECT_EQ(transform.synthesis(signal, 0), signal);
}

TEST(FastWaveletTransformErrors, NameTheArgument) {
  EXPECT_THROW(FastWaveletTransform{bspline_filter(3)}, std::invalid_argument);
  EXPECT_THROW(FastWaveletTransform{Eigen::VectorXd()}, std::invalid_argument);
  EXPECT_THROW(FastWaveletTransform{2.0 * daubechies_filter(4)}, std::invalid_argument);
  const FastWaveletTransform transform(daubechies_filter(4));
  EXPECT_THROW(transform.analysis(Eigen::VectorXd::Ones(12), 3), std::invalid_argument);
  EXPECT_THROW(transform.synthesis(Eigen::VectorXd::Ones(12), 3), std::invalid_argument);
  EXPECT_THROW(transform.analysis(Eigen::VectorXd::Ones(8), -1), std::invalid_argument);
  EXPECT_THROW(transform.analysis(Eigen::VectorXd(), 0), std::invalid_argument);
}

// The analysis of one level maps a smooth function's coefficients to coefficients of translates twice as
// wide, which are known from their inner products.
TEST(TwoScaleFilter, OfTheOrthonormalSplineIsOrthonormalAndRefinesItsTranslates) {
  const auto phi = ScalingFunction::orthonormal_bspline();
  const TwoScaleFilter filter = two_scale_filter(phi);
  EXPECT_EQ(filter.first % 2, 0);
  EXPECT_NEAR(filter.values.sum(), 2.0, 512 * eps);
  for (int shift = 0; shift < 8; shift += 2) {
    const Eigen::Index overlap = filter.values.size() - shift;
    EXPECT_NEAR(filter.values.head(overlap).dot(filter.values.tail(overlap)), shift == 0 ? 2.0 : 0.0, 1e-12);
  }
  const PeriodicBasis coarse(phi, 4), fine(phi, 5);
  const Eigen::VectorXd wide = coarse.samples(256, 0), narrow = fine.samples(256, 0);
  Eigen::VectorXd refined = Eigen::VectorXd::Zero(256);
  for (Eigen::Index l = 0; l < filter.values.size(); ++l)
    for (int i = 0; i < 256; ++i) {
      const auto from = i - (filter.first + l) * 8;
      refined[i] += filter.values[l] * narrow[((from % 256) + 256) % 256];
    }
  EXPECT_LT((refined - wide).cwiseAbs().maxCoeff(), 1e-11 * wide.cwiseAbs().maxCoeff());
  EXPECT_EQ(two_scale_filter(ScalingFunction::daubechies(6)).values, daubechies_filter(6));
}

}  // namespace
}  // namespace wavebalance::wavelets
