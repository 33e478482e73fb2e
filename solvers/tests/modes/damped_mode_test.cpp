// Damped nonlinear modes against event-driven exact motions of the extended periodic motion concept, closed
// forms of linear structures, and finite differences of their Jacobian.
#include "wavebalance/solvers/modes/damped_mode.hpp"

#include "linalg/dense.hpp"
#include "modes/damped_equations.hpp"
#include "support/friction_scenes.hpp"
#include "support/refusal.hpp"
#include "support/rigid_law.hpp"
#include "support/small_problems.hpp"
#include "testing.hpp"

namespace wavebalance::solvers {
namespace {

using testing::FrictionScene;

// m = k = k_t = limit = 1, no damping but friction.
FrictionScene undamped_slider() {
  FrictionScene scene = testing::slider_on_oscillator(1.0, 1.0, 1.0);
  scene.structure.damping.setZero();
  return scene;
}

DampedPoint at_amplitude(const DampedMode& mode, double amplitude) {
  DampedBackboneOptions options{.first_amplitude = 0.5 * std::min(amplitude, mode.linear_amplitude()),
                                .last_amplitude = amplitude};
  options.initial_step = options.max_step = 0.5;
  DampedBackbone curve = mode.backbone(options);
  EXPECT_EQ(curve.status, DampedBackboneStatus::reached_amplitude);
  return curve.points.empty() ? DampedPoint{} : curve.points.back();
}

struct Dashpot {
  double coefficient;
  double force(double, double v) const { return coefficient * v; }
  double tangent(double, double) const { return 0.0; }
  double damping(double, double) const { return coefficient; }
  double potential(double) const { return 0.0; }
  double gap() const { return 0.0; }
  bool unilateral() const { return false; }
};

double turning_point(const DampedPoint& point) { return point.displacement.row(0).maxCoeff(); }

DampedBackbone fine_curve(const DampedMode& mode) {
  DampedBackboneOptions options{.first_amplitude = 0.5 * mode.linear_amplitude(),
                                .last_amplitude = 12.0 * mode.linear_amplitude()};
  options.initial_step = options.max_step = 0.02;
  return mode.backbone(options);
}

// Frequency and damping where the first contact turns back at `turn`, between neighbours of a curve whose
// amplitude may have folds.
DampedPoint with_turning_point(const DampedBackbone& curve, double turn) {
  const auto above = std::find_if(curve.points.begin(), curve.points.end(),
                                  [&](const DampedPoint& one) { return turning_point(one) >= turn; });
  if (above == curve.points.end() || above == curve.points.begin()) return {};
  const DampedPoint &low = *std::prev(above), &high = *above;
  const double share = (turn - turning_point(low)) / (turning_point(high) - turning_point(low));
  DampedPoint between;
  between.omega = low.omega + share * (high.omega - low.omega);
  between.xi = low.xi + share * (high.xi - low.xi);
  return between;
}

// From event-driven half periods between turning points, exact to 1e-12.
TEST(DampedMode, FrequencyAndDampingOfASliderAreThoseOfItsExactMotion) {
  struct Exact {
    double turn, omega, xi;
  };
  const FrictionScene scene = undamped_slider();
  const DampedMode mode(scene.structure, testing::fourier_pair(63, 1024), scene.contact_laws());
  const DampedBackbone curve = fine_curve(mode);
  for (const Exact& exact : {Exact{1.05, 1.407981866599, 0.040911227739},
                             {1.2, 1.374760867048, 0.127612626271},
                             {1.5, 1.307405927642, 0.214608194793},
                             {2.0, 1.225867690198, 0.259278078520},
                             {3.0, 1.137365865899, 0.250943400416},
                             {5.0, 1.068675871863, 0.193173154265},
                             {10.0, 1.025286800615, 0.112857733317}}) {
    const DampedPoint point = with_turning_point(curve, exact.turn);
    EXPECT_NEAR(point.omega, exact.omega, 1e-4) << exact.turn;
    EXPECT_NEAR(point.xi, exact.xi, 2e-3 * exact.xi) << exact.turn;
    EXPECT_NEAR(point.damping_ratio(), exact.xi / (2.0 * exact.omega), 1e-4) << exact.turn;
  }
}

TEST(DampedMode, FewHarmonicsHaveTheBalancesOfTheirHarmonics) {
  struct Row {
    int functions, points;
    double omega, xi;
  };
  const FrictionScene scene = undamped_slider();
  // With one harmonic friction dissipates 4 (A - 1) per period, and xi gives pi xi omega A^2.
  const double amplitude = 2.000767809,
               one = 4.0 * (amplitude - 1.0) / (std::numbers::pi * 1.224645134 * amplitude * amplitude);
  for (const Row& row : {Row{3, 1024, 1.224645134, one},
                         {11, 1024, 1.225866959, 0.259253004},
                         {31, 1024, 1.225867271, 0.259278299}}) {
    const DampedMode mode(scene.structure, testing::fourier_pair(row.functions, row.points),
                          scene.contact_laws());
    const DampedPoint point = at_amplitude(mode, amplitude);
    EXPECT_NEAR(point.omega, row.omega, 1e-6) << row.functions;
    EXPECT_NEAR(point.xi, row.xi, 1e-5) << row.functions;
  }
}

TEST(DampedMode, TwoMassesHaveTheirExactFrequencyAndDamping) {
  struct Exact {
    double turn, omega, xi;
  };
  const auto expect_on_curve = [](double kt, double limit, const std::vector<Exact>& motions) {
    const FrictionScene scene = testing::rubbing_masses(1.0, kt, limit, 1.0);
    const DampedMode mode(scene.structure, testing::fourier_pair(63, 1024), scene.contact_laws());
    const DampedBackbone curve = fine_curve(mode);
    for (const Exact& exact : motions) {
      const DampedPoint point = with_turning_point(curve, exact.turn);
      EXPECT_NEAR(point.omega, exact.omega, 1e-4 * exact.omega) << exact.turn;
      EXPECT_NEAR(point.xi, exact.xi, 1e-3 * exact.xi) << exact.turn;
    }
  };
  expect_on_curve(2.0, 0.3, {{0.45, 1.1350677112, 0.2004748189}, {1.5, 1.0273839781, 0.1282033400}});
  expect_on_curve(20.0, 1.0, {{0.5, 1.3470051993, 0.3178054066}});
}

// The state of a curve a little off it, where all derivatives count.
TEST(DampedMode, JacobianIsTheDerivativeOfTheResidual) {
  DampedBackboneOptions options;
  for (const TimePair& pair :
       {testing::fourier_pair(9, 64), testing::make_pair(testing::CubicBasis{8}, testing::CubicBasis{8}, 64),
        testing::make_pair(testing::HaarBasis{8}, spectral::FourierBasis(8), 64, Formulation::distributional,
                           InnerProducts::quadrature, NyquistCoefficient::drop)}) {
    FrictionScene scene = testing::lift_off(2.0, 2.0, 0.6, 0.5, 3.0);
    const Eigen::Matrix2d damping{{0.3, 0.1}, {0.1, 0.2}};
    scene.structure.damping = damping.sparseView();
    scene.structure.loss_factor = 0.05;
    const DampedProblem problem = damped_problem(scene.structure, pair, scene.contact_laws(), 1);
    DampedMotions motions(problem, options);
    CurvePoint point;
    point.displacement = Eigen::VectorXd::LinSpaced(problem.unknowns(), -0.2, 0.3).array().sin();
    point.displacement[pair.functions() > 8 ? 1 : 2] += 1.0;
    point.displacement.tail(2) << 0.93, 0.11;
    point.parameter = std::log(0.4);
    motions.evaluate(point, nullptr);
    const Eigen::MatrixXd exact = motions.jacobian();
    Eigen::MatrixXd differences(exact.rows(), exact.cols());
    constexpr double step = 1e-6;
    for (Eigen::Index i = 0; i < exact.cols(); ++i) {
      const auto residual_at = [&](double change) -> Eigen::VectorXd {
        CurvePoint other = point;
        if (i < point.displacement.size())
          other.displacement[i] += change;
        else
          other.parameter += change;
        motions.evaluate(other, nullptr);
        return motions.residual();
      };
      differences.col(i) = (residual_at(step) - residual_at(-step)) / (2.0 * step);
    }
    EXPECT_LT((exact - differences).cwiseAbs().maxCoeff(), 1e-7 * exact.cwiseAbs().maxCoeff());
  }
}

TEST(DampedMode, BelowSlipItIsTheLinearModeWithItsContactsStuck) {
  const FrictionScene scene = testing::rubbing_masses(1.0, 20.0, 1.0, 1.0);
  const DampedMode mode(scene.structure, testing::fourier_pair(15, 64), scene.contact_laws());
  // Slip begins where k_t times the displacement is the limit.
  EXPECT_NEAR(mode.linear_amplitude(), 0.05, 1e-9);
  const DampedPoint point = at_amplitude(mode, 0.04);
  const Eigen::Matrix2d stuck{{22.0, -1.0}, {-1.0, 2.0}};
  const double lowest = std::sqrt(detail::symmetric_eigen(stuck)->values[0]);
  EXPECT_NEAR(point.omega, lowest, 1e-3);
  EXPECT_NEAR(mode.linear_omega(), lowest, 1e-12);
  EXPECT_NEAR(point.damping_ratio(), mode.linear_damping_ratio(), 1e-3 * mode.linear_damping_ratio());
  EXPECT_NEAR(turning_point(point), 0.04, 1e-3 * 0.04);
}

// A linear dashpot at the contact adds its damping whatever the amplitude.
TEST(DampedMode, ADashpotAddsItsDamping) {
  const auto one = Eigen::MatrixXd::Ones(1, 1);
  const FrictionScene scene = testing::friction_scene(
      one, 0.1 * one, 4.0 * one, one, Eigen::VectorXd::Ones(1), 1.0, {contact::CoulombLaw({0.0, 1.0, 1.0})});
  const Dashpot dashpot{0.3};
  const DampedMode mode(scene.structure, testing::fourier_pair(7, 32), dashpot);
  EXPECT_EQ(mode.linear_amplitude(), 0.0);
  DampedBackboneOptions options{.first_amplitude = 0.1, .last_amplitude = 10.0};
  const DampedBackbone curve = mode.backbone(options);
  ASSERT_EQ(curve.status, DampedBackboneStatus::reached_amplitude);
  for (const DampedPoint& point : curve.points) {
    EXPECT_NEAR(point.omega, 2.0, 1e-9);
    EXPECT_NEAR(point.xi, 0.4, 1e-9);
  }
}

// Every basis has the same motion within its error.
TEST(DampedMode, PairsOfBasesAgree) {
  const FrictionScene scene = testing::lift_off(2.0, 2.0, 0.6, 0.5, 3.0);
  const DampedMode reference(scene.structure, testing::fourier_pair(63, 512), scene.contact_laws());
  const double amplitude = 4.0 * reference.linear_amplitude();
  const DampedPoint exact = at_amplitude(reference, amplitude);
  EXPECT_GT(exact.xi, 0.36);  // the structure's is 0.35
  const testing::CubicBasis cubic{64};
  const DampedMode splines(scene.structure, testing::make_pair(cubic, cubic, 512), scene.contact_laws());
  const DampedPoint point = at_amplitude(splines, amplitude);
  EXPECT_NEAR(point.omega, exact.omega, 2e-4 * exact.omega);
  EXPECT_NEAR(point.xi, exact.xi, 2e-3 * exact.xi);
}

TEST(DampedMode, BadInputIsRefusedByName) {
  const FrictionScene scene = testing::rubbing_masses(1.0, 20.0, 1.0, 1.0);
  const TimePair pair = testing::fourier_pair(7, 32);
  const auto made = [&](const LinearStructure& structure, const ContactLaws& laws, int mode) {
    return testing::refusal([&] { DampedMode(structure, pair, laws, mode); });
  };
  EXPECT_NE(made(scene.structure, scene.contact_laws(), 3).find("mode is 3; it must be in 1..2"),
            std::string::npos);
  EXPECT_NE(made(scene.structure, testing::Rigid{1.0}, 1).find("rigid"), std::string::npos);
  LinearStructure turning = scene.structure;
  turning.stiffness.coeffRef(0, 1) += 0.5;
  EXPECT_NE(made(turning, scene.contact_laws(), 1).find("not symmetric"), std::string::npos);
  const DampedMode mode(scene.structure, pair, scene.contact_laws());
  DampedBackboneOptions options;
  EXPECT_NE(testing::refusal([&] { mode.backbone(options); }).find("first_amplitude is 0"),
            std::string::npos);
  options.first_amplitude = 1.0;
  options.last_amplitude = 0.5;
  EXPECT_NE(testing::refusal([&] { mode.backbone(options); }).find("above first_amplitude"),
            std::string::npos);
}

}  // namespace
}  // namespace wavebalance::solvers
