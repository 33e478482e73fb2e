#include <chrono>

#include "testing.hpp"
#include "wavebalance/fem/blade.hpp"
#include "wavebalance/fem/craig_bampton.hpp"
#include "wavebalance/fem/eigenmodes.hpp"

namespace wavebalance::fem {
namespace {

// Found by an independent program (20-node hexahedra, 11 x 1 x 16).
const Eigen::VectorXd published_blade =
    (Eigen::VectorXd(5) << 570.0, 1662.4, 2206.2, 3781.2, 4655.5).finished();

TEST(ReferenceBlade, HasItsFrequenciesAndTipMotion) {
  const Blade found = blade();
  const Matrices matrices = solid_matrices(found.model);
  const EigenmodesResult modes = eigenmodes(matrices.stiffness, matrices.mass, 5);
  ASSERT_EQ(modes.status, EigenmodesStatus::converged);
  for (int mode = 0; mode < 5; ++mode)
    EXPECT_NEAR(modes.frequencies_hz[mode] / published_blade[mode], 1.0, 1e-3) << mode;
  // Along the face eta = -1, over the leading edge there.
  const auto radial = [&](std::size_t contact) { return modes.shapes(found.contact_unknowns[contact], 0); };
  EXPECT_NEAR(radial(22) / radial(0), -0.68, 5e-3);
  for (std::size_t contact = 2; contact < 24; ++contact)
    EXPECT_LT(radial(contact) / radial(0), radial(contact - 2) / radial(0)) << contact;
}

TEST(ReferenceBlade, KeepsEightModesWhenReducedToItsTipAndFortyModes) {
  const Blade found = blade();
  const Matrices matrices = solid_matrices(found.model, 1e-6);
  const auto start = std::chrono::steady_clock::now();
  const CraigBampton reduced = craig_bampton(matrices, found.boundary_unknowns, {.modes = 40, .solver = {}});
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  RecordProperty("reduction_seconds", std::to_string(taken.count()));
  ASSERT_EQ(reduced.status, EigenmodesStatus::converged);
  ASSERT_EQ(reduced.mass.rows(), 112);
  const Eigen::VectorXd full = eigenmodes(matrices.stiffness, matrices.mass, 8).omega;
  const Eigen::VectorXd kept = eigenmodes(reduced.stiffness.sparseView(), reduced.mass.sparseView(), 8).omega;
  for (int mode = 0; mode < 8; ++mode) {
    EXPECT_GE(kept[mode] / full[mode], 1.0 - 1e-9) << mode;
    EXPECT_LE(kept[mode] / full[mode], 1.0 + 4e-4) << mode;
  }
}

}  // namespace
}  // namespace wavebalance::fem
