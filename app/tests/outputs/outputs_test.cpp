// Outputs: degrees of freedom and contacts whose motion a record shows.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <complex>
#include <numbers>

#include "support/chain_files.hpp"
#include "support/scene_error.hpp"
#include "support/scene_texts.hpp"
#include "support/summary_value.hpp"
#include "wavebalance/app/analysis/sweep.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"
#include "wavebalance/app/outputs/output_measures.hpp"
#include "wavebalance/app/results/record.hpp"
#include "wavebalance/app/scene/scene_writer.hpp"

namespace {

using namespace wavebalance::app;

class ChainOutputs : public testing::Test {
 protected:
  ChainOutputs() {
    write_chain(folder_);
    folder_.write("chain.dof", "7.3\n20.3\n4.5\n");
  }
  Scene load(const std::vector<std::string>& overrides, const std::vector<std::string>& removed = {}) const {
    const std::string mapped =
        with(chain_scene, "modal_damping = 0.01", "dof_map = \"chain.dof\"\nmodal_damping = 0.01");
    return parse_scene(mapped, (folder_.path() / "case.toml").string(), overrides, removed);
  }
  Scene sweep(std::vector<std::string> overrides) const {
    for (const char* one : {"analysis.type=frequency_sweep", "analysis.frequency_from=40",
                            "analysis.frequency_to=90", "analysis.stability=false"})
      overrides.emplace_back(one);
    return load(overrides);
  }
  SceneError::Details fault(const std::vector<std::string>& overrides) const {
    return details_of_error([&](const std::string&) { load(overrides); }, "");
  }

