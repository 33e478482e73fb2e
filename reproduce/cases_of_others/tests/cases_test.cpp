// Holds the cases to their references, and the references to closed forms and to shooting.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <filesystem>
#include <tuple>

#include "constants.hpp"
#include "curve.hpp"
#include "dense_algebra.hpp"
#include "event_shooting.hpp"
#include "figures.hpp"
#include "paper_results.hpp"
#include "references.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"
#include "wavebalance/app/results/record.hpp"

namespace wavebalance::cases {
namespace {

namespace fs = std::filesystem;
using references::Type;
using testing::EventShooting;
using testing::SpringSystem;

// Of the cases whose scene is a curve; the other one is a motion.
const std::vector<std::string> names{
    "pyharm_onedofgap",  "nlvib_example03", "oscillator_with_stop", "small_gap_bar", "lightly_damped_bar",
    "impact_oscillator", "slider"};

report::PaperResults& results() {
  static report::PaperResults all(figures());
  return all;
}

fs::path scene_file(const std::string& name) {
  return fs::path(WAVEBALANCE_SCENES) / "cases_of_others" / (name + ".toml");
}

const app::Table& special_points(const app::Summary& summary) {
  if (const auto* points = app::value_in<app::Table>(summary, "special_points")) return *points;
  throw std::runtime_error("no special points");
}

TEST(CasesOfOthers, ACurveOfImpactsShowsTheirImpulses) {
  results().need({"impact_oscillator"});
  const app::Table table = results().read("impact_oscillator.csv");
  const auto impulse = table.numbers("impulse");
  EXPECT_EQ(impulse.front(), 0.0);
  EXPECT_GT(*std::max_element(impulse.begin(), impulse.end()), 3.0);
  const std::string script = app::read_file(results().folder() / "impact_oscillator.figure.js");
  EXPECT_NE(script.find("Impulse of the impact"), std::string::npos);
}

TEST(CasesOfOthers, PanelsWithALetterHaveATitle) {
  const std::vector<std::string> several{"den_hartog", "nlvib_example03", "pyharm_onedofgap", "slider"};
  results().need(several);
  for (const std::string& name : several) {
    const std::string text = app::read_file(results().folder() / (name + ".figure.js"));
    EXPECT_EQ(text.find(R"({"title":"","x":)"), std::string::npos) << name;
  }
}

TEST(CasesOfOthers, EachValueAgreesWithinItsTolerance) {
  std::vector<std::string> all = names;
  all.emplace_back("den_hartog");
  results().need(all);
  for (const auto& name : all) {
    const app::Table rows = results().read(name + "_comparison.csv");
    for (std::size_t i = 0; i < rows.rows(); ++i) {
      if (std::isnan(rows.numbers("given")[i])) continue;
      EXPECT_LE(std::abs(rows.numbers("difference")[i]), rows.numbers("tolerance")[i])
          << name << ": " << rows.texts("quantity")[i];
    }
    for (const auto& check : results().record(name).checks)
      EXPECT_TRUE(check.passes) << name << ": " << check.sentence << ", " << check.measured;
    EXPECT_TRUE(results().has(name + ".svg") && results().has(name + ".png") && results().has(name + ".md"));
  }
}

TEST(CasesOfOthers, TheCommandFindsTheSameSpecialPointsInEachScene) {
  results().need(names);
  for (const auto& name : names) {
    const app::Record record = app::analyse(app::load_scene(scene_file(name)));
    EXPECT_TRUE(record.converged) << name;
    const app::Table found = special_points(record.summary);
    const app::Table shown = results().read(name + "_special_points.csv");
    const bool angular = shown.columns()[1] == "frequency_rad_per_s";
    ASSERT_EQ(found.texts("type"), shown.texts("type")) << name;
    for (std::size_t i = 0; i < found.rows(); ++i)
      EXPECT_NEAR((angular ? two_pi : 1.0) * found.numbers("frequency_Hz")[i],
                  shown.numbers(shown.columns()[1])[i], 1e-12 * 1e4)
          << name;
  }
}

TEST(CasesOfOthers, ExactCurvesHaveTheSpecialPointsOfTheReferencesToTheirDigits) {
  constexpr double digits = 5e-9;  // of the references, nine or ten
  const std::vector<std::tuple<std::string, std::vector<references::KnownPoint>, double>> known{
      {"pyharm_onedofgap", references::pyharm_points, two_pi},
      {"nlvib_example03", references::nlvib_points, two_pi},
      {"oscillator_with_stop", references::oscillator_points, two_pi},
      {"small_gap_bar", references::small_gap_points, 1.0},
      {"lightly_damped_bar", references::lightly_damped_points, 1.0}};
  for (const auto& [name, points, unit] : known) {
    const std::vector<std::string> overrides{"analysis.exact=true", "analysis.branches=false"};
    const app::Record record = app::analyse(app::load_scene(scene_file(name), overrides));
    EXPECT_TRUE(record.converged) << name;
    const app::Table found = special_points(record.summary);
    if (unit != 1.0) {
      EXPECT_EQ(found.rows(), points.size()) << name;  // those of the bars are not all known
    }
    for (const references::KnownPoint& point : points) {
      double nearest = 1.0;
      for (std::size_t i = 0; i < found.rows(); ++i)
        if (found.texts("type")[i] == to_string(point.type))
          nearest =
              std::min(nearest, std::abs(unit * found.numbers("frequency_Hz")[i] / point.frequency - 1.0));
      EXPECT_LT(nearest, digits) << name << " " << to_string(point.type) << " " << point.frequency;
    }
  }
}

// Stick and slip as phases with exact instants, which neither bases nor samples take part in.
TEST(References, OfTheSliderAreThoseOfExactPhases) {
  constexpr double digits = 1e-8;
  for (const references::KnownSlip& known : references::slider_motions) {
    const std::vector<std::string> overrides{
        "analysis.type=forced_response", "time.method=phases",
        fmt::format("forcing.frequency={:.17g}", known.frequency / two_pi)},
        removed{"time.trial",
                "time.weight",
                "time.functions",
                "time.quadrature_points",
                "analysis.frequency_from",
                "analysis.frequency_to"};
    const app::Summary found =
        app::analyse(app::load_scene(scene_file("slider"), overrides, removed)).summary;
    const auto value = [&](const char* name) {
      const auto* number = app::value_in<double>(found, name);
      return number ? *number : std::nan("");
    };
    EXPECT_NEAR(value("friction_work_J"), known.work, digits * known.work) << known.frequency;
    EXPECT_NEAR(std::hypot(value("leading_multiplier_real"), value("leading_multiplier_imag")),
                known.multiplier, digits)
        << known.frequency;
  }
}

// Each hundredfold stiffness brings the motion ten times as near.
TEST(CasesOfOthers, StiffSlidersComeToRigidFrictionLikeTheRootOfTheirFlexibility) {
  results().need({"den_hartog"});
  const app::Table distances = results().read("den_hartog_distances.csv");
  for (const char* name : {"distance_at_0.75", "distance_at_1.5"}) {
    const auto distance = distances.numbers(name);
    ASSERT_EQ(distance.size(), 7U);
    for (std::size_t i = 4; i < distance.size(); ++i)
      EXPECT_NEAR(distance[i - 2] / distance[i], 10.0, 1.0) << name << " " << i;
  }
}

SpringSystem one_mass(double stiffness, double damping, double load, double spring, double gap) {
  const auto matrix = [](double value) { return Eigen::MatrixXd::Constant(1, 1, value); };
  return {matrix(1.0), matrix(damping), matrix(stiffness), Eigen::VectorXd::Constant(1, load), spring, gap};
}

SpringSystem pyharm_system() { return one_mass(40.0, 0.1 * std::sqrt(40.0), 100.0, 1000.0, 10.0); }
SpringSystem oscillator_system() { return one_mass(1.0, 0.1, 0.8, 10.0, 0.1); }
SpringSystem nlvib_system() {
  Eigen::MatrixXd stiffness(2, 2);
  stiffness << 1.0, -1.0, -1.0, 2.0;
  return {
      Eigen::MatrixXd::Identity(2, 2), 0.03 * stiffness, stiffness, Eigen::Vector2d(0.0, 0.1), 100.0, 1.0};
}

double free_amplitude(const SpringSystem& system, double omega) {
  const std::complex<double> i(0.0, 1.0);
  const Eigen::MatrixXcd dynamic =
      (system.stiffness - omega * omega * system.mass).cast<std::complex<double>>() +
      i * omega * system.damping.cast<std::complex<double>>();
  return std::abs(oracle::solve(dynamic, Eigen::VectorXcd(system.load.cast<std::complex<double>>()))[0]);
}

/// The system and the special points of a case without units.
struct Known {
  std::string name;
  SpringSystem system;
  std::vector<references::KnownPoint> points;
};
std::vector<Known> known_cases() {
  return {{names[0], pyharm_system(), references::pyharm_points},
          {names[1], nlvib_system(), references::nlvib_points},
          {names[2], oscillator_system(), references::oscillator_points}};
}

TEST(References, AtGrazingsTheFreeMotionReachesTheGap) {
  for (const Known& known : known_cases())
    for (const auto& point : known.points) {
      if (point.type != Type::grazing) continue;
      EXPECT_NEAR(free_amplitude(known.system, point.frequency) / known.system.gap, 1.0, 2e-8)
          << known.name << " " << point.frequency;
    }
}

double largest_displacement(const Eigen::VectorXd& samples) { return samples.maxCoeff(); }

/// The curve of a scene, coarser, to start from.
Curve coarse_curve(const std::string& name) {
  const std::vector<std::string> overrides{"time.functions=63", "time.quadrature_points=1024",
                                           "analysis.branches=false"};
  Curve curve{app::load_scene(scene_file(name), overrides), {}, {}, two_pi};
  curve.model = app::make_model(curve.scene);
  curve.sweep = app::frequency_sweep(curve.scene, curve.model);
  return curve;
}

/// The multipliers of the motion in contact at `omega`, by shooting from the one of the curve.
Eigen::VectorXcd multipliers(const Curve& curve, const SpringSystem& system, double omega) {
  const auto near = response_near(curve, omega, largest_displacement, 1.5 * system.gap, curve.scene.time);
  Eigen::VectorXd state(2 * system.load.size());
  state << near.structure.displacement.col(0), near.structure.velocity.col(0);
  const EventShooting shooting(system, omega);
  const testing::Period period = shooting.periodic(state);
  EXPECT_LT((period.end - state).norm(), 1e-10 * (1.0 + state.norm())) << omega;
  return oracle::eigenvalues(period.monodromy);
}

// Beside a grazing, multipliers change like the square root of the distance.
TEST(References, AtPeriodDoublingsAndNeimarkSackerPointsShootingHasAMultiplierOnTheCircle) {
  for (const Known& known : known_cases()) {
    const Curve curve = coarse_curve(known.name);
    for (const auto& point : known.points) {
      if (point.type != Type::period_doubling && point.type != Type::neimark_sacker) continue;
      double nearest = infinity;
      for (const std::complex<double> one : multipliers(curve, known.system, point.frequency))
        nearest = std::min(nearest, point.type == Type::period_doubling ? std::abs(one + 1.0)
                                                                        : std::abs(std::abs(one) - 1.0));
      const bool beside_grazing = std::abs(point.frequency - 0.5818996390) < 1e-5;
      EXPECT_LT(nearest, beside_grazing ? 1e-3 : 1e-5) << known.name << " " << point.frequency;
    }
  }
}

TEST(References, OscillatorsMultipliersAreThoseOfShooting) {
  const Curve curve = coarse_curve("oscillator_with_stop");
  for (const auto& motion : references::oscillator_motions) {
    double nearest = infinity;
    for (const std::complex<double> one : multipliers(curve, oscillator_system(), motion.frequency))
      nearest = std::min(nearest, std::abs(one - motion.multiplier));
    EXPECT_LT(nearest, 1e-7) << motion.frequency;
  }
}

TEST(Harmonics, OfASumOfCosinesAreItsAmplitudes) {
  Eigen::VectorXd samples(64);
  for (int k = 0; k < 64; ++k)
    samples[k] = -2.0 + 3.0 * std::cos(two_pi * k / 64.0 + 0.3) + 0.5 * std::sin(3.0 * two_pi * k / 64.0);
  EXPECT_LT((harmonics(samples, 3) - Eigen::Vector4d(2.0, 3.0, 0.0, 0.5)).cwiseAbs().maxCoeff(), 64 * eps);
}

}  // namespace
}  // namespace wavebalance::cases
