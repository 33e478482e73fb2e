// Matrices of which rows have no mass, as rotations have none where mass is lumped.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "support/scene_error.hpp"
#include "support/scene_texts.hpp"
#include "temporary_folder.hpp"
#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"
#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/app/results/record.hpp"
#include "wavebalance/fem/matrix_market.hpp"

namespace {

using namespace wavebalance::app;
using Dense = Eigen::MatrixXd;

constexpr int beam_elements = 6;
constexpr int beam_size = 2 * beam_elements;  // deflection and rotation of each node

/// Stiffness of a clamped Euler-Bernoulli beam of steel, 0.5 m x 20 mm x 5 mm.
Dense beam_stiffness() {
  const double l = 0.5 / beam_elements, k = 2.1e11 * 0.02 * std::pow(0.005, 3) / 12.0 / (l * l * l);
  Eigen::Matrix4d element;
  element << 12, 6 * l, -12, 6 * l, 6 * l, 4 * l * l, -6 * l, 2 * l * l, -12, -6 * l, 12, -6 * l, 6 * l,
      2 * l * l, -6 * l, 4 * l * l;
  Dense whole = Dense::Zero(beam_size + 2, beam_size + 2);
  for (int e = 0; e < beam_elements; ++e) whole.block<4, 4>(2 * e, 2 * e) += k * element;
  return whole.bottomRightCorner(beam_size, beam_size);
}

/// Half of each element's mass at either end, none for rotations.
Dense lumped_mass() {
  Eigen::VectorXd masses = Eigen::VectorXd::Zero(beam_size);
  const double element = 7850.0 * 0.02 * 0.005 * 0.5 / beam_elements;
  for (int e = 0; e < beam_elements; ++e) masses[2 * e] = e + 1 == beam_elements ? 0.5 * element : element;
  return masses.asDiagonal();
}

const std::string lumped_scene = R"([structure]
type = "matrices"
mass = "m.mtx"
stiffness = "k.mtx"
contact_dofs = [11]
modal_damping = 0.01
[contact]
law = "linear"
stiffness = 1e5
gap = 1e-3
[forcing]
load = "f.mtx"
amplitude = 1.0
frequency = 15.0
[time]
trial = "fourier"
weight = "fourier"
functions = 31
)";

/// The beam with all its rows, and condensed by hand in a second folder.
class LumpedBeam : public testing::Test {
 protected:
  LumpedBeam() {
    stiffness_ = beam_stiffness();
    load_ = Eigen::VectorXd::LinSpaced(beam_size, 0.1, 0.4);  // forces and moments
    write(whole_, stiffness_, lumped_mass(), load_);
    std::vector<int> a, b;
    for (int row = 0; row < beam_size; row += 2) {
      a.push_back(row);
      b.push_back(row + 1);
    }
    const Dense among = stiffness_(b, b), across = stiffness_(b, a);
    const Dense follow = -among.llt().solve(across);
    const Dense condensed = stiffness_(a, a) + stiffness_(a, b) * follow;
    write(hand_, 0.5 * (condensed + condensed.transpose()), lumped_mass()(a, a),
          load_(a) + follow.transpose() * load_(b));
  }

  static void write(const TemporaryFolder& folder, const Dense& stiffness, const Dense& mass,
                    const Eigen::VectorXd& load) {
    namespace fem = wavebalance::fem;
    fem::write_matrix_market(folder / "k.mtx", stiffness.sparseView());
    fem::write_matrix_market(folder / "m.mtx", mass.sparseView());
    fem::write_matrix_market(folder / "f.mtx", Dense(load).sparseView());
  }

  Scene whole(const std::vector<std::string>& overrides = {}, const std::string& text = lumped_scene) const {
    return load_scene(whole_.write("case.toml", text), overrides);
  }
  Scene by_hand() const { return load_scene(hand_.write("case.toml", with(lumped_scene, "[11]", "[6]"))); }

  Dense stiffness_;
  Eigen::VectorXd load_;
  TemporaryFolder whole_, hand_;
};

