#include <iterator>

#include "dense_system.hpp"
#include "pairs.hpp"
#include "paper_values.hpp"
#include "period_oracle/shooting.hpp"
#include "testing.hpp"
#include "wavebalance/solvers/response/forced_response.hpp"
#include "wavebalance/solvers/response/frequency_sweep.hpp"
#include "wavebalance/solvers/response/response_motion.hpp"
#include "wavebalance/solvers/time/translate_spectrum.hpp"

// The six pairs of [JL14, Table 2] on both cases of [JL14, Table 1], against shooting and against figures
// that were computed independently of this project.
namespace wavebalance::pairs {
namespace {

using solvers::Formulation;
using solvers::InnerProducts;

const oracle::ShootingResult& reference(const Case& scene) {
  static const auto run = [](const Case& c) {
    oracle::ShootingOptions how{.full_history = true};
    return oracle::shoot(c.structure(), c.law(), c.frequency_hz, how);
  };
  static const oracle::ShootingResult results[] = {run(cases[0]), run(cases[1])};
  return results[&scene - cases];
}

struct Solved {
  solvers::CondensedProblem problem;
  solvers::PeriodicResponse response;
};

Solved solve(const Pair& pair, const Case& scene, int functions, double sample_offset = 0.0,
             solvers::NyquistCoefficient nyquist = solvers::NyquistCoefficient::keep) {
  solvers::TimePairOptions how = paper_options(pair, functions);
  how.sample_offset = sample_offset;
  how.nyquist = nyquist;
  solvers::CondensedProblem problem(time_pair(pair, functions, how), scene.structure(), cosine_load());
  problem.set_frequency(scene.frequency_hz);
  solvers::PeriodicResponse response = solvers::forced_response(problem, scene.law(), {});
  return {std::move(problem), std::move(response)};
}

// Relative rms of the tip displacement [JL14, section 5.5].
double tip_error(const Pair& pair, const Case& scene, int functions) {
  const Solved solved = solve(pair, scene, functions);
  EXPECT_TRUE(solved.response.converged()) << pair.name << " " << scene.name << " M " << functions;
  solvers::TrialEvaluator evaluate(solved.problem.pair().trial(), 1024, 0);
  const Eigen::VectorXd exact = reference(scene).contacts.displacement.row(0);
  return (evaluate(solved.response.coefficients) - exact).norm() / exact.norm();
}

TEST(PaperPairs, ReferencesConverge) {
  for (const Case& scene : cases) EXPECT_EQ(reference(scene).status, oracle::ShootingStatus::converged);
}

const Pair& pair_named(const std::string& name) {
  return *std::find_if(std::begin(table_2), std::end(table_2),
                       [&](const Pair& pair) { return name == pair.name; });
}

TEST(PaperPairs, ErrorsAreThoseOfAnIndependentComputation) {
  for (const auto& listed : paper_values::tip_errors) {
    const double found = tip_error(pair_named(listed.pair), cases[listed.case_number - 1], listed.functions);
    EXPECT_NEAR(found, listed.error, paper_values::tip_error_tolerance * listed.error)
        << listed.pair << " M " << listed.functions;
  }
}

// The best approximation of one harmonic by 64 Haar functions has an error of 2 pi / (64 sqrt(12)) = 2.8e-2.
// The other pairs have at most the 1.69e-3 of tip_errors.
TEST(PaperPairs, AllTwelveCombinationsWith64FunctionsConverge) {
  for (const Pair& pair : table_2)
    for (const Case& scene : cases) {
      const bool haar = pair.trial == Family::haar;
      EXPECT_LE(tip_error(pair, scene, 64), haar ? 4e-2 : 2e-3) << pair.name << " " << scene.name;
    }
}

// The residual of all n M equations, assembled independently of the condensation.
TEST(PaperPairs, EveryConvergedResponseSolvesTheAssembledSystem) {
  for (const Pair& pair : table_2)
    for (const Case& scene : cases) {
      Solved solved = solve(pair, scene, 64);
      ASSERT_TRUE(solved.response.converged());
      dense::DenseSystem system(scene.structure(), scene.law(),
                                dense::discretise(basis(pair.trial, 64), basis(pair.weight, 64),
                                                  paper_options(pair, 64), cosine_load()));
      system.set_frequency(scene.frequency_hz);
      const Eigen::MatrixXcd spectra = solved.problem.full_coefficients(solved.response.contact_force);
      Eigen::VectorXd coefficients(system.unknowns());
      for (int i = 0; i < 25; ++i)
        coefficients.segment(64 * i, 64) = solvers::translate_coefficients(spectra.row(i), 64);
      EXPECT_LE(system.relative_residual(coefficients), 1e-10) << pair.name << " " << scene.name;
      const Eigen::VectorXd& force = solved.response.contact_force;
      for (int l = 0; l < force.size(); ++l) {
        EXPECT_GE(force[l], 0.0);
        EXPECT_EQ(force[l] > 0.0, solved.response.displacement[l] > scene.gap);
      }
    }
}

// Haar:Fourier at 150 Hz with sums over the middles: errors that are listed with three digits. The
// cosine that the other computation keeps is zero on average over each cell, so that its Nyquist coefficient
// has no force.
TEST(PaperPairs, HaarFourierAtTheMiddlesIsThatOfAnIndependentComputation) {
  const Case& scene = cases[0];
  constexpr int functions = 64, points = 1024, cell = points / functions;
  const Solved solved =
      solve(pair_named("haar_fourier"), scene, functions, 0.5, solvers::NyquistCoefficient::drop);
  ASSERT_TRUE(solved.response.converged());
  const solvers::Motion found = solvers::contact_motion(solved.problem, solved.response, scene.law(), points);
  const solvers::Motion& exact = reference(scene).contacts;
  const auto error = [](const Eigen::MatrixXd& values, const Eigen::MatrixXd& truth) {
    return (values - truth).norm() / truth.norm();
  };
  EXPECT_NEAR(error(found.displacement, exact.displacement), 0.0323, 1e-4);
  EXPECT_NEAR(error(found.velocity, exact.velocity), 0.200, 5e-4);
  EXPECT_NEAR(error(found.force, exact.force), 0.506, 5e-4);
  const auto middles = Eigen::seqN(cell / 2, functions, cell);
  EXPECT_NEAR(error(found.displacement(0, middles), exact.displacement(0, middles)), 0.0127, 5e-5);
  int touching = 0, within = 0;
  for (int l = 0; l < points; ++l) {
    if (exact.force(0, l) <= 0.0) continue;
    ++touching;
    within += std::abs(found.displacement(0, l) - exact.displacement(0, l)) < 0.02 * scene.gap;
  }
  EXPECT_NEAR(double(within) / touching, 0.927, 1.0 / touching);
}

TEST(PaperPairs, AdmissibilityIsThatOfTheSobolevExponents) {
  const auto verdict = [](const wavelets::ScalingFunction& trial, const wavelets::ScalingFunction& weight) {
    return solvers::admissibility(wavelets::PeriodicBasis(trial, 5), wavelets::PeriodicBasis(weight, 5),
                                  Formulation::distributional, InnerProducts::exact);
  };
  const auto haar = wavelets::ScalingFunction::haar();
  const auto bspline = wavelets::ScalingFunction::orthonormal_bspline();
  const auto db4 = wavelets::ScalingFunction::daubechies(4), db6 = wavelets::ScalingFunction::daubechies(6);
  EXPECT_TRUE(verdict(haar, bspline).admissible);
  EXPECT_TRUE(verdict(db6, db6).admissible);
  for (const auto& [trial, weight] : {std::pair{haar, haar}, {haar, db6}, {db4, db4}}) {
    const auto refused = verdict(trial, weight);
    EXPECT_FALSE(refused.admissible) << trial.name() << ":" << weight.name();
    EXPECT_NE(refused.reason.find(std::to_string(trial.sobolev_exponent())), std::string::npos)
        << refused.reason;
    EXPECT_NE(refused.reason.find("sum above 2"), std::string::npos) << refused.reason;
    EXPECT_THROW(solvers::TimePair(wavelets::PeriodicBasis(trial, 5), wavelets::PeriodicBasis(weight, 5),
                                   {.quadrature_points = 64}),
                 solvers::InadmissiblePair);
  }
}

// Rms over the period of the energy, over that of shooting [JL14, Fig. 10].
TEST(PaperPairs, EnergyNormOfDaubechies6IsThatOfAnIndependentComputation) {
  for (const auto& listed : paper_values::energy_norms) {
    const Case& scene = cases[listed.case_number - 1];
    const double exact = solvers::energy_norm(scene.structure(), scene.law(), reference(scene).structure);
    Solved solved = solve(table_2[2], scene, listed.functions);
    ASSERT_TRUE(solved.response.converged());
    const auto motion = solvers::structure_motion(solved.problem, solved.response, 1024);
    EXPECT_NEAR(solvers::energy_norm(scene.structure(), scene.law(), motion) / exact, listed.ratio,
                listed.tolerance)
        << "case " << listed.case_number << ", M " << listed.functions;
  }
}

// The steps of Haar functions make the discrete curve turn several times beside its fold; coarse steps may
// pass some of these turns, but not the fold nor the grazing point.
TEST(PaperPairs, SweepsOfFourierAndHaarPassFoldAndCornerInBothDirections) {
  for (const Pair& pair : {table_2[0], table_2[3]})
    for (const bool rising : {true, false}) {
      const Case& scene = cases[1];
      solvers::CondensedProblem problem(time_pair(pair, 64, paper_options(pair, 64)), scene.structure(),
                                        cosine_load());
      solvers::FrequencySweepOptions how;
      how.from = rising ? 1100.0 : 1700.0;
      how.to = rising ? 1700.0 : 1100.0;
      const solvers::FrequencySweep sweep = solvers::frequency_sweep(problem, scene.law(), how);
      ASSERT_EQ(sweep.status, solvers::SweepStatus::reached_end) << pair.name;
      ASSERT_GE(sweep.turning_points.size(), 2u);
      const auto& fold = rising ? sweep.turning_points.front() : sweep.turning_points.back();
      const auto& turn = rising ? sweep.turning_points.back() : sweep.turning_points.front();
      EXPECT_NEAR(fold.frequency, 1337.748, pair.trial == Family::haar ? 1.5 : 0.1);
      EXPECT_NEAR(turn.frequency, 1315.067, 0.1);
      EXPECT_TRUE(turn.grazing);
    }
}

}  // namespace
}  // namespace wavebalance::pairs
