// Motions at points of a sweep, and solutions that start from them.
#include "wavebalance/app/analysis/curve_motions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "period_oracle/shooting.hpp"
#include "support/chain_files.hpp"
#include "support/curve_record.hpp"
#include "support/scene_error.hpp"
#include "support/scene_texts.hpp"
#include "support/summary_value.hpp"
#include "temporary_folder.hpp"
#include "wavebalance/app/analysis/start_motion.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"
#include "wavebalance/app/files/output.hpp"
#include "wavebalance/app/scene/scene_keys.hpp"

namespace wavebalance::app {
namespace {

TEST(MotionAt, IsOneNameOneFrequencyOrAList) {
  const auto at = [](const std::string& value) {
    return stop_with({"analysis.motion_at=" + value}).analysis.motion_at;
  };
  EXPECT_EQ(at("peak"), (MotionAt{true, false, {}}));
  EXPECT_EQ(at("0.2"), (MotionAt{false, false, {0.2}}));
  EXPECT_EQ(at("[\"peak\", \"special\", 0.2, 0.18, 0.2]"), (MotionAt{true, true, {0.2, 0.18}}));
  EXPECT_EQ(at("[0.2]"), (MotionAt{false, false, {0.2}}));
  EXPECT_EQ(at("[\"special\"]"), (MotionAt{false, true, {}}));
  const Scene whole =
      parse_scene(with(stop_scene, "from = 0.13", "from = 1"), "stop.toml",
                  std::vector<std::string>{"analysis.frequency_to=3", "analysis.motion_at=[\"peak\", 2]"});
  EXPECT_EQ(whole.analysis.motion_at, (MotionAt{true, false, {2.0}}));
}

// Stopped for good at the first step of a phase.
Observer stop_at(const std::string& phase) {
  return [phase, stopped = false](const solvers::Progress& progress) mutable {
    stopped = stopped || progress.phase == phase;
    return !stopped;
  };
}

TEST(InterruptedSweep, HasNotConvergedWhereverTheInterruptionCame) {
  for (const std::string phase : {"frequency sweep", "stability", "motions"}) {
    const Record record = analyse(stop_with({"analysis.motion_at=[\"peak\", 0.18, 0.24]"}), stop_at(phase));
    EXPECT_TRUE(record.interrupted) << phase;
    EXPECT_FALSE(record.converged) << phase;
    EXPECT_EQ(record.status, "interrupted") << phase;
    const bool named = std::any_of(record.warnings.begin(), record.warnings.end(), [](const auto& warning) {
      return warning.find("before these motions were solved for: peak, 0.18Hz, 0.24Hz.") != std::string::npos;
    });
    EXPECT_TRUE(named) << phase;
  }
}

TEST(MotionAt, IsWrittenAsItWasRead) {
  const Scene scene = stop_with({"analysis.motion_at=[0.2, \"peak\", 0.18]"});
  EXPECT_NE(write_scene(scene).find("motion_at = [\"peak\", 0.2, 0.18]"), std::string::npos);
  EXPECT_EQ(parse_scene(write_scene(scene), "again.toml"), scene);
  EXPECT_EQ(write_scene(stop_with({})).find("motion_at"), std::string::npos);
}

TEST(MotionAt, RefusesWhatIsNoPointOfTheCurve) {
  const auto refused = [](const std::string& value, const std::string& part,
                          std::vector<std::string> more = {}) {
    more.push_back("analysis.motion_at=" + value);
    const std::string message = message_of(stop_scene, more);
    EXPECT_NE(message.find("analysis.motion_at"), std::string::npos) << message;
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  refused("top", "\"peak\", \"special\" or a number in Hz or N, > 0, or a list of these");
  refused("[\"peak\", \"pek\"]", "\"pek\" is none of them");
  refused("[]", "or a list of these");
  refused("true", "or a list of these");
  refused("-1", "out of range");
  refused("0.3", "0.3 Hz is outside the sweep; expected a frequency from 0.13 to 0.25 Hz");
  refused("special", "analysis.stability = true", {"analysis.stability=false"});
  refused("peak", "only with analysis.type = \"frequency_sweep\" or \"amplitude_sweep\"",
          {"analysis.type=forced_response"});
  EXPECT_NE(
      message_of(over_amplitude(stop_scene), {"analysis.motion_at=0.6"})
          .find(
              "analysis.motion_at = 0.6: 0.6 N is outside the sweep; expected an amplitude from 0.05 to 0.5 N"),
      std::string::npos);
}

TEST(CurveMotions, AreThoseOfThePeakTheFoldsAndTheFrequencies) {
  const Record record = analyse(stop_with({"analysis.motion_at=[\"peak\", \"special\", 0.18, 0.24]"}));
  ASSERT_TRUE(record.converged);
  std::set<std::string> names;
  for (const RecordFile& file : record.files) names.insert(file.name);
  for (const char* name :
       {"motion_peak.csv", "motion_fold_1.csv", "motion_fold_2.csv", "motion_grazing_1.csv",
        "motion_0.18Hz_1.csv", "motion_0.18Hz_2.csv", "motion_0.18Hz_3.csv", "motion_0.24Hz.csv"})
    EXPECT_TRUE(names.contains(name)) << name;
  EXPECT_EQ(largest(table_of(record, "motion_peak.csv")),
            value_of<double>(record.summary, "max_displacement_m"));
  const Table motions = value_of<Table>(record.summary, "motions");
  EXPECT_EQ(motions.rows(), record.files.size());
  const Table peak = motions.where("at", "peak");
  EXPECT_EQ(peak.numbers("frequency_Hz"),
            std::vector<double>{value_of<double>(record.summary, "frequency_at_max_displacement_Hz")});
  EXPECT_EQ(record.motion_pictures.size(), motions.rows());
  const Table folds = motions.where("at", "fold");
  const auto turns = value_of<std::vector<double>>(record.summary, "turning_points_Hz");
  ASSERT_EQ(folds.rows(), turns.size());
  for (std::size_t i = 0; i < turns.size(); ++i)
    EXPECT_NEAR(folds.numbers("frequency_Hz")[i], turns[i], 1e-6);
  const Table three = motions.where("frequency_Hz", "0.18");
  EXPECT_EQ(three.numbers("unstable_multipliers"), (std::vector<double>{0.0, 1.0, 0.0}));
  for (const double residual : motions.numbers("residual")) EXPECT_LT(residual, 1e-9);
}

// A picture shades the contact of the motion of the structure; the force of the balance begins and ends
// there.
TEST(CurveMotions, HaveTheInstantsOfContactInTheSummaryAndInTheirPictures) {
  const Record record = analyse(stop_with({"analysis.motion_at=[\"peak\", 0.24]"}));
  ASSERT_TRUE(record.converged);
  ASSERT_EQ(record.motion_pictures.size(), 2u);
  const Table phases = value_of<Table>(record.summary, "phases").where("file", "motion_peak.csv");
  ASSERT_EQ(phases.rows(), 1u);
  const double begin = phases.numbers("begin")[0], end = phases.numbers("end")[0];
  const Table motion = table_of(record, "motion_peak.csv");
  const auto time = motion.numbers("time_fraction"), force = motion.numbers("contact_force_N");
  constexpr double near = 0.02;
  for (std::size_t l = 0; l < time.size(); ++l) {
    if (!(force[l] > 0.0)) continue;
    const double since = time[l] - begin - std::floor(time[l] - begin);
    EXPECT_TRUE(since < end - begin + near || since > 1.0 - near) << time[l];
  }
  const RecordFigure& peak = record.motion_pictures.front();
  EXPECT_EQ(peak.stem, "motion_peak");
  EXPECT_NE(peak.figure.title.find("at the peak, "), std::string::npos) << peak.figure.title;
  for (std::size_t p = 0; p < 3; ++p) {
    ASSERT_FALSE(peak.figure.panels[p].rectangles.empty());
    EXPECT_DOUBLE_EQ(peak.figure.panels[p].rectangles[0].x1, begin);
  }
  const Table motions = value_of<Table>(record.summary, "motions");
  for (const std::string& status : motions.texts("phases_status")) EXPECT_EQ(status, "converged");
}

// Shooting integrates in time with another method. From the state of a motion at the load's maximum it finds
// the motion itself, stable or not.
TEST(CurveMotions, AtAFrequencyAreThoseOfShootingFromTheirState) {
  const Scene scene = stop_with({"analysis.motion_at=0.18", "time.functions=201",
                                 "time.quadrature_points=2048", "analysis.stability=false"});
  const Record record = analyse(scene);
  ASSERT_TRUE(record.converged);
  const StructureModel model = make_model(scene);
  std::vector<double> tops;
  for (const char* name : {"motion_0.18Hz_1.csv", "motion_0.18Hz_2.csv", "motion_0.18Hz_3.csv"}) {
    const Table table = table_of(record, name);
    ASSERT_FALSE(table.empty());
    const auto shot = shot_from(scene, model, table);
    ASSERT_EQ(shot.status, oracle::ShootingStatus::converged) << name;
    const auto u = table.numbers("displacement_m"), force = table.numbers("contact_force_N");
    for (std::size_t l = 0; l < u.size(); ++l) {
      EXPECT_NEAR(u[l], shot.contacts.displacement(0, Eigen::Index(l)), 2e-5) << name;
      EXPECT_NEAR(force[l], shot.contacts.force(0, Eigen::Index(l)), 1e-4) << name;
    }
    tops.push_back(largest(table));
  }
  EXPECT_TRUE(std::is_sorted(tops.rbegin(), tops.rend()));
  EXPECT_GT(tops.front(), 1.2 * tops.back());
}

TEST(CurveMotions, OfMatricesHoldEveryContactAndTheWholeStructure) {
  const TemporaryFolder folder;
  write_chain(folder);
  const Scene scene = load_scene(
      folder.write("chain.toml", chain_scene),
      std::vector<std::string>{"analysis.type=frequency_sweep", "analysis.frequency_from=40",
                               "analysis.frequency_to=48", "time.functions=31", "analysis.motion_at=peak",
                               "analysis.motion_points=16", "analysis.stability=false"});
  const Record record = analyse(scene);
  ASSERT_TRUE(record.converged) << record.status;
  EXPECT_EQ(table_of(record, "motion_peak_contacts.csv").rows(), 2u * 1024u);
  ASSERT_NE(file_of(record, "motion_peak.mtx"), nullptr);
  EXPECT_NE(file_of(record, "motion_peak.mtx")->contents.find("\n3 16\n"), std::string::npos);
  EXPECT_NE(file_of(record, "motion_peak.mtx")->about.find("peak"), std::string::npos);
  EXPECT_EQ(start_of(record, "motion_peak_contacts.csv").contacts.rows(), 2);
}

TEST(CurveMotions, OfSeveralPeriodsOfTheLoadHaveTheLoadsFrequency) {
  const Record once = analyse(stop_with({"analysis.motion_at=0.24"}));
  const Record twice = analyse(
      stop_with({"analysis.motion_at=0.24", "analysis.subharmonic=2", "time.functions=125",
                 "time.quadrature_points=2048", "analysis.output_points=2048", "analysis.stability=false"}));
  const auto u = table_of(once, "motion_0.24Hz.csv").numbers("displacement_m"),
             v = table_of(twice, "motion_0.24Hz.csv").numbers("displacement_m");
  ASSERT_EQ(v.size(), 2 * u.size());
  for (std::size_t l = 0; l < v.size(); ++l) EXPECT_NEAR(v[l], u[l % u.size()], 1e-9);
  EXPECT_EQ(value_of<Table>(twice.summary, "motions").numbers("frequency_Hz"), std::vector<double>{0.24});
}

TEST(CurveMotions, WarnOfAFrequencyThatTheCurveDoesNotReach) {
  const Record record = analyse(stop_with({"analysis.motion_at=0.24", "analysis.max_points=5"}));
  EXPECT_FALSE(record.converged);
  EXPECT_EQ(value_of<Table>(record.summary, "motions").rows(), 0u);
  EXPECT_TRUE(std::any_of(record.warnings.begin(), record.warnings.end(), [](const std::string& text) {
    return text.find("does not reach 0.24 Hz") != std::string::npos;
  }));
}

TEST(StartFrom, LeadsToTheUpperBranchThatIsNotFoundOtherwise) {
  const Record curve = analyse(stop_with({"analysis.motion_at=[0.18, 0.185]"}));
  const Record alone = analyse(response_with());
  const StartMotion upper = start_of(curve, "motion_0.185Hz_1.csv");
  const Record near = analyse(response_with(), AnalysisOptions{.start = upper});
  ASSERT_TRUE(near.converged);
  const Table expected = table_of(curve, "motion_0.18Hz_1.csv");
  EXPECT_NEAR(value_of<double>(near.summary, "max_displacement_m"), largest(expected), 1e-9);
  EXPECT_GT(value_of<double>(near.summary, "max_displacement_m"),
            1.1 * value_of<double>(alone.summary, "max_displacement_m"));
  EXPECT_GT(value_of<double>(near.summary, "start_distance"), 1e-3);
  EXPECT_LT(value_of<double>(near.summary, "start_distance"), 0.5);
}

// Another gap, stiffness, number of functions, basis and form.
TEST(StartFrom, LeadsToTheSameBranchOfANeighbouringScene) {
  const Record curve = analyse(stop_with({"analysis.motion_at=0.18"}));
  const StartMotion upper = start_of(curve, "motion_0.18Hz_1.csv");
  const double top = largest(table_of(curve, "motion_0.18Hz_1.csv"));
  for (const std::vector<std::string>& other : {std::vector<std::string>{"contact.gap=1.05"},
                                                {"contact.stiffness=2.2"},
                                                {"time.functions=101", "time.quadrature_points=900"},
                                                {"time.trial=daubechies6", "time.weight=daubechies6",
                                                 "time.functions=128", "time.quadrature_points=512"},
                                                {"time.sample_offset=0.5"},
                                                {"contact.form=force"}}) {
    const Record near = analyse(response_with(other), AnalysisOptions{.start = upper});
    ASSERT_TRUE(near.converged) << other.front() << ": " << near.status;
    EXPECT_NEAR(value_of<double>(near.summary, "max_displacement_m"), top, 0.06 * top) << other.front();
  }
}

TEST(StartFrom, IsTheFirstPointOfASweep) {
  const Record curve = analyse(stop_with({"analysis.motion_at=0.185"}));
  const Record upper = analyse(stop_with({"analysis.frequency_from=0.185", "analysis.frequency_to=0.13"}),
                               AnalysisOptions{.start = start_of(curve, "motion_0.185Hz_1.csv")});
  ASSERT_TRUE(upper.converged) << upper.status;
  EXPECT_NEAR(upper.sweep.numbers("max_displacement_m").front(),
              largest(table_of(curve, "motion_0.185Hz_1.csv")), 1e-8);
  EXPECT_EQ(upper.sweep.numbers("unstable").front(), 0.0);
}

TEST(StartFrom, WarnsOfAMotionFarFromTheStart) {
  const Record curve = analyse(stop_with({"analysis.motion_at=peak"}));
  const Record far = analyse(response_with({"forcing.frequency=0.24"}),
                             AnalysisOptions{.start = start_of(curve, "motion_peak.csv")});
  ASSERT_TRUE(far.converged);
  EXPECT_TRUE(std::any_of(far.warnings.begin(), far.warnings.end(), [](const std::string& text) {
    return text.find("may lie on another branch") != std::string::npos;
  }));
}

TEST(StartFrom, OfTheMotionItselfIsSolvedAtOnce) {
  const Record first = analyse(response_with());
  const TemporaryFolder folder;
  write_csv(folder / "response.csv", first.response);
  const Record again = analyse(response_with(), AnalysisOptions{.start = read_start_motion(folder.path())});
  EXPECT_LT(value_of<double>(again.summary, "start_distance"), 1e-3);
  EXPECT_LE(value_of<std::int64_t>(again.summary, "iterations"), 3);
  EXPECT_EQ(value_of<std::string>(again.summary, "strategy"), "newton");
}

TEST(StartFrom, OfOnePeriodServesMotionsOfTwo) {
  const Record first = analyse(response_with());
  const TemporaryFolder folder;
  write_csv(folder / "response.csv", first.response);
  const StartMotion start = read_start_motion(folder.path());
  const Record twice =
      analyse(response_with({"analysis.subharmonic=2", "time.functions=125", "time.quadrature_points=2048"}),
              AnalysisOptions{.start = start});
  ASSERT_TRUE(twice.converged);
  EXPECT_LT(value_of<double>(twice.summary, "start_distance"), 1e-3);
  folder.write("summary.json", "{\"subharmonic\": 2}");
  const StartMotion two = read_start_motion(folder.path());
  EXPECT_EQ(two.periods, 2);
  EXPECT_THROW(analyse(response_with(), AnalysisOptions{.start = two}), std::invalid_argument);
}

std::string refusal_of(const StartMotion& start, const Scene& scene) {
  try {
    require_start_fits(start, scene);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(StartFrom, RefusesMotionsThatDoNotFit) {
  StartMotion start;
  start.source = "old/contacts.csv";
  start.contacts.displacement = start.contacts.force = Eigen::MatrixXd::Zero(3, 8);
  EXPECT_EQ(refusal_of(start, response_with()),
            "--start-from: old/contacts.csv has the motion of 3 contacts, but the scene has 1 contact");
  start.contacts = start.contacts.contact(0);
  Scene scene = response_with();
  EXPECT_EQ(refusal_of(start, scene), "");
  scene.analysis.type = AnalysisType::time_stepping;
  EXPECT_NE(refusal_of(start, scene).find("analysis.type = \"time_stepping\" has no start"),
            std::string::npos);
}

std::string io_error_of(const std::filesystem::path& place) {
  try {
    read_start_motion(place);
  } catch (const IoError& error) {
    return error.reason();
  }
  return "";
}

TEST(StartFrom, SaysWhatAFolderLacks) {
  const TemporaryFolder folder;
  EXPECT_NE(io_error_of(folder / "nowhere").find("does not exist"), std::string::npos);
  EXPECT_NE(io_error_of(folder.path()).find("holds no motion"), std::string::npos);
  const std::string motion =
      "time_fraction,displacement_m,velocity_m_per_s,contact_force_N\n0,1,0,0\n0.5,2,0,0\n";
  folder.write("motion_peak.csv", motion);
  EXPECT_EQ(read_start_motion(folder.path()).contacts.points(), 2);
  folder.write("motion_fold_1.csv", motion);
  EXPECT_NE(io_error_of(folder.path()).find("motion_fold_1.csv, motion_peak.csv"), std::string::npos);
  EXPECT_NE(io_error_of(folder.write("a.csv", "time_fraction,displacement_m\n0,1\n")).find("contact_force_N"),
            std::string::npos);
  EXPECT_NE(io_error_of(folder.write("b.csv", with(motion, "0.5,2", "0.7,2"))).find("uniform"),
            std::string::npos);
  EXPECT_NE(io_error_of(folder.write("c.csv", with(motion, "0.5,2", "0.5,nan"))).find("finite"),
            std::string::npos);
}

}  // namespace
}  // namespace wavebalance::app
