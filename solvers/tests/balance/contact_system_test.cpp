#include "wavebalance/solvers/balance/contact_system.hpp"

#include "support/small_problems.hpp"
#include "testing.hpp"
#include "wavebalance/solvers/continuation/arc_length.hpp"

namespace wavebalance::solvers {
namespace {

class ContactSystemTest : public ::testing::TestWithParam<int> {
 protected:
  ContactSystemTest()
      : generator_(static_cast<unsigned>(GetParam())),
        problem_(testing::pair_kinds()[static_cast<std::size_t>(GetParam())],
                 testing::random_chain(5, generator_), testing::cosine_load()),
        system_(problem_, law_) {
    problem_.set_frequency(0.23);
    compliance_ = testing::compliance_matrix(problem_);
  }

  // Samples on both sides of the gap; every sample, or none, in contact for a large shift either way.
  Eigen::VectorXd state(double shift) {
    return (testing::random_vector(problem_.points(), generator_).array() + law_.start + shift).matrix();
  }

  std::mt19937 generator_;
  testing::ExponentialLaw law_{1.3, 0.8, 0.4};
  CondensedProblem problem_;
  ContactSystem system_;
  Eigen::MatrixXd compliance_;
};

TEST_P(ContactSystemTest, KeptOnTheirSidesSamplesPassTheGapSmoothly) {
  const Eigen::VectorXd u = state(0.0);
  const LawSegments sides = (u.array() > law_.start).cast<int>();
  ASSERT_TRUE(sides.any() && !sides.all());
  system_.evaluate(u);
  const Eigen::VectorXd residual = system_.residual(), tangent = system_.tangent();
  system_.evaluate(u, sides);
  EXPECT_EQ(system_.residual(), residual);
  EXPECT_EQ(system_.tangent(), tangent);
  // Beyond their gaps: those that pressed keep the law's slope there, the others stay free.
  const Eigen::VectorXd across = (2.0 * law_.start - u.array()).matrix();
  system_.evaluate(across, sides);
  const double slope = law_.tangent(law_.start);
  for (Eigen::Index l = 0; l < u.size(); ++l) {
    EXPECT_EQ(system_.tangent()[l], sides[l] ? slope : 0.0);
    EXPECT_NEAR(system_.force()[l], sides[l] ? slope * (across[l] - law_.start) : 0.0,
                1e-15 * slope * std::abs(across[l]));
  }
}

TEST_P(ContactSystemTest, ResidualIsThatOfTheExplicitCompliance) {
  const Eigen::VectorXd u = state(0.0);
  const double relative = system_.evaluate(u);
  Eigen::VectorXd force(u.size());
  for (Eigen::Index l = 0; l < u.size(); ++l) force[l] = law_.force(u[l]);
  const Eigen::VectorXd product = compliance_ * force;
  const Eigen::VectorXd residual = u - problem_.linear_response() + product;
  EXPECT_LE((system_.residual() - residual).norm(), 1e-13 * (u.norm() + product.norm()));
  EXPECT_NEAR(relative, residual.norm() / (problem_.linear_response().norm() + product.norm()),
              1e-12 * relative);
}

TEST_P(ContactSystemTest, FrequencySlopeIsTheDerivativeOfTheResidual) {
  const Eigen::VectorXd u = state(0.0);
  const FrequencyParameter frequency;
  const auto residual = [&](double value) {
    frequency.set(system_, value);
    system_.evaluate(u);
    return system_.residual();
  };
  const double at = 0.23, h = 1e-5;  // error h^2 R''' / 6 + eps |R| / h
  const Eigen::VectorXd difference = (residual(at + h) - residual(at - h)) / (2 * h);
  residual(at);
  Eigen::VectorXd slope;
  frequency.slope(system_, slope);
  EXPECT_LE((slope - difference).norm(), 1e-5 * slope.norm());
}

INSTANTIATE_TEST_SUITE_P(PairKinds, ContactSystemTest, ::testing::Range(0, testing::pair_kind_count));

TEST(ContactSystem, TangentOnTheKinkIsTheRightHandSlopeUntilToldOtherwise) {
  CondensedProblem problem = testing::fourier_problem(testing::jl14_bar(1, 1e-4), 3, 6, 150.0);
  const testing::ExponentialLaw law;
  ContactSystem system(problem, law);
  system.evaluate(Eigen::VectorXd::Constant(6, law.start));
  EXPECT_DOUBLE_EQ(system.tangent()[2], law.constant * law.exponent);
  system.set_tangent(2, 0.0);
  EXPECT_EQ(system.tangent()[2], 0.0);
  EXPECT_DOUBLE_EQ(system.tangent()[3], law.constant * law.exponent);
}

TEST(ContactSystem, OverflowingForceMakesAnInfiniteResidual) {
  CondensedProblem problem = testing::fourier_problem(testing::jl14_bar(1, 1e-4), 3, 6, 150.0);
  ContactSystem system(problem, testing::ExponentialLaw{});
  EXPECT_EQ(system.evaluate(Eigen::VectorXd::Constant(6, 1e3)), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace wavebalance::solvers
