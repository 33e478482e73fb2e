#include <gtest/gtest.h>

#include "support/bar_scene.hpp"
#include "support/summary_value.hpp"
#include "temporary_folder.hpp"
#include "wavebalance/app/results/record.hpp"
#include "wavebalance/app/scene/scene_error.hpp"

namespace wavebalance::app {
namespace {

Record record_with_phases(std::vector<std::string> more) {
  more.emplace_back("analysis.phases=true");
  return analyse(scene_of(more), Observer());
}

TEST(PhasesOfAResponse, HoldTheInstantsOfContactAndTheErrorsOfTheResponse) {
  const Record coarse = record_with_phases({"time.functions=31", "time.quadrature_points=128"}),
               fine = record_with_phases({"time.functions=255", "time.quadrature_points=1024"});
  ASSERT_TRUE(coarse.converged && fine.converged);
  EXPECT_EQ(value_of<std::string>(coarse.summary, "phases_status"), "converged");
  EXPECT_GT(value_of<double>(coarse.summary, "error_of_displacement"),
            10.0 * value_of<double>(fine.summary, "error_of_displacement"));
  EXPECT_GT(value_of<double>(coarse.summary, "error_of_force"),
            value_of<double>(fine.summary, "error_of_force"));
  const Table phases = value_of<Table>(coarse.summary, "phases");
  const Table same = value_of<Table>(fine.summary, "phases");
  ASSERT_EQ(phases.rows(), same.rows());
  for (std::size_t i = 0; i < phases.rows(); ++i)
    for (const char* end : {"begin", "end"})
      EXPECT_NEAR(std::get<double>(phases.at(i, end)), std::get<double>(same.at(i, end)), 1e-8);
}

TEST(PhasesOfAResponse, HaveTheStabilityThatTheRecordNames) {
  const Record record = record_with_phases({});
  EXPECT_EQ(value_of<std::string>(record.summary, "stability"), "stable");
  EXPECT_EQ(value_of<std::string>(record.summary, "stability_by"), "phases");
}

/// Two masses with five short contacts in a period, between stops of 456 to 1927 kN/m. The balance of 63
/// functions errs by 0.6 % and is unstable with a multiplier of 4.8. That of the structure, -0.39505 +
/// 0.83330i, is from an integration of its own.
constexpr const char* two_masses = R"([structure]
type = "matrices"
mass = "mass.mtx"
stiffness = "stiffness.mtx"
damping = "damping.mtx"
[contact]
law = "linear"
stiffness = 1.0
gap = 0.0
[[contact.pairs]]
dofs = [1]
law = "exponential"
constant = 362.4734199610997
exponent = 12506.293532321932
gap = 0.00011183162081386775
[[contact.pairs]]
dofs = [2]
law = "clearance"
stiffness = 1927029.124852406
gap = 1.521361593455108e-05
stiffness_below = 456189.4743533799
gap_below = 1.158036679384574e-06
[forcing]
load_dofs = [1]
amplitude = 0.6522603106486901
frequency = 14.77656632196452
[[forcing.terms]]
harmonic = 2
amplitude = -0.3922260723374983
dofs = [2]
phase = 55.27044072172913
[[forcing.terms]]
harmonic = 2
amplitude = -0.4652582418074515
dofs = [2]
phase = -74.80543042487284
[[forcing.terms]]
harmonic = 2
amplitude = -0.30127713897442704
dofs = [1]
phase = 0.6755242496654148
[time]
trial = "fourier"
weight = "fourier"
functions = 63
quadrature_points = 512
[analysis]
type = "forced_response"
phases = true
)";

TEST(PhasesOfAResponse, HaveTheStabilityOfTheStructureWhereThatOfTheBalanceIsAnother) {
  const TemporaryFolder folder;
  const char* symmetric = "%%MatrixMarket matrix coordinate real symmetric\n";
  folder.write("damping.mtx",
               std::string(symmetric) +
                   "2 2 3\n1 1 2.6716230790832305\n2 1 0.10613642184992771\n2 2 5.0503342967785834\n");
  folder.write("stiffness.mtx",
               std::string(symmetric) + "2 2 2\n1 1 7431.6088486205153\n2 2 7768.5984198501328\n");
  folder.write("mass.mtx",
               std::string(symmetric) + "2 2 2\n1 1 0.6279173363755336\n2 2 2.1098921735191771\n");
  const auto place = folder.write("two_masses.toml", two_masses);
  for (const char* functions : {"63", "127"}) {
    const Scene scene =
        load_scene(place, std::vector<std::string>{"time.functions=" + std::string(functions)});
    const Record record = analyse(scene, Observer());
    ASSERT_TRUE(record.converged) << record.status;
    EXPECT_EQ(value_of<std::string>(record.summary, "phases_status"), "converged");
    EXPECT_EQ(value_of<Table>(record.summary, "phases").rows(), 5u);
    EXPECT_EQ(value_of<std::string>(record.summary, "stability"), "stable");
    EXPECT_NEAR(value_of<double>(record.summary, "leading_multiplier_real"), -0.395055, 2e-5);
    EXPECT_NEAR(value_of<double>(record.summary, "leading_multiplier_imag"), 0.833296, 2e-5);
  }
}

TEST(PhasesOfAResponse, NameWhyTheyAreNotKnown) {
  const Scene scene = load_scene(WAVEBALANCE_SCENES "/jones_legrand_2014/case1_rigid.toml",
                                 std::vector<std::string>{"analysis.phases=true"});
  const Record record = analyse(scene, Observer());
  ASSERT_TRUE(record.converged) << record.status;
  EXPECT_EQ(value_of<std::string>(record.summary, "phases_status"), "rigid_contact");
  EXPECT_EQ(value_of<std::string>(record.summary, "stability_by"), "balance");
  EXPECT_EQ(value_of<Table>(record.summary, "phases").rows(), 0u);
}

TEST(PhasesOfAResponse, AreRefusedForCurves) {
  EXPECT_THROW(record_with_phases({"analysis.type=frequency_sweep", "analysis.from=100", "analysis.to=200"}),
               SceneError);
}

}  // namespace
}  // namespace wavebalance::app
