#include "wavebalance/solvers/modes/nonlinear_mode.hpp"

#include <ostream>

#include "ll10_rod.hpp"
#include "testing.hpp"

namespace wavebalance::solvers {
namespace {

using testing::UnitRod;

NonlinearMode rod_mode(const UnitRod& rod, int harmonics, int samples, bool cosine_only = false) {
  return {rod.model, {.harmonics = harmonics, .samples = samples, .cosine_only = cosine_only}};
}

// ||K u_n - n^2 omega^2 M u_n + e force_n|| over ||K u||, all n, by the matrices.
double equation_residual(const UnitRod& rod, const ModePoint& point) {
  const Eigen::MatrixXcd u = rod.shapes * point.amplitudes;
  const auto samples = point.force.cols();
  double residual = 0.0, scale = 0.0;
  for (Eigen::Index n = 0; n < u.cols(); ++n) {
    std::complex<double> force = 0.0;
    for (Eigen::Index k = 0; k < samples; ++k)
      force +=
          point.force(0, k) * std::polar(1.0 / double(samples),
                                         -2.0 * std::numbers::pi * double(n * k % samples) / double(samples));
    Eigen::VectorXcd r =
        rod.stiffness * u.col(n) - double(n * n) * point.omega * point.omega * (rod.mass * u.col(n));
    r[r.size() - 1] += force;
    residual += r.squaredNorm();
    scale += (rod.stiffness * u.col(n)).squaredNorm();
  }
  return std::sqrt(residual / scale);
}

TEST(NonlinearMode, LinearFrequencyAndGrazingEnergyAreThoseOfTheUnitRod) {
  const UnitRod rod(20);
  const NonlinearMode mode = rod_mode(rod, 2, 20);
  EXPECT_NEAR(mode.linear_omega(), 1.571200085, 5e-10);
  EXPECT_NEAR(mode.grazing_energy(), 0.124871556, 5e-10);
}

struct Listed {
  int harmonics;
  double frequency_ratio, energy_ratio;

