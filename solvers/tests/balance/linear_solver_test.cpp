#include <numeric>

#include "balance/harmonic_coarse_space.hpp"
#include "dense_algebra.hpp"
#include "linalg/gmres.hpp"
#include "support/newton_checks.hpp"
#include "support/oscillator.hpp"
#include "testing.hpp"
#include "wavebalance/solvers/continuation/arc_length.hpp"
#include "wavebalance/solvers/response/forced_response.hpp"

namespace wavebalance::solvers {
namespace {

LinearMap product_with(const Eigen::MatrixXd& matrix) {
  return [&matrix](const Eigen::VectorXd& v, Eigen::VectorXd& product) { product = matrix * v; };
}

Eigen::MatrixXd random_matrix(Eigen::Index rows, Eigen::Index columns, std::mt19937& generator) {
  return testing::random_vector(rows * columns, generator).reshaped(rows, columns);
}

TEST(Gmres, ReachesTheTargetThatItReports) {
  std::mt19937 generator(1);
  const Eigen::Index size = 40;
  const Eigen::MatrixXd matrix =
      random_matrix(size, size, generator);  // no structure: needs all of the space
  const Eigen::VectorXd right = testing::random_vector(size, generator);
  Eigen::VectorXd x;
  for (const double target : {1e-1, 1e-5, 1e-9}) {
    const GmresResult result = gmres(product_with(matrix), right, target, 60, x);
    EXPECT_TRUE(result.solved) << target;
    EXPECT_LE(result.iterations, size);
    const double rounding = 100.0 * eps * matrix.norm() * x.norm();
    EXPECT_LE((right - matrix * x).norm(), target + rounding);
    EXPECT_NEAR((right - matrix * x).norm(), result.residual, rounding);
  }
}

TEST(Gmres, IdentityPlusRankThreeTakesFourIterations) {
  std::mt19937 generator(2);
  const Eigen::Index size = 50;
  const Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(size, size) +
                                 random_matrix(size, 3, generator) * random_matrix(3, size, generator);
  Eigen::VectorXd x;
  const Eigen::VectorXd right = testing::random_vector(size, generator);
  const GmresResult result = gmres(product_with(matrix), right, 1e-9 * right.norm(), 60, x);
  EXPECT_TRUE(result.solved);
  EXPECT_LE(result.iterations, 4);
}

TEST(Gmres, StopsUnsolvedWhereTheRightSideIsOutOfReach) {
  Eigen::MatrixXd matrix = Eigen::VectorXd::LinSpaced(8, 0.0, 7.0).asDiagonal();  // its first row is zero
  const Eigen::VectorXd right = Eigen::VectorXd::Ones(8);
  Eigen::VectorXd x;
  GmresResult result = gmres(product_with(matrix), right, 1e-10, 100, x);
  EXPECT_FALSE(result.solved);
  EXPECT_LE(result.iterations, 8);
  EXPECT_GE(result.residual, 1.0 - 1e-10);
  EXPECT_TRUE(x.allFinite());
  const Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(8, 8);
  result = gmres(product_with(zero), right, 1e-10, 100, x);
  EXPECT_FALSE(result.solved);
  matrix(3, 3) = std::nan("");
  result = gmres(product_with(matrix), right, 1e-10, 100, x);
  EXPECT_FALSE(result.solved);
  EXPECT_TRUE(x.allFinite());
}

TEST(Gmres, KeepsToTheLimitOfIterations) {
  std::mt19937 generator(3);
  const Eigen::MatrixXd matrix = random_matrix(30, 30, generator);
  Eigen::VectorXd x;
  const GmresResult result = gmres(product_with(matrix), testing::random_vector(30, generator), 1e-12, 5, x);
  EXPECT_FALSE(result.solved);
  EXPECT_EQ(result.iterations, 5);
}

// Three contacts of a chain and all harmonics that its functions represent.
class CoarseSpaceTest : public ::testing::Test {
 protected:
  CoarseSpaceTest() : problem_(testing::fourier_pair(31, points), structure(), testing::cosine_load()) {
    problem_.set_frequency(0.23);
    set({0, 1000, 0.0});
  }
  void set(const CoarseSize& wanted) {
    ContactOperator contact(problem_);
    space_.set(contact, harmonics, wanted);
  }
  LinearStructure structure() {
    LinearStructure chain = testing::random_chain(5, generator_);
    chain.contact_directions = contact_rows({0, 1, 4}, chain.size());
    return chain;
  }
  Eigen::MatrixXd synthesis() {
    Eigen::MatrixXd matrix(problem_.samples(), space_.size());
    Eigen::VectorXd column;
    for (Eigen::Index j = 0; j < space_.size(); ++j) {
      space_.synthesise(Eigen::VectorXd::Unit(space_.size(), j), column);
      matrix.col(j) = column;
    }
    return matrix;
  }
  Eigen::MatrixXd response() {
    Eigen::MatrixXd matrix(space_.size(), problem_.samples());
    Eigen::VectorXd column;
    for (Eigen::Index j = 0; j < problem_.samples(); ++j) {
      space_.respond(Eigen::VectorXd::Unit(problem_.samples(), j), column);
      matrix.col(j) = column;
    }
    return matrix;
  }