  TemporaryFolder folder_;
};

// Without contact the response of the chain is (K - w^2 M + i w C)^-1 f, here with C = beta K.
TEST_F(ChainOutputs, OfALinearStructureAreItsTransferFunction) {
  const Scene scene =
      sweep({"analysis.outputs=[\"node 7 z\", \"-node 4 ry\"]", "contact.gap=1.0",
             "analysis.output_harmonics=2", "structure.modal_damping=0", "structure.stiffness_damping=2e-5"});
  const Record record = analyse(scene);
  ASSERT_TRUE(record.converged);
  const std::vector<double> frequency = record.sweep.numbers("frequency_Hz"),
                            amplitude = record.sweep.numbers("node_7_z_amplitude_1_m"),
                            phase = record.sweep.numbers("node_7_z_phase_1_degrees"),
                            half = record.sweep.numbers("node_7_z_half_peak_to_peak_m"),
                            second = record.sweep.numbers("node_7_z_amplitude_2_m"),
                            rotation = record.sweep.numbers("minus_node_4_ry_amplitude_1_rad");
  Eigen::Matrix3d stiffness;
  stiffness << 2e6, -1e6, 0, -1e6, 2e6, -1e6, 0, -1e6, 1e6;
  for (std::size_t i = 0; i < frequency.size(); ++i) {
    const double w = 2.0 * std::numbers::pi * frequency[i];
    const Eigen::Matrix3cd dynamic =
        std::complex<double>(1.0, 2e-5 * w) * stiffness - 2.0 * w * w * Eigen::Matrix3cd::Identity();
    const Eigen::Vector3cd motion = dynamic.inverse() * Eigen::Vector3cd(0.0, 0.0, 100.0);
    const std::complex<double> first = motion[0], last = motion[2];
    EXPECT_NEAR(amplitude[i], std::abs(first), 1e-9 * std::abs(first));
    EXPECT_NEAR(std::remainder(phase[i] - std::arg(first) * 180.0 / std::numbers::pi, 360.0), 0.0, 1e-6);
    EXPECT_NEAR(half[i], amplitude[i], 1e-4 * amplitude[i]);
    EXPECT_LE(second[i], 1e-10 * amplitude[i]);
    EXPECT_NEAR(rotation[i], std::abs(last), 1e-9 * std::abs(last));
  }
}

TEST_F(ChainOutputs, OfContactsAreTheirOwnExtremesMeansAndForces) {
  const Record record = analyse(sweep({}));
  ASSERT_TRUE(record.converged);
  const auto column = [&](const std::string& name) { return record.sweep.numbers(name); };
  const std::vector<double> largest = column("max_displacement_m"), force = column("max_contact_force_N"),
                            first = column("contact_1_max_m"), second = column("contact_2_max_rad");
  for (std::size_t i = 0; i < largest.size(); ++i) {
    EXPECT_EQ(std::max(first[i], second[i]), largest[i]);
    EXPECT_NEAR(column("contact_2_half_peak_to_peak_rad")[i],
                0.5 * (second[i] - column("contact_2_min_rad")[i]), 1e-18);
  }
  EXPECT_GT(force.back() + *std::max_element(force.begin(), force.end()), 0.0);
  const Table peaks = value_of<Table>(record.summary, "outputs");
  EXPECT_EQ(peaks.texts("output"), (std::vector<std::string>{"contact 1", "contact 2"}));
}

TEST_F(ChainOutputs, OfTheContactsAreLeftOutWhereTheSceneSaysSo) {
  const Record record = analyse(sweep({"analysis.contact_outputs=false"}));
  EXPECT_FALSE(record.sweep.has_column("contact_1_max_m"));
  EXPECT_TRUE(record.output_pictures.empty());
}

TEST_F(ChainOutputs, AreTheSameOfAReducedStructureWithAllItsModes) {
  const std::vector<std::string> wanted{"analysis.outputs=[\"node 7 z\"]", "contact.gap=2e-4"};
  std::vector<std::string> reduced = wanted;
  reduced.emplace_back("structure.kept_modes=1");
  const Record whole = analyse(sweep(wanted)), modes = analyse(sweep(reduced));
  ASSERT_TRUE(whole.converged && modes.converged);
  const auto peak = [](const Record& record) {
    return value_of<Table>(record.summary, "outputs").numbers("half_peak_to_peak")[0];
  };
  EXPECT_NEAR(peak(modes), peak(whole), 1e-3 * peak(whole));
}

// The first mass of the chain vibrates most at another frequency than the last one.
TEST_F(ChainOutputs, SayWhereThePeakIsOfWhichAMotionIsWritten) {
  const std::vector<std::string> ends{
      "analysis.frequency_to=220",       "analysis.motion_at=peak",      "contact.gap=1.0",
      "analysis.outputs=[\"node 7 z\"]", "structure.modal_damping=0.05", "forcing.load_dofs=[1]"};
  std::vector<std::string> chosen = ends;
  chosen.emplace_back("analysis.peak_of=\"node 7 z\"");
  const auto with_peak = [&](std::vector<std::string> all) {
    all.insert(all.end(),
               {"analysis.type=frequency_sweep", "analysis.frequency_from=40", "analysis.stability=false"});
    const Record record = analyse(load(all));
    EXPECT_TRUE(record.converged);
    return std::pair{value_of<Table>(record.summary, "motions").numbers("frequency_Hz")[0],
                     value_of<Table>(record.summary, "outputs").numbers("frequency_Hz")[0]};
  };
  const auto [by_contacts, best] = with_peak(ends);
  const auto [by_output, same] = with_peak(chosen);
  EXPECT_EQ(by_output, same);
  EXPECT_EQ(best, same);
  EXPECT_NE(by_contacts, by_output);
}

TEST_F(ChainOutputs, OfAResponseAreItsMotionOverThePeriod) {
  const Record record = analyse(load({"analysis.outputs=[\"node 20 z\"]", "analysis.contact_outputs=true"}));
  ASSERT_TRUE(record.converged);
  EXPECT_EQ(record.outputs.columns(),
            (std::vector<std::string>{"time_fraction", "node_20_z_m", "contact_1_m", "contact_2_rad"}));
  const std::vector<double> node = record.outputs.numbers("node_20_z_m"),
                            contact = record.outputs.numbers("contact_1_m");
  for (std::size_t i = 0; i < node.size(); ++i) EXPECT_NEAR(node[i], contact[i], 1e-12);
  const Table table = value_of<Table>(record.summary, "outputs");
  EXPECT_EQ(table.rows(), 3u);
  EXPECT_NEAR(table.numbers("max")[0], *std::max_element(node.begin(), node.end()), 1e-15);
}

TEST_F(ChainOutputs, OfTimeSteppingAreNearThoseOfTheBalance) {
  std::vector<std::string> wanted{"analysis.outputs=[\"node 7 z\"]", "structure.modal_damping=0.05"},
      stepped = wanted;
  wanted.emplace_back("time.functions=127");
  stepped.emplace_back("analysis.type=time_stepping");
  const auto rms = [](const Record& record) {
    return value_of<Table>(record.summary, "outputs").numbers("rms")[0];
  };
  const double balance = rms(analyse(load(wanted)));
  EXPECT_NEAR(rms(analyse(load(stepped))), balance, 1e-3 * balance);
}

/// Largest distance of the columns of two curves at places of the first, over the largest value, by linear
/// interpolation of the second, whose places rise.
double distance_between(const Table& curve, const Table& fine, const std::string& place,
                        const std::string& column) {
  const std::vector<double> at = curve.numbers(place), values = curve.numbers(column),
                            x = fine.numbers(place), y = fine.numbers(column);
  double largest = 0.0, distance = 0.0;
  for (std::size_t i = 0; i < at.size(); ++i) {
    std::size_t k = 1;
    while (k + 1 < x.size() && x[k] < at[i]) ++k;
    const double share = (at[i] - x[k - 1]) / (x[k] - x[k - 1]);
    distance = std::max(distance, std::abs((1.0 - share) * y[k - 1] + share * y[k] - values[i]));
    largest = std::max(largest, std::abs(values[i]));
  }
  return distance / largest;
}

// With much damping both curves pass every place once.
TEST_F(ChainOutputs, OfAnExactCurveOverTheAmplitudeAreThoseOfAFineBalance) {
  const auto record = [&](const std::string& how) {
    return analyse(
        load({"analysis.type=amplitude_sweep", "analysis.amplitude_from=50", "analysis.amplitude_to=300",
              "analysis.outputs=[\"node 7 z\"]", "structure.modal_damping=0.1", "analysis.stability=false",
              "time.functions=127", "time.quadrature_points=512", "analysis.largest_step=1",
              "forcing.load_dofs=[3]", how}));
  };
  const Record exact = record("analysis.exact=true"), balance = record("analysis.exact=false");
  ASSERT_TRUE(exact.converged && balance.converged);
  EXPECT_GT(exact.sweep.numbers("contact_1_contact_fraction").back(), 0.0);
  for (const char* column :
       {"node_7_z_half_peak_to_peak_m", "node_7_z_amplitude_2_m", "contact_1_max_force_N"})
    EXPECT_LE(distance_between(exact.sweep, balance.sweep, "amplitude_N", column), 1e-3) << column;
}

// Those of the response at the place of a point.
TEST_F(ChainOutputs, OfACurveWithImpactsAreThoseOfItsMotionsWithoutForces) {
  const std::vector<std::string> rigid{"contact.law=rigid", "contact.restitution=0.7",
                                       "analysis.outputs=[\"node 7 z\"]", "structure.modal_damping=0.05"};
  const std::vector<std::string> balance{"contact.stiffness", "time.trial", "time.weight", "time.functions"};
  std::vector<std::string> over = rigid, at = rigid;
  over.insert(over.end(), {"analysis.type=frequency_sweep", "analysis.frequency_from=40",
                           "analysis.frequency_to=60", "analysis.stability=false"});
  const Record curve = analyse(load(over, balance));
  ASSERT_FALSE(curve.sweep.empty()) << curve.status;
  at.emplace_back("forcing.frequency=40");
  const Record response = analyse(load(at, balance));
  ASSERT_TRUE(response.converged) << response.status;
  const Table table = value_of<Table>(response.summary, "outputs");
  EXPECT_GT(value_of<double>(response.summary, "impacts"), 0.0);
  for (const char* column : {"half_peak_to_peak", "rms", "amplitude_1"})
    EXPECT_NEAR(curve.sweep.numbers(std::string("node_7_z_") + column + "_m")[0], table.numbers(column)[0],
                1e-6 * table.numbers(column)[0]);
  EXPECT_TRUE(std::isnan(curve.sweep.numbers("contact_1_max_force_N")[0]));
}

TEST_F(ChainOutputs, AreNamedWhereTheyAreWrong) {
  EXPECT_NE(fault({"analysis.outputs=[\"node 8 z\"]"}).allowed.find("node 8 is not in"), std::string::npos);
  EXPECT_NE(fault({"analysis.outputs=[4]"}).allowed.find("expected 1..3"), std::string::npos);
  EXPECT_NE(fault({"analysis.outputs=[1, -1]"}).allowed.find("is there twice"), std::string::npos);
  const auto sweep_fault = [&](std::vector<std::string> overrides) {
    return details_of_error([&](const std::string&) { sweep(overrides); }, "").allowed;
  };
  EXPECT_NE(sweep_fault({"analysis.peak_of=\"node 8 z\""})
                .find("expected one of the outputs, which are contact 1, contact 2"),
            std::string::npos);
  EXPECT_NE(sweep_fault({"analysis.peak_of=\"contact 1\"", "analysis.contact_outputs=false"})
                .find("there are no outputs"),
            std::string::npos);
  EXPECT_NE(sweep_fault({"analysis.output_harmonics=600"}).find("less than half of analysis.output_points"),
            std::string::npos);
}

TEST_F(ChainOutputs, AreWrittenAndReadBack) {
  const Scene scene = sweep({"analysis.outputs=[\"-node 7 z\", 2]", "analysis.peak_of=\"-node 7 z\""});
  EXPECT_EQ(parse_scene(write_scene(scene), (folder_.path() / "case.toml").string()), scene)
      << write_scene(scene);
}

}  // namespace
