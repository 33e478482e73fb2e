// Holds what the program writes to known values: those of the references come from an independent shooting
// solution, the errors from an independent implementation.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>

#include "figures.hpp"
#include "jl14.hpp"
#include "jl14_results.hpp"
#include "paper_values.hpp"
#include "readings.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"
#include "wavebalance/app/files/output.hpp"

namespace wavebalance::jl14 {
namespace {

namespace fs = std::filesystem;
using Columns = std::vector<std::string>;

const Columns pair_columns{
    "time_fraction",           "reference",    "fourier_fourier",     "bspline_bspline",
    "daubechies6_daubechies6", "haar_fourier", "daubechies6_fourier", "haar_bspline"};

/// Starts the program with a folder of its own for what it writes.
class Jl14Program : public testing::Test {
 protected:
  int run(std::vector<const char*> arguments) {
    const std::string output = folder_.path().string();
    arguments.insert(arguments.begin(), "jl14");
    arguments.insert(arguments.end(), {"--output", output.c_str()});
    testing::internal::CaptureStderr();
    const int code = report::run_program(static_cast<int>(arguments.size()), arguments.data(), figures());
    messages_ = testing::internal::GetCapturedStderr();
    return code;
  }

  TemporaryFolder folder_;
  std::string messages_;
};

Eigen::VectorXd column(const Table& table, const std::string& name) {
  const auto values = table.numbers(name);
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

double entry(const Table& table, int case_number, const std::string& name, int functions,
             const std::string& what) {
  const Pair& one = pair(name);
  return table.where("case", std::to_string(case_number))
      .where("trial", one.trial)
      .where("weight", one.weight)
      .where("functions", std::to_string(functions))
      .numbers(what)
      .at(0);
}

// Known to half a unit of the last digit.
TEST(Jl14Paper, ReferencesMeetTheShootingValues) {
  results().need({"reference_case1", "reference_case2"});
  const Table one = results().read("reference_case1.csv"), two = results().read("reference_case2.csv");
  EXPECT_NEAR(app::rms(column(one, "displacement_m")), 0.9316321e-3, 0.5e-10);
  EXPECT_NEAR(app::rms(column(two, "displacement_m")), 11.47116e-3, 0.5e-8);
  EXPECT_NEAR(column(one, "displacement_m").cwiseAbs().maxCoeff(), 1.438608e-3,
              1e-5 * 1.44e-3);  // of 1024 points
  EXPECT_NEAR(column(two, "displacement_m").cwiseAbs().maxCoeff(), 16.26369e-3, 1e-5 * 16.3e-3);
  EXPECT_NEAR(column(two, "contact_force_N").maxCoeff() / 250e3, 5.694, 2e-3);
  EXPECT_NEAR((column(one, "contact_force_N").array() > 0.0).cast<double>().mean(), 0.2396, 2.0 / 1024);
  EXPECT_NEAR((column(two, "contact_force_N").array() > 0.0).cast<double>().mean(), 0.1069, 2.0 / 1024);
}

TEST(Jl14Paper, ReferencesAreContactPhasesThatTimeSteppingComesNear) {
  results().need({"reference_case1", "reference_case2"});
  for (const std::string number : {"1", "2"}) {
    const std::string stem = "reference_case" + number;
    const auto scene =
        app::load_scene(std::string(WAVEBALANCE_SCENES) + "/jones_legrand_2014/" + stem + ".toml");
    EXPECT_EQ(scene.time.method, app::TimeMethod::exact) << stem;
    const auto exact = app::phases_response(scene);
    ASSERT_TRUE(exact.converged) << exact.status;
    EXPECT_LE(exact.phases->motion.estimated_error, scene.time.tolerance) << stem;
    const Table phases = results().read(stem + ".csv"),
                stepping = results().read(stem + "_time_stepping.csv");
    for (const char* name : {"displacement_m", "velocity_m_per_s", "contact_force_N"}) {
      const double distance = app::relative_rms_error(column(stepping, name), column(phases, name));
      EXPECT_LT(distance, 1e-5) << stem << " " << name;
      EXPECT_GT(distance, 1e-12) << "two methods do not share their digits: " << stem << " " << name;
    }
    EXPECT_LT(app::relative_rms_error(exact.displacement(), column(phases, "displacement_m")), 1e-12) << stem;
    EXPECT_TRUE(results().passes(stem, "finds the motion of the contact phases")) << stem;
  }
}

TEST(Jl14Paper, DisplacementsHaveTheirColumnsAndFiles) {
  results().need({"reference_case1", "reference_case2", "haar_readings", "fig06", "fig07"});
  for (const std::string stem : {"fig06_tip_displacement_case1", "fig07_tip_displacement_case2"}) {
    const Table table = results().read(stem + ".csv");
    EXPECT_EQ(table.columns(), pair_columns) << stem;
    EXPECT_EQ(table.rows(), 1024u) << stem;
    EXPECT_TRUE(results().has(stem + ".svg") && results().has(stem + ".png") &&
                results().has("records/" + stem + ".json"))
        << stem;
    const double error =
        app::relative_rms_error(column(table, "fourier_fourier"), column(table, "reference"));
    EXPECT_LT(error, 2e-3) << stem;
  }
}

TEST(Jl14Paper, MotionsForThePageAreThoseOfTheFigures) {
  results().need({"reference_case1", "reference_case2", "haar_readings", "fig06", "fig07"});
  const std::vector<std::string> stems{"fig06_tip_displacement_case1", "fig07_tip_displacement_case2"};
  for (std::size_t study = 0; study < 2; ++study) {
    const Table table = results().read(stems[study] + ".csv");
    const auto file = results().folder() / ("motion_case" + std::to_string(study + 1) + ".json");
    const auto motion = nlohmann::json::parse(app::read_file(file));
    const std::size_t instants = motion["time"].size();
    ASSERT_EQ(instants, 128u);
    EXPECT_EQ(motion["pairs"].size(), 6u);
    auto moving = motion["pairs"].get<std::vector<nlohmann::json>>();
    moving.push_back(motion["reference"]);
    for (const auto& one : moving) {
      const auto tip = table.numbers(one["name"].get<std::string>());
      ASSERT_EQ(one["nodes"].size(), instants);
      for (std::size_t i = 0; i < instants; ++i) {
        ASSERT_EQ(one["nodes"][i].size(), 26u);
        EXPECT_EQ(one["nodes"][i][0], 0.0);
        EXPECT_NEAR(one["nodes"][i][25], tip[i * tip.size() / instants], 5e-6 * 20e-3) << one["name"] << i;
        EXPECT_EQ(one["nodes"][i][25], one["tip"][i]);
        // The obstacle pushes where and only where the tip is beyond the gap.
        const double beyond = one["tip"][i].get<double>() - motion["gap"].get<double>();
        if (std::abs(beyond) > 2e-7) {
          EXPECT_EQ(one["force"][i] > 0.0, beyond > 0.0) << one["name"] << i;
        }
      }
    }
  }
}

double reading(const Table& table, const std::string& samples, const std::string& offset,
               const std::string& products, const std::string& nyquist, const std::string& weight,
               const std::string& what) {
  return table.where("samples", samples)
      .where("offset", offset)
      .where("inner_products", products)
      .where("nyquist", nyquist)
      .where("weight", weight)
      .numbers(what)
      .at(0);
}

TEST(Jl14Paper, HaarReadingsMeetAnIndependentSolver) {
  results().need({"reference_case1", "reference_case2", "haar_readings"});
  const Table table = results().read("haar_readings.csv");
  EXPECT_EQ(table.rows(), 2 * all_sums().size());
  const auto found = [&](const char* samples, const char* offset, const char* products, const char* nyquist,
                         const char* weight, const char* what) {
    return reading(table, samples, offset, products, nyquist, weight, what);
  };
  EXPECT_NEAR(found("256", "0", "quadrature", "keep", "fourier", "case1_rms_error"), 0.03746, 2e-5);
  EXPECT_NEAR(found("256", "0", "quadrature", "keep", "fourier", "case1_midpoint_error"), 0.02445, 2e-5);
  EXPECT_NEAR(found("256", "0", "quadrature", "keep", "fourier", "case1_force_error"), 0.624, 1e-3);
  EXPECT_NEAR(found("64", "0", "exact", "keep", "fourier", "case1_force_error"), 0.145, 1e-3);
  EXPECT_NEAR(found("64", "0", "exact", "keep", "bspline", "case1_force_error"), 0.146, 1e-3);
  EXPECT_NEAR(found("64", "0.5", "exact", "keep", "bspline", "case1_force_error"), 0.412, 1e-3);
  // At mid-points the cosine leaves no alternating part, and the sine does.
  EXPECT_NEAR(found("256", "0.5", "quadrature", "keep", "fourier", "case1_force_error"), 0.506, 1e-3);
  EXPECT_NEAR(found("256", "0.5", "quadrature", "keep", "bspline", "case1_force_error"), 0.365, 1e-3);
  EXPECT_NEAR(found("256", "0.5", "quadrature", "keep", "fourier", "case2_rms_error"), 0.0288, 1e-4);
  for (const double converged : table.numbers("converged")) EXPECT_EQ(converged, 1.0);
  EXPECT_TRUE(results().passes("haar_readings", "Exact inner products take the saw tooth away"));
}

TEST(Jl14Paper, TheFirstReadingIsThatOfTheScenes) {
  const fs::path file = std::string(WAVEBALANCE_SCENES) + "/jones_legrand_2014/case1.toml";
  const auto overrides = all_sums().front().overrides(pair("fourier_fourier"));
  EXPECT_EQ(app::load_scene(file, overrides), app::load_scene(file));
  EXPECT_TRUE(all_sums().front().of_text());
  EXPECT_EQ(all_sums().size(), 18u);
}

TEST(Jl14Paper, ChecksOfTheCodePass) {
  results().need({"reference_case1", "reference_case2", "fig02", "fig03", "fig04", "fig05", "tab02"});
  for (const char* stem :
       {"reference_case1", "reference_case2", "fig02_fourier_functions", "fig03_bspline_levels",
        "fig04_daubechies6_levels", "fig05_haar_levels", "tab02_pairs"}) {
    const auto record = results().record(stem);
    EXPECT_FALSE(record.checks.empty()) << stem;
    for (const auto& check : record.checks) EXPECT_TRUE(check.passes) << stem << ": " << check.sentence;
  }
}

TEST(Jl14Paper, ErrorsMeetAnIndependentImplementation) {
  results().need({"reference_case1", "reference_case2", "fig11"});
  const Table table = results().read("fig11_tip_error.csv");
  EXPECT_EQ(table.columns(),
            (Columns{"case", "trial", "weight", "functions", "rms_relative_error", "converged"}));
  EXPECT_EQ(table.rows(), 60u);
  for (const auto& listed : paper_values::tip_errors)
    EXPECT_NEAR(entry(table, listed.case_number, listed.pair, listed.functions, "rms_relative_error"),
                listed.error, paper_values::tip_error_tolerance * listed.error)
        << listed.pair << " " << listed.functions;
}

TEST(Jl14Paper, TheErrorsOfTheTipFillTheirAxis) {
  results().need({"reference_case1", "reference_case2", "fig11"});
  const std::string text = app::read_file(results().folder() / "fig11_tip_error.figure.js");
  const std::size_t begin = text.find(" = {") + 3;
  const auto panels = nlohmann::json::parse(text.substr(begin, text.rfind(';') - begin))["panels"];
  const auto errors = results().read("fig11_tip_error.csv").numbers("rms_relative_error");
  const auto [least, largest] = std::minmax_element(errors.begin(), errors.end());
  for (const auto& panel : panels) {
    EXPECT_GT(panel["y"]["lower"].get<double>(), *least / 2.0);
    EXPECT_LT(panel["y"]["upper"].get<double>(), *largest * 2.0);
  }
}

TEST(Jl14Paper, EnergyNormsMeetAnIndependentImplementation) {
  results().need({"reference_case1", "reference_case2", "fig10"});
  const Table table = results().read("fig10_energy_norm.csv");
  EXPECT_EQ(table.columns(),
            (Columns{"case", "trial", "weight", "functions", "energy_norm_ratio", "converged"}));
  for (const auto& listed : paper_values::energy_norms)
    EXPECT_NEAR(
        entry(table, listed.case_number, "daubechies6_daubechies6", listed.functions, "energy_norm_ratio"),
        listed.ratio, listed.tolerance)
        << "case " << listed.case_number << ", " << listed.functions;
}

TEST(Jl14Paper, FrequencyResponseTurnsWhereItShould) {
  results().need({"fig12"});
  const Table table = results().read("fig12_frequency_response.csv");
  EXPECT_EQ(table.columns(),
            (Columns{"trial", "weight", "frequency_Hz", "max_displacement_m", "rms_displacement_m",
                     "max_abs_displacement_m", "unstable", "functions"}));
  const auto frequency = table.where("functions", "64").where("trial", "fourier").numbers("frequency_Hz");
  EXPECT_NEAR(frequency.front(), 1100.0, 1e-9);
  EXPECT_GE(frequency.back(), 1699.0);
  const auto fold = std::adjacent_find(frequency.begin(), frequency.end(), std::greater<>());
  ASSERT_NE(fold, frequency.end());
  EXPECT_NEAR(*fold, 1337.748, 0.1);
  EXPECT_NEAR(*std::min_element(fold, frequency.end()), 1315.067, 0.1);
  EXPECT_FALSE(table.where("trial", "haar").empty());
}

TEST(Jl14Paper, TheFilesOfTheFrequencyResponseHoldAllSixPairsAndWhereTheyTurn) {
  results().need({"fig12"});
  const Table all = results().read("fig12_frequency_response.csv").where("functions", "64"),
              special = results().read("fig12_frequency_response_special_points.csv");
  for (const Pair& pair : pairs()) {
    const Table curve = all.where("trial", pair.trial).where("weight", pair.weight);
    EXPECT_GT(curve.rows(), 100u) << pair.label;
    const Table turns = special.where("curve", "first resonance, " + pair.label);
    ASSERT_EQ(turns.rows(), 2u) << pair.label;
    EXPECT_NEAR(turns.numbers("frequency_Hz")[0], 1337.9, 0.2) << pair.label;
    EXPECT_NEAR(turns.numbers("frequency_Hz")[1], 1315.0, 0.2) << pair.label;
  }
}

// Whoever draws the figure again finds the line, its stability and its marks in the files.
TEST(Jl14Paper, FilesOfTheFrequencyResponseHoldAllThatIsDrawn) {
  results().need({"fig12"});
  const Table line = results().read("fig12_frequency_response.csv").where("functions", "63");
  const auto frequency = line.numbers("frequency_Hz"), largest = line.numbers("max_displacement_m"),
             modulus = line.numbers("max_abs_displacement_m"), unstable = line.numbers("unstable");
  ASSERT_GT(line.rows(), 100u);
  int outside = 0, unknown = 0;  // on a grazing no multipliers are counted
  for (std::size_t i = 0; i < line.rows(); ++i) {
    EXPECT_GE(modulus[i], largest[i]) << frequency[i];
    unknown += std::isnan(unstable[i]) ? 1 : 0;
    outside += unstable[i] > 0.0 ? 1 : 0;
    if (unstable[i] > 0.0) {  // between the folds
      EXPECT_GT(frequency[i], 1314.0);
      EXPECT_LT(frequency[i], 1338.0);
    }
  }
  EXPECT_GT(outside, 3);
  EXPECT_LE(unknown, 2);
  const Table special = results().read("fig12_frequency_response_special_points.csv");
  const auto folds = special.where("curve", "first resonance, 63 functions").where("type", "fold");
  ASSERT_GE(folds.rows(), 1u);  // the other is a grazing
  EXPECT_NEAR(folds.numbers("frequency_Hz")[0], 1337.74, 0.1);
  EXPECT_EQ(special.where("curve", "first resonance, 63 functions").where("type", "grazing").rows(), 2u);
  const auto doublings =
      special.where("curve", "second resonance, small gap").where("type", "period_doubling");
  ASSERT_EQ(doublings.rows(), 2u);
  EXPECT_NEAR(doublings.numbers("frequency_Hz")[0], 3428.5, 0.5);
  EXPECT_NEAR(doublings.numbers("frequency_Hz")[1], 3960.3, 0.5);
}

TEST(Jl14Paper, TablesComeFromTheScenes) {
  results().need({"tab01", "tab02"});
  const Table cases = results().read("tab01_cases.csv");
  EXPECT_EQ(column(cases, "forcing_frequency_Hz"), Eigen::Vector2d(150.0, 1275.0));
  EXPECT_EQ(column(cases, "penalty_exponent_per_m"), Eigen::Vector2d(50.0, 20.0));
  EXPECT_EQ(column(cases, "initial_gap_m"), Eigen::Vector2d(1e-3, 14.5e-3));
  EXPECT_NEAR(column(cases, "free_max_displacement_m")[0], 1.439e-3, 1e-6);
  EXPECT_NEAR(column(cases, "free_max_displacement_m")[1], 28.84e-3, 1e-5);
  const Table listed = results().read("tab02_pairs.csv");
  EXPECT_EQ(listed.rows(), 6u);
  for (std::size_t i = 0; i < listed.rows(); ++i)
    EXPECT_TRUE(std::get<bool>(listed.at(i, "admissible"))) << i;
  EXPECT_TRUE(results().has("tab01_cases.md") && results().has("tab02_pairs.md"));
}

TEST(Jl14Paper, SketchAndBasesAreDrawn) {
  const std::map<std::string, std::string> stems{{"fig01", "system_sketch"},
                                                 {"fig02", "fourier_functions"},
                                                 {"fig03", "bspline_levels"},
                                                 {"fig04", "daubechies6_levels"},
                                                 {"fig05", "haar_levels"}};
  for (const auto& [figure, slug] : stems) {
    results().need({figure});
    for (const char* suffix : {".csv", ".svg", ".png"})
      EXPECT_TRUE(results().has(figure + "_" + slug + suffix)) << figure << suffix;
  }
}

TEST_F(Jl14Program, AMissingStepOrSceneIsAnErrorAndWritesNothing) {
  EXPECT_EQ(run({"fig06"}), 2);  // no reference
  EXPECT_NE(messages_.find("reference_case1.csv"), std::string::npos) << messages_;
  EXPECT_EQ(run({"tab01", "--scenes", "/nowhere"}), 2);
  EXPECT_NE(messages_.find("/nowhere/case1.toml"), std::string::npos) << messages_;
  EXPECT_EQ(run({"fig99"}), 2);
  EXPECT_NE(messages_.find("fig12"), std::string::npos) << "the steps that there are: " << messages_;
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

TEST(Jl14Paper, EverySceneReadsBackAsWritten) {
  int scenes = 0;
  for (const auto& file : fs::directory_iterator(std::string(WAVEBALANCE_SCENES) + "/jones_legrand_2014")) {
    const auto scene = app::load_scene(file.path());
    EXPECT_EQ(app::parse_scene(app::write_scene(scene), "written"), scene) << file.path();
    ++scenes;
  }
  EXPECT_GE(scenes, 11);
}

TEST(Jl14Paper, RigidObstacleFlattensThePlateauForAllPairs) {
  results().need({"reference_case1", "reference_case2", "rigid_plateau"});
  EXPECT_TRUE(results().has("rigid_plateau.svg") && results().has("rigid_plateau.png"));
  const auto checks = results().record("rigid_plateau").checks;
  EXPECT_EQ(checks.size(), 4u);
  for (const auto& check : checks) EXPECT_TRUE(check.passes) << check.sentence << " " << check.measured;
  const Table table = results().read("rigid_plateau.csv");
  for (const char* number : {"1", "2"}) {
    const Table rows = table.where("case", number), rigid = rows.where("contact", "rigid");
    ASSERT_EQ(rigid.rows(), 6u);
    const double penalty = rows.where("contact", "exponential").numbers("largest_penetration_over_gap").at(0);
    // Mean force over amplitude, found independently: 0.0502 to 0.0515 and 0.355; 64 functions are near.
    const double mean = number[0] == '1' ? 0.051 : 0.355;
    const Table exact = rows.where("contact", "rigid, contact phases");
    ASSERT_EQ(exact.rows(), 1u);
    EXPECT_NEAR(exact.numbers("mean_force_over_amplitude")[0], mean, number[0] == '1' ? 0.8e-3 : 0.5e-3);
    EXPECT_LT(exact.numbers("largest_penetration_over_gap")[0], 1e-12);
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_EQ(rigid.numbers("converged")[i], 1.0);
      EXPECT_LT(rigid.numbers("penetration_at_quadrature_points_over_gap")[i], 0.01);
      EXPECT_LT(rigid.numbers("largest_penetration_over_gap")[i], 0.5 * penalty);
      EXPECT_NEAR(rigid.numbers("mean_force_over_amplitude")[i], mean, 0.1 * mean);
    }
  }
}

}  // namespace
}  // namespace wavebalance::jl14
