#include "nyquist_resonances.hpp"

#include <gtest/gtest.h>

#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/fem/eigenmodes.hpp"

namespace wavebalance::jl14 {
namespace {

using namespace app;

Scene case2(const std::string& trial, const std::string& weight, int functions) {
  const std::vector<std::string> overrides{"time.trial=" + trial, "time.weight=" + weight,
                                           "time.functions=" + std::to_string(functions),
                                           "time.nyquist=keep"};
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

TEST(NyquistResonances, DoNotExistForFullHarmonicsAndWhereTheCoefficientIsDropped) {
  EXPECT_TRUE(nyquist_resonances(case2("fourier", "fourier", 63), 0.0, 1e9).empty());
  Scene dropped = case2("fourier", "fourier", 64);
  dropped.time.nyquist = NyquistCoefficient::drop;
  EXPECT_TRUE(nyquist_resonances(dropped, 0.0, 1e9).empty());
}

/// Largest displacement of the contact for a force that alternates between +1 and -1 N.
double alternating_compliance(const Scene& scene, double frequency) {
  auto problem = make_problem(scene);
  problem.set_frequency(frequency);
  Eigen::VectorXd force(problem.points()), displacement;
  const Eigen::Index width = force.size() / scene.time.functions;
  for (Eigen::Index l = 0; l < force.size(); ++l) force[l] = (l / width) % 2 == 0 ? 1.0 : -1.0;
  problem.apply(force, displacement);
  return displacement.cwiseAbs().maxCoeff();
}

class NyquistResonancesOfPairs : public ::testing::TestWithParam<std::pair<const char*, const char*>> {};

/// Also for the pairs whose first derivative has a symbol that is not zero: being real, it does not damp.
TEST_P(NyquistResonancesOfPairs, AreWhereTheDynamicStiffnessOfTheNyquistCoefficientIsSingular) {
  Scene scene = case2(GetParam().first, GetParam().second, 64);
  const auto frequencies = nyquist_resonances(scene, 1100.0, 1700.0);
  ASSERT_FALSE(frequencies.empty());
  for (const double frequency : frequencies)
    EXPECT_GT(alternating_compliance(scene, frequency * (1.0 + 1e-7)),
              1e3 * alternating_compliance(scene, frequency * 1.002))
        << frequency;
  scene.time.nyquist = NyquistCoefficient::drop;
  EXPECT_LE(alternating_compliance(scene, frequencies[0]),
            2.0 * alternating_compliance(scene, frequencies[0] * 1.002));
}

/// A real generator has a real product of its coefficients at the two harmonics that alias to M/2.
TEST_P(NyquistResonancesOfPairs, BelongToACoefficientWhoseSymbolsAreReal) {
  for (const char* products : {"quadrature", "exact"}) {
    Scene scene = case2(GetParam().first, GetParam().second, 64);
    scene.time.inner_products =
        std::string(products) == "exact" ? InnerProducts::exact : InnerProducts::quadrature;
    const solvers::TimePair pair = make_pair(scene.time);
    for (int derivative = 0; derivative <= 2; ++derivative)
      EXPECT_LE(std::abs(pair.symbol(derivative)[32].imag()), 1e-10 * std::abs(pair.symbol(derivative)[31]))
          << products << " derivative " << derivative;
  }
}

INSTANTIATE_TEST_SUITE_P(Paper, NyquistResonancesOfPairs,
                         ::testing::Values(std::pair{"fourier", "fourier"}, std::pair{"bspline", "bspline"},
                                           std::pair{"daubechies6", "daubechies6"},
                                           std::pair{"haar", "fourier"}, std::pair{"daubechies6", "fourier"},
                                           std::pair{"haar", "bspline"}));

}  // namespace
}  // namespace wavebalance::jl14
