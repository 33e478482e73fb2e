// Modes of equal frequency, as a round pipe has them in pairs.
#include <gtest/gtest.h>

#include <cmath>

#include "support/chain_files.hpp"
#include "support/scene_texts.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"
#include "wavebalance/app/results/record.hpp"

namespace {

using namespace wavebalance::app;

/// A mass of 2 kg on springs along x and y, which are equal but for `apart`, against a stop along (0.6, 0.8);
/// and a third mass beside them.
class RoundMass : public testing::Test {
 protected:
  Scene load(double apart) const {
    write_chain(folder_);
    folder_.write("k.mtx", "%%MatrixMarket matrix coordinate real symmetric\n3 3 3\n1 1 1e6\n2 2 " +
                               std::to_string(1e6 * (1.0 + apart)) + "\n3 3 9e6\n");
    const std::string text =
        with(with(with(chain_scene, "contact_dofs = [2, 3]", ""), "modal_damping = 0.01", ""), "[forcing]",
             "[[contact.pairs]]\ndofs = [1, 2]\ncoefficients = [0.6, 0.8]\n[forcing]");
    return parse_scene(text, (folder_.path() / "case.toml").string(),
                       std::vector<std::string>{"analysis.type=nonlinear_mode", "analysis.largest_energy=1.2",
                                                "analysis.points=20", "time.functions=31"});
  }
  bool warns(const Scene& scene, const std::string& part) const {
    for (const std::string& one : analyse(scene).warnings)
      if (one.find(part) != std::string::npos) return true;
    return false;
  }
  TemporaryFolder folder_;
};

TEST_F(RoundMass, HasAModeTowardsTheStopAndOneThatNeverTouches) {
  const StructureModes modes = make_modes(make_model(load(1e-8)));
  EXPECT_NEAR(std::abs(modes.model.contact_shapes(0, 0)), std::sqrt(0.5), 1e-6);
  EXPECT_NEAR(modes.model.contact_shapes(0, 1), 0.0, 1e-6);
  const Eigen::MatrixXd mass = 2.0 * Eigen::MatrixXd::Identity(3, 3);
  EXPECT_TRUE((modes.shapes.transpose() * mass * modes.shapes).isIdentity(1e-10));
}

TEST_F(RoundMass, SaysThatItsFrequenciesAreEqualOrNear) {
  EXPECT_TRUE(warns(load(1e-8), "were combined so that the first of them moves the contacts most"));
  EXPECT_TRUE(warns(load(1e-3), "each may run into the other"));
  EXPECT_FALSE(warns(load(0.5), "linear frequencies"));
}

TEST_F(RoundMass, KeepsModesThatDiffer) {
  const StructureModes modes = make_modes(make_model(load(1e-3)));
  EXPECT_NEAR(std::abs(modes.model.contact_shapes(0, 0)), 0.6 * std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(std::abs(modes.model.contact_shapes(0, 1)), 0.8 * std::sqrt(0.5), 1e-9);
}

}  // namespace