  static constexpr int points = 64, harmonics = 15;
  std::mt19937 generator_{4};
  CondensedProblem problem_;
  HarmonicCoarseSpace space_;
};

TEST_F(CoarseSpaceTest, SynthesisIsOrthonormalAndAnalysisItsTranspose) {
  const Eigen::MatrixXd u = synthesis();
  EXPECT_LE((u.transpose() * u - Eigen::MatrixXd::Identity(space_.size(), space_.size())).norm(), 1e3 * eps);
  const Eigen::VectorXd v = testing::random_vector(problem_.samples(), generator_);
  Eigen::VectorXd coefficients;
  space_.analyse(v, coefficients);
  EXPECT_LE((u.transpose() * v - coefficients).norm(), 1e3 * eps * v.norm());
}

TEST_F(CoarseSpaceTest, OfAllDirectionsIsTheCompliance) {
  EXPECT_EQ(space_.size(), 3 * 31);
  const Eigen::MatrixXd expected = testing::compliance_matrix(problem_);
  EXPECT_LE((synthesis() * response() - expected).norm(), 1e3 * eps * expected.norm());
}

TEST_F(CoarseSpaceTest, LeavesOutWhatIsSmallerThanTheRemainder) {
  const Eigen::MatrixXd compliance = testing::compliance_matrix(problem_);
  const double norm = oracle::spectral_norm(compliance);
  for (const double share : {0.3, 1e-2, 1e-3}) {
    set({0, 1000, share * norm});
    EXPECT_LT(space_.size(), 3 * 31);
    EXPECT_LT(oracle::spectral_norm(compliance - synthesis() * response()), share * norm);
  }
}

TEST_F(CoarseSpaceTest, HasNoMoreUnknownsThanAllowedAndNoFewerThanWanted) {
  set({0, 40, 0.0});
  EXPECT_GE(space_.size(), 39);
  EXPECT_LE(space_.size(), 40);
  set({20, 40, 1e100});
  EXPECT_GE(space_.size(), 19);
  EXPECT_LE(space_.size(), 20);
}

TEST_F(CoarseSpaceTest, MatrixIsThatOfTheExplicitProducts) {
  set({0, 60, 0.0});
  const Eigen::VectorXd tangent = testing::random_vector(problem_.samples(), generator_).cwiseAbs();
  const Eigen::MatrixXd expected = Eigen::MatrixXd::Identity(space_.size(), space_.size()) +
                                   response() * tangent.asDiagonal() * synthesis();
  Eigen::MatrixXd matrix(space_.size() + 1, space_.size() + 1);
  space_.fill({tangent, {}, {}}, 0.23, matrix);
  EXPECT_LE((matrix.topLeftCorner(space_.size(), space_.size()) - expected).norm(),
            1e3 * eps * expected.norm());
}

// The same state of each kind of pair, solved by LU and by GMRES.
class LinearSolverTest : public ::testing::TestWithParam<int> {
 protected:
  LinearSolverTest()
      : problem_(testing::pair_kinds(64, 256)[static_cast<std::size_t>(GetParam())],
                 testing::random_chain(5, generator_), testing::cosine_load()),
        system_(problem_, law_) {
    problem_.set_frequency(0.05);
    // In contact for two stretches of the period.
    u_ = Eigen::VectorXd::NullaryExpr(problem_.points(), [&](Eigen::Index l) {
      const double t = 2.0 * std::numbers::pi * double(l) / problem_.points();
      return law_.start + std::cos(t) + 0.5 * std::cos(3.0 * t);
    });
    system_.evaluate(u_);
  }

