#include "wavebalance/solvers/time/motion.hpp"

#include "support/local_bases.hpp"
#include "testing.hpp"
#include "wavebalance/solvers/time/motion_evaluator.hpp"
#include "wavebalance/spectral/fourier_basis.hpp"

namespace wavebalance::solvers {
namespace {

using spectral::FourierBasis;
using testing::HaarBasis;

TEST(Motion, OfOneContactIsItsRow) {
  const Motion motion{Eigen::MatrixXd{{1, 2, 3}, {4, 5, 6}}, Eigen::MatrixXd{{7, 8, 9}, {10, 11, 12}}, {}};
  const Motion second = motion.contact(1);
  EXPECT_EQ(second.rows(), 1);
  EXPECT_EQ(second.points(), 3);
  EXPECT_EQ(second.displacement, (Eigen::MatrixXd{{4, 5, 6}}));
  EXPECT_EQ(second.velocity, (Eigen::MatrixXd{{10, 11, 12}}));
  EXPECT_EQ(second.force.size(), 0);
  EXPECT_TRUE(Motion().contact(0).empty());
}

TEST(ByContact, ContactMajorSamplesBecomeARowPerContact) {
  EXPECT_EQ(by_contact(Eigen::VectorXd::LinSpaced(6, 1, 6), 2), (Eigen::MatrixXd{{1, 2, 3}, {4, 5, 6}}));
}

TEST(NearestSamples, AreTheLaterOnesOfTwoAndGoRoundThePeriod) {
  const Eigen::MatrixXd samples{{1, 2, 3}, {4, 5, 6}};
  EXPECT_EQ(nearest_samples(samples, 3), samples);
  EXPECT_EQ(nearest_samples(samples, 6), (Eigen::MatrixXd{{1, 2, 2, 3, 3, 1}, {4, 5, 5, 6, 6, 4}}));
  EXPECT_EQ(nearest_samples(samples, 2), (Eigen::MatrixXd{{1, 3}, {4, 6}}));
}

// Cell values 0, 1, 3, 2 make jumps 1, 2, -1, -2 at the left edges, held for half a cell on either side.
TEST(MotionEvaluator, HaarVelocityIsTheJumpOverTheCellWidth) {
  Eigen::VectorXd cells(4);
  cells << 0.0, 1.0, 3.0, 2.0;
  MotionEvaluator motion(HaarBasis{4}, 16);
  const Eigen::VectorXd velocity = motion.velocity(translate_spectrum(cells), 10.0);
  Eigen::VectorXd expected(16);
  expected << -2, -2, 1, 1, 1, 1, 2, 2, 2, 2, -1, -1, -1, -1, -2, -2;
  EXPECT_LE((velocity - 40.0 * expected).norm(), 1e-12);
}

TEST(MotionEvaluator, FourierVelocityIsTheDerivativeInSeconds) {
  const FourierBasis basis(5);
  MotionEvaluator motion(basis, 20);
  Eigen::VectorXd samples(5), expected(20);
  for (int j = 0; j < 5; ++j) samples[j] = std::sin(2 * std::numbers::pi * j / 5);
  for (int l = 0; l < 20; ++l)
    expected[l] = 2 * std::numbers::pi * 50.0 * std::cos(2 * std::numbers::pi * l / 20);
  EXPECT_LE((motion.velocity(translate_spectrum(samples), 50.0) - expected).norm(), 1e-10);
}

TEST(MotionEvaluator, EachColumnOfCoefficientsIsARowOfTheMotion) {
  Eigen::MatrixXcd coefficients(3, 2);
  coefficients.col(0) = translate_spectrum(Eigen::VectorXd::LinSpaced(5, 0, 1));
  coefficients.col(1) = translate_spectrum(Eigen::VectorXd::LinSpaced(5, 2, -1));
  MotionEvaluator evaluate(FourierBasis(5), 20);
  const Motion motion = evaluate(coefficients, 50.0);
  for (int row = 0; row < 2; ++row) {
    EXPECT_EQ(motion.displacement.row(row).transpose(), evaluate.displacement(coefficients.col(row)));
    EXPECT_EQ(motion.velocity.row(row).transpose(), evaluate.velocity(coefficients.col(row), 50.0));
  }
}

}  // namespace
}  // namespace wavebalance::solvers
