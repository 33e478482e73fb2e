#include "wavebalance/app/compose/structure_model.hpp"

#include <gtest/gtest.h>

#include "support/chain_files.hpp"
#include "support/scene_texts.hpp"
#include "support/strip.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/fem/centrifugal.hpp"
#include "wavebalance/fem/eigenmodes.hpp"
#include "wavebalance/fem/matrix_market.hpp"

namespace {

using namespace wavebalance::app;
namespace fem = wavebalance::fem;

TEST(StructureModel, ComputesItsPolesOnceForAllCopies) {
  const StructureModel model = make_model(load_scene(WAVEBALANCE_SCENES "/jones_legrand_2014/case1.toml"));
  const StructureModel copy = model;
  ASSERT_NE(model.contact_dynamics(), nullptr);
  EXPECT_EQ(model.contact_dynamics(), copy.contact_dynamics());
}

TEST(MatricesModel, RecoversMotionsOfItsSizeAlone) {
  const TemporaryFolder folder;
  write_chain(folder);
  const StructureModel model = make_model(load_scene(folder.write("case.toml", chain_scene)));
  const Eigen::MatrixXd motion = Eigen::MatrixXd::Ones(3, 1);
  EXPECT_EQ(model.recover(motion), motion);
  EXPECT_THROW(model.recover(Eigen::MatrixXd(2, 1)), std::invalid_argument);
}

TEST(MatricesModel, TermsOfOneShapeAreOneForce) {
  const TemporaryFolder folder;
  write_chain(folder);
  const std::string terms =
      "[[forcing.terms]]\namplitude = 60.0\n"
      "[[forcing.terms]]\ndofs = [3]\namplitude = 40.0\n[time]";
  const Scene scene = load_scene(folder.write("case.toml", with(chain_scene, "[time]", terms)),
                                 std::vector<std::string>{"forcing.amplitude=0"});
  EXPECT_EQ(make_model(scene).structure.forces.size(), 1u);
}

const std::string small_blade = R"([structure]
type = "blade"
chord_elements = 3
span_elements = 4
kept_modes = 20
[contact]
law = "rigid"
gap = 1e-3
[analysis]
type = "nonlinear_mode"
)";

TEST(BladeModel, ShowsItsReductionAndIsCancelledBetweenItsSteps) {
  const TemporaryFolder folder;
  const Scene scene = load_scene(folder.write("case.toml", small_blade));
  std::vector<std::string> phases;
  int calls = 0, last = 1000;
  const auto observe = [&](const wavebalance::solvers::Progress& progress) {
    if (phases.empty() || phases.back() != progress.phase) phases.emplace_back(progress.phase);
    return ++calls < last;
  };
  EXPECT_EQ(make_model(scene, observe).structure.stiffness.toDense(),
            make_model(scene).structure.stiffness.toDense());
  EXPECT_EQ(phases.front(), "assembling the structure");
  EXPECT_EQ(phases[1], "reducing the structure, factorising the stiffness");
  EXPECT_EQ(phases.back(), "reducing the structure, projecting the matrices");
  for (last = calls; last > 0; last /= 2) {
    calls = 0;
    EXPECT_THROW(make_model(scene, observe), ReductionCancelled);
    EXPECT_EQ(calls, last);
  }
}

double first_omega(const StructureModel& model) {
  return fem::eigenmodes(model.structure.stiffness, model.structure.mass, 1).omega[0];
}

TEST(BladeModel, TurnsAboutAnAxisBelowItsRoot) {
  const auto model_of = [](const std::vector<std::string>& overrides) {
    return make_model(parse_scene(small_blade, "blade.toml", overrides));
  };
  const StructureModel model = model_of({"structure.rotation_speed=1000", "structure.hub_radius=0.3"});
  const auto& solid = model.blade->model;
  const auto matrices = fem::solid_matrices(solid);
  const auto turning = fem::centrifugal_stiffness(
      solid, matrices.stiffness, {.direction = Eigen::Vector3d::UnitX(), .point = {0.0, 0.0, -0.3}});
  const double whole =
      fem::eigenmodes(turning.stiffness(matrices.stiffness, 1000.0), matrices.mass, 1).omega[0];
  EXPECT_NEAR(first_omega(model), whole, 5e-4 * whole);
  EXPECT_GT(first_omega(model), 1.01 * first_omega(model_of({})));
}