  std::mt19937 generator_{static_cast<unsigned>(GetParam())};
  testing::ExponentialLaw law_{1.3, 0.8, 0.4};
  CondensedProblem problem_;
  ContactSystem system_;
  Eigen::VectorXd u_;
};

TEST_P(LinearSolverTest, GmresLeavesTheResidualThatWasAskedFor) {
  system_.set_linear_solver(LinearSolver::krylov);
  const Eigen::VectorXd r = testing::random_vector(problem_.points(), generator_);
  for (const double reduction : {1e-1, 1e-4, 1e-8, 1e-12}) {
    ASSERT_TRUE(system_.factorize());
    Eigen::VectorXd x, product;
    ASSERT_TRUE(system_.solve(r, x, reduction)) << reduction;
    problem_.apply(system_.tangent().cwiseProduct(x), product);
    const double rounding = 1e3 * eps * (product.norm() + r.norm());
    EXPECT_LE((x + product - r).norm(), reduction * r.norm() + rounding);
  }
}

TEST_P(LinearSolverTest, SolutionsByGmresAndByLuAreEqual) {
  testing::expect_gmres_equals_lu(system_, problem_.points(), generator_);
}

TEST_P(LinearSolverTest, ConditionOfGmresIsALowerBound) {
  std::vector<Eigen::Index> active;
  for (Eigen::Index l = 0; l < u_.size(); ++l)
    if (system_.tangent()[l] != 0.0) active.push_back(l);
  const Eigen::MatrixXd jacobian = Eigen::MatrixXd::Identity(u_.size(), u_.size()) +
                                   testing::compliance_matrix(problem_) * system_.tangent().asDiagonal();
  const Eigen::MatrixXd block = jacobian(active, active);
  const double bound = block.norm() * oracle::inverse(block).norm();  // Frobenius: at least the 2-norm's
  system_.set_linear_solver(LinearSolver::krylov);
  EXPECT_EQ(system_.condition(), 0.0);
  ASSERT_TRUE(system_.factorize());
  Eigen::VectorXd x;
  ASSERT_TRUE(system_.solve(system_.residual(), x));
  EXPECT_GE(system_.condition(), 1.0);
  EXPECT_LE(system_.condition(), bound);
  system_.set_linear_solver(LinearSolver::dense);
  ASSERT_TRUE(system_.factorize());
  // Eigen's estimate of the inverse's 1-norm is a lower bound too, hardly ever off by more than three.
  const auto norm = [](const Eigen::MatrixXd& m) { return m.cwiseAbs().colwise().sum().maxCoeff(); };
  const double exact = norm(block) * norm(oracle::inverse(block));
  EXPECT_LE(system_.condition(), exact * (1.0 + 1e-9));
  EXPECT_GE(system_.condition(), exact / 3.0);
}

INSTANTIATE_TEST_SUITE_P(PairKinds, LinearSolverTest, ::testing::Range(0, testing::pair_kind_count));

// A force that grows with -stiffness times the displacement.
struct Destabilising {
  double stiffness;
  double force(double u) const { return -stiffness * u; }
  double tangent(double) const { return -stiffness; }
  double potential(double u) const { return -0.5 * stiffness * u * u; }
  double gap() const { return -std::numeric_limits<double>::infinity(); }
};

// It removes the static stiffness, up to a rounding or a little more: the mean of the response is anything
// or nearly so. Whether a pivot vanishes in the first case is a matter of rounding.
TEST(LinearSolver, ConditionSaysThatTheNewtonMatrixIsNearlySingular) {
  const LinearStructure bar = testing::jl14_bar(1, 1e-4);
  CondensedProblem problem(testing::fourier_pair(127, 512), bar, Eigen::Vector2cd(1.0, 1.0));
  problem.set_frequency(150.0);
  for (const auto method : {LinearSolver::dense, LinearSolver::krylov}) {
    ForcedResponseOptions options;
    options.newton.linear_solver = method;
    options.fallbacks = false;
    for (const double detuning : {0.5, 1e-13, 0.0}) {
      const double stiffness = (1.0 - detuning) * bar.stiffness.coeff(0, 0);
      const auto response = forced_response(problem, Destabilising{stiffness}, options);
      EXPECT_EQ(response.condition > 1e12, detuning < 0.5) << response.condition << " at " << detuning;
      EXPECT_TRUE(response.converged() || detuning < 0.5);
    }
  }
}

// At a fold J is singular and the tangent of the curve solves [J b; c^T 0] (z, y) = (0, 1) with y = 0.
TEST(LinearSolver, GmresFindsTheTangentAtAFold) {
  const LinearStructure bar = testing::jl14_bar(1, 1e-4);
  CondensedProblem problem(testing::fourier_pair(127, 512), bar, Eigen::Vector2cd(1.0, 1.0));
  problem.set_frequency(150.0);
  ContactSystem system(problem, Destabilising{(1.0 - 1e-13) * bar.stiffness.coeff(0, 0)});
  system.set_linear_solver(LinearSolver::krylov);
  system.evaluate(problem.linear_response());
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(problem.samples());
  ASSERT_TRUE(system.factorize_bordered(ones, ones, 0.0));
  Eigen::VectorXd z;
  double y = 0.0;
  ASSERT_TRUE(system.solve_bordered(Eigen::VectorXd::Zero(ones.size()), 1.0, z, y));
  EXPECT_LE((z - ones / double(ones.size())).norm(), 1e-9 * z.norm());
  EXPECT_LE(std::abs(y), 1e-9 * z.norm());
}

// Every mass of a chain in contact: neighbours move together, so that few directions carry the compliance.
TEST(LinearSolver, ManyContactsTakeATenthOfTheOperationsOfLu) {
  std::mt19937 generator(6);
  LinearStructure chain = testing::random_chain(24, generator);
  std::vector<int> all(24);
  std::iota(all.begin(), all.end(), 0);
  chain.contact_directions = contact_rows(all, chain.size());
  CondensedProblem problem = testing::fourier_problem(chain, 31, 128, 0.05);
  const testing::LinearContact law{0.5, 0.1};
  ContactSystem dense(problem, law), automatic(problem, law);
  dense.set_linear_solver(LinearSolver::dense);
  const Eigen::VectorXd r = testing::random_vector(problem.samples(), generator),
                        b = testing::random_vector(problem.samples(), generator),
                        c = testing::random_vector(problem.samples(), generator);
  std::vector<Eigen::VectorXd> found;
  std::vector<int> signs;
  for (ContactSystem* system : {&dense, &automatic}) {
    system->evaluate(problem.linear_response());
    ASSERT_GT((system->tangent().array() > 0.0).count(), 1000);
    double y = 0.0;
    ASSERT_TRUE(system->factorize_bordered(b, c, 0.7));
    ASSERT_TRUE(system->solve_bordered(r, -0.4, found.emplace_back(), y, 1e-12));
    signs.push_back(system->determinant_sign());
  }
  EXPECT_LE((found[0] - found[1]).norm(), 1e-9 * found[0].norm());
  EXPECT_EQ(signs[0], signs[1]);
  EXPECT_LT(automatic.operations(), 0.1 * dense.operations());
}

TEST(LinearSolver, ATangentThatIsNotFiniteIsASingularMatrix) {
  CondensedProblem problem = testing::fourier_problem(testing::jl14_bar(1, 1e-4), 127, 512, 150.0);
  for (const auto method : {LinearSolver::dense, LinearSolver::krylov, LinearSolver::automatic}) {
    for (const double stiffness : {std::numeric_limits<double>::infinity(), std::nan("")}) {
      ContactSystem system(problem, Destabilising{1e6});
      system.set_linear_solver(method);
      system.evaluate(problem.linear_response());
      system.set_tangent(3, stiffness);
      EXPECT_FALSE(system.factorize());
    }
  }
}

}  // namespace
}  // namespace wavebalance::solvers
