// Nonlinear modes with springs that act on both sides, and laws without a gap.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/scene_error.hpp"
#include "support/summary_value.hpp"
#include "temporary_folder.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"
#include "wavebalance/app/results/record.hpp"

namespace wavebalance::app {
namespace {

/// A mass of 1 kg on a spring of 1 N/m, and a law.
class ModeOfOneMass : public testing::Test {
 protected:
  ModeOfOneMass() { folder_.write("one.mtx", "%%MatrixMarket matrix array real general\n1 1\n1\n"); }
  std::string text(const std::string& law, const std::string& analysis) const {
    return "[structure]\ntype = \"matrices\"\nmass = \"one.mtx\"\nstiffness = \"one.mtx\"\ncontact_dofs = [1]\n"
           "[contact]\n" +
           law +
           "[forcing]\nload_dofs = [1]\namplitude = 0.0\n"
           "[analysis]\ntype = \"nonlinear_mode\"\n" +
           analysis;
  }
  Record solved(const std::string& law, const std::string& analysis) const {
    return analyse(parse_scene(text(law, analysis), (folder_.path() / "mode.toml").string()));
  }
  std::string refusal(const std::string& law, const std::string& analysis) const {
    return details_of_error(
               [&](const std::string& scene) { parse_scene(scene, (folder_.path() / "mode.toml").string()); },
               text(law, analysis))
        .allowed;
  }
  TemporaryFolder folder_;
};

/// The period of u'' + u + f(u) = 0 of an amplitude by the energy, 4 int du / sqrt(2 (V(a) - V(u))), where
/// the substitution u = a sin(t) takes the end's singularity away.
template <class Potential>
double period_of(double amplitude, const Potential& potential, int steps = 200000) {
  double sum = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double angle = 0.5 * std::numbers::pi * (i + 0.5) / steps, u = amplitude * std::sin(angle);
    sum += amplitude * std::cos(angle) / std::sqrt(2.0 * (potential(amplitude) - potential(u)));
  }
  return 4.0 * sum * 0.5 * std::numbers::pi / steps;
}

TEST_F(ModeOfOneMass, HasTheFrequencyOfDuffingsOscillatorAtEachEnergy) {
  const Record mode = solved("law = \"cubic\"\ncubic_stiffness = 0.5\n",
                             "reference_length = 1.0\nharmonics = 9\nsamples = 128\nlargest_energy = 4.0\n"
                             "last_frequency_ratio = 3.0\n");
  ASSERT_TRUE(mode.converged) << mode.status;
  const auto energies = mode.backbone.numbers("energy_ratio"),
             ratios = mode.backbone.numbers("frequency_ratio");
  ASSERT_GT(energies.size(), 20u);
  EXPECT_GT(energies.back(), 3.9);
  for (std::size_t i = 0; i < energies.size(); i += 5) {
    // Energy 1 is that of the linear mode of amplitude 1, 0.5 J: V(a) = a^2 / 2 + a^4 / 8.
    const double energy = 0.5 * energies[i],
                 amplitude = std::sqrt(2.0 * (std::sqrt(1.0 + 2.0 * energy) - 1.0));
    const double period = period_of(amplitude, [](double u) { return 0.5 * u * u + 0.125 * u * u * u * u; });
    EXPECT_NEAR(ratios[i], 2.0 * std::numbers::pi / period, 1e-7) << energies[i];
  }
  EXPECT_TRUE(std::isnan(value_of<double>(mode.summary, "max_penetration_over_gap")));
}

TEST_F(ModeOfOneMass, HasTheFrequencyOfAClearanceOnBothSides) {
  const Record mode =
      solved("law = \"clearance\"\nstiffness = 3.0\ngap = 0.5\n",
             "harmonics = 21\nsamples = 1024\nlargest_energy = 5.0\nlast_frequency_ratio = 1.9\n");
  ASSERT_TRUE(mode.converged) << mode.status;
  const auto energies = mode.backbone.numbers("energy_ratio"),
             ratios = mode.backbone.numbers("frequency_ratio");
  EXPECT_GT(energies.back(), 4.9);
  for (std::size_t i = 0; i < energies.size(); i += 7) {
    if (energies[i] < 1.05) {
      if (energies[i] < 1.0) {
        EXPECT_NEAR(ratios[i], 1.0, 1e-6) << energies[i];
      }
      continue;
    }
    // A linear oscillator between the stops, and another, w^2 = 4, beyond: a quarter of a period of each.
    const double energy = 0.125 * energies[i], inside = std::asin(0.5 / std::sqrt(2.0 * energy));
    // Beyond the stop u - 3/8 turns with w = 2: 4 (u - 3/8)^2 + v^2 stays the same.
    const double speed = std::sqrt(2.0 * energy - 0.25);
    const double outside = 0.5 * std::atan2(speed, 2.0 * (0.5 - 0.375));
    EXPECT_NEAR(ratios[i], 0.5 * std::numbers::pi / (inside + outside), 1e-4) << energies[i];
  }
}

TEST_F(ModeOfOneMass, NeedsALengthWhereNoGapIsOneAndTakesNoOther) {
  EXPECT_NE(refusal("law = \"cubic\"\ncubic_stiffness = 0.5\n", "").find("the law \"cubic\" has no gap"),
            std::string::npos);
  EXPECT_NE(refusal("law = \"clearance\"\nstiffness = 3.0\ngap = 0.5\n", "reference_length = 1.0\n")
                .find("all laws have gaps"),
            std::string::npos);
  EXPECT_NE(refusal("law = \"clearance\"\nstiffness = 3.0\ngap = 0.0\n", "").find("> 0 for a nonlinear mode"),
            std::string::npos);
}

/// u'' + u + f = 0 with f = 3 (u - 1/2) + c u' beyond the stop: the work of the damper over a period is that
/// of the artificial damping, xi times the mean square of the velocity, so that the amplitude of a free
/// motion decays so.
TEST_F(ModeOfOneMass, HasTheDampingThatAStopTakesOverTheAmplitude) {
  const std::string law = "law = \"kelvin_voigt\"\nstiffness = 3.0\ndamping = 0.05\ngap = 0.5\n";
  const Record mode = solved(law, "harmonics = 31\nsamples = 2048\nlargest_amplitude = 6.0\npoints = 40\n");
  ASSERT_TRUE(mode.converged) << mode.status;
  EXPECT_FALSE(mode.backbone.has_column("friction_work_J"));
  const auto ratios = mode.backbone.numbers("amplitude_ratio"),
             damping = mode.backbone.numbers("damping_ratio"),
             frequencies = mode.backbone.numbers("frequency_ratio");
  EXPECT_NEAR(value_of<double>(mode.summary, "slip_amplitude_m"), 0.5, 1e-12);
  EXPECT_NEAR(damping.front(), 0.0, 1e-10);
  EXPECT_NEAR(frequencies.front(), 1.0, 1e-9);
  EXPECT_GT(ratios.back(), 5.9);
  EXPECT_GT(damping.back(), 0.003);
  EXPECT_GT(frequencies.back(), 1.1);
  // One motion: what the damper takes is what the artificial damping gives.
  const Record motion = solved(law, "harmonics = 31\nsamples = 2048\namplitude_ratio = 3.0\n");
  ASSERT_TRUE(motion.converged) << motion.status;
  const auto f = motion.response.numbers("contact_force_N"), v = motion.response.numbers("velocity_m_per_s");
  double taken = 0.0, square = 0.0;
  for (std::size_t i = 0; i < f.size(); ++i) {
    taken += f[i] * v[i];
    square += v[i] * v[i];
  }
  const double omega = 2.0 * std::numbers::pi * value_of<double>(motion.summary, "frequency_Hz");
  EXPECT_NEAR(value_of<double>(motion.summary, "damping_ratio"), taken / square / (2.0 * omega),
              0.01 * value_of<double>(motion.summary, "damping_ratio"));
}

}  // namespace
}  // namespace wavebalance::app
