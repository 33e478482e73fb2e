#include "wavebalance/app/analysis/nyquist_resonances.hpp"

#include <gtest/gtest.h>

#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"
#include "wavebalance/fem/eigenmodes.hpp"

namespace wavebalance::app {
namespace {

Scene case2(const std::string& trial, const std::string& weight, int functions) {
  const std::vector<std::string> overrides{"time.trial=" + trial, "time.weight=" + weight,
                                           "time.functions=" + std::to_string(functions)};
  return load_scene(std::string(WAVEBALANCE_SCENES) + "/jones_legrand_2014/case2.toml", overrides);
}

TEST(NyquistResonances, OfFourierAreNaturalFrequenciesDividedByTheHarmonic) {
  const Scene scene = case2("fourier", "fourier", 64);
  const auto structure = make_structure(scene);
  const auto modes = fem::eigenmodes(structure.stiffness, structure.mass, structure.size());
  const auto found = nyquist_resonances(scene, 0.0, 1e9);
  ASSERT_EQ(found.size(), static_cast<std::size_t>(structure.size()));
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_NEAR(found[i], modes.frequencies_hz[static_cast<Eigen::Index>(i)] / 32.0, 1e-9 * found[i]);
}

TEST(NyquistResonances, KeepToTheInterval) {
  for (const double frequency : nyquist_resonances(case2("fourier", "fourier", 64), 1200.0, 1400.0)) {
    EXPECT_GE(frequency, 1200.0);
    EXPECT_LE(frequency, 1400.0);
  }
}

TEST(NyquistResonances, DoNotExistForFullHarmonicsAndDampedPairs) {
  EXPECT_TRUE(nyquist_resonances(case2("fourier", "fourier", 63), 0.0, 1e9).empty());
  EXPECT_TRUE(nyquist_resonances(case2("haar", "fourier", 64), 0.0, 1e9).empty());
}

/// With the contact out of reach and a load at the Nyquist harmonic, the response is largest at the frequency
/// predicted.
TEST(NyquistResonances, AreWhereTheDynamicStiffnessOfTheNyquistCoefficientIsSingular) {
  const Scene scene = case2("bspline", "bspline", 64);
  const auto frequencies = nyquist_resonances(scene, 1200.0, 1300.0);
  ASSERT_EQ(frequencies.size(), 1u);
  const auto compliance = [&](double frequency) {
    auto problem = make_problem(scene);
    problem.set_frequency(frequency);
    Eigen::VectorXd force(problem.points()), displacement;
    for (Eigen::Index l = 0; l < force.size(); ++l)
      force[l] = (l / (force.size() / 64)) % 2 == 0 ? 1.0 : -1.0;
    problem.apply(force, displacement);
    return displacement.cwiseAbs().maxCoeff();
  };
  EXPECT_GT(compliance(frequencies[0] * (1.0 + 1e-7)), 1e3 * compliance(frequencies[0] * 1.02));
}

}  // namespace
}  // namespace wavebalance::app
