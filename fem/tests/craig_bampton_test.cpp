#include "wavebalance/fem/craig_bampton.hpp"

#include "testing.hpp"
#include "wavebalance/fem/bar.hpp"

namespace wavebalance::fem {
namespace {

Matrices damped_bar(int elements) {
  BarOptions options{.elements = elements, .stiffness_damping = 1e-4};
  return bar(options);
}

Eigen::VectorXd omega_of(const CraigBampton& reduced, int count) {
  return eigenmodes(reduced.stiffness.sparseView(), reduced.mass.sparseView(), count).omega;
}

TEST(CraigBampton, IsTheStructureItselfWithAllModes) {
  const Matrices matrices = damped_bar(30);
  const std::vector<int> boundary = {29, 4, 17};
  const CraigBampton reduced = craig_bampton(matrices, boundary, {.modes = 27, .solver = {}});
  const Eigen::VectorXd expected = eigenmodes(matrices.stiffness, matrices.mass, 30).omega;
  EXPECT_LE((omega_of(reduced, 30) - expected).cwiseQuotient(expected).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(CraigBampton, IsTheProjectionOnItsTransformation) {
  const Matrices matrices = damped_bar(300);
  const std::vector<int> boundary = {299, 100};
  for (int modes : {0, 1, 12}) {
    const CraigBampton reduced = craig_bampton(matrices, boundary, {.modes = modes, .solver = {}});
    ASSERT_EQ(reduced.status, EigenmodesStatus::converged);
    ASSERT_EQ(reduced.mass.rows(), 2 + modes);
    const Eigen::MatrixXd& basis = reduced.transformation;
    const auto expect_projection = [&](const Eigen::MatrixXd& found, const Eigen::MatrixXd& full) {
      EXPECT_LE((found - basis.transpose() * full * basis).norm(), 1e-10 * found.norm());
    };
    expect_projection(reduced.mass, Eigen::MatrixXd(matrices.mass));
    expect_projection(reduced.stiffness, Eigen::MatrixXd(matrices.stiffness));
    expect_projection(reduced.damping, Eigen::MatrixXd(matrices.damping));
  }
}

// Relative motion of two unknowns, their sum with another, and a single one.
TEST(CraigBampton, KeepsWhatDirectionsTouch) {
  const Matrices matrices = damped_bar(300);
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(3, 300);
  rows(0, 299) = 1.0;
  rows(0, 100) = -1.0;
  rows(1, 100) = 0.5;
  rows(1, 200) = 0.25;
  rows(2, 299) = -1.0;
  const Eigen::SparseMatrix<double, Eigen::RowMajor> directions = rows.sparseView();
  const std::vector<int> boundary = touched_unknowns(directions);
  EXPECT_EQ(boundary, (std::vector<int>{100, 299, 200}));
  const CraigBampton reduced = craig_bampton(matrices, boundary, {.modes = 5, .solver = {}});
  const Eigen::MatrixXd projected = reduced.project_directions(directions);
  EXPECT_EQ(projected, rows * reduced.transformation);
  const Eigen::VectorXd coordinates = Eigen::VectorXd::LinSpaced(8, 1, 8);
  EXPECT_LE((projected * coordinates - rows * reduced.recover(coordinates)).norm(),
            10.0 * eps * coordinates.norm());
  rows(2, 7) = 1.0;
  EXPECT_THROW(reduced.project_directions(rows.sparseView()), std::invalid_argument);
  EXPECT_THROW(reduced.project_directions(rows.leftCols(299).sparseView()), std::invalid_argument);
}

TEST(CraigBampton, KeepsBoundaryDisplacementsAsCoordinates) {
  const Matrices matrices = damped_bar(300);
  const std::vector<int> boundary = {299, 100};
  const CraigBampton reduced = craig_bampton(matrices, boundary, {.modes = 5, .solver = {}});
  const Eigen::VectorXd coordinates = Eigen::VectorXd::LinSpaced(7, 1, 7);
  const Eigen::VectorXd recovered = reduced.recover(coordinates);
  EXPECT_EQ(recovered[299], 1.0);
  EXPECT_EQ(recovered[100], 2.0);
  const Eigen::VectorXd load = Eigen::VectorXd::Random(300);
  EXPECT_NEAR(reduced.project_load(load).dot(coordinates), load.dot(recovered),
              1e3 * eps * load.norm() * recovered.norm());
}

// Statics on the boundary are exact whatever modes are kept.
TEST(CraigBampton, HasTheExactStaticComplianceOfTheBoundary) {
  const BarOptions options;
  const Matrices matrices = bar(options);
  const std::vector<int> boundary = {24};
  const CraigBampton reduced = craig_bampton(matrices, boundary, {.modes = 2, .solver = {}});
  EXPECT_NEAR(reduced.stiffness(0, 0) * options.length / (options.youngs_modulus * options.area), 1.0, 1e-12);
}

TEST(CraigBampton, BoundsFrequenciesFromAboveAndConvergesWithItsModes) {
  const Matrices matrices = damped_bar(300);
  const std::vector<int> boundary = {299};
  const Eigen::VectorXd exact = eigenmodes(matrices.stiffness, matrices.mass, 3).omega;
  double previous = 1.0;
  for (int modes : {2, 4, 8, 16}) {
    const double error =
        omega_of(craig_bampton(matrices, boundary, {.modes = modes, .solver = {}}), 3)[2] / exact[2] - 1.0;
    EXPECT_GT(error, 0.0);
    EXPECT_LT(error, previous / 4);
    previous = error;
  }
}

TEST(CraigBampton, RejectsWhatDoesNotFit) {
  const Matrices matrices = damped_bar(10);
  const auto rejects = [](const Matrices& given, std::vector<int> boundary, int modes) {
    EXPECT_THROW(craig_bampton(given, boundary, {.modes = modes, .solver = {}}), std::invalid_argument);
  };
  rejects(matrices, {10}, 2);
  rejects(matrices, {-1}, 2);
  rejects(matrices, {3, 3}, 2);
  rejects(matrices, {9}, 10);
  rejects(matrices, {9}, -1);
  rejects(matrices, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9}, 0);
  rejects({matrices.mass, damped_bar(9).damping, matrices.stiffness}, {9}, 2);
  rejects({damped_bar(9).mass, matrices.damping, matrices.stiffness}, {9}, 2);
  Matrices asymmetric = matrices;
  asymmetric.stiffness.coeffRef(3, 2) *= 1.01;
  rejects(asymmetric, {9}, 2);
  const CraigBampton reduced = craig_bampton(matrices, std::vector<int>{9}, {.modes = 2, .solver = {}});
  EXPECT_THROW(reduced.recover(Eigen::VectorXd(4)), std::invalid_argument);
  EXPECT_THROW(reduced.project_load(Eigen::VectorXd(3)), std::invalid_argument);
  EXPECT_THROW(reduced.project(damped_bar(9).mass), std::invalid_argument);
}

TEST(CraigBampton, RejectsAStructureThatFloatsWithItsBoundaryHeld) {
  Matrices matrices = damped_bar(10);
  matrices.stiffness.coeffRef(4, 4) = -matrices.stiffness.coeff(4, 4);
  EXPECT_THROW(craig_bampton(matrices, std::vector<int>{9}, {.modes = 2, .solver = {}}), std::domain_error);
}

}  // namespace
}  // namespace wavebalance::fem
