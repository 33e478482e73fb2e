#include <Eigen/Core>

#include "laws_under_test.hpp"
#include "testing.hpp"
#include "wavebalance/contact/no_contact.hpp"

namespace wavebalance::contact {
namespace {

constexpr double largest = std::numeric_limits<double>::max();

TEST(ExponentialLaw, IsThePublishedFormula) {
  const ExponentialLaw law = published_law();
  for (double u : {-1.0, 0.0, 0.9e-3, 1e-3}) EXPECT_EQ(law.force(u), 0.0) << u;
  for (double u : {-1.0, 0.0, 0.9e-3}) EXPECT_EQ(law.tangent(u), 0.0) << u;
  for (double u : {1.0001e-3, 1.01e-3, 1.5e-3, 16e-3, 0.1, 2.0}) {
    const double expected = 1e8 * (std::exp(50.0 * (u - 1e-3)) - 1.0);
    EXPECT_NEAR(law.force(u), expected, 8 * eps * (expected + 1e8)) << u;
    const double slope = 50.0 * (expected + 1e8);
    EXPECT_NEAR(law.tangent(u), slope, 64 * eps * slope) << u;
  }
}

TEST(ExponentialLaw, KeepsFullPrecisionAtSmallPenetration) {
  const ExponentialLaw law(1e8, 50.0, 0.0);
  for (double u : {1e-300, 1e-100, 1e-20, 1e-12, 1e-9}) {
    const double x = 50.0 * u;
    EXPECT_NEAR(law.force(u) / (1e8 * x * (1 + x / 2)), 1.0, 8 * eps) << u;
  }
  for (double u : {1e-140, 1e-20, 1e-12, 1e-9}) {  // below, x^2 is not a normal number
    const double x = 50.0 * u;
    EXPECT_NEAR(law.potential(u) / (1e8 / 50.0 * x * x / 2 * (1 + x / 3)), 1.0, 8 * eps) << u;
  }
}

TEST(ExponentialLaw, SlopeAtTheKinkIsThatOfTheRightHandSide) {
  const ExponentialLaw law = published_law();
  EXPECT_EQ(law.tangent(std::nextafter(1e-3, 0.0)), 0.0);
  EXPECT_EQ(law.tangent(1e-3), 1e8 * 50.0);
  EXPECT_EQ(law.evaluate(1e-3).tangent, 1e8 * 50.0);
}

TEST(ExponentialLaw, PotentialIsTheIntegralOfTheForce) {
  const ExponentialLaw law = published_law();
  // alpha (u - g0) on both sides of the change from series to expm1 (1), and far above.
  for (double argument : {1e-6, 1e-3, 0.1, 0.999, 1.001, 3.0, 10.0}) {
    const double u = 1e-3 + argument / 50.0;
    const double rounding = 4 * eps * 50.0 * u / argument;  // of u - g0
    EXPECT_NEAR(law.potential(u) / integrated_force(law, u, 40), 1.0, 64 * eps + rounding) << argument;
  }
}

TEST(ExponentialLaw, GoesOnLinearlyAndOnceContinuouslyDifferentiable) {
  const ExponentialLaw law(2.0, 4.0, -1.0);
  const double edge = -1.0 + ExponentialLaw::linear_beyond / 4.0;
  const double slope = law.tangent(edge);
  EXPECT_NEAR(slope / (8.0 * std::exp(ExponentialLaw::linear_beyond)), 1.0, 4 * eps);
  const double reach = 10.0;
  EXPECT_EQ(law.tangent(edge + reach), slope);
  EXPECT_NEAR(law.force(edge + reach) / (law.force(edge) + reach * slope), 1.0, 8 * eps);
  const double energy = law.potential(edge) + reach * law.force(edge) + reach * reach / 2 * slope;
  EXPECT_NEAR(law.potential(edge + reach) / energy, 1.0, 8 * eps);
  EXPECT_NEAR(law.force(std::nextafter(edge, 1e3)) / law.force(edge), 1.0, 1e3 * eps);
  EXPECT_NEAR(law.potential(std::nextafter(edge, 1e3)) / law.potential(edge), 1.0, 1e3 * eps);
}

template <class Law>
void expect_finite_everywhere(const Law& law) {
  for (double u : {-infinity, -largest, -1e300, -1.0, -5e-324, 0.0, 5e-324, 1e-310, 1.0, 1e10, 1e300, largest,
                   infinity}) {
    for (double value :
         {law.force(u), law.tangent(u), law.potential(u), law.evaluate(u).force, law.evaluate(u).tangent}) {
      EXPECT_TRUE(std::isfinite(value)) << "at " << u;
      EXPECT_GE(value, 0.0) << "at " << u;
    }
  }
}

TEST(ExponentialLaw, IsFiniteForEveryDisplacementAndConstant) {
  for (double constant : {5e-324, 1e8, 1e300})
    for (double exponent : {5e-324, 50.0, 1e300})
      for (double gap : {-largest, -1.0, 0.0, 1e-3, largest}) {
        SCOPED_TRACE(testing::Message() << constant << ", " << exponent << ", " << gap);
        expect_finite_everywhere(ExponentialLaw(constant, exponent, gap));
      }
  EXPECT_EQ(published_law().force(1e300), largest);
  EXPECT_EQ(published_law().force(-1e300), 0.0);
}

TEST(LinearLaw, IsFiniteForEveryDisplacementAndConstant) {
  for (double stiffness : {5e-324, 1e8, 1e300})
    for (double gap : {-largest, 0.0, largest}) expect_finite_everywhere(LinearLaw(stiffness, gap));
}

TEST(LinearLaw, IsAUnilateralSpring) {
  const LinearLaw law(4.0, 1.0);
  EXPECT_EQ(law.force(0.5), 0.0);
  EXPECT_EQ(law.tangent(0.5), 0.0);
  EXPECT_EQ(law.potential(0.5), 0.0);
  EXPECT_EQ(law.tangent(1.0), 4.0);
  EXPECT_EQ(law.force(3.0), 8.0);
  EXPECT_EQ(law.tangent(3.0), 4.0);
  EXPECT_EQ(law.potential(3.0), 8.0);
  EXPECT_NEAR(law.potential(3.0), integrated_force(law, 3.0, 1), 16 * eps);
}

TEST(NoContact, NeverPushes) {
  for (double u : {-1e300, 0.0, 1e300}) {
    EXPECT_EQ(NoContact{}.force(u), 0.0);
    EXPECT_EQ(NoContact{}.tangent(u), 0.0);
    EXPECT_EQ(NoContact{}.potential(u), 0.0);
  }
  EXPECT_EQ(NoContact{}.gap(), infinity);
}

template <class Law>
void expect_not_a_number(const Law& law) {
  EXPECT_TRUE(std::isnan(law.force(nan)));
  EXPECT_TRUE(std::isnan(law.tangent(nan)));
  EXPECT_TRUE(std::isnan(law.potential(nan)));
  EXPECT_TRUE(std::isnan(law.evaluate(nan).force));
  EXPECT_TRUE(std::isnan(law.evaluate(nan).tangent));
}

TEST(ContactLaws, PassOnWhatIsNotANumber) {
  expect_not_a_number(published_law());
  expect_not_a_number(LinearLaw(1e8, 1e-3));
}

template <class Law>
void expect_arrays_agree(const Law& law) {
  std::vector<double> u{-1.0, 0.0, 1e-3, 1.2e-3, 0.7, 7.0, 1e200}, force(u.size()), tangent(u.size());
  law.evaluate(u, force, tangent);
  for (std::size_t i = 0; i < u.size(); ++i) {
    EXPECT_EQ(force[i], law.force(u[i])) << u[i];
    EXPECT_EQ(tangent[i], law.tangent(u[i])) << u[i];
  }
  force.pop_back();
  EXPECT_THROW(law.evaluate(u, force, tangent), std::invalid_argument);
}

TEST(ContactLaws, AnswerArraysAsTheyAnswerNumbers) {
  expect_arrays_agree(published_law());
  expect_arrays_agree(LinearLaw(1e8, 1e-3));
}

std::string message_of(auto&& call) {
  try {
    call();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "nothing thrown";
}

TEST(ContactLaws, NameTheConstantThatIsWrong) {
  EXPECT_EQ(message_of([] { ExponentialLaw(-1.0, 50.0, 1e-3); }),
            "ExponentialLaw: constant is -1; it must be positive and finite");
  EXPECT_EQ(message_of([] { ExponentialLaw(1e8, 0.0, 1e-3); }),
            "ExponentialLaw: exponent is 0; it must be positive and finite");
  EXPECT_EQ(message_of([] { ExponentialLaw(1e8, 50.0, infinity); }),
            "ExponentialLaw: gap is inf; it must be finite");
  EXPECT_EQ(message_of([] { LinearLaw(nan, 0.0); }),
            "LinearLaw: stiffness is nan; it must be positive and finite");
  EXPECT_EQ(message_of([] { LinearLaw(1.0, nan); }), "LinearLaw: gap is nan; it must be finite");
}

}  // namespace
}  // namespace wavebalance::contact
