// Motions of amplitude sweeps, and of the whole structure along a curve.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "period_oracle/shooting.hpp"
#include "support/chain_files.hpp"
#include "support/curve_record.hpp"
#include "support/scene_texts.hpp"
#include "support/summary_value.hpp"
#include "wavebalance/app/analysis/start_motion.hpp"
#include "wavebalance/app/compose/compose.hpp"

namespace wavebalance::app {
namespace {

// One harmonic of Duffing's oscillator, u = a cos: the load is a |1 + 3/4 a^2 - w^2 + i c w|.
TEST(CurveMotions, AtAnAmplitudeAreAllThoseOfTheClosedFormOfDuffingsOscillator) {
  const std::string scene =
      with(with(over_amplitude(stop_scene), "law = \"linear\"\nstiffness = 2.0\ngap = 1.0",
                "law = \"cubic\"\ncubic_stiffness = 1.0"),
           "frequency = 0.18", "frequency = 0.25");
  const double w = 2.0 * std::numbers::pi * 0.25, c = 0.05;
  const auto load = [&](double a) { return a * std::hypot(1.0 + 0.75 * a * a - w * w, c * w); };
  const Record record = analyse(parse_scene(
      scene, "duffing.toml",
      std::vector<std::string>{"time.functions=3", "time.quadrature_points=16", "analysis.amplitude_to=3",
                               "analysis.motion_at=[0.3, 0.7, 2.5]", "analysis.stability=false"}));
  ASSERT_TRUE(record.converged) << record.status;
  const Table motions = value_of<Table>(record.summary, "motions");
  for (const double asked : {0.3, 0.7, 2.5}) {
    std::vector<double> expected;
    constexpr double step = 1e-4;
    for (double a = 0.0; a < 4.0; a += step) {
      if ((load(a) - asked) * (load(a + step) - asked) > 0.0) continue;
      double low = a, high = a + step;
      for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        ((load(middle) - asked) * (load(low) - asked) > 0.0 ? low : high) = middle;
      }
      expected.push_back(low);
    }
    const Table found = motions.where("amplitude_N", cell_text(asked));
    ASSERT_EQ(found.rows(), expected.size()) << asked;
    EXPECT_EQ(found.where("at", "amplitude").rows(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i)
      EXPECT_NEAR(std::sqrt(2.0) * found.numbers("rms_displacement_m")[i], expected[i], 1e-8) << asked;
  }
  EXPECT_EQ(motions.rows(), 7u);  // three, three and one
}

TEST(CurveMotions, AtAnAmplitudeAreThoseOfShootingFromTheirState) {
  const Scene scene =
      load_with({"analysis.motion_at=0.2", "time.functions=201", "time.quadrature_points=2048"});
  const Record record = analyse(scene);
  ASSERT_TRUE(record.converged);
  EXPECT_EQ(value_of<Table>(record.summary, "motions").numbers("unstable_multipliers"),
            (std::vector<double>{0.0, 1.0, 0.0}));
  const StructureModel model = make_model(scene);  // under 0.2 N
  for (const char* name : {"motion_0.2N_1.csv", "motion_0.2N_2.csv", "motion_0.2N_3.csv"}) {
    const Table table = table_of(record, name);
    ASSERT_FALSE(table.empty());
    const auto shot = shot_from(scene, model, table);
    ASSERT_EQ(shot.status, oracle::ShootingStatus::converged) << name;
    const auto u = table.numbers("displacement_m");
    for (std::size_t l = 0; l < u.size(); ++l)
      EXPECT_NEAR(u[l], shot.contacts.displacement(0, Eigen::Index(l)), 5e-5) << name;
  }
}

TEST(CurveMotions, OverTheAmplitudeAreThoseOfThePeakTheFoldsAndBothEnds) {
  const Record record = analyse(load_with({"analysis.motion_at=[\"peak\", \"special\", 0.05, 0.5]"}));
  ASSERT_TRUE(record.converged);
  for (const char* name : {"motion_peak.csv", "motion_fold_1.csv", "motion_fold_2.csv",
                           "motion_grazing_1.csv", "motion_0.05N.csv", "motion_0.5N.csv"})
    EXPECT_NE(file_of(record, name), nullptr) << name;
  EXPECT_EQ(largest(table_of(record, "motion_peak.csv")),
            value_of<double>(record.summary, "max_displacement_m"));
  const Table motions = value_of<Table>(record.summary, "motions");
  EXPECT_EQ(motions.rows(), record.files.size());
  EXPECT_EQ(motions.where("at", "peak").numbers("amplitude_N"),
            std::vector<double>{value_of<double>(record.summary, "amplitude_at_max_displacement_N")});
  const Table folds = motions.where("at", "fold");
  const auto turns = value_of<std::vector<double>>(record.summary, "turning_points_N");
  ASSERT_EQ(folds.rows(), turns.size());
  // Motions are those of the balance, turning points those of the structure.
  for (std::size_t i = 0; i < turns.size(); ++i)
    EXPECT_NEAR(folds.numbers("amplitude_N")[i], turns[i], 1e-4 * turns[i]);
  for (const double residual : motions.numbers("residual")) EXPECT_LT(residual, 1e-9);
  EXPECT_TRUE(record.warnings.empty());
}

TEST(CurveMotions, OverTheAmplitudeStartAResponseOnTheirBranch) {
  const Record curve = analyse(load_with({"analysis.motion_at=0.2"}));
  for (const char* name : {"motion_0.2N_1.csv", "motion_0.2N_3.csv"}) {
    const Record near = analyse(response_with(), AnalysisOptions{.start = start_of(curve, name)});
    ASSERT_TRUE(near.converged) << name;
    EXPECT_NEAR(value_of<double>(near.summary, "max_displacement_m"), largest(table_of(curve, name)), 1e-8);
  }
}

/// The matrix of a Matrix Market file of a record.
Eigen::MatrixXd dense_file(const Record& record, const std::string& name, int rows, int instants) {
  const RecordFile* file = file_of(record, name);
  if (file == nullptr) return {};
  std::istringstream lines(file->contents);
  std::string line;
  do std::getline(lines, line);
  while (line.starts_with("%"));
  Eigen::MatrixXd values(rows, instants);
  for (double& value : values.reshaped()) lines >> value;
  return values;
}

// The structure is recovered at the place of the motion, wherever the search for it ended.
TEST(CurveMotions, OfTheWholeStructureMoveItsContactsAsTheContactsMove) {
  const TemporaryFolder folder;
  write_chain(folder);
  const std::string file = folder.write("chain.toml", chain_scene);
  const std::vector<std::string> both{"time.functions=31", "analysis.motion_points=16",
                                      "analysis.output_points=16", "analysis.stability=false"};
  const auto check = [&](std::vector<std::string> overrides, const std::string& suffix, std::size_t least) {
    overrides.insert(overrides.end(), both.begin(), both.end());
    const Record record = analyse(load_scene(file, overrides));
    ASSERT_TRUE(record.converged) << record.status;
    std::size_t compared = 0;
    for (const RecordFile& one : record.files) {
      if (!one.name.ends_with(".mtx")) continue;
      const std::string stem = one.name.substr(0, one.name.size() - 4);
      EXPECT_NE(stem.find(suffix), std::string::npos) << stem;
      const Eigen::MatrixXd whole = dense_file(record, one.name, 3, 16);
      const Table contacts = table_of(record, stem + "_contacts.csv");
      for (int contact = 1; contact <= 2; ++contact) {
        const auto u = contacts.where("contact", std::to_string(contact)).numbers("displacement_m");
        ASSERT_EQ(u.size(), 16u);
        const Eigen::Map<const Eigen::VectorXd> expected(u.data(), 16);
        EXPECT_LT((whole.row(contact).transpose() - expected).norm(), 1e-6 * expected.norm()) << stem;
      }
      ++compared;
    }
    EXPECT_GE(compared, least);
  };
  check({"analysis.type=frequency_sweep", "analysis.frequency_from=40", "analysis.frequency_to=48",
         "analysis.motion_at=[41, 43, 44, 45, 46, 47.5]"},
        "Hz", 6);
  check({"analysis.type=amplitude_sweep", "analysis.amplitude_from=20", "analysis.amplitude_to=400",
         "analysis.motion_at=[30, 100, 200, 350]"},
        "N", 4);
}

}  // namespace
}  // namespace wavebalance::app
