#include "wavebalance/solvers/continuation/curve_corrector.hpp"

#include "testing.hpp"

namespace wavebalance::solvers {
namespace {

/// u^2 + p^2 = 1.
class Circle {
 public:
  struct Pieces {};
  double evaluate(const CurvePoint& at, const Pieces*) {
    u_ = at.displacement[0];
    p_ = at.parameter;
    residual_[0] = u_ * u_ + p_ * p_ - 1.0;
    return std::abs(residual_[0]);
  }
  const Eigen::VectorXd& residual() const { return residual_; }
  bool solve_bordered(const Eigen::VectorXd& row, double last, const Eigen::VectorXd& right,
                      double last_right, Eigen::VectorXd& change, double& parameter_change) {
    determinant_ = 2.0 * u_ * last - 2.0 * p_ * row[0];
    change = Eigen::VectorXd::Constant(1, (last * right[0] - 2.0 * p_ * last_right) / determinant_);
    parameter_change = (2.0 * u_ * last_right - row[0] * right[0]) / determinant_;
    return determinant_ != 0.0;
  }
  int determinant_sign() const { return determinant_ > 0.0 ? 1 : -1; }
  Eigen::VectorXd weighted(const Eigen::VectorXd& u) const { return u; }
  double squared_parameter_scale() const { return 1.0; }
  double tolerance() const { return 1e-14; }
  int max_corrections(bool) const { return 10; }

 private:
  Eigen::VectorXd residual_ = Eigen::VectorXd::Zero(1);
  double u_ = 0.0, p_ = 0.0, determinant_ = 0.0;
};

/// A circle whose radius is known up to a rounding that differs from one parameter to the next.
class RoundedCircle : public Circle {
 public:
  double evaluate(const CurvePoint& at, const Pieces* pieces) {
    Circle::evaluate(at, pieces);
    const double rounding = 1e-9 * std::sin(1e16 * at.parameter);
    rounded_ = Circle::residual() + Eigen::VectorXd::Constant(1, rounding);
    return std::abs(rounded_[0]);
  }
  const Eigen::VectorXd& residual() const { return rounded_; }

 private:
  Eigen::VectorXd rounded_;
};

CurvePoint at_the_top() {
  CurvePoint point;
  point.displacement = Eigen::VectorXd::Ones(1);
  point.displacement_tangent = Eigen::VectorXd::Zero(1);
  point.parameter_tangent = 1.0;
  return point;
}

TEST(CurveCorrector, GoesOnceRoundACircleThroughBothFolds) {
  CurveCorrector<Circle> corrector{Circle()};
  CurvePoint point = at_the_top(), next;
  double angle = 0.0;
  int corrections = 0;
  for (int step = 0; step < 60 && angle < 6.2; ++step) {
    ASSERT_TRUE(corrector.correct(point, 0.2, nullptr, next, corrections));
    EXPECT_NEAR(std::hypot(next.displacement[0], next.parameter), 1.0, 1e-14);
    EXPECT_NEAR(corrector.inner(next, next), 1.0, 1e-14);
    EXPECT_NEAR(next.parameter_tangent, next.displacement[0], 1e-12);
    EXPECT_EQ(next.orientation, 1);
    angle += std::asin(0.2);
    point = next;
  }
  EXPECT_NEAR(point.parameter, std::sin(angle), 1e-12);
}

TEST(CurveCorrector, FindsPointsBetweenAndRefusesWhereNoneIs) {
  CurveCorrector<Circle> corrector{Circle()};
  CurvePoint to = at_the_top(), point;
  to.displacement[0] = 0.0;
  to.parameter = 1.0;
  int corrections = 0;
  const double aside = 1.0 - std::sqrt(0.5);
  ASSERT_TRUE(corrector.between(at_the_top(), to, 0.5, 1.01 * aside, point, corrections));
  EXPECT_NEAR(point.parameter, std::sqrt(0.5), 1e-12);
  EXPECT_FALSE(corrector.between(at_the_top(), to, 0.5, 0.99 * aside, point, corrections));
  EXPECT_FALSE(corrector.correct(at_the_top(), 1.5, nullptr, point, corrections));
}

TEST(CurveCorrector, SolvesAtOneParameterWhatRoundsDifferentlyAtEach) {
  CurveCorrector<RoundedCircle> corrector{RoundedCircle()};
  CurvePoint point = at_the_top(), next;
  int corrections = 0;
  for (int step = 0; step < 5; ++step) {
    ASSERT_TRUE(corrector.correct(point, 0.15, nullptr, next, corrections)) << step;
    EXPECT_NEAR(std::hypot(next.displacement[0], next.parameter), 1.0, 1e-9);
    point = next;
  }
}

TEST(CurveCorrector, StepsAreHalvedUntilOneIsTakenOrLost) {
  double step = 1.0;
  const auto short_enough = [&] { return step > 0.2 ? StepAttempt::too_long : StepAttempt::taken; };
  EXPECT_TRUE(halve_until_taken(step, 0.01, short_enough));
  EXPECT_EQ(step, 0.125);
  EXPECT_FALSE(halve_until_taken(step, 0.01, [] { return StepAttempt::too_long; }));
  EXPECT_EQ(step, 0.01);
  step = 1.0;
  EXPECT_FALSE(halve_until_taken(step, 0.01, [] { return StepAttempt::lost; }));
  EXPECT_EQ(step, 1.0);
}

}  // namespace
}  // namespace wavebalance::solvers
