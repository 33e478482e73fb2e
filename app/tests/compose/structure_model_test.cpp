#include "wavebalance/app/compose/structure_model.hpp"

#include <gtest/gtest.h>

#include "support/chain_files.hpp"
#include "support/scene_texts.hpp"
#include "support/strip.hpp"
#include "support/summary_value.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/analysis/modes.hpp"
#include "wavebalance/app/analysis/sweep.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"
#include "wavebalance/app/results/record.hpp"
#include "wavebalance/fem/centrifugal.hpp"
#include "wavebalance/fem/eigenmodes.hpp"
#include "wavebalance/fem/matrix_market.hpp"

namespace {

using namespace wavebalance::app;
namespace fem = wavebalance::fem;

/// The bar of a scene as Matrix Market files and the scene of them: the same sections but [structure].
Scene as_matrices(const TemporaryFolder& folder, const Scene& bar, const std::string& structure = "") {
  const auto matrices = make_structure(bar);
  fem::write_matrix_market(folder / "m.mtx", matrices.mass, fem::MatrixMarketSymmetry::symmetric);
  fem::write_matrix_market(folder / "k.mtx", matrices.stiffness, fem::MatrixMarketSymmetry::symmetric);
  fem::write_matrix_market(folder / "c.mtx", matrices.damping, fem::MatrixMarketSymmetry::symmetric);
  const std::string tip = std::to_string(bar.structure.elements);
  const std::string text = write_scene(bar);
  std::string result =
      "[structure]\ntype = \"matrices\"\nmass = \"m.mtx\"\nstiffness = \"k.mtx\"\ncontact_dofs = [" + tip +
      "]\n" + structure + "\n" + text.substr(text.find("\n[contact]"));
  if (bar.analysis.type != AnalysisType::nonlinear_mode)
    result = with(result, "[forcing]\n", "[forcing]\nload_dofs = [" + tip + "]\n");
  return load_scene(folder.write("matrices.toml", result));
}

double distance(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

TEST(StructureModel, ComputesItsPolesOnceForAllCopies) {
  const StructureModel model = make_model(load_scene(WAVEBALANCE_SCENES "/jones_legrand_2014/case1.toml"));
  const StructureModel copy = model;
  ASSERT_NE(model.contact_dynamics(), nullptr);
  EXPECT_EQ(model.contact_dynamics(), copy.contact_dynamics());
}

TEST(MatricesModel, BarGivenAsMatricesHasTheSameNonlinearMode) {
  const TemporaryFolder folder;
  const Scene bar = parse_scene(rod_scene, "rod.toml");
  const Record expected = analyse(bar), found = analyse(as_matrices(folder, bar));
  ASSERT_EQ(found.backbone.rows(), expected.backbone.rows());
  EXPECT_EQ(found.backbone.texts("status"), expected.backbone.texts("status"));
  const auto a = found.backbone.numbers("energy_ratio"), b = expected.backbone.numbers("energy_ratio");
  for (std::size_t i = 0; i < a.size(); ++i)
    if (std::isfinite(b[i])) {
      EXPECT_NEAR(a[i], b[i], 1e-10 * b[i]);
    }
}

TEST(MatricesModel, BarGivenAsMatricesRespondsAlike) {
  const TemporaryFolder folder;
  const Scene bar = parse_scene(bar_scene, "bar.toml");
  const Response expected = weighted_residual_response(bar);
  const Response found = weighted_residual_response(as_matrices(folder, bar, "damping = \"c.mtx\""));
  ASSERT_TRUE(found.converged);
  EXPECT_LT(distance(found.displacement(), expected.displacement()), 1e-10);
  EXPECT_LT(distance(found.force(), expected.force()), 1e-10);
}

TEST(MatricesModel, BarGivenAsMatricesHasTheSameSweep) {
  const TemporaryFolder folder;
  const std::string text = with(bar_scene, "\"forced_response\"        # 23",
                                "\"frequency_sweep\"\nfrequency_from = 1250\nfrequency_to = 1260");
  const Scene bar = parse_scene(text, "bar.toml");
  const Sweep expected = frequency_sweep(bar);
  const Sweep found = frequency_sweep(as_matrices(folder, bar, "stiffness_damping = 1e-4"));
  ASSERT_TRUE(found.converged());
  ASSERT_EQ(found.curve.points.size(), expected.curve.points.size());
  for (std::size_t i = 0; i < found.curve.points.size(); ++i) {
    const auto &a = found.curve.points[i], &b = expected.curve.points[i];
    EXPECT_NEAR(a.frequency, b.frequency, 1e-10 * b.frequency);
    EXPECT_NEAR(a.max_displacement, b.max_displacement, 1e-10 * b.max_displacement);
  }
}

TEST(MatricesModel, AllModesKeptChangeNothing) {
  const TemporaryFolder folder;
  const Scene bar = parse_scene(rod_scene, "rod.toml");
  const ModeStudy whole(bar), reduced(as_matrices(folder, bar, "kept_modes = 19"));
  EXPECT_TRUE(reduced.model().reduced());
  const auto a = reduced.at_energy(3.0), b = whole.at_energy(3.0);
  EXPECT_NEAR(a.omega, b.omega, 1e-8 * b.omega);
  const auto u = reduced.model().recover(reduced.structure_motion(a, 64).displacement);
  const auto v = whole.structure_motion(b, 64).displacement;
  EXPECT_LT((u - v).cwiseAbs().maxCoeff(), 1e-6 * v.cwiseAbs().maxCoeff());
}

TEST(MatricesModel, NegativeContactDofsLookTheOtherWay) {
  const TemporaryFolder folder;
  write_chain(folder);
  const auto model_of = [&](const std::string& dofs) {
    return make_model(load_scene(folder.write("case.toml", with(chain_scene, "[2, 3]", dofs))));
  };
  const StructureModel up = model_of("[2, 3]"), down = model_of("[-2, 3]");
  EXPECT_EQ(Eigen::MatrixXd(up.structure.contact_directions),
            (Eigen::MatrixXd(2, 3) << 0, 1, 0, 0, 0, 1).finished());
  EXPECT_EQ(Eigen::MatrixXd(down.structure.contact_directions),
            (Eigen::MatrixXd(2, 3) << 0, -1, 0, 0, 0, 1).finished());
  Eigen::MatrixXd motion(3, 1);
  motion << 1.0, 2.0, 3.0;
  EXPECT_EQ(down.recover(motion), motion);
  EXPECT_THROW(up.recover(Eigen::MatrixXd(2, 1)), std::invalid_argument);
}

TEST(MatricesModel, ModalDampingIsTheRatioOfEveryMode) {
  const TemporaryFolder folder;
  write_chain(folder);
  const auto structure = make_model(load_scene(folder.write("case.toml", chain_scene))).structure;
  const auto modes = fem::eigenmodes(structure.stiffness, structure.mass, 3);
  const Eigen::MatrixXd modal = modes.shapes.transpose() * (structure.damping * modes.shapes);
  const Eigen::MatrixXd expected = (2.0 * 0.01 * modes.omega).asDiagonal();
  EXPECT_LT((modal - expected).norm(), 1e-12 * expected.norm());
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
  for (const char* scene : {"strip_mode.toml", "strip_forced.toml"})
    EXPECT_EQ(structure_dofs(load_scene(folder / scene)), 72) << scene;
}

Scene chain(const TemporaryFolder& folder, const std::vector<std::string>& overrides,
            const std::string& text = chain_scene) {
  write_chain(folder);
  return load_scene(folder.write("case.toml", text), overrides);
}

/// A chain whose responses settle within few periods, and more settings.
std::vector<std::string> damped(std::initializer_list<std::string> more) {
  std::vector<std::string> overrides{"forcing.frequency=35", "structure.modal_damping=0.1",
                                     "contact.gap=[5e-5, 1e-4]"};
  overrides.insert(overrides.end(), more);
  return overrides;
}

TEST(Contacts, TwoOfAChainMoveAsTimeSteppingSays) {
  const TemporaryFolder folder;
  const Response found = weighted_residual_response(
      chain(folder, damped({"contact.stiffness=1e6", "time.functions=127", "time.quadrature_points=2048"})));
  const Response reference = time_stepping_response(chain(
      folder, damped({"contact.stiffness=1e6", "analysis.type=time_stepping", "analysis.tolerance=1e-7"})));
  ASSERT_TRUE(found.converged && reference.converged);
  ASSERT_EQ(found.contacts.rows(), 2);
  for (int contact = 0; contact < 2; ++contact) {
    const auto a = found.contacts.contact(contact), b = reference.contacts.contact(contact);
    // A kink of the force leaves Fourier coefficients of the displacement of order k^-4: together 63^-3.5
    // of the motion, below the error of stepping to 1e-7 per period.
    EXPECT_LT(relative_rms_error(a.displacement.row(0), b.displacement.row(0)), 5e-6) << contact;
    EXPECT_GT(b.force.maxCoeff(), 0.0) << contact;
  }
  EXPECT_EQ(found.displacement().transpose(), found.contacts.displacement.row(found.contact));
}

// One mode is left beside the two contacts, and the load drives it at its resonance.
TEST(Contacts, RigidOnesHoldUpToTheErrorOfTheFunctions) {
  const TemporaryFolder folder;
  const std::string rigid = with(with(chain_scene, "\"linear\"", "\"rigid\""), "stiffness = 1e7", "# ");
  for (const int functions : {15, 31, 63}) {
    const Record record = analyse(chain(folder,
                                        damped({"time.functions=" + std::to_string(functions),
                                                "time.quadrature_points=" + std::to_string(8 * functions)}),
                                        rigid));
    EXPECT_TRUE(record.converged) << record.status;
    EXPECT_GE(value_of<double>(record.summary, "min_contact_force_N"), 0.0);
    EXPECT_LT(value_of<double>(record.summary, "max_penetration_m"), 0.5 * 5e-5) << functions;
    const auto forces = record.contacts.numbers("contact_force_N");
    EXPECT_GT(*std::max_element(forces.begin(), forces.end()), 0.0);
  }
}

TEST(Contacts, ObstaclesOnEitherSideAreMirrorImages) {
  const TemporaryFolder folder;
  const auto up = weighted_residual_response(chain(folder, damped({})));
  const auto down = weighted_residual_response(
      chain(folder, damped({"structure.contact_dofs=[-2,-3]", "forcing.load_dofs=[-3]"})));
  ASSERT_TRUE(up.converged && down.converged);
  EXPECT_LT((up.contacts.displacement - down.contacts.displacement).norm(),
            1e-12 * up.contacts.displacement.norm());
}

TEST(Contacts, AllPairsAgreeOnTheChain) {
  const TemporaryFolder folder;
  const auto overrides = damped({"contact.stiffness=1e6", "time.functions=64", "time.quadrature_points=256"});
  const Response fourier = weighted_residual_response(chain(folder, overrides));
  for (const auto& [trial, weight, tolerance] :
       std::vector<std::tuple<std::string, std::string, double>>{{"bspline", "bspline", 5e-3},
                                                                 {"daubechies6", "daubechies6", 5e-3},
                                                                 {"daubechies6", "fourier", 5e-3},
                                                                 {"haar", "fourier", 5e-2},
                                                                 {"haar", "bspline", 5e-2}}) {
    auto all = overrides;
    all.insert(all.end(), {"time.trial=" + trial, "time.weight=" + weight});
    const Response wavelet = weighted_residual_response(chain(folder, all));
    ASSERT_TRUE(wavelet.converged) << trial << weight << wavelet.status;
    EXPECT_LT((wavelet.contacts.displacement - fourier.contacts.displacement).norm(),
              tolerance * fourier.contacts.displacement.norm())
        << trial << weight;
  }
}

TEST(Contacts, MotionOfTheWholeFollowsTheContacts) {
  const TemporaryFolder folder;
  const Scene scene = chain(folder, damped({"structure.contact_dofs=[-2,3]"}));
  const StructureModel model = make_model(scene);
  ResponseOptions options;
  options.structure_points = 64;
  const Response response = weighted_residual_response(scene, model, options);
  const Eigen::MatrixXd whole = model.recover(response.structure.displacement);
  for (int l = 0; l < 64; ++l) {
    EXPECT_NEAR(whole(1, l), -response.contacts.displacement(0, 16 * l), 1e-12 * whole.norm());
    EXPECT_NEAR(whole(2, l), response.contacts.displacement(1, 16 * l), 1e-12 * whole.norm());
  }
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
