#include "wavebalance/solvers/modes/elastic_mode.hpp"

#include "linalg/dense.hpp"
#include "ll10_rod.hpp"
#include "support/duffing_spring.hpp"
#include "support/oscillator.hpp"
#include "support/rigid_law.hpp"
#include "support/runge_kutta.hpp"
#include "support/small_problems.hpp"
#include "testing.hpp"

namespace wavebalance::solvers {
namespace {

using testing::CubicBasis;
using testing::fourier_pair;
using testing::HaarBasis;
using testing::LinearContact;
using testing::UnitRod;

/// stiffness (exp(u - 1) - 1) beyond a gap of 1.
struct ExponentialContact {
  double stiffness;
  double force(double u) const { return u > 1.0 ? stiffness * std::expm1(u - 1.0) : 0.0; }
  double tangent(double u) const { return u >= 1.0 ? stiffness * std::exp(u - 1.0) : 0.0; }
  double potential(double u) const { return u > 1.0 ? stiffness * (std::expm1(u - 1.0) - (u - 1.0)) : 0.0; }
  double gap() const { return 1.0; }
};

/// m = k = gap = 1.
ModalModel unit_model() {
  return {Eigen::VectorXd::Ones(1), Eigen::MatrixXd::Ones(1, 1), Eigen::VectorXd::Ones(1)};
}

/// Angular frequency of u'' + u + stiffness (u - 1)_+ = 0 at the energy ratio: a free flight and an arc in
/// contact, each a part of a sine.
double exact_omega(double stiffness, double energy_ratio) {
  const double speed = std::sqrt(energy_ratio - 1.0), natural = std::sqrt(1.0 + stiffness);
  const double flight = std::acos(-1.0 / std::sqrt(energy_ratio));
  const double contact = std::atan2(speed / natural, 1.0 / (1.0 + stiffness)) / natural;
  return std::numbers::pi / (flight + contact);
}

ElasticBackboneOptions far(double energy) { return {.max_energy = energy, .max_frequency_ratio = 10.0}; }

double oscillator_error(double stiffness, double energy_ratio, int functions, int points) {
  const ElasticMode mode(unit_model(), fourier_pair(functions, points), LinearContact{stiffness, 1.0});
  const ModePoint point = mode.at_energy(energy_ratio, far(energy_ratio));
  EXPECT_EQ(point.status, ModeStatus::converged) << stiffness << ' ' << energy_ratio << ' ' << functions;
  EXPECT_NEAR(point.energy_ratio, energy_ratio, 1e-9 * energy_ratio);
  const double exact = exact_omega(stiffness, energy_ratio);
  return std::abs(point.omega - exact) / exact;
}

TEST(ElasticMode, OscillatorWithALinearStopHasTheBackboneOfItsTwoArcs) {
  for (const double stiffness : {0.1, 1.0, 10.0})
    for (const double energy : {1.01, 1.5, 4.0, 20.0})
      EXPECT_LT(oscillator_error(stiffness, energy, 63, 1024), 2e-5) << stiffness << ' ' << energy;
}

TEST(ElasticMode, ErrorOfTheOscillatorsFrequencyFallsAtLeastQuadraticallyWithTheFunctions) {
  double coarse = 0.0, fine = 0.0;
  for (const double energy : {1.5, 4.0, 20.0}) {
    coarse = std::max(coarse, oscillator_error(4.0, energy, 15, 240));
    fine = std::max(fine, oscillator_error(4.0, energy, 63, 1008));
  }
  const double order = std::log(coarse / fine) / std::log(63.0 / 15.0);
  RecordProperty("order", std::to_string(order));
  EXPECT_GT(order, 2.0) << coarse << ' ' << fine;
}

TEST(ElasticMode, StopWithoutAGapHasTheFrequencyOfTwoHalfSwingsAtEveryEnergy) {
  for (const double stiffness : {0.1, 3.0}) {
    const ElasticMode mode(unit_model(), fourier_pair(63, 1024), LinearContact{stiffness, 0.0});
    const double natural = std::sqrt(1.0 + stiffness), exact = 2.0 * natural / (1.0 + natural);
    const ElasticBackbone curve = mode.backbone(far(4.0));
    EXPECT_EQ(curve.status, BackboneStatus::reached_energy);
    for (const ModePoint& point : curve.points) EXPECT_NEAR(point.omega, exact, 2e-5);
  }
}

TEST(ElasticMode, SoftStopWithoutAGapShiftsABarsFrequencyByHalfOfThatOfItsSpring) {
  const UnitRod rod(8);
  const double stiffness = 1e-4;
  const ElasticMode mode(rod.model, fourier_pair(31, 256), LinearContact{stiffness, 0.0});
  const double shape = rod.model.contact_shapes(0, 0);
  const double spring =
      0.5 * stiffness * shape * shape / mode.linear_omega();  // of the bar held by the spring
  const ModePoint point = mode.at_energy(1.0, far(1.0));
  EXPECT_NEAR(point.omega - mode.linear_omega(), 0.5 * spring, 1e-3 * spring);
}

// Change of the state over one period, relative, integrated by Runge and Kutta's method in the two modes of a
// rod.
double return_error(const ModalModel& model, const AnyContactLaw& law, const ModePoint& point) {
  Eigen::Vector4d start = Eigen::Vector4d::Zero();
  for (Eigen::Index n = 0; n < point.amplitudes.cols(); ++n) {
    const Eigen::Vector2cd shape = (n == 0 ? 1.0 : 2.0) * point.amplitudes.col(n);
    start.head<2>() += shape.real();
    start.tail<2>() -= static_cast<double>(n) * point.omega * shape.imag();
  }
  const Eigen::Vector2d contact = model.contact_shapes.row(0), stiffness = model.omega_squared;
  const auto rate = [&](double, const Eigen::Vector4d& at) {
    const Eigen::Vector2d x = at.head<2>();
    Eigen::Vector4d result;
    result << at.tail<2>(), -stiffness.cwiseProduct(x) - law.force(contact.dot(x)) * contact;
    return result;
  };
  const Eigen::Vector4d end = testing::runge_kutta(rate, start, 2.0 * std::numbers::pi / point.omega, 20000);
  return (end - start).norm() / start.norm();
}

TEST(ElasticMode, MotionsOfTheBackboneReturnToTheirStartWhenTheyAreIntegrated) {
  const UnitRod rod(2);
  for (const AnyContactLaw& law :
       {AnyContactLaw(LinearContact{4.0, 1.0}), AnyContactLaw(ExponentialContact{3.0})}) {
    double coarse = 0.0, fine = 0.0;
    for (const double energy : {1.2, 2.0, 5.0}) {
      const auto error = [&](int functions) {
        const ElasticMode mode(rod.model, fourier_pair(functions, 8 * functions + 8), law);
        const ModePoint point = mode.at_energy(energy, far(energy));
        EXPECT_EQ(point.status, ModeStatus::converged) << energy << ' ' << functions;
        EXPECT_LT(point.residual, 1e-8);
        return return_error(rod.model, law, point);
      };
      coarse = std::max(coarse, error(63));
      fine = std::max(fine, error(255));
    }
    EXPECT_LT(fine, 5e-6);
    EXPECT_LT(fine, 0.1 * coarse);
  }
}

// The rod of LL10 with nearly all of its tip's mass at the neighbour.
ModalModel rod_with_light_tip() {
  UnitRod rod(20, 0.5);
  const Eigen::Index tip = rod.mass.rows() - 1;
  rod.mass(tip - 1, tip - 1) += rod.mass(tip, tip) + 2.0 * rod.mass(tip, tip - 1);
  rod.mass(tip, tip - 1) = rod.mass(tip - 1, tip) = 0.0;
  rod.mass(tip, tip) = 1e-7;
  const auto modes = detail::symmetric_eigen(rod.stiffness, rod.mass);
  return {modes->values, modes->vectors.row(tip), Eigen::VectorXd::Ones(1)};
}

TEST(ElasticMode, StiffStopTendsToTheRigidModeLikeItsFlexibility) {
  constexpr double energy = 2.0, least_stiffness = 1e2;
  const ModalModel model = rod_with_light_tip();
  const auto of = [&](const AnyContactLaw& law) {
    const ModePoint point = ElasticMode(model, fourier_pair(21, 160), law).at_energy(energy, far(energy));
    EXPECT_EQ(point.status, ModeStatus::converged);
    return point;
  };
  const auto at = [&](double stiffness) { return of(LinearContact{stiffness, 1.0}); };
  const ModePoint limit = of(testing::Rigid{1.0});
  double last = std::abs(at(least_stiffness).omega - limit.omega);
  for (const double stiffness : {1e3, 1e4, 1e5}) {
    const double distance = std::abs(at(stiffness).omega - limit.omega);
    EXPECT_NEAR(distance, 0.1 * last, 0.03 * last) << stiffness;
    last = distance;
  }
}

TEST(ElasticMode, PairThatDampsFreeMotionsIsRefused) {
  const TimePair pair = testing::make_pair(HaarBasis{8}, CubicBasis{8}, 32);
  try {
    const ElasticMode mode(unit_model(), pair, LinearContact{1.0, 1.0});
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("damps a free motion"), std::string::npos) << error.what();
  }
}

TEST(ElasticMode, EvenMotionsAreThoseOfAllCoefficients) {
  const UnitRod rod(2);
  const ElasticMode all(rod.model, fourier_pair(31, 256), LinearContact{4.0, 1.0});
  const ElasticMode even(rod.model, fourier_pair(31, 256), LinearContact{4.0, 1.0}, {.cosine_only = true});
  const ModePoint a = all.at_energy(3.0, far(3.0)), b = even.at_energy(3.0, far(3.0));
  ASSERT_EQ(a.status, ModeStatus::converged);
  ASSERT_EQ(b.status, ModeStatus::converged);
  EXPECT_NEAR(a.omega, b.omega, 1e-8 * a.omega);
  EXPECT_EQ(a.force.rows(), b.force.rows());
}

TEST(ElasticMode, BalanceAndVirialIdentityHoldAtEveryPoint) {
  const UnitRod rod(20, 0.5);
  const ElasticMode mode(rod.model, fourier_pair(21, 160), LinearContact{20.0, 1.0});
  const ElasticBackbone curve = mode.backbone(far(10.0));
  EXPECT_EQ(curve.status, BackboneStatus::reached_energy) << to_string(curve.status);
  EXPECT_GT(curve.points.size(), 20u);
  for (const ModePoint& point : curve.points) {
    EXPECT_LT(point.virial_residual, 1e-9);
    EXPECT_LT(point.residual, 1e-9);
    EXPECT_GE(point.min_force, 0.0);
  }
}

TEST(ElasticMode, InternalResonanceBesideTheLinearFrequencyIsPassed) {
  const UnitRod rod(20);  // 3 omega_1 is 0.2 % below omega_2
  const ElasticMode mode(rod.model, fourier_pair(11, 80), LinearContact{10.0, 1.0});
  const ElasticBackbone curve = mode.backbone(far(5.0));
  EXPECT_EQ(curve.status, BackboneStatus::reached_energy) << to_string(curve.status);
  const ModePoint& last = curve.points.back();
  EXPECT_EQ(last.status, ModeStatus::converged);
  EXPECT_GT(last.omega, 1.05 * mode.linear_omega());
}

// A chain of four masses with omega_2 = 2.086 omega_1. The frequency ratios come from shooting on the
// event-driven flow, a separate program.
TEST(ElasticMode, GoesAlongAnInternalResonanceThatNoMotionLiesBeyond) {
  Eigen::Matrix4d stiffness{{8327.56, -3352.706, 0.0, 0.0},
                            {-3352.706, 5609.372, -2256.666, 0.0},
                            {0.0, -2256.666, 3417.922, -1161.256},
                            {0.0, 0.0, -1161.256, 1161.256}};
  const Eigen::Matrix4d mass = Eigen::Vector4d(1.5721635, 1.7891257, 0.7152621, 1.1018919).asDiagonal();
  const auto modes = detail::symmetric_eigen(stiffness, mass);
  const double gap = 0.734738e-3;
  const ModalModel model{modes->values, modes->vectors.row(3), Eigen::VectorXd::Constant(1, gap)};
  const ElasticMode mode(model, fourier_pair(61, 512), LinearContact{3947.904, gap});
  for (const auto& [energy, ratio] : {std::pair{2.0, 1.024191}, std::pair{4.0, 1.031834}}) {
    const ModePoint point = mode.at_energy(energy, far(energy));
    EXPECT_EQ(point.status, ModeStatus::internal_resonance);
    EXPECT_EQ(point.resonance.harmonic, 2);
    EXPECT_EQ(point.resonance.mode, 2);
    EXPECT_NEAR(point.energy_ratio, energy, 1e-9 * energy);
    EXPECT_NEAR(point.omega / mode.linear_omega(), ratio, 1e-5);
    EXPECT_LT(point.virial_residual, 1e-9);
  }
  EXPECT_EQ(mode.backbone(far(4.0)).status, BackboneStatus::reached_energy);
}

TEST(ElasticMode, BackboneSaysWhereItEnds) {
  const ElasticMode mode(unit_model(), fourier_pair(31, 256), LinearContact{10.0, 1.0});
  EXPECT_EQ(mode.backbone(far(4.0)).status, BackboneStatus::reached_energy);
  const ElasticBackbone low = mode.backbone({.max_energy = 1e9, .max_frequency_ratio = 1.1});
  EXPECT_EQ(low.status, BackboneStatus::reached_frequency);
  EXPECT_LT(low.points.back().energy_ratio, 1e9);
  const ElasticBackbone few = mode.backbone({.max_points = 3});
  EXPECT_EQ(few.status, BackboneStatus::point_limit);
  EXPECT_EQ(few.points.size(), 3u);
  ElasticBackboneOptions options;
  options.observer = [](const Progress&) { return false; };
  EXPECT_EQ(mode.backbone(options).status, BackboneStatus::cancelled);
  // Energies beyond the frequency limit are not reached.
  EXPECT_EQ(mode.at_energy(1e6, {.max_frequency_ratio = 1.1}).status, ModeStatus::no_contact);
  EXPECT_EQ(mode.at_energy(0.5).status, ModeStatus::linear);
}

TEST(ElasticMode, BadInputIsAnErrorThatNamesTheValue) {
  const TimePair pair = fourier_pair(11, 80);
  EXPECT_THROW(ElasticMode(unit_model(), pair, LinearContact{1.0, 2.0}), std::invalid_argument);
  EXPECT_THROW(ElasticMode(unit_model(), pair, LinearContact{1.0, 1.0}, {.mode = 2}), std::invalid_argument);
  EXPECT_THROW(
      ElasticMode(unit_model(), pair, testing::DuffingSpring{.start = 0.0}, {.form = ContactForm::force}),
      std::invalid_argument);
  EXPECT_THROW(ElasticMode(unit_model(), fourier_pair(2, 8), LinearContact{1.0, 1.0}), std::invalid_argument);
  const ElasticMode mode(unit_model(), pair, LinearContact{1.0, 1.0});
  EXPECT_THROW(mode.backbone({.max_energy = -1.0}), std::invalid_argument);
  EXPECT_THROW(mode.at_energy(-1.0), std::invalid_argument);
  EXPECT_THROW(mode.linear_mode(2.0), std::invalid_argument);
}

}  // namespace
}  // namespace wavebalance::solvers