TEST(BladeModel, ForceActsAtTheNamedPlaceOfTheTip) {
  const std::string forced = with(small_blade, "nonlinear_mode", "forced_response") +
                             "[forcing]\namplitude = 6\nfrequency = 100\n"
                             "[time]\ntrial = \"fourier\"\nweight = \"fourier\"\nfunctions = 8\n";
  const auto load_of = [&](const std::string& place, const std::string& direction) {
    return make_model(parse_scene(forced, "blade.toml",
                                  std::vector<std::string>{"contact.law=linear", "contact.stiffness=1e6",
                                                           "forcing.place=" + place,
                                                           "forcing.direction=" + direction}))
        .structure.load;
  };
  // Eight corner nodes in pairs from the leading edge, x y z of each, then the kept modes.
  const auto leading = load_of("leading_edge", "y"), middle = load_of("mid_chord", "z"),
             trailing = load_of("trailing_edge", "x");
  for (const auto& [load, entries] : std::vector<std::pair<Eigen::VectorXd, std::vector<int>>>{
           {leading, {1, 4}}, {middle, {8, 11, 14, 17}}, {trailing, {18, 21}}}) {
    Eigen::VectorXd expected = Eigen::VectorXd::Zero(44);
    for (const int entry : entries) expected[entry] = 6.0 / static_cast<double>(entries.size());
    EXPECT_LT((load - expected).norm(), 1e-12);
  }
}

TEST(BladeModel, TermsOfTheForcingActAtItsPlaceAndOnItsMass) {
  const std::string forced = with(small_blade, "nonlinear_mode", "forced_response") +
                             "[forcing]\namplitude = 6\nfrequency = 100\ndirection = \"x\"\n"
                             "[[forcing.terms]]\nharmonic = 0\namplitude = 3\n"
                             "[[forcing.terms]]\nkind = \"base_acceleration\"\namplitude = 2\n"
                             "[time]\ntrial = \"fourier\"\nweight = \"fourier\"\nfunctions = 8\n";
  const StructureModel model = make_model(parse_scene(
      forced, "blade.toml", std::vector<std::string>{"contact.law=linear", "contact.stiffness=1e6"}));
  ASSERT_EQ(model.structure.forces.size(), 2u);
  EXPECT_LT((6.0 * model.structure.forces[0].shape - model.structure.load).norm(), 1e-12);
  const std::vector<int>& free = model.blade->model.dofs.free();
  const Eigen::VectorXd along = Eigen::VectorXd::NullaryExpr(
      std::ssize(free), [&](Eigen::Index i) { return free[std::size_t(i)] % 3 == 0 ? 1.0 : 0.0; });
  const Eigen::VectorXd expected =
      -model.recovery.transpose() * (fem::solid_matrices(model.blade->model).mass * along);
  EXPECT_LT((model.structure.forces[1].shape - expected).norm(), 1e-12 * expected.norm());
}

TEST(BladeModel, RecoveryIsThatOfTheReduction) {
  const StructureModel model = make_model(parse_scene(small_blade, "blade.toml"));
  const auto matrices = fem::solid_matrices(model.blade->model);
  const Eigen::VectorXd q = Eigen::VectorXd::LinSpaced(model.size(), -1.0, 1.0);
  const Eigen::VectorXd u = model.recover(q);
  const double energy = u.dot(matrices.stiffness * u);
  EXPECT_NEAR(q.dot(model.structure.stiffness * q), energy, 1e-9 * energy);
  for (int contact = 0; contact < model.contacts(); ++contact)
    EXPECT_DOUBLE_EQ(u[model.blade->contact_unknowns[static_cast<std::size_t>(contact)]],
                     q[model.structure.selected_dof(contact)]);
}

TEST(MatricesModel, FilesOfTheStripAreWhatFemMakes) {
  const auto folder = std::filesystem::path(WAVEBALANCE_SCENES) / "matrices";
  const auto matrices = strip_matrices();
  const Eigen::SparseMatrix<double> mass = fem::read_matrix_market(folder / "strip_mass.mtx") - matrices.mass;
  const Eigen::SparseMatrix<double> stiffness =
      fem::read_matrix_market(folder / "strip_stiffness.mtx") - matrices.stiffness;
  EXPECT_LT(mass.norm(), 1e-12 * matrices.mass.norm());
  EXPECT_LT(stiffness.norm(), 1e-12 * matrices.stiffness.norm());
}

TEST(MatricesModel, FilesAreReadOnce) {
  const TemporaryFolder folder;
  write_chain(folder);
  const Scene scene = load_scene(folder.write("case.toml", chain_scene));
  std::filesystem::remove(folder / "k.mtx");
  EXPECT_EQ(make_model(scene).size(), 3);
  Scene other = scene;
  other.structure.matrices.stiffness = folder / "other.mtx";
  EXPECT_THROW(make_model(other), std::runtime_error);
}

}  // namespace
