// Attractors with stops that have brief impacts, forces that jump, or contacts that stay closed. The
// periods are compared with the integration of variable step.

#include "support/oscillator.hpp"
#include "support/small_problems.hpp"
#include "support/solved.hpp"
#include "testing.hpp"
#include "wavebalance/contact/exponential_law.hpp"
#include "wavebalance/contact/hunt_crossley_law.hpp"
#include "wavebalance/contact/kelvin_voigt_law.hpp"
#include "wavebalance/solvers/period/attractor_integration.hpp"

namespace wavebalance::solvers {
namespace {

using testing::LinearContact;

struct ImpactCase {
  LinearStructure structure;
  ContactLaws laws;
  double frequency = 0.0;  // Hz
};

// Five impacts per period, each a hundredth of it.
ImpactCase exponential_oscillator() {
  const testing::Oscillator one{.mass = 2.356008832581709,
                                .damping = 3.9383455457756775,
                                .stiffness = 2312.6695455316872,
                                .load = 0.7521877343242652};
  return {one.structure(),
          contact::ExponentialLaw(3532.9508909372225, 319.35069453383096, -0.00019960275959173023),
          2.8168395818352803};
}

ImpactCase lightly_damped_oscillator() {
  const testing::Oscillator one{.mass = 0.3579488890060608,
                                .damping = 0.5094121056080518,
                                .stiffness = 2140.6211356230096,
                                .load = 1.5 * 0.6495061955687167};
  LinearStructure structure = one.structure();
  structure.contact_directions *= -1.0;
  return {structure, contact::ExponentialLaw(2123.816192948994, 561.4980938288148, 0.0001278422200390512),
          4.26834894992727};
}

ImpactCase damped_stop_oscillator() {
  const testing::Oscillator one{.mass = 1.01321, .damping = 3.86047, .stiffness = 1000.0, .load = 0.550218};
  return {one.structure(), contact::KelvinVoigtLaw(86047.0, 106.823, 0.178528e-3), 3.37606};
}

// The motions of these two repeat after one period, which coarse steps report as six and five.
ImpactCase five_masses_between_damped_stops() {
  Eigen::MatrixXd mass(5, 5), damping(5, 5), stiffness(5, 5), contacts(2, 5);
  mass << 3.5390196605174564, 0.7598622391738068, -0.0930833302846969, 0.2591291198889093, 0.9503855961940204,
      0.7598622391738068, 4.612112629774477, 0.830388707766413, 0.584255157389898, 0.2903358426890283,
      -0.0930833302846969, 0.830388707766413, 4.698414486553229, -0.30231149114444106, -0.382023316767481,
      0.2591291198889093, 0.584255157389898, -0.30231149114444106, 1.6480617463011342, -0.3306344293043167,
      0.9503855961940204, 0.2903358426890283, -0.382023316767481, -0.3306344293043167, 2.8394689673539317;
  damping << 63.21495061793425, -28.416360972757047, -3.3658535741385815, 1.2203990747640587,
      -0.9218875427570995, -28.416360972757047, 57.06674543334281, 2.0951021686431086, 2.9111061916875705,
      -1.8701576119085594, -3.3658535741385815, 2.0951021686431086, 19.042396313300276, -1.3431531046527887,
      -1.0556068247222232, 1.2203990747640587, 2.9111061916875705, -1.3431531046527887, 17.607638971456126,
      -1.762226597741177, -0.9218875427570995, -1.8701576119085594, -1.0556068247222232, -1.762226597741177,
      16.290308776501774;
  stiffness << 39164.23807299936, -27043.84072249004, -1444.8786117611864, 0.0, -2555.9889734979415,
      -27043.84072249004, 27043.84072249004, 0.0, 0.0, 0.0, -1444.8786117611864, 0.0, 1444.8786117611864, 0.0,
      0.0, 0.0, 0.0, 0.0, 4635.96561261294, 0.0, -2555.9889734979415, 0.0, 0.0, 0.0, 2555.9889734979415;
  contacts << 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0;
  const Eigen::VectorXd load = 19.62968366675098 * Eigen::VectorXd::Unit(5, 0);
  return {
      testing::structure(mass, damping, stiffness, load, contacts),
      ContactLaws({contact::KelvinVoigtLaw(2755886.357316102, 3218.888317007048, 8.513757003834608e-05),
                   contact::KelvinVoigtLaw(5797048.625604386, 184.80879999898036, 0.0007371992129435768)}),
      4.347472126367738};
}

ImpactCase two_masses_before_damped_stops() {
  const Eigen::Matrix2d mass{{0.7678967366957882, 0.0}, {0.0, 1.8614719122906114}};
  const Eigen::Matrix2d damping{{31.546619574316946, -15.000898805438226},
                                {-15.000898805438226, 33.15048563061004}};
  const Eigen::Matrix2d stiffness{{26769.868193757728, -16690.770671322567},
                                  {-16690.770671322567, 16690.770671322567}};
  return {testing::structure(mass, damping, stiffness, Eigen::Vector2d(0.0, 1.5 * 22.6105257256964),
                             Eigen::MatrixXd(-Eigen::Matrix2d::Identity())),
          ContactLaws(
              {contact::KelvinVoigtLaw(10016228.727020187, 632.0689858520601, 0.0009428975171644093),
               contact::HuntCrossleyLaw(507848825.0698899, 2.5, 1.4480338776274324, 0.0013314989930147305)}),
          17.45219292300007};
}

CondensedProblem problem_of(const ImpactCase& one, int functions, int points) {
  return testing::fourier_problem(one.structure, functions, points, one.frequency);
}

TimeSteppingResult stepped(const ImpactCase& one) {
  return testing::stepped_motion(one.structure, one.laws, one.frequency, 1024);
}

/// For exponential_oscillator().
const TimeSteppingResult& stepped_exponential() {
  static const TimeSteppingResult result = stepped(exponential_oscillator());
  return result;
}

void expect_one_period(const ImpactCase& one, const TimeSteppingResult& reference) {
  const AttractorMotion motion = settle(problem_of(one, 63, 512), one.laws);
  EXPECT_EQ(motion.attractor_periods, 1);
  ASSERT_EQ(reference.status, TimeSteppingStatus::converged);
  const Eigen::MatrixXd& u = reference.contacts.displacement;
  const double size = u.cwiseAbs().maxCoeff();
  ASSERT_EQ(motion.last.displacement.cols(), u.cols());
  EXPECT_LE((motion.last.displacement - u).cwiseAbs().maxCoeff(), 1e-4 * size);
}

void expect_one_period(const ImpactCase& one) { expect_one_period(one, stepped(one)); }

TEST(AttractorImpacts, BriefOnesAreResolved) {
  expect_one_period(exponential_oscillator(), stepped_exponential());
  expect_one_period(lightly_damped_oscillator());
}

TEST(AttractorImpacts, ForcesThatJumpDoNotMakeOnePeriodSeveral) {
  expect_one_period(damped_stop_oscillator());
  expect_one_period(five_masses_between_damped_stops());
  expect_one_period(two_masses_before_damped_stops());
}

TEST(AttractorImpacts, NothingIsSaidOfPeriodsWhereTheOperationsRunOut) {
  const ImpactCase one = exponential_oscillator();
  AttractorOptions options;
  options.max_operations = 2e8;
  const AttractorMotion motion = settle(problem_of(one, 63, 512), one.laws, options);
  EXPECT_EQ(motion.attractor_periods, AttractorMotion::unknown);
}

TEST(AttractorImpacts, TheSettledMotionStartsTheBalance) {
  const ImpactCase one = exponential_oscillator();
  CondensedProblem problem = problem_of(one, 255, 2048);
  const PeriodicResponse response = testing::solved_response(problem, one.laws);
  EXPECT_EQ(response.strategy, Strategy::settling);
  EXPECT_EQ(response.attractor_periods, 1);
  EXPECT_NEAR(response.displacement.maxCoeff(), stepped_exponential().contacts.displacement.maxCoeff(),
              1e-3 * response.displacement.cwiseAbs().maxCoeff());
}

// An exponential spring that stays closed: its force in the rest position is exp(50) times its constant.
TEST(AttractorImpacts, AnExponentialStopThatStaysClosedIsSolvedWithAnyNumberOfFunctions) {
  LinearStructure structure =
      testing::Oscillator{.mass = 1.0, .damping = 4.0, .stiffness = 1000.0, .load = 1.5}.structure();
  structure.forces.push_back({-Eigen::VectorXd::Ones(1), Eigen::VectorXcd::Ones(1)});
  const ImpactCase one{structure, contact::ExponentialLaw(0.01, 1e4, -5e-3), 4.0};
  CondensedProblem few = problem_of(one, 63, 512);
  const PeriodicResponse known = testing::solved_response(few, one.laws);
  for (const int functions : {127, 255}) {
    CondensedProblem problem = problem_of(one, functions, 1024);
    const PeriodicResponse response = testing::solved_response(problem, one.laws);
    EXPECT_NEAR(response.displacement.maxCoeff(), known.displacement.maxCoeff(), 1e-9);
  }
}

// A mass in a clearance, whose motion of one period is unstable: Newton's method finds it from the
// attractor, which is aperiodic or of several periods. Three stops of laws of the velocity, in contact for
// nearly the whole period.
ImpactCase closed_damped_stops() {
  ImpactCase one;
  one.structure = testing::structure(
      Eigen::Matrix3d{{0.81104509065602937, -0.21642970430800249, 0.18611908966275201},
                      {-0.21642970430800249, 1.7530606253947627, -0.53997127749341034},
                      {0.18611908966275201, -0.53997127749341034, 1.358089385098056}},
      Eigen::Matrix3d{{9.2861529048050606, -0.82615204179352231, -0.67748505948193127},
                      {0.23695897011480638, 3.1630762072900103, 0.85473534641256588},
                      {-0.11295904353177683, -2.0313528042597815, 3.6452756751926523}},
      Eigen::Matrix3d{{31047.11720036254, 0.0, -3078.9864094969125},
                      {0.0, 1615.0983394445434, 0.0},
                      {-3078.9864094969125, 0.0, 3078.9864094969125}},
      Eigen::Vector3d(0.0, 0.7096901995947826, 0.0),
      Eigen::MatrixXd(Eigen::Matrix3d{{0.0, 1.0, 0.0}, {0.0, 0.0, -1.0}, {-1.0, 0.0, 0.6}}));
  Eigen::VectorXcd third = Eigen::VectorXcd::Zero(4);
  third[3] = std::polar(0.6010694728806378, -46.79134340006354 * two_pi / 360.0);
  one.structure.forces = {{Eigen::Vector3d::UnitX(), third, 0}};
  one.laws = ContactLaws(std::vector<AnyContactLaw>{
      contact::HuntCrossleyLaw(561831.1382835587, 1.0, 10.154925463396308, -0.00015134796165387185),
      contact::HuntCrossleyLaw(1796932.9694524335, 1.5, 62.04547658083764, 0.0),
      contact::KelvinVoigtLaw(6683896.619919047, 3570.651545077029, -4.961188384634818e-05,
                              2.8497810652946015e-06)});
  one.frequency = 3.4765100836822973;
  return one;
}

// All samples are active, many more than the motions have coefficients.
TEST(AttractorImpacts, DampedStopsThatStayClosedAreSolvedFromTheSettledMotion) {
  const ImpactCase one = closed_damped_stops();
  CondensedProblem problem = problem_of(one, 127, 1024);
  const AttractorMotion motion = settle(problem, one.laws);
  ASSERT_EQ(motion.attractor_periods, 1);
  const Eigen::VectorXd settled = resample(motion.last.displacement, problem.points(), motion.start);
  ForcedResponseOptions newton_alone;
  newton_alone.fallbacks = false;
  newton_alone.newton.max_operations = newton_alone.max_fallback_operations;
  const PeriodicResponse response = testing::solved_response(problem, one.laws, newton_alone, settled);
  // The truncation by 127 functions, of forces that jump.
  EXPECT_LE((response.displacement - settled).norm(), 5e-3 * settled.norm());
}

TEST(AttractorImpacts, AnUnstableMotionIsFoundNearAReturn) {
  const testing::Oscillator mass{.mass = 1.0, .damping = 0.1, .stiffness = 1.0, .load = 1.0};
  const LinearContact stop{100.0, 0.0};
  AttractorOptions options;
  options.max_periods = 200;
  int found = 0;
  for (double omega = 2.2; omega < 4.4 && found < 2; omega += 0.2) {
    const ImpactCase one{mass.structure(), stop, omega / two_pi};
    CondensedProblem problem = problem_of(one, 255, 2048);
    const AttractorMotion motion = settle(problem, one.laws, options);
    if (motion.returns.empty()) continue;
    EXPECT_NE(motion.attractor_periods, 1);
    ForcedResponseOptions newton_alone;
    newton_alone.fallbacks = false;
    const PeriodicResponse response = forced_response(
        problem, one.laws, newton_alone, resample(motion.returns.front().displacement, 2048, motion.start));
    found += response.converged() ? 1 : 0;
  }
  EXPECT_GE(found, 2);
}

}  // namespace
}  // namespace wavebalance::solvers