  friend void PrintTo(const Listed& point, std::ostream* out) {
    *out << "N = " << point.harmonics << ", frequency ratio " << point.frequency_ratio;
  }
};

class ListedBackbone : public ::testing::TestWithParam<Listed> {};

TEST_P(ListedBackbone, EnergyAgreesWithTheIndependentFiguresTo1e5) {
  const UnitRod rod(20);
  for (const bool cosine_only : {false, true}) {
    const NonlinearMode mode = rod_mode(rod, GetParam().harmonics, 20, cosine_only);
    const ModePoint point =
        mode.at_frequency_by_harmonic_continuation(GetParam().frequency_ratio * mode.linear_omega());
    ASSERT_EQ(point.status, ModeStatus::converged);
    EXPECT_NEAR(point.energy_ratio, GetParam().energy_ratio, 1e-5 * GetParam().energy_ratio);
  }
}

INSTANTIATE_TEST_SUITE_P(Rod, ListedBackbone,
                         ::testing::Values(Listed{2, 1.05, 1.227941}, Listed{2, 1.10, 1.626491},
                                           Listed{2, 1.15, 2.400736}, Listed{5, 1.05, 1.068082},
                                           Listed{5, 1.10, 1.507018}, Listed{5, 1.15, 2.755518}));

TEST(NonlinearMode, RayleighQuotientAgreesWithTheIndependentFigures) {
  const UnitRod rod(20);
  const NonlinearMode mode = rod_mode(rod, 5, 20);
  const double listed[][2] = {{1.05, 1.005778}, {1.10, 1.027513}, {1.15, 1.075272}};
  for (const auto& [ratio, rayleigh] : listed) {
    const ModePoint point = mode.at_frequency_by_harmonic_continuation(ratio * mode.linear_omega());
    EXPECT_NEAR(std::sqrt(point.rayleigh) / mode.linear_omega(), rayleigh, 1e-6);
  }
}

TEST(NonlinearMode, EveryAcceptedPointHoldsEquationIdentityAndComplementarity) {
  const UnitRod rod(20, 0.5);
  const NonlinearMode mode = rod_mode(rod, 10, 20);
  const auto points = backbone(mode, {.points = 60});
  int accepted = 0;
  for (const ModePoint& point : points) {
    if (!point.accepted()) continue;
    ++accepted;
    EXPECT_LE(point.virial_residual, 1e-12);
    EXPECT_LE(equation_residual(rod, point), 1e-9);
    EXPECT_GE(point.min_force, 0.0);
    for (Eigen::Index k = 0; k < point.force.cols(); ++k) {
      const Eigen::VectorXcd contact = (rod.model.contact_shapes * point.amplitudes).transpose();
      double u = contact[0].real();
      for (Eigen::Index n = 1; n < contact.size(); ++n)
        u += 2.0 * (contact[n] *
                    std::polar(1.0, 2.0 * std::numbers::pi * double(n * k) / double(point.force.cols())))
                       .real();
      EXPECT_LE(u, 1.0 + 2e-10);
      if (point.force(0, k) > 0.0) {
        EXPECT_NEAR(u, 1.0, 1e-9);
      }
    }
  }
  EXPECT_GE(accepted, 40);
}

TEST(NonlinearMode, ThreeToOneResonanceIsNamedBesideTheLinearFrequency) {
  const UnitRod rod(20);
  EXPECT_NEAR(std::sqrt(rod.model.omega_squared[1] / rod.model.omega_squared[0]), 3.00617, 5e-6);
  const NonlinearMode mode = rod_mode(rod, 3, 20);
  const ModePoint point = mode.at_frequency_by_harmonic_continuation(1.0025 * mode.linear_omega());
  EXPECT_EQ(point.status, ModeStatus::internal_resonance);
  EXPECT_EQ(point.resonance.harmonic, 3);
  EXPECT_EQ(point.resonance.mode, 2);
}

TEST(NonlinearMode, BackbonePassesInternalResonancesWithoutAnUnreportedJump) {
  const UnitRod rod(20);
  const NonlinearMode mode = rod_mode(rod, 5, 20);
  const BackboneOptions options{.points = 150};
  const auto points = backbone(mode, options);
  const ModePoint* before = nullptr;
  bool beyond = false;
  for (const ModePoint& point : points) {
    if (!point.accepted()) continue;
    if (before) {
      EXPECT_LE(std::abs(std::log(point.energy_ratio / before->energy_ratio)), options.max_jump);
    }
    beyond = beyond || point.energy_ratio > 5.0;
    before = &point;
  }
  EXPECT_TRUE(beyond);
}

TEST(NonlinearMode, PrescribedEnergyIsMetAndBelowContactGivesTheLinearMode) {
  const UnitRod rod(20, 0.5);
  const NonlinearMode mode = rod_mode(rod, 10, 20);
  const auto points = backbone(mode, {});
  const ModePoint high = at_energy(mode, points, 3.0);
  ASSERT_EQ(high.status, ModeStatus::converged);
  EXPECT_NEAR(high.energy_ratio, 3.0, 3e-9);
  const ModePoint low = at_energy(mode, points, 0.7);
  EXPECT_EQ(low.status, ModeStatus::linear);
  EXPECT_DOUBLE_EQ(low.omega, mode.linear_omega());
  EXPECT_LT(low.max_penetration, 0.0);
}

TEST(NonlinearMode, MotionShiftedByASampleIsTheSameMotion) {
  const UnitRod rod(20, 0.5);
  const NonlinearMode mode = rod_mode(rod, 5, 20);
  const ModePoint point = mode.at_frequency_by_harmonic_continuation(1.15 * mode.linear_omega());
  ASSERT_TRUE(point.accepted());
  std::vector<int> shifted;
  for (const int sample : point.active) shifted.push_back((sample + 7) % 20);
  const ModePoint moved = mode.at_frequency(point.omega, shifted);
  ASSERT_TRUE(moved.accepted());
  EXPECT_NEAR(moved.energy_ratio, point.energy_ratio, 1e-11 * point.energy_ratio);
  for (int k = 0; k < 20; ++k)
    EXPECT_NEAR(moved.force(0, (k + 7) % 20), point.force(0, k), 1e-10 * point.force.maxCoeff());
}

TEST(NonlinearModeOptions, ValidateNamesTheFieldTheValueAndWhatIsAllowed) {
  const auto message = [](const NonlinearModeOptions& options) -> std::string {
    try {
      options.validate();
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(message({}), "accepted");
  EXPECT_EQ(message({.mode = 0}), "NonlinearModeOptions: mode is 0; it must be at least 1");
  EXPECT_EQ(message({.harmonics = 0}), "NonlinearModeOptions: harmonics is 0; it must be at least 1");
  EXPECT_EQ(message({.harmonics = 10, .samples = 19}),
            "NonlinearModeOptions: samples is 19; it must be at least twice the harmonics, which are 10");
  EXPECT_EQ(message({.tolerance = -1e-3}),
            "NonlinearModeOptions: tolerance is -0.001; it must be positive and finite");
  EXPECT_EQ(message({.max_iterations = 0}),
            "NonlinearModeOptions: max_iterations is 0; it must be at least 1");
}

TEST(NonlinearMode, BadOptionsAreErrorsThatNameTheValue) {
  const UnitRod rod(4);
  EXPECT_THROW(rod_mode(rod, 10, 19), std::invalid_argument);
  EXPECT_THROW(rod_mode(rod, 0, 20), std::invalid_argument);
  EXPECT_THROW(NonlinearMode(rod.model, {.mode = 5}), std::invalid_argument);
  ModalModel negative = rod.model;
  negative.gaps[0] = -1.0;
  EXPECT_THROW(NonlinearMode(negative, {}), std::invalid_argument);
  EXPECT_THROW(backbone(rod_mode(rod, 2, 20), {.first_ratio = 0.9}), std::invalid_argument);
}

}  // namespace
}  // namespace wavebalance::solvers
