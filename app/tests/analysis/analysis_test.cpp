#include "wavebalance/app/results/record.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>

#include "support/bar_scene.hpp"
#include "support/scene_texts.hpp"
#include "support/summary_value.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"

namespace {

using namespace wavebalance::app;
namespace solvers = wavebalance::solvers;

TEST(MakeStructure, LoadAndContactAreAtTheTip) {
  const auto structure = make_structure(scene_of());
  EXPECT_EQ(structure.size(), 25);
  EXPECT_EQ(structure.contacts(), 1);
  EXPECT_EQ(structure.selected_dof(0), 24);
  EXPECT_EQ(structure.load[24], 250e3);
  EXPECT_EQ(structure.load.head(24).norm(), 0.0);
  const double eps = std::numeric_limits<double>::epsilon();
  EXPECT_LE((structure.damping - 1e-4 * structure.stiffness).norm(), 8 * eps * structure.damping.norm());
}

TEST(MakeLaw, FollowsTheScene) {
  EXPECT_EQ(make_law(scene_of().contact).gap(), 1e-3);
  EXPECT_NEAR(make_law(scene_of().contact).force(2e-3), 1e8 * std::expm1(50.0 * 1e-3), 1e-6);
  EXPECT_DOUBLE_EQ(make_law({.law = "linear", .values = {{"stiffness", 1e6}}, .gap = 1e-3}).force(3e-3), 2e3);
  EXPECT_EQ(make_law({}).force(1.0), 0.0);
}

TEST(MakePair, DaubechiesGalerkinTakesConnectionCoefficients) {
  Time time = scene_of().time;
  time.trial = time.weight = "daubechies6";
  EXPECT_EQ(effective_inner_products(time), InnerProducts::exact);
  EXPECT_EQ(make_pair(time).inner_products(), wavebalance::solvers::InnerProducts::exact);
  time.weight = "fourier";
  EXPECT_EQ(effective_inner_products(time), InnerProducts::quadrature);
  time.trial = time.weight = "bspline";
  EXPECT_EQ(effective_inner_products(time), InnerProducts::quadrature);
}

TEST(MakePair, ExactHaarFourierSeesInertiaAtTheNyquistFunction) {
  Time time = scene_of().time;
  time.trial = "haar";
  time.inner_products = InnerProducts::exact;
  const auto pair = make_pair(time);
  EXPECT_GT(std::abs(pair.symbol(2)[32]), 1e-3 * std::abs(pair.symbol(2)[31]));
}

TEST(MakePair, KeptNyquistCoefficientOfHaarAndBsplineIsZeroAtTheMiddles) {
  Time time = scene_of({"time.trial=haar", "time.weight=bspline", "time.nyquist=keep"}).time;
  EXPECT_FALSE(make_pair(time).drops_nyquist());
  time.sample_offset = 0.5;
  EXPECT_TRUE(make_pair(time).drops_nyquist());
  time.weight = "fourier";
  EXPECT_FALSE(make_pair(time).drops_nyquist());
}

TEST(MakeBasis, RefusesUnknownNamesAndSizes) {
  EXPECT_THROW(make_basis("fourie", 8), std::invalid_argument);
  EXPECT_THROW(make_basis("daubechies5", 8), std::invalid_argument);
  EXPECT_THROW(make_basis("haar", 12), std::invalid_argument);
  EXPECT_EQ(make_basis("fourier", 7).functions(), 7);
}

TEST(Analyse, ForcedResponseHoldsTheFieldsInOrder) {
  const Record record = analyse(scene_of());
  const std::vector<std::string> names{"converged",
                                       "status",
                                       "residual",
                                       "iterations",
                                       "unknowns",
                                       "wall_seconds",
                                       "solve_seconds",
                                       "max_displacement_m",
                                       "min_displacement_m",
                                       "rms_displacement_m",
                                       "vibration_m",
                                       "rms_vibration_m",
                                       "max_contact_force_N",
                                       "contact_fraction"};
  for (std::size_t i = 0; i < names.size(); ++i) EXPECT_EQ(record.summary[i].name, names[i]);
  EXPECT_TRUE(record.converged);
  EXPECT_TRUE(value_of<bool>(record.summary, "converged"));
  EXPECT_EQ(value_of<std::int64_t>(record.summary, "unknowns"), 64);
  EXPECT_LT(value_of<double>(record.summary, "residual"), 1e-10);
  EXPECT_EQ(record.response.columns(), (std::vector<std::string>{"time_fraction", "displacement_m",
                                                                 "velocity_m_per_s", "contact_force_N"}));
  EXPECT_EQ(record.response.rows(), 1024u);
  EXPECT_EQ(record.figure.panels.size(), 3u);
  EXPECT_TRUE(record.sweep.empty());
}

TEST(Analyse, PointOfASweepIsTheForcedResponseAtItsFrequency) {
  const Record curve = analyse(scene_of({"analysis.type=frequency_sweep", "analysis.frequency_from=150",
                                         "analysis.frequency_to=155", "analysis.stability=false"}));
  const Record motion = analyse(scene_of());
  const auto at_start = [&](const char* column) { return curve.sweep.numbers(column).at(0); };
  const auto of_motion = [&](const char* name) { return value_of<double>(motion.summary, name); };
  ASSERT_EQ(at_start("frequency_Hz"), of_motion("frequency_Hz"));
  const double peak = of_motion("max_displacement_m"), least = of_motion("min_displacement_m");
  ASSERT_GT(of_motion("contact_fraction"), 0.0);
  EXPECT_NEAR(at_start("max_displacement_m"), peak, 1e-9 * peak);
  EXPECT_NEAR(at_start("min_displacement_m"), least, 1e-9 * peak);
  EXPECT_NEAR(at_start("max_abs_displacement_m"), std::max(peak, -least), 1e-9 * peak);
  // A curve has forces at the 256 quadrature points, a motion at the 1024 points of its output.
  EXPECT_NEAR(at_start("contact_fraction"), of_motion("contact_fraction"), 4.0 / 256);
  const double force = of_motion("max_contact_force_N");
  EXPECT_LE(at_start("max_contact_force_N"), force * (1.0 + 1e-9));
  EXPECT_GT(at_start("max_contact_force_N"), 0.95 * force);
  const auto shares = curve.sweep.numbers("contact_fraction"),
             lows = curve.sweep.numbers("min_displacement_m");
  EXPECT_EQ(value_of<double>(curve.summary, "contact_fraction"),
            *std::max_element(shares.begin(), shares.end()));
  EXPECT_EQ(value_of<double>(curve.summary, "min_displacement_m"),
            *std::min_element(lows.begin(), lows.end()));
}

TEST(Analyse, SummaryIsThatOfTheResponse) {
  const Record record = analyse(scene_of());
  const auto u = record.response.numbers("displacement_m");
  const auto force = record.response.numbers("contact_force_N");
  EXPECT_EQ(value_of<double>(record.summary, "max_displacement_m"), *std::max_element(u.begin(), u.end()));
  EXPECT_EQ(value_of<double>(record.summary, "min_displacement_m"), *std::min_element(u.begin(), u.end()));
  const auto touching = std::count_if(force.begin(), force.end(), [](double f) { return f > 0; });
  EXPECT_DOUBLE_EQ(value_of<double>(record.summary, "contact_fraction"),
                   static_cast<double>(touching) / 1024);
  const auto gaps = std::count_if(u.begin(), u.end(), [](double x) { return x > 1e-3; });
  EXPECT_EQ(touching, gaps);
}

TEST(Analyse, VelocityIsTheRateOfTheDisplacement) {
  const Record record = analyse(scene_of({"analysis.output_points=4096"}));
  const auto u = record.response.numbers("displacement_m");
  const auto v = record.response.numbers("velocity_m_per_s");
  // The truncation error of the central difference, h^2/6 u''', with u''' <= (2 pi 32 f)^3 max|u|, is far
  // below 1e-2 max|v|.
  double largest = 0.0, worst = 0.0;
  for (std::size_t i = 1; i + 1 < u.size(); ++i) {
    worst = std::max(worst, std::abs(v[i] - (u[i + 1] - u[i - 1]) * 4096 * 150 / 2));
    largest = std::max(largest, std::abs(v[i]));
  }
  EXPECT_LT(worst, 1e-2 * largest);
}

TEST(Analyse, NoContactIsTheLinearResponse) {
  const Record record = analyse(
      parse_scene(with(with(with(with(bar_scene, "\"exponential\"", "\"none\""), "constant = 1e8", ""),
                            "exponent = 50.0", ""),
                       "gap = 1e-3", ""),
                  "case.toml"));
  EXPECT_TRUE(record.converged);
  EXPECT_EQ(value_of<double>(record.summary, "max_contact_force_N"), 0.0);
  EXPECT_EQ(value_of<double>(record.summary, "contact_fraction"), 0.0);
  // Amplitude without contact of JL14's case 1, found independently to four digits.
  EXPECT_NEAR(value_of<double>(record.summary, "max_displacement_m"), 1.439e-3, 5e-7);
  const double peak = value_of<double>(record.summary, "max_displacement_m");
  EXPECT_NEAR(value_of<double>(record.summary, "rms_displacement_m"), peak / std::sqrt(2.0), 1e-5 * peak);
}

TEST(Analyse, SweepGivesACurve) {
  const Record record = analyse(parse_scene(
      with(
          bar_scene, "\"forced_response\"        # 23",
          "\"frequency_sweep\"\nfrequency_from = 100\nfrequency_to = 200\nfirst_step = 20\nlargest_step = 20"),
      "case.toml", {{"time.functions=31", "structure.elements=5"}}));
  EXPECT_TRUE(record.converged) << record.status;
  EXPECT_EQ(record.sweep.columns(),
            (std::vector<std::string>{"frequency_Hz", "max_displacement_m", "rms_displacement_m",
                                      "min_displacement_m", "max_abs_displacement_m", "max_contact_force_N",
                                      "contact_fraction", "vibration_m", "rms_vibration_m", "unstable",
                                      "contacts"}));
  EXPECT_EQ(record.sweep.numbers("frequency_Hz").front(), 100.0);
  EXPECT_TRUE(record.response.empty());
  EXPECT_EQ(record.figure.panels.size(), 1u);
}

TEST(Analyse, UndampedResonanceIsToldByName) {
  Scene scene =
      scene_of({"structure.stiffness_damping=0", "structure.elements=1", "structure.youngs_modulus=1",
                "structure.density=3", "structure.area=1", "structure.length=1", "time.functions=9"});
  // One element: k = E A / l = 1 and m = rho A l / 3 = 1, so that the natural frequency is 1 / (2 pi).
  scene.forcing.frequency = 1.0 / (2.0 * std::acos(-1.0));
  const Record record = analyse(scene);
  EXPECT_FALSE(record.converged);
  EXPECT_NE(record.status.find("singular"), std::string::npos) << record.status;
  EXPECT_TRUE(std::isinf(value_of<double>(record.summary, "condition_estimate")));
  EXPECT_EQ(record.warnings.size(), 1u);
  EXPECT_TRUE(std::isnan(value_of<double>(record.summary, "max_displacement_m")));
}

TEST(Analyse, OrdinaryConditionsAreWithoutWarning) {
  const Record record = analyse(scene_of());
  EXPECT_GT(value_of<double>(record.summary, "condition_estimate"), 1.0);
  EXPECT_LT(value_of<double>(record.summary, "condition_estimate"), 1e12);
  EXPECT_TRUE(record.warnings.empty());
  EXPECT_TRUE(value_of<std::vector<std::string>>(record.summary, "warnings").empty());
  const Record stepped = analyse(scene_of({"analysis.type=time_stepping"}));
  EXPECT_TRUE(std::isnan(value_of<double>(stepped.summary, "condition_estimate")));
  EXPECT_TRUE(stepped.warnings.empty());
}

// An undamped oscillator without contact, whose natural frequency is 1 / (2 pi), at a frequency that is
// larger by this share; its dynamic stiffness k - omega^2 m is twice the share of k.
Scene beside_resonance(double share) {
  Scene scene =
      scene_of({"structure.stiffness_damping=0", "structure.elements=1", "structure.youngs_modulus=1",
                "structure.density=3", "structure.area=1", "structure.length=1", "time.functions=9"});
  scene.contact = {};
  scene.forcing.frequency = (1.0 + share) / (2.0 * std::acos(-1.0));
  return scene;
}

TEST(Analyse, RoundingErrorsPast1e6Warn) {
  const Record record = analyse(beside_resonance(1e-11));
  EXPECT_TRUE(record.converged) << record.status;
  EXPECT_NEAR(value_of<double>(record.summary, "rounding_error_estimate"), 9e-5, 1e-5);
  ASSERT_EQ(record.warnings.size(), 1u);
  EXPECT_NE(record.warnings[0].find("rounding error of the condensation"), std::string::npos)
      << record.warnings[0];
  const Record ordinary = analyse(beside_resonance(1e-6));
  EXPECT_LT(value_of<double>(ordinary.summary, "rounding_error_estimate"), 1e-8);
  EXPECT_TRUE(ordinary.warnings.empty());
}

TEST(Analyse, RoundingErrorsPastAThousandthOfTheMotionAreNoResponse) {
  const Record record = analyse(beside_resonance(1e-13));
  EXPECT_FALSE(record.converged);
  EXPECT_EQ(record.status.rfind("inaccurate: ", 0), 0u) << record.status;
  EXPECT_NE(record.status.find("of the motion, more than 1e-03"), std::string::npos) << record.status;
  EXPECT_EQ(value_of<std::string>(record.summary, "status"), record.status);
  EXPECT_TRUE(record.response.empty());  // the last iterate is no motion
  EXPECT_TRUE(std::isnan(value_of<double>(record.summary, "max_displacement_m")));
}

TEST(Analyse, SweepsWhoseRoundingErrorsPastAThousandthAreNotConverged) {
  Scene scene = beside_resonance(1e-13);
  scene.analysis.type = AnalysisType::frequency_sweep;
  scene.analysis.frequency_from = scene.forcing.frequency;
  scene.analysis.frequency_to = 2.0 * scene.forcing.frequency;
  scene.analysis.largest_step = 0.1 * scene.forcing.frequency;
  scene.analysis.first_step = 0.01 * scene.forcing.frequency;
  const Record record = analyse(scene);
  EXPECT_FALSE(record.converged);
  EXPECT_EQ(record.status.rfind("inaccurate: ", 0), 0u) << record.status;
}

// Ten equal oscillators in a ring, coupled to the next by 1e-4 of their stiffness; the load acts five of them
// away from the contact. The modal sum for the motion of the contact cancels all digits.
TEST(Analyse, MotionFarFromTheLoadInAWeaklyCoupledStructureIsAccurate) {
  constexpr int size = 10;
  Eigen::MatrixXd stiffness = 1e4 * Eigen::MatrixXd::Identity(size, size);
  for (int i = 0; i < size; ++i) {
    const int next = (i + 1) % size;
    stiffness(i, i) += 1.0;
    stiffness(next, next) += 1.0;
    stiffness(i, next) -= 1.0;
    stiffness(next, i) -= 1.0;
  }
  Scene scene = scene_of({"time.functions=9"});
  scene.contact = {};
  const double omega = 80.0;
  scene.forcing.frequency = omega / (2.0 * std::acos(-1.0));
  StructureModel model = make_model(scene);
  auto& structure = model.structure;
  structure.mass = Eigen::MatrixXd::Identity(size, size).sparseView();
  structure.stiffness = stiffness.sparseView();
  structure.damping = 0.5 * structure.mass;
  structure.load = Eigen::VectorXd::Unit(size, 5) * 1e18;
  structure.contact_directions = wavebalance::solvers::contact_rows({0}, structure.size());
  const Response response = weighted_residual_response(scene, model);
  const std::complex<double> added(-omega * omega, 0.5 * omega);
  const Eigen::MatrixXcd stiff = stiffness + added * Eigen::MatrixXcd::Identity(size, size);
  const double expected =
      std::abs(stiff.partialPivLu().solve(structure.load.cast<std::complex<double>>())[0]);
  EXPECT_TRUE(response.converged) << response.status;
  EXPECT_NEAR(response.displacement().cwiseAbs().maxCoeff(), expected, 1e-3 * expected);
  EXPECT_LT(response.rounding_error, 1e-11);
}

TEST(Analyse, ConditionsPast1e12Warn) {
  const Record record = analyse(beside_resonance(9e-13));
  EXPECT_TRUE(record.converged) << record.status;
  EXPECT_NEAR(value_of<double>(record.summary, "condition_estimate"), 1.11e12, 1e10);
  ASSERT_EQ(record.warnings.size(), 2u);  // of the rounding error too
  EXPECT_EQ(record.warnings, value_of<std::vector<std::string>>(record.summary, "warnings"));
  EXPECT_NE(record.warnings[0].find("past 1e+12"), std::string::npos) << record.warnings[0];
  EXPECT_NE(json_text(record.summary).find("\"warnings\": [\n    \"the condition"), std::string::npos);
}

TEST(Analyse, ASweepHasTheLargestConditionOfItsCurve) {
  const auto condition_up_to = [](const std::string& frequency) {
    const Scene scene =
        scene_of({"time.functions=31", "analysis.type=frequency_sweep", "analysis.stability=false",
                  "analysis.frequency_from=100", "analysis.frequency_to=" + frequency});
    return value_of<double>(analyse(scene).summary, "condition_estimate");
  };
  const double near = condition_up_to("110");
  EXPECT_GE(near, 1.0);
  EXPECT_GE(condition_up_to("200"), near);
}

TEST(Analyse, UnconvergedCurvesAreMarkedAsSuch) {
  const Record record = analyse(scene_of({"analysis.type=time_stepping", "analysis.max_periods=1"}));
  EXPECT_FALSE(record.converged);
  EXPECT_NE(record.figure.title.find("NOT CONVERGED"), std::string::npos);
  EXPECT_EQ(record.figure.panels[0].series[0].colour, Colour::grey);
}

TEST(Analyse, ObserverIsToldOfPeriods) {
  int calls = 0;
  double last = 0.0;
  analyse(scene_of({"analysis.type=time_stepping", "analysis.tolerance=1e-3"}),
          [&](const Progress& progress) {
            ++calls;
            last = progress.done;
            EXPECT_EQ(progress.phase, "time stepping");
            return true;
          });
  EXPECT_GE(calls, 2);
  EXPECT_EQ(last, 1.0);
}

TEST(Analyse, SweepThatItsObserverStopsHoldsThePointsSoFar) {
  int points = 0;
  const Record record = analyse(scene_of(sweep_overrides), [&](const Progress& progress) {
    points += progress.phase == "frequency sweep" ? 1 : 0;
    return points < 3;
  });
  EXPECT_TRUE(record.interrupted);
  EXPECT_FALSE(record.converged);
  EXPECT_EQ(record.status, "interrupted");
  EXPECT_EQ(record.sweep.rows(), 3u);
  EXPECT_EQ(value_of<std::string>(record.summary, "status"), "interrupted");
}

// Turning points found independently: 1331.0 and 1314.839 Hz.
TEST(Analyse, RigidSweepPassesFoldsAndSaysItsForm) {
  const std::vector<std::string> overrides{"time.trial=fourier", "time.weight=fourier", "time.functions=63",
                                           "time.quadrature_points=512", "analysis.largest_step=10"};
  const Scene scene = load_scene(WAVEBALANCE_SCENES "/jones_legrand_2014/case2_sweep_rigid.toml", overrides);
  const Record record = analyse(scene);
  EXPECT_EQ(record.status, "reached_end");
  EXPECT_EQ(value_of<std::string>(record.summary, "form"), "force");
  const auto turns = value_of<std::vector<double>>(record.summary, "turning_points_Hz");
  ASSERT_EQ(turns.size(), 2u);
  EXPECT_NEAR(turns[0], 1331.0, 0.2);
  EXPECT_NEAR(turns[1], 1314.839, 0.02);
  EXPECT_GT(value_of<double>(record.summary, "max_contact_force_N"), 0.0);
}

TEST(Analyse, SweepSaysAtWhichFrequencyItIsLargest) {
  std::vector<std::string> overrides = sweep_overrides;
  overrides.emplace_back("analysis.stability=false");
  const Record record = analyse(scene_of(overrides));
  const auto frequencies = record.sweep.numbers("frequency_Hz");
  const auto largest = record.sweep.numbers("max_displacement_m");
  const auto peak = std::max_element(largest.begin(), largest.end()) - largest.begin();
  EXPECT_EQ(value_of<double>(record.summary, "frequency_at_max_displacement_Hz"),
            frequencies[static_cast<std::size_t>(peak)]);
}

TEST(Analyse, SaysThatNoContactClosesAndThatNoLoadActs) {
  const Record open = analyse(scene_of({"contact.gap=5"}));
  ASSERT_TRUE(open.converged);
  ASSERT_EQ(open.warnings.size(), 1u);
  EXPECT_EQ(open.warnings[0].find("No contact closes: the nearest stays "), 0u) << open.warnings[0];
  EXPECT_NE(open.warnings[0].find(" short of its gap of 5 m."), std::string::npos) << open.warnings[0];
  EXPECT_TRUE(analyse(scene_of()).warnings.empty());
  const Record unloaded = analyse(scene_of({"forcing.amplitude=0"}));
  ASSERT_FALSE(unloaded.warnings.empty());
  EXPECT_EQ(unloaded.warnings[0].find("No load acts"), 0u) << unloaded.warnings[0];
}

TEST(DescribeScene, SaysHowLargeAndWhetherAdmissible) {
  const std::string text = describe_scene(scene_of());
  for (const char* part : {"25 elements", "64 unknowns", "1600 before", "admissible", "1273 Hz"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " is not in\n" << text;
  Scene scene = scene_of();
  scene.time.trial = "haar";
  scene.time.weight = "haar";
  EXPECT_NE(describe_scene(scene).find("NOT admissible"), std::string::npos);
}

}  // namespace