TEST_F(LumpedBeam, IsTheStructureCondensedByHand) {
  const StructureModel found = make_model(whole()), expected = make_model(by_hand());
  ASSERT_EQ(found.size(), beam_elements);
  const auto near = [](const Dense& a, const Dense& b) { return (a - b).norm() <= 1e-12 * b.norm(); };
  EXPECT_TRUE(near(Dense(found.structure.stiffness), Dense(expected.structure.stiffness)));
  EXPECT_TRUE(near(Dense(found.structure.mass), Dense(expected.structure.mass)));
  EXPECT_TRUE(near(found.structure.load, expected.structure.load));
  const Response a = weighted_residual_response(whole()), b = weighted_residual_response(by_hand());
  ASSERT_TRUE(a.converged) << a.status;
  EXPECT_GT(a.force().maxCoeff(), 1.0);
  EXPECT_LT((a.displacement() - b.displacement()).norm(), 1e-9 * b.displacement().norm());
}

TEST_F(LumpedBeam, IsTheLimitOfRotationsWithVanishingMass) {
  const std::string no_contact =
      with(with(with(lumped_scene, "\"linear\"", "\"none\""), "stiffness = 1e5\n", ""), "gap = 1e-3\n", "");
  const Response condensed = weighted_residual_response(whole({}, no_contact));
  ASSERT_TRUE(condensed.converged) << condensed.status;
  Dense mass = lumped_mass();
  for (int row = 1; row < beam_size; row += 2) mass(row, row) = 1e-12;
  write(whole_, stiffness_, mass, load_);
  const Response all_rows = weighted_residual_response(whole({}, no_contact));
  ASSERT_TRUE(all_rows.converged) << all_rows.status;
  EXPECT_LT((condensed.displacement() - all_rows.displacement()).norm(),
            1e-6 * all_rows.displacement().norm());
}

TEST_F(LumpedBeam, TakesProportionalDampingOfAFileAndABaseAcceleration) {
  wavebalance::fem::write_matrix_market(whole_ / "c.mtx",
                                        Dense(1e-5 * stiffness_ + 2.0 * lumped_mass()).sparseView());
  const StructureModel model =
      make_model(whole({}, with(lumped_scene, "modal_damping = 0.01", "damping = \"c.mtx\"")));
  ASSERT_EQ(model.size(), beam_elements);
  const Dense expected = 1e-5 * Dense(model.structure.stiffness) + 2.0 * Dense(model.structure.mass);
  EXPECT_LT((Dense(model.structure.damping) - expected).norm(), 1e-10 * expected.norm());
  const StructureModel moved =
      make_model(whole({}, with(lumped_scene, "[time]",
                                "[[forcing.terms]]\nkind = \"base_acceleration\"\namplitude = 3.0\n"
                                "dofs = [1, 3, 5, 7, 9, 11]\n[time]")));
  ASSERT_EQ(moved.structure.forces.size(), 1u);
  const Eigen::VectorXd inertia = Dense(moved.structure.mass) * Eigen::VectorXd::Ones(beam_elements);
  EXPECT_LT((moved.structure.forces[0].shape + inertia).norm(), 1e-12 * inertia.norm());
}

TEST_F(LumpedBeam, IsDescribedAndTakenByReductionsAndShooting) {
  const std::string text = describe_scene(whole());
  EXPECT_NE(text.find("6 rows without mass condensed, 6 degrees of freedom"), std::string::npos) << text;
  const StructureModel reduced = make_model(
      whole({"structure.kept_modes=2"}, with(lumped_scene, "load = \"f.mtx\"", "load_dofs = [11]")));
  EXPECT_EQ(reduced.size(), 3);
  EXPECT_EQ(reduced.contacts(), 1);
  EXPECT_TRUE(analyse(whole({"analysis.type=shooting"})).converged);
}

TEST_F(LumpedBeam, IsAnErrorWhereDampingActsOnARotationAlone) {
  Dense damping = Dense::Zero(beam_size, beam_size);
  damping(1, 1) = 0.1;
  wavebalance::fem::write_matrix_market(whole_ / "c.mtx", damping.sparseView());
  const auto details = details_of_error([&](const std::string& text) { whole({}, text); },
                                        with(lumped_scene, "modal_damping = 0.01", "damping = \"c.mtx\""));
  EXPECT_EQ(details.key, "structure.mass");
  EXPECT_NE(details.allowed.find("Of its rows 6 have no mass: 2, 4, 6, 8, 10, ..."), std::string::npos)
      << details.allowed;
}

}  // namespace
