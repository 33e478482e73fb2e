#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "adaptive_wavelet.hpp"
#include "pairs.hpp"
#include "wavebalance/solvers/time/translate_spectrum.hpp"
#include "wavebalance/wavelets/fast_transform.hpp"

// Adaptive wavelet balance: what a selection of functions must have in common with the whole level.
namespace wavebalance::pairs {
namespace {

using solvers::InnerProducts;
using solvers::MultiscaleBasis;

constexpr Pair galerkin[] = {{"daubechies6", Family::daubechies6, Family::daubechies6},
                             {"bspline", Family::bspline, Family::bspline}};

solvers::CondensedProblem problem(const Pair& pair, const Case& scene, int functions, int points,
                                  std::complex<double> load = 1.0) {
  const auto how = options(pair, functions, points, InnerProducts::exact);
  solvers::CondensedProblem result(time_pair(pair, functions, how), scene.structure(),
                                   Eigen::Vector2cd(0.0, load));
  result.set_frequency(scene.frequency_hz);
  return result;
}

wavelets::FastWaveletTransform transform(const Pair& pair) {
  return wavelets::FastWaveletTransform(wavelets::two_scale_filter(scaling_function(pair.trial)).values);
}

MultiscaleBasis multiscale(const Pair& pair, int functions, int points, int levels) {
  return {basis(pair.trial, functions), points, transform(pair), levels};
}

double relative(const Eigen::VectorXd& u, const Eigen::VectorXd& reference) {
  return (u - reference).norm() / reference.norm();
}

// Every third function and the first block.
solvers::Selection sparse_selection(const MultiscaleBasis& basis) {
  solvers::Selection selection;
  for (int i = 0; i < basis.functions(); ++i)
    if (i < basis.size(0) || i % 3 == 0) selection.push_back(i);
  return selection;
}

// Newton's own tolerance must not hide what is compared.
solvers::NewtonOptions tight() {
  solvers::NewtonOptions options;
  options.tolerance = 1e-13;
  return options;
}

class AdaptiveGalerkin : public ::testing::TestWithParam<std::tuple<Pair, Case>> {
 protected:
  const Pair pair_ = std::get<0>(GetParam());
  const Case scene_ = std::get<1>(GetParam());
  // Where contact closes and opens, fractions of the period (of shooting).
  const std::vector<double> instants_ =
      scene_.frequency_hz < 1000.0 ? std::vector<double>{0.127, 0.887} : std::vector<double>{0.049, 0.156};
};

TEST_P(AdaptiveGalerkin, WithAllFunctionsIsTheUniformBalance) {
  auto whole = problem(pair_, scene_, 64, 256);
  solvers::ForcedResponseOptions options;
  options.newton = tight();
  const auto uniform = solvers::forced_response(whole, scene_.law(), options);
  const auto basis = multiscale(pair_, 64, 256, 3);
  const auto all = solvers::selected_response(
      solvers::selected_balance(whole, basis, basis.uniform(basis.blocks())), scene_.law(), tight());
  ASSERT_TRUE(uniform.converged() && all.converged());
  EXPECT_LE(relative(all.displacement, uniform.displacement), 1e-10);
  EXPECT_LE(relative(all.contact_force, uniform.contact_force), 1e-8);  // the law is stiff
}

TEST_P(AdaptiveGalerkin, LeavesAResidualOrthogonalToTheSelection) {
  auto whole = problem(pair_, scene_, 64, 256);
  const auto basis = multiscale(pair_, 64, 256, 3);
  const auto selection = solvers::near_instants(basis, instants_, 2, 4, 3.0);
  const auto response =
      solvers::selected_response(solvers::selected_balance(whole, basis, selection), scene_.law(), tight());
  ASSERT_TRUE(response.converged());
  const Eigen::VectorXcd answer = whole.coefficients(response.contact_force);
  const Eigen::VectorXd analysed = transform(pair_).analysis(solvers::translate_coefficients(answer, 64), 3);
  EXPECT_LE(relative(analysed(selection), response.coefficients), 1e-11);
  EXPECT_LE(relative(basis.analysis(answer), analysed), 1e-10);
  // Outside it something is left, or the test would hold for any selection.
  Eigen::VectorXd outside = analysed;
  for (const int function : selection) outside[function] = 0.0;
  EXPECT_GE(outside.norm(), 1e-5 * analysed.norm());
}

TEST_P(AdaptiveGalerkin, SelectsTheSameFunctionsOneCoarseCellLater) {
  constexpr int functions = 128, points = 512, levels = 4, coarse = functions >> levels;
  const auto basis = multiscale(pair_, functions, points, levels);
  solvers::AdaptiveOptions options;
  options.max_functions = 60;
  options.max_rounds = 6;
  auto now = problem(pair_, scene_, functions, points);
  auto later = problem(pair_, scene_, functions, points, std::polar(1.0, -2.0 * std::numbers::pi / coarse));
  const auto first = solvers::adaptive_response(now, basis, scene_.law(), options);
  const auto second = solvers::adaptive_response(later, basis, scene_.law(), options);
  ASSERT_EQ(first.rounds.size(), second.rounds.size());
  ASSERT_GE(first.rounds.size(), 3u);
  for (std::size_t i = 0; i < first.rounds.size(); ++i) {
    solvers::Selection shifted;
    for (const int function : first.rounds[i].response.selection) {
      const int block = basis.block_of(function), size = basis.size(block), start = basis.first(block);
      shifted.push_back(start + (function - start + size / coarse) % size);
    }
    std::sort(shifted.begin(), shifted.end());
    EXPECT_EQ(shifted, second.rounds[i].response.selection) << "round " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(PairsAndCases, AdaptiveGalerkin,
                         ::testing::Combine(::testing::ValuesIn(galerkin), ::testing::ValuesIn(cases)),
                         [](const auto& instance) {
                           return std::string(std::get<0>(instance.param).name) +
                                  (std::get<1>(instance.param).frequency_hz < 1000.0 ? "_case_1" : "_case_2");
                         });

// Measured: 1.3e-4 with 37 functions where the uniform 64 have 1.7e-4, 8e-6 with 61 where the uniform 128
// have 1.3e-5. A quarter of the uniform number is left for other machines' rounding.
TEST(AdaptiveWavelet, NeedsThreeQuartersOfTheUniformUnknownsOrFewerInCase2) {
  const Pair& bspline = galerkin[1];
  const Case& scene = cases[1];
  constexpr int functions = 256, points = 1024;
  auto fine = problem(bspline, scene, functions, points);
  const auto reference = solvers::forced_response(fine, scene.law(), {});
  ASSERT_TRUE(reference.converged());
  solvers::AdaptiveOptions options;
  options.tolerance = 1e-5;
  const auto adapted =
      solvers::adaptive_response(fine, multiscale(bspline, functions, points, 5), scene.law(), options);
  ASSERT_TRUE(adapted.met_tolerance);
  double previous = INFINITY;
  for (const auto& round : adapted.rounds) {
    const double error = relative(round.response.displacement, reference.displacement);
    EXPECT_LT(error, previous) << round.response.selection.size() << " functions";
    previous = error;
  }
  for (const int uniform_functions : {64, 128}) {
    auto uniform = problem(bspline, scene, uniform_functions, points);
    const auto response = solvers::forced_response(uniform, scene.law(), {});
    const double bound = relative(response.displacement, reference.displacement);
    const auto enough = std::find_if(adapted.rounds.begin(), adapted.rounds.end(), [&](const auto& round) {
      return relative(round.response.displacement, reference.displacement) <= bound;
    });
    ASSERT_NE(enough, adapted.rounds.end()) << uniform_functions;
    EXPECT_LE(4 * enough->response.selection.size(), 3u * static_cast<unsigned>(uniform_functions));
  }
}

TEST(MultiscaleBasis, SectionsAreThoseOfTheTransformedCirculant) {
  for (const Pair& pair : galerkin) {
    const auto basis = multiscale(pair, 16, 32, 2);
    auto whole = problem(pair, cases[0], 16, 32);
    const Eigen::VectorXcd symbol = whole.pair().symbol(1);
    const Eigen::VectorXd column = solvers::translate_coefficients(symbol, 16);
    Eigen::MatrixXd circulant(16, 16), analysis(16, 16);
    for (int j = 0; j < 16; ++j) {
      for (int i = 0; i < 16; ++i) circulant(i, j) = column[(i - j + 16) % 16];
      analysis.col(j) = transform(pair).analysis(Eigen::VectorXd::Unit(16, j), 2);
    }
    const Eigen::MatrixXd expected = analysis * circulant * analysis.transpose();
    const auto selection = sparse_selection(basis);
    const Eigen::MatrixXd difference =
        basis.section(symbol, selection) - Eigen::MatrixXd(expected(selection, selection));
    EXPECT_LE(difference.cwiseAbs().maxCoeff(), 1e-10 * expected.cwiseAbs().maxCoeff()) << pair.name;
  }
}

TEST(MultiscaleBasis, FindsTheFunctionsAroundAnInstant) {
  const auto basis = multiscale(galerkin[1], 64, 128, 3);
  for (int function = 0; function < 64; ++function) {
    const int block = basis.block_of(function);
    const auto found = basis.around(block, basis.centre(function), 0.4 / basis.size(block));
    EXPECT_EQ(found, std::vector<int>{function});
  }
  EXPECT_EQ(basis.around(3, 0.99, 0.5).size(), 32u);
}

TEST(AdaptiveWavelet, NamesWhatDoesNotFit) {
  auto whole = problem(galerkin[0], cases[0], 32, 64);
  const auto basis = multiscale(galerkin[0], 32, 64, 2);
  EXPECT_THROW(solvers::selected_balance(whole, basis, {}), std::invalid_argument);
  EXPECT_THROW(solvers::selected_balance(whole, basis, {3, 2}), std::invalid_argument);
  EXPECT_THROW(solvers::selected_balance(whole, basis, {32}), std::invalid_argument);
  EXPECT_THROW(solvers::selected_balance(whole, multiscale(galerkin[0], 16, 64, 2), {0}),
               std::invalid_argument);
  EXPECT_THROW(multiscale(galerkin[0], 32, 48, 2), std::invalid_argument);
  EXPECT_THROW(multiscale(galerkin[0], 32, 64, 6), std::invalid_argument);
  EXPECT_THROW(basis.uniform(4), std::invalid_argument);
  auto touching_twice = cases[0].structure();
  touching_twice.contact_directions = solvers::contact_rows({23, 24}, touching_twice.size());
  const auto how = options(galerkin[0], 32, 64, InnerProducts::exact);
  solvers::CondensedProblem twice(time_pair(galerkin[0], 32, how), touching_twice, cosine_load());
  twice.set_frequency(150.0);
  EXPECT_THROW(solvers::selected_balance(twice, basis, {0}), std::invalid_argument);
  solvers::AdaptiveOptions adapt;
  adapt.fraction = 0.0;
  EXPECT_THROW(solvers::adaptive_response(whole, basis, cases[0].law(), adapt), std::invalid_argument);
}

}  // namespace
}  // namespace wavebalance::pairs
