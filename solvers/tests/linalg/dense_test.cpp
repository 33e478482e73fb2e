#include "linalg/dense.hpp"

#include "linalg/multipliers.hpp"
#include "testing.hpp"

namespace wavebalance::solvers::detail {
namespace {

// With eigenvalues of falling modulus, the first `largest`, and vectors that are far from orthogonal.
Eigen::MatrixXd matrix_with(double largest, Eigen::Index size) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Eigen::MatrixXd upper = Eigen::MatrixXd::NullaryExpr(size, size, [&] { return uniform(random); });
  upper = upper.triangularView<Eigen::StrictlyUpper>();
  for (Eigen::Index i = 0; i < size; ++i)
    upper(i, i) = largest * (i % 2 == 0 ? 1.0 : -1.0) / (1.0 + 0.1 * double(i));
  return upper;
}

TEST(PowersOfAMatrix, VanishWhereAllEigenvaluesLieWithinTheUnitCircle) {
  for (const double largest : {0.5, 0.9, 0.99}) {
    EXPECT_TRUE(powers_vanish(matrix_with(largest, 12))) << largest;
    EXPECT_EQ(count_outside_circle(matrix_with(largest, 12)), 0) << largest;
  }
}

TEST(PowersOfAMatrix, DoNotVanishWhereOneLiesOnItOrOutside) {
  for (const double largest : {1.0, 1.0 + 1e-9, 1.5, 1e80})
    EXPECT_FALSE(powers_vanish(matrix_with(largest, 12))) << largest;
  EXPECT_FALSE(powers_vanish(Eigen::MatrixXd::Constant(3, 3, std::nan(""))));
}

// exp(S D S^-1) = S exp(D) S^-1, with rates as of a structure whose fast modes have decayed.
TEST(Exponential, OfALargeMatrixIsThatOfItsEigenvalues) {
  constexpr Eigen::Index size = 60;
  Eigen::MatrixXd vectors = matrix_with(2.0, size);
  Eigen::VectorXd rates(size);
  for (Eigen::Index i = 0; i < size; ++i) rates[i] = -std::pow(10.0, -2.0 + 0.08 * double(i));
  vectors.diagonal().setConstant(4.0 * std::sqrt(double(size)));
  const Lu<double> inverse(vectors);
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(size, size);
  const Eigen::MatrixXd matrix = vectors * rates.asDiagonal() * inverse.solve(identity);
  const Eigen::MatrixXd expected =
      vectors * rates.array().exp().matrix().asDiagonal() * inverse.solve(identity);
  EXPECT_LT((exponential(matrix) - expected).norm(), 1e-11 * expected.norm());
  EXPECT_FALSE(exponential(Eigen::MatrixXd::Constant(size, size, std::nan(""))).allFinite());
}

TEST(CountOutsideTheCircle, IsThatOfTheEigenvalues) {
  EXPECT_EQ(count_outside_circle(matrix_with(1.05, 12)), 1);
  EXPECT_EQ(count_outside_circle(matrix_with(1.25, 12)), 3);
  EXPECT_EQ(count_outside_circle(Eigen::MatrixXd(0, 0)), 0);
  EXPECT_EQ(count_outside_circle(Eigen::MatrixXd::Constant(3, 3, std::nan(""))), -1);
}

// Rotations and one real factor in coordinates that are far from orthogonal.
Eigen::MatrixXd turning(double factor) {
  Eigen::MatrixXd turns = Eigen::MatrixXd::Zero(5, 5);
  for (const Eigen::Index i : {0, 2}) {
    const double angle = 0.3 + double(i);
    turns.block<2, 2>(i, i) << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  }
  turns(4, 4) = factor;
  const Eigen::MatrixXd vectors = matrix_with(2.0, 5);
  return vectors * turns * Lu<double>(vectors).solve(Eigen::MatrixXd(Eigen::MatrixXd::Identity(5, 5)));
}

TEST(CountOutsideTheCircle, IsNotKnownWhereEigenvaluesLieOnItWithinTheirErrors) {
  EXPECT_EQ(count_outside_circle(turning(0.5)), -1);
  EXPECT_EQ(count_outside_circle(turning(-1.0)), -1);
  EXPECT_EQ(count_outside_circle(turning(1.5)), 1);
  const Eigen::VectorXcd multipliers = map_multipliers(turning(-1.0));
  for (const std::complex<double> multiplier : multipliers) EXPECT_TRUE(lies_on_circle(multiplier));
}

TEST(CountOutsideTheCircle, KnowsWhatLiesBesideItByMoreThanTheErrors) {
  EXPECT_EQ(count_outside_circle((1.0 - 1e-8) * turning(0.5)), 0);
  EXPECT_EQ(count_outside_circle((1.0 + 1e-8) * turning(0.5)), 4);
}

TEST(FreeMultiplier, IsOnTheCircleWhereDampingIsRounding) {
  EXPECT_TRUE(lies_on_circle(free_multiplier({1e-14, 3.0})));
  EXPECT_FALSE(lies_on_circle(free_multiplier({-1e-8, 3.0})));
  EXPECT_FALSE(lies_outside_circle(free_multiplier({-1e-8, 3.0})));
}

}  // namespace
}  // namespace wavebalance::solvers::detail
