// What the record of a curve says of the motions of the structure near its points.
#include "wavebalance/app/analysis/sweep_phases.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <tuple>

#include "support/curve_record.hpp"
#include "support/summary_value.hpp"
#include "support/two_masses.hpp"
#include "wavebalance/app/analysis/sweep.hpp"

namespace wavebalance::app {
namespace {

using Overrides = std::vector<std::string>;

// At a fold a motion at its frequency is as uncertain as the root of its equations' error.
const std::set<std::string> with_errors{"converged", "converged_beside", "tolerance_missed"};

/// The oscillator with a stop up to a frequency below its folds, at which the curve is highest.
Record low_sweep(Overrides more) {
  more.insert(more.end(), {"time.functions=31", "analysis.frequency_to=0.168"});
  return analyse(stop_with(more), Observer());
}

TEST(PhasesOfASweep, HaveTheErrorsOfAForcedResponseAtThePeak) {
  const Record curve = low_sweep({});
  ASSERT_TRUE(curve.converged);
  Scene scene = response_with({"time.functions=31", "analysis.phases=true"});
  scene.forcing.frequency = value_of<double>(curve.summary, "frequency_at_max_displacement_Hz");
  const Record response = analyse(scene, Observer());
  EXPECT_EQ(value_of<std::string>(curve.summary, "phases_status"), "converged");
  for (const char* error : {"error_of_displacement", "error_of_force"}) {
    const double expected = value_of<double>(response.summary, error);
    EXPECT_GT(expected, 1e-6);
    EXPECT_NEAR(value_of<double>(curve.summary, error), expected, 0.02 * expected) << error;
  }
  EXPECT_FALSE(curve.sweep.has_column("phases_status"));
}

TEST(PhasesOfASweep, HaveSmallerErrorsAtItsSpecialPointsWithMoreFunctions) {
  std::vector<double> worst;
  for (const char* functions : {"31", "127"}) {
    const Record record = analyse(
        stop_with({"time.functions=" + std::string(functions), "time.quadrature_points=1024"}), Observer());
    const Table points = value_of<Table>(record.summary, "special_points");
    ASSERT_GE(points.rows(), 2u);
    for (const std::string& status : points.texts("phases_status")) EXPECT_TRUE(with_errors.count(status));
    worst.push_back(0.0);
    for (const double error : points.numbers("error_of_displacement"))
      worst.back() = std::fmax(worst.back(), error);
    EXPECT_GT(worst.back(), 0.0);
  }
  EXPECT_LT(worst[1], 0.3 * worst[0]);
}

// At the first point the multipliers of the structure are known, two_masses.hpp: all lie inside the circle.
TEST(PhasesOfASweep, CorrectTheCountsOfTheBalance) {
  const TemporaryFolder folder;
  const auto place = two_masses_in(folder);
  const auto sweep_with = [&](const std::string& phases) {
    return analyse(load_scene(place, Overrides{"analysis.type=frequency_sweep",
                                               "analysis.frequency_from=14.77656632196452",
                                               "analysis.frequency_to=14.7768", "analysis.phases=" + phases}),
                   Observer());
  };
  const Record balance = sweep_with("false"), phases = sweep_with("true");
  ASSERT_GT(balance.sweep.rows(), 0u);
  ASSERT_EQ(phases.sweep.rows(), balance.sweep.rows());
  EXPECT_EQ(balance.sweep.numbers("unstable")[0], 1.0);
  EXPECT_EQ(phases.sweep.numbers("unstable")[0], 0.0);
  EXPECT_EQ(phases.sweep.texts("stability_by")[0], "phases");
  EXPECT_EQ(phases.sweep.texts("phases_status")[0], "converged");
  for (std::size_t i = 0; i < phases.sweep.rows(); ++i) {
    const bool none = phases.sweep.texts("phases_status")[i] == "not_found";
    EXPECT_EQ(std::isnan(phases.sweep.numbers("unstable")[i]), none);
    EXPECT_EQ(phases.sweep.texts("stability_by")[i], none ? "none" : "phases");
  }
}

/// Three masses between stops of 14 to 141 kN/m that touch for a few per cent of the period.
constexpr const char* three_masses = R"([structure]
type = "matrices"
mass = "mass.mtx"
stiffness = "stiffness.mtx"
damping = "damping.mtx"
[contact]
law = "clearance"
stiffness = 1.0
gap = 0.0
[[contact.pairs]]
dofs = [1]
coefficients = [-1.0]
stiffness = 141142.30477585082
gap = 9.747021996955785e-05
stiffness_below = 13738.43640600048
gap_below = 0.0003557793476694954
[[contact.pairs]]
dofs = [2]
coefficients = [-1.0]
stiffness = 60026.75970528996
gap = 0.0001861640154736735
stiffness_below = 24896.188958470753
gap_below = 0.00014785866233082734
[forcing]
load_dofs = [1]
amplitude = 0.07400215130981587
[time]
trial = "fourier"
weight = "fourier"
functions = 63
quadrature_points = 512
[analysis]
type = "frequency_sweep"
frequency_from = 1.0
frequency_to = 2.0
)";

// At these frequencies Newton's method on the map of the period and variational equations give 0 and 1
// multipliers outside the unit circle, and the balance of 63 functions has 1 and 2.
TEST(PhasesOfASweep, CorrectTheCountsOfShortContacts) {
  const TemporaryFolder folder;
  const std::string symmetric = "%%MatrixMarket matrix coordinate real symmetric\n";
  folder.write("mass.mtx", symmetric +
                               "3 3 3\n1 1 1.2877028452601675\n2 2 1.8445934785249525\n"
                               "3 3 1.0842696832647172\n");
  folder.write("stiffness.mtx", symmetric +
                                    "3 3 5\n1 1 3950.5547299417126\n2 1 -2670.645518305771\n"
                                    "2 2 4985.2918624310969\n3 2 -2314.6463441253254\n"
                                    "3 3 2314.6463441253254\n");
  folder.write("damping.mtx", symmetric +
                                  "3 3 6\n1 1 3.9665853684625745\n2 1 -1.7282177563625007\n"
                                  "3 1 -0.28433599184748792\n2 2 4.8267707866039817\n"
                                  "3 2 -1.6811063760824079\n3 3 2.6662432479887506\n");
  const auto place = folder.write("three_masses.toml", three_masses);
  for (const auto& [from, to, count] : {std::tuple{"2.124", "2.1241", 0.0}, {"2.29704", "2.29714", 1.0}}) {
    const Overrides interval{std::string("analysis.frequency_from=") + from,
                             std::string("analysis.frequency_to=") + to};
    Overrides phased = interval;
    phased.emplace_back("analysis.phases=true");
    const Record balance = analyse(load_scene(place, interval), Observer()),
                 phases = analyse(load_scene(place, phased), Observer());
    ASSERT_TRUE(balance.converged && phases.converged);
    EXPECT_EQ(balance.sweep.numbers("unstable")[0], count + 1.0);
    EXPECT_EQ(phases.sweep.numbers("unstable")[0], count);
    EXPECT_EQ(phases.sweep.texts("stability_by")[0], "phases");
  }
}

TEST(PhasesOfASweep, SumUpTheErrorsOfAllPoints) {
  const Record record = low_sweep({"analysis.phases=true"});
  ASSERT_TRUE(record.converged);
  double largest = 0.0;
  for (const double error : record.sweep.numbers("error_of_displacement"))
    largest = std::fmax(largest, error);
  EXPECT_EQ(value_of<double>(record.summary, "largest_error_of_displacement"), largest);
  EXPECT_EQ(value_of<std::int64_t>(record.summary, "points_phases_converged"),
            static_cast<std::int64_t>(record.sweep.rows()));
  EXPECT_EQ(value_of<std::int64_t>(record.summary, "points_not_found"), 0);
  EXPECT_EQ(value_of<std::int64_t>(record.summary, "points_phases_not_known"), 0);
}

TEST(PhasesOfASweep, NeedNoStability) {
  const Record record = low_sweep({"analysis.phases=true", "analysis.stability=false"});
  ASSERT_TRUE(record.converged);
  EXPECT_FALSE(record.sweep.has_column("stability_by"));
  EXPECT_EQ(record.sweep.texts("phases_status")[0], "converged");
  EXPECT_EQ(find_entry(low_sweep({"analysis.stability=false"}).summary, "phases_status"), nullptr);
}

TEST(PhasesOfASweep, AreThoseOfAnAmplitudeToo) {
  const Record record = analyse(load_with({"analysis.phases=true", "time.functions=31"}), Observer());
  ASSERT_TRUE(record.converged);
  EXPECT_TRUE(with_errors.count(value_of<std::string>(record.summary, "phases_status")));
  const std::vector<double> errors = record.sweep.numbers("error_of_displacement"),
                            highest = record.sweep.numbers("max_displacement_m");
  for (std::size_t i = 0; i < errors.size(); ++i) {
    if (!std::isnan(errors[i])) {
      EXPECT_LT(errors[i], highest[i] < 1.0 ? 1e-9 : 0.01);
    }
  }
}

// A branch of two periods has its own functions and points.
TEST(PhasesOfASweep, AreThoseOfItsBranchesToo) {
  const Scene scene = load_scene(WAVEBALANCE_SCENES "/cases_of_others/oscillator_with_stop.toml",
                                 Overrides{"analysis.phases=true"});
  ASSERT_TRUE(scene.analysis.branches);
  const Record record = analyse(scene, Observer());
  ASSERT_TRUE(record.sweep.has_column("period"));
  int doubled = 0;
  for (std::size_t i = 0; i < record.sweep.rows(); ++i) {
    if (record.sweep.numbers("period")[i] < 2.0) continue;
    ++doubled;
    if (record.sweep.texts("phases_status")[i] == "converged") {
      EXPECT_LT(record.sweep.numbers("error_of_displacement")[i], 0.05);
    }
  }
  EXPECT_GT(doubled, 10);
  EXPECT_GT(value_of<std::int64_t>(record.summary, "points_phases_converged"),
            static_cast<std::int64_t>(0.9 * double(record.sweep.rows())));
}

TEST(PhasesOfASweep, NameWhyTheyAreNotKnown) {
  const Scene scene = load_scene(
      WAVEBALANCE_SCENES "/jones_legrand_2014/case2_sweep.toml",
      Overrides{"analysis.phases=true", "analysis.frequency_from=1225", "analysis.frequency_to=1235",
                "structure.loss_factor=0.02", "structure.stiffness_damping=0"});
  const Record record = analyse(scene, Observer());
  EXPECT_EQ(value_of<std::string>(record.summary, "phases_status"), "structural_damping");
  EXPECT_TRUE(std::isnan(value_of<double>(record.summary, "error_of_displacement")));
  EXPECT_EQ(value_of<std::int64_t>(record.summary, "points_phases_not_known"),
            static_cast<std::int64_t>(record.sweep.rows()));
  for (std::size_t i = 0; i < record.sweep.rows(); ++i) {
    EXPECT_EQ(record.sweep.texts("phases_status")[i], "structural_damping");
    EXPECT_EQ(record.sweep.texts("stability_by")[i], "balance");
  }
}

TEST(PhasesOfASweep, AreKnownAgainstARigidObstacleAtATipWithoutMass) {
  const Scene scene = load_scene(
      WAVEBALANCE_SCENES "/jones_legrand_2014/case2_sweep_rigid.toml",
      Overrides{"analysis.phases=true", "analysis.frequency_from=1225", "analysis.frequency_to=1235"});
  const Record record = analyse(scene, Observer());
  EXPECT_EQ(value_of<std::string>(record.summary, "phases_status"), "converged");
  EXPECT_LT(value_of<double>(record.summary, "error_of_displacement"), 1e-2);
  for (std::size_t i = 0; i < record.sweep.rows(); ++i) {
    if (record.sweep.texts("phases_status")[i] != "converged") continue;
    EXPECT_EQ(record.sweep.texts("stability_by")[i], "phases");
    EXPECT_GE(record.sweep.numbers("unstable")[i], 0.0);
  }
}

TEST(PhasesOfASweep, AreMarkedWhereAnInterruptionCameFirst) {
  int calls = 0;
  Scene scene = stop_with({"analysis.phases=true", "time.functions=31"});
  AnalysisOptions how;
  how.threads = 1;
  how.observer = [&](const Progress& progress) { return progress.phase != "contact phases" || ++calls < 5; };
  const Record record = analyse(scene, how);
  EXPECT_EQ(calls, 5);
  EXPECT_TRUE(record.interrupted);
  EXPECT_FALSE(record.converged);
  EXPECT_EQ(record.status, "interrupted");
  EXPECT_EQ(record.sweep.texts("phases_status").back(), "not_computed");
  EXPECT_EQ(record.sweep.texts("stability_by").back(), "balance");
}

TEST(PhasesOfASweep, DecideTheVerdictPointByPoint) {
  using solvers::PhasesStatus, solvers::PointPhases, solvers::StabilityStatus;
  solvers::CurveStability balance;
  balance.points.resize(4);
  for (auto& point : balance.points) point = {StabilityStatus::converged, 3, 1, 1, 1};
  SweepPhases phases;
  phases.points.resize(4);
  phases.points[0] =
      PointPhases{PhasesStatus::converged, 1e-3, 1e-2, solvers::MotionStability{"stable", 0}, 0};
  phases.points[1] = PointPhases{PhasesStatus::not_found};
  phases.points[2] = PointPhases{PhasesStatus::structural_damping};
  const StabilityAlong along = stability_along(balance, &phases);
  EXPECT_EQ(along.by, (Overrides{"phases", "none", "balance", "balance"}));
  EXPECT_EQ(along.points[0].unstable, 0);
  EXPECT_EQ(along.points[1].unstable, -1);
  EXPECT_EQ(along.points[2].unstable, 3);
  EXPECT_EQ(along.status, "not_found");
  EXPECT_EQ(stability_along(balance, nullptr).points[0].unstable, 3);
}

}  // namespace
}  // namespace wavebalance::app
