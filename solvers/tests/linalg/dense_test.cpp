#include "linalg/dense.hpp"

#include <gtest/gtest.h>

#include <random>

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

TEST(CountOutsideTheCircle, IsThatOfTheEigenvalues) {
  EXPECT_EQ(count_outside_circle(matrix_with(1.05, 12)), 1);
  EXPECT_EQ(count_outside_circle(matrix_with(1.25, 12)), 3);
  EXPECT_EQ(count_outside_circle(Eigen::MatrixXd(0, 0)), 0);
  EXPECT_EQ(count_outside_circle(Eigen::MatrixXd::Constant(3, 3, std::nan(""))), -1);
}

}  // namespace
}  // namespace wavebalance::solvers::detail
