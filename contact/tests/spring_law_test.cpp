#include <rapidcheck/gtest.h>
#include <numeric>

#include "random_values.hpp"
#include "testing.hpp"
#include "wavebalance/contact/bilinear_law.hpp"
#include "wavebalance/contact/clearance_law.hpp"
#include "wavebalance/contact/cubic_law.hpp"
#include "wavebalance/contact/polynomial_law.hpp"
#include "wavebalance/contact/table_law.hpp"

namespace wavebalance::contact {
namespace {

double any_magnitude(double least, double greatest) { return std::pow(10.0, any_between(least, greatest)); }
double any_sign() { return *rc::gen::element(-1.0, 1.0); }

BilinearLaw any_bilinear_law() {
  return {any_sign() * any_magnitude(0, 4), any_sign() * any_magnitude(0, 4), any_between(-1, 1)};
}
ClearanceLaw any_clearance_law() {
  return {{any_magnitude(0, 6), any_between(0, 1)}, {any_magnitude(0, 6), any_between(0, 1)}};
}
CubicLaw any_cubic_law() { return CubicLaw(any_sign() * any_magnitude(-2, 4)); }
PolynomialLaw any_polynomial_law() {
  std::vector<double> coefficients{any_between(-5, 5)};
  for (int more = *rc::gen::inRange(0, 6); more > 0; --more) coefficients.push_back(any_between(-5, 5));
  coefficients.push_back(any_sign() * any_magnitude(-1, 1));
  return PolynomialLaw(std::move(coefficients));
}
TableLaw any_table_law() {
  const int count = *rc::gen::inRange(2, 12);
  std::vector<double> u{any_between(-1.5, -0.5)}, f{any_between(-3, 3)};
  for (int i = 1; i < count; ++i) {
    u.push_back(u.back() + any_between(0.05, 0.5));
    f.push_back(any_between(0, 1) < 0.3 ? f.back() : any_between(-3, 3));
  }
  return TableLaw(std::move(u), std::move(f));
}

// Away from the kinks, where the slope is continuous in between.
template <class Law>
void check_slope_and_work(const Law& law) {
  const double u = any_between(-2, 2), step = 1e-5;
  for (const double kink : law.kinks()) RC_PRE(std::abs(u - kink) > 2 * step);
  const double size = std::abs(law.force(u)) + std::abs(law.tangent(u)) + std::abs(law.force(u + 0.5)) +
                      std::abs(law.force(u - 0.5)) + std::abs(law.potential(u));
  const double slope = (law.force(u + step) - law.force(u - step)) / (2 * step);
  const double work = (law.potential(u + step) - law.potential(u - step)) / (2 * step);
  RC_ASSERT(std::abs(slope - law.tangent(u)) <= 2e-3 * size);
  RC_ASSERT(std::abs(work - law.force(u)) <= 1e-7 * size);
  RC_ASSERT(law.evaluate(u).force == law.force(u));
  RC_ASSERT(law.evaluate(u).tangent == law.tangent(u));
}

RC_GTEST_PROP(SpringLawProperty, BilinearSlopeAndForceAreTheDerivatives, ()) {
  check_slope_and_work(any_bilinear_law());
}
RC_GTEST_PROP(SpringLawProperty, ClearanceSlopeAndForceAreTheDerivatives, ()) {
  check_slope_and_work(any_clearance_law());
}
RC_GTEST_PROP(SpringLawProperty, CubicSlopeAndForceAreTheDerivatives, ()) {
  check_slope_and_work(any_cubic_law());
}
RC_GTEST_PROP(SpringLawProperty, PolynomialSlopeAndForceAreTheDerivatives, ()) {
  check_slope_and_work(any_polynomial_law());
}

// The law at u = v - c f with the slope t / (1 + c t), where there is a force at all.
template <class Law>
void check_resolvent(const Law& law, double flexibility, double v) {
  const ForceAndTangent at = law.resolvent(v, flexibility);
  const double u = v - flexibility * at.force;
  const double tangent = law.tangent(u), rounding = 64 * eps * (std::abs(u) + std::abs(v));
  const double condition = std::max(1.0, 1.0 / std::abs(1.0 + flexibility * tangent));  // of a falling law
  double before = 0.0;  // the force with which a piece of the law begins
  for (const double kink : law.kinks()) before = std::max(before, std::abs(law.force(kink)));
  RC_ASSERT(std::abs(law.force(u) - at.force) <=
            condition * ((std::abs(tangent) + 1.0 / flexibility) * rounding + 64 * eps * before));
  for (const double kink : law.kinks()) RC_PRE(std::abs(u - kink) > 1e-9);
  RC_ASSERT(std::abs(at.tangent * (1.0 + flexibility * tangent) - tangent) <= 1e-9 * std::abs(tangent));
}

RC_GTEST_PROP(SpringLawProperty, BilinearResolventHoldsTheLawInSeriesWithASpring, ()) {
  const BilinearLaw law = any_bilinear_law();
  const double softest = std::max(-law.slope_below(), -law.slope_beyond());
  const double flexibility = softest > 0.0 ? any_between(0.05, 0.95) / softest : any_magnitude(-6, 2);
  check_resolvent(law, flexibility, any_between(-3, 3));
}
RC_GTEST_PROP(SpringLawProperty, ClearanceResolventHoldsTheLawInSeriesWithASpring, ()) {
  check_resolvent(any_clearance_law(), any_magnitude(-8, 2), any_between(-3, 3));
}
RC_GTEST_PROP(SpringLawProperty, CubicResolventHoldsTheLawInSeriesWithASpring, ()) {
  const CubicLaw law = any_cubic_law();
  const double flexibility = any_magnitude(-6, 2), v = any_between(-3, 3);
  const double fold = 1.5 * std::sqrt(3.0 * flexibility * std::abs(law.stiffness())) * std::abs(v);
  RC_PRE(std::abs(fold - 1.0) > 1e-3);  // where two roots of a softening law meet its slope is infinite
  const ForceAndTangent at = law.resolvent(v, flexibility);
  const double u = v - flexibility * at.force;
  const double size = std::abs(at.force) + (std::abs(v) + std::abs(u)) / flexibility;
  RC_ASSERT(std::abs(law.force(u) - at.force) <=
            1e-11 * size * (1.0 + flexibility * std::abs(law.tangent(u))));
}

TEST(SpringLaw, SofteningBeyondTheSpringInSeriesHasNoForce) {
  const BilinearLaw law(0.0, -10.0, 1.0);
  EXPECT_TRUE(std::isnan(law.resolvent(2.0, 0.5).force));     // 1 + c k2 = -4
  EXPECT_NEAR(law.resolvent(2.0, 0.05).force, -20.0, 1e-12);  // u = 3: -10 (3 - 1)
}

TEST(SpringLaw, HasTheForcesOfItsFormula) {
  const BilinearLaw bilinear(100.0, -50.0, 0.2);
  EXPECT_DOUBLE_EQ(bilinear.force(-1.0), -100.0);
  EXPECT_DOUBLE_EQ(bilinear.force(0.6), 0.0);
  EXPECT_EQ(bilinear.tangent(0.2), -50.0);
  EXPECT_FALSE(bilinear.unilateral());
  EXPECT_TRUE(BilinearLaw(0.0, 3.0, 0.1).unilateral());
  const ClearanceLaw clearance({100.0, 0.1}, {200.0, 0.3});
  for (const double u : {-0.3, -0.1, 0.0, 0.1}) EXPECT_EQ(clearance.force(u), 0.0) << u;
  EXPECT_DOUBLE_EQ(clearance.force(0.4), 30.0);
  EXPECT_DOUBLE_EQ(clearance.force(-0.4), -20.0);
  EXPECT_DOUBLE_EQ(clearance.potential(-0.4), 1.0);
  EXPECT_DOUBLE_EQ(CubicLaw(-2.0).force(3.0), -54.0);
  const PolynomialLaw polynomial({1.0, -2.0, 0.5});
  EXPECT_DOUBLE_EQ(polynomial.force(2.0), 2.0 - 8.0 + 4.0);
  EXPECT_DOUBLE_EQ(polynomial.potential(2.0), 2.0 - 16.0 / 3.0 + 2.0);
}

TEST(SpringLaw, IsFiniteForEveryFiniteDisplacementAndPassesOnWhatIsNotANumber) {
  const auto check = [](const auto& law) {
    for (const double u : {1e300, -1e300, std::numeric_limits<double>::max()}) {
      EXPECT_TRUE(std::isfinite(law.force(u))) << u;
      EXPECT_FALSE(std::isnan(law.potential(u))) << u;
    }
    EXPECT_TRUE(std::isnan(law.force(std::nan(""))));
    EXPECT_TRUE(std::isnan(law.tangent(std::nan(""))));
  };
  check(BilinearLaw(1e3, 1e6, 0.1));
  check(ClearanceLaw(1e6, 0.1));
  check(CubicLaw(1e6));
  check(TableLaw({0.0, 1.0, 2.0}, {0.0, 1.0, 3.0}));
}

std::string refusal_of_spring(auto&& call) {
  try {
    call();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "nothing thrown";
}

TEST(SpringLaw, NamesTheConstantThatIsWrong) {
  EXPECT_EQ(refusal_of_spring([] { ClearanceLaw(-1.0, 1e-3); }),
            "ClearanceLaw: above.stiffness is -1; it must be positive and finite");
  EXPECT_EQ(refusal_of_spring([] {
              ClearanceLaw({1.0, 0.0}, {1.0, -0.5});
            }),
            "ClearanceLaw: below.gap is -0.5; it must be finite and at least 0");
  EXPECT_EQ(refusal_of_spring([] { CubicLaw(0.0); }),
            "CubicLaw: stiffness is 0; it must be finite and not zero");
  EXPECT_EQ(refusal_of_spring([] {
              PolynomialLaw({0.0, 0.0});
            }),
            "PolynomialLaw: coefficients has no entry that is not zero; give one or more");
  EXPECT_EQ(refusal_of_spring([] { BilinearLaw(1.0, std::nan(""), 0.0); }),
            "BilinearLaw: slope_beyond is nan; it must be finite");
}

RC_GTEST_PROP(TableLawProperty, SlopeAndForceAreTheDerivatives, ()) { check_slope_and_work(any_table_law()); }

RC_GTEST_PROP(TableLawProperty, RisesOrFallsBetweenTwoPointsAsTheyDoAndMeetsThem, ()) {
  const TableLaw law = any_table_law();
  const auto u = law.displacements(), f = law.forces();
  const double rounding = 1e-12;
  for (std::size_t i = 0; i < u.size(); ++i) RC_ASSERT(std::abs(law.force(u[i]) - f[i]) <= rounding);
  const std::size_t i = *rc::gen::inRange<std::size_t>(0, u.size() - 1);
  const double x = any_between(0, 1), y = any_between(0, 1);
  const double low = u[i] + std::min(x, y) * (u[i + 1] - u[i]),
               high = u[i] + std::max(x, y) * (u[i + 1] - u[i]);
  const double rise = law.force(high) - law.force(low);
  RC_ASSERT(rise * (f[i + 1] - f[i]) >= -rounding);
  if (f[i + 1] == f[i]) RC_ASSERT(std::abs(rise) <= rounding);
}

}  // namespace
}  // namespace wavebalance::contact
