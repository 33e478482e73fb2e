#include "wavebalance/fem/bar.hpp"

#include "expect_error.hpp"
#include "symmetric_factor.hpp"
#include "testing.hpp"
#include "uniform_bar.hpp"

namespace wavebalance::fem {
namespace {

Eigen::VectorXd row_sums(const Eigen::SparseMatrix<double>& matrix) {
  return matrix * Eigen::VectorXd::Ones(matrix.cols());
}

// The matrices as the sums over elements that define them.
Eigen::MatrixXd summed(int elements, const Eigen::Matrix2d& element) {
  Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(elements + 1, elements + 1);
  for (int e = 0; e < elements; ++e) whole.block<2, 2>(e, e) += element;
  return whole.bottomRightCorner(elements, elements);
}

TEST(Bar, IsTheSumOfItsElements) {
  for (int elements : {1, 2, 3, 25})
    for (double lumped : {0.0, 0.25, 0.5, 1.0}) {
      BarOptions options = published_bar();
      options.elements = elements;
      options.lumped_fraction = lumped;
      const double size = options.length / elements;
      const double spring = options.youngs_modulus * options.area / size;
      const double weight = options.density * options.area * size;
      const Eigen::Matrix2d consistent = weight / 6 * (Eigen::Matrix2d() << 2, 1, 1, 2).finished();
      const Eigen::Matrix2d mass =
          (1 - lumped) * consistent + lumped * weight / 2 * Eigen::Matrix2d::Identity();
      const Matrices found = bar(options);
      const Eigen::MatrixXd stiffness =
          summed(elements, spring * (Eigen::Matrix2d() << 1, -1, -1, 1).finished());
      EXPECT_LE((Eigen::MatrixXd(found.stiffness) - stiffness).cwiseAbs().maxCoeff(), 4 * eps * spring);
      EXPECT_LE((Eigen::MatrixXd(found.mass) - summed(elements, mass)).cwiseAbs().maxCoeff(),
                4 * eps * weight);
    }
}

TEST(Bar, IsSymmetricTridiagonalAndCompressed) {
  BarOptions options{.elements = 100'000};
  const Matrices found = bar(options);
  for (const auto* matrix : {&found.mass, &found.stiffness, &found.damping}) {
    EXPECT_TRUE(matrix->isCompressed());
    EXPECT_EQ(matrix->nonZeros(), 3 * 100'000 - 2);
    EXPECT_EQ((*matrix - Eigen::SparseMatrix<double>(matrix->transpose())).norm(), 0.0);
  }
}

TEST(Bar, HasItsWholeMassButTheClampedShare) {
  for (double lumped : {0.0, 0.5, 1.0}) {
    BarOptions options{.lumped_fraction = lumped};
    const double weight = options.density * options.area * options.length;
    // The clamped node's diagonal entry and twice its coupling, of one element.
    const double clamped = weight / options.elements * (2.0 / 3.0 * (1 - lumped) + 0.5 * lumped);
    EXPECT_NEAR(row_sums(bar(options).mass).sum(), weight - clamped, 16 * eps * weight);
  }
}

TEST(Bar, TranslationStrainsTheClampedElementOnly) {
  const BarOptions options;
  const double spring = options.youngs_modulus * options.area * options.elements / options.length;
  Eigen::VectorXd forces = row_sums(bar(options).stiffness);
  EXPECT_NEAR(forces[0], spring, 4 * eps * spring);
  EXPECT_EQ(forces.tail(options.elements - 1).cwiseAbs().maxCoeff(), 0.0);
}

// Patch test: a tip force strains all elements alike, so the nodes lie on the exact straight line P x/(E A).
TEST(Bar, TipForceGivesTheExactDisplacement) {
  BarOptions options{.elements = 1000};
  const Matrices found = bar(options);
  const double force = 250e3;
  const detail::SymmetricFactor factor(found.stiffness);
  const Eigen::VectorXd u = factor.solve(force * Eigen::VectorXd::Unit(1000, 999));
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(1000, 1, 1000) / 1000 * options.length;
  const double tip = force * options.length / (options.youngs_modulus * options.area);
  EXPECT_LE((u - tip * x / options.length).cwiseAbs().maxCoeff(), 1000 * eps * tip);
}

TEST(Bar, DampingIsBetaTimesStiffness) {
  const Matrices found = bar(published_bar());
  EXPECT_LE((found.damping - 1e-4 * found.stiffness).norm(), eps * found.damping.norm());
  EXPECT_GT(found.damping.norm(), 0.0);
  EXPECT_EQ(bar(BarOptions{}).damping.norm(), 0.0);
}

TEST(Bar, NamesTheOptionThatIsWrong) {
  for (const auto& [options, words] : std::initializer_list<std::pair<BarOptions, const char*>>{
           {{.youngs_modulus = 0.0}, "youngs_modulus is 0; it must be positive and finite"},
           {{.density = -2700}, "density is -2700; it must be positive and finite"},
           {{.area = infinity}, "area is inf; it must be positive and finite"},
           {{.length = nan}, "length is nan; it must be positive and finite"},
           {{.elements = 0}, "elements is 0; it must be in 1..500000000"},
           {{.stiffness_damping = -1}, "stiffness_damping is -1; it must be finite and at least 0"},
           {{.lumped_fraction = 1.5}, "lumped_fraction is 1.5; it must be in [0, 1]"}})
    expect_error([&wrong = options] { bar(wrong); }, std::string("BarOptions: ") + words);
}

}  // namespace
}  // namespace wavebalance::fem
