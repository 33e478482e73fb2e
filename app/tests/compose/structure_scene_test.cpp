#include <gtest/gtest.h>

#include "support/chain_files.hpp"
#include "support/scene_error.hpp"
#include "support/scene_texts.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"
#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/app/results/record.hpp"
#include "wavebalance/app/scene/contacts.hpp"
#include "wavebalance/app/scene/scene_keys.hpp"
#include "wavebalance/fem/blade.hpp"

namespace {

using namespace wavebalance::app;

const std::string blade_scene = R"([structure]
type = "blade"                  # 2
[contact]
law = "rigid"                   # 4
gap = 1e-3                      # 5
[analysis]
type = "nonlinear_mode"         # 7
)";

/// A folder with the chain, and the errors of scenes in it.
class ChainScene : public testing::Test {
 protected:
  ChainScene() { write_chain(folder_); }

  Scene load(const std::string& text, const std::vector<std::string>& overrides = {}) const {
    return load_scene(folder_.write("case.toml", text), overrides);
  }

  SceneError::Details error_of(const std::string& text,
                               const std::vector<std::string>& overrides = {}) const {
    return details_of_error([&](const std::string& one) { load(one, overrides); }, text);
  }

  void expect_error(const std::string& text, int line, const std::string& key,
                    const std::string& allowed) const {
    const auto details = error_of(text);
    EXPECT_EQ(details.line, line) << details.allowed;
    EXPECT_EQ(details.key, key) << details.allowed;
    EXPECT_NE(details.allowed.find(allowed), std::string::npos) << details.allowed;
  }

  TemporaryFolder folder_;
};

TEST_F(ChainScene, WhatWasProbablyMeantOtherwiseIsRefusedOrSaid) {
  expect_error(with(chain_scene, "modal_damping = 0.01", "modal_damping = 2"), 6, "structure.modal_damping",
               "in 0..1");
  expect_error(with(chain_scene, "stiffness = \"k.mtx\"", "stiffness = \"m.mtx\""), 4, "structure.stiffness",
               "is the file of structure.mass, too");
  expect_error(with(chain_scene, "contact_dofs = [2, 3]", "contact_dofs = [3, -3]"), 5,
               "structure.contact_dofs",
               "[[contact.pairs]] with dofs = [3] and side = \"both\" has an obstacle on either side");
  const std::string pairs = with(with(chain_scene, "contact_dofs = [2, 3]", "# "), "[forcing]",
                                 "[[contact.pairs]]\ndofs = [3]\nside = \"both\"\ngap = -1e-4\n[forcing]");
  const Scene both = load(pairs);
  const std::string text = describe_scene(both);
  EXPECT_NE(text.find(" m; two each of the 1 direction with obstacles on both sides"), std::string::npos)
      << text;
  bool said = false;
  for (const std::string& warning : analyse(both).warnings)
    said = said || warning.find("contact.pairs[1].gap is -0.0001 m with side = \"both\"") == 0;
  EXPECT_TRUE(said);
}

TEST_F(ChainScene, TimeSteppingCountsTheStatesOfTheMatrices) {
  const std::string text = describe_scene(load(chain_scene, {"analysis.type=time_stepping"}));
  EXPECT_NE(text.find("size       6 states"), std::string::npos) << text;
}

TEST(StripScene, TimeSteppingOfManyModesIsAdvisedToKeepFewer) {
  const std::string strip = WAVEBALANCE_SCENES "/matrices/strip_forced.toml";
  const auto described = [&](std::vector<std::string> more) {
    more.push_back("analysis.type=time_stepping");
    return describe_scene(load_scene(strip, more, std::vector<std::string>{"analysis.motion_points"}));
  };
  EXPECT_NE(described({}).find("advice     time stepping follows all 72 modes"), std::string::npos)
      << described({});
  EXPECT_EQ(described({"structure.kept_modes=4"}).find("advice"), std::string::npos);
}

TEST_F(ChainScene, DampingThatAddsEnergyIsAWarning) {
  folder_.write("c.mtx", "%%MatrixMarket matrix coordinate real symmetric\n3 3 3\n1 1 10\n2 2 10\n3 3 -1\n");
  const std::string damped = with(chain_scene, "modal_damping = 0.01 ", "damping = \"c.mtx\"");
  const Scene scene = load(damped);
  EXPECT_NE(describe_scene(scene).find("warning    structure.damping is not positive semidefinite"),
            std::string::npos);
  const Record record = analyse(scene);
  ASSERT_EQ(record.warnings.size(), 1u);
  EXPECT_NE(record.warnings[0].find("the structure itself is unstable"), std::string::npos);
  folder_.write("c.mtx", "%%MatrixMarket matrix coordinate real symmetric\n3 3 3\n1 1 10\n2 2 10\n3 3 1\n");
  EXPECT_TRUE(analyse(load(damped)).warnings.empty());
}

TEST_F(ChainScene, LoadsWithPathsRelativeToItsFile) {
  const Scene scene = load(chain_scene);
  EXPECT_EQ(scene.structure.matrices.mass, (folder_ / "m.mtx").string());
  EXPECT_EQ(scene.structure.matrices.contact_dofs, (std::vector<int>{2, 3}));
  EXPECT_EQ(scene.structure.kept_modes, -1);
  EXPECT_EQ(scene.analysis.motion_points, 0);
  EXPECT_EQ(structure_dofs(scene), 3);
  EXPECT_EQ(parse_scene(write_scene(scene), "elsewhere.toml"), scene);
}

TEST_F(ChainScene, UnreadableFilesAreErrorsAtTheirKey) {
  expect_error(with(chain_scene, "m.mtx", "no.mtx"), 3, "structure.mass",
               "no.mtx: the file cannot be opened");
  folder_.write("bad.mtx", "%%MatrixMarket matrix coordinate real symmetric\n3 3 1\n4 1 2\n");
  expect_error(with(chain_scene, "k.mtx", "bad.mtx"), 4, "structure.stiffness",
               "bad.mtx:3: the row is 4; it must be in 1..3");
  expect_error(with(chain_scene, "\"m.mtx\"", "3"), 3, "structure.mass", "the name of a file");
  expect_error(with(chain_scene, "m.mtx", "/dev/zero"), 3, "structure.mass",
               "/dev/zero is not a regular file");
}

TEST_F(ChainScene, SizesThatDifferAreErrors) {
  folder_.write("two.mtx", "%%MatrixMarket matrix coordinate real symmetric\n2 2 2\n1 1 1\n2 2 1\n");
  expect_error(with(chain_scene, "m.mtx", "two.mtx"), 3, "structure.mass", "2 x 2; expected 3 x 3");
  folder_.write("wide.mtx", "%%MatrixMarket matrix coordinate real general\n2 3 1\n1 1 1\n");
  expect_error(with(chain_scene, "k.mtx", "wide.mtx"), 4, "structure.stiffness", "2 x 3; expected a square");
  expect_error(with(chain_scene, "modal_damping = 0.01 ", "damping = \"two.mtx\" "), 6, "structure.damping",
               "2 x 2; expected 3 x 3");
}

TEST_F(ChainScene, UnsymmetricMatricesAreErrorsWithRowsFromOne) {
  folder_.write("skew.mtx",
                "%%MatrixMarket matrix coordinate real general\n3 3 4\n1 1 2\n2 2 2\n3 3 2\n1 3 1\n");
  expect_error(with(chain_scene, "k.mtx", "skew.mtx"), 4, "structure.stiffness",
               "is not symmetric: row 3, column 1");
}

TEST_F(ChainScene, IndefiniteMassAndSingularStiffnessAreErrors) {
  folder_.write("no_mass.mtx", "%%MatrixMarket matrix coordinate real symmetric\n3 3 2\n1 1 2\n3 3 2\n");
  const std::string massless = with(chain_scene, "m.mtx", "no_mass.mtx");
  expect_error(massless, 5, "structure.contact_dofs", "degree of freedom 2 has no mass and is condensed");
  const std::string kept = with(massless, "[2, 3]", "[3]\nunsymmetric = true");
  expect_error(kept, 3, "structure.mass", "not positive definite: its diagonal entry 2 is 0");
  expect_error(kept, 3, "structure.mass",
               "Of its rows 1 has no mass: 2. They are condensed statically where");
  folder_.write(
      "free.mtx",
      "%%MatrixMarket matrix coordinate real symmetric\n3 3 5\n1 1 1\n2 1 -1\n2 2 2\n3 2 -1\n3 3 1\n");
  expect_error(with(chain_scene, "k.mtx", "free.mtx"), 4, "structure.stiffness", "free to move");
}

TEST_F(ChainScene, DenseMatricesAndASparseLoadAreTakenAsTheOthersAre) {
  folder_.write(
      "k_dense.mtx",
      "%%MatrixMarket matrix array real general\n3 3\n2e6\n-1e6\n0\n-1e6\n2e6\n-1e6\n0\n-1e6\n1e6\n");
  folder_.write("m_dense.mtx", "%%MatrixMarket matrix array real symmetric\n3 3\n2\n0\n0\n2\n0\n2\n");
  folder_.write("f_sparse.mtx", "%%MatrixMarket matrix coordinate real general\n3 1 1\n3 1 1\n");
  const std::string vector = with(chain_scene, "load_dofs = [3] ", "load = \"f.mtx\"");
  const StructureModel sparse = make_model(load(vector));
  const StructureModel dense = make_model(load(
      with(with(with(vector, "k.mtx", "k_dense.mtx"), "m.mtx", "m_dense.mtx"), "f.mtx", "f_sparse.mtx")));
  EXPECT_EQ(Eigen::MatrixXd(dense.structure.stiffness), Eigen::MatrixXd(sparse.structure.stiffness));
  EXPECT_EQ(Eigen::MatrixXd(dense.structure.mass), Eigen::MatrixXd(sparse.structure.mass));
  EXPECT_EQ(dense.structure.load, sparse.structure.load);
}

TEST_F(ChainScene, ContactDofsAreInRangeAndOnce) {
  expect_error(with(chain_scene, "[2, 3]", "[2, 4]"), 5, "structure.contact_dofs", "no degree of freedom 4");
  expect_error(with(chain_scene, "[2, 3]", "[0]"), 5, "structure.contact_dofs", "expected 1..3");
  expect_error(with(chain_scene, "[2, 3]", "[3, -3]"), 5, "structure.contact_dofs", "3 is there twice");
  expect_error(with(chain_scene, "[2, 3]", "[]"), 5, "structure.contact_dofs", "there are 0");
  expect_error(with(chain_scene, "[2, 3]", "[2.5]"), 5, "structure.contact_dofs", "a list of integers");
  expect_error(with(chain_scene, "[2, 3]", "3"), 5, "structure.contact_dofs", "a list of integers");
  expect_error(with(chain_scene, "contact_dofs", "# "), 1, "structure.contact_dofs", "missing");
}

TEST_F(ChainScene, GapsAreOneOrOneAContact) {
  const Scene scene = load(with(chain_scene, "gap = 1e-4", "gap = [1e-4, 2e-4]"));
  EXPECT_EQ(contacts_of(scene).at(1).gap, 2e-4);
  EXPECT_TRUE(std::isnan(common_gap(scene)));
  EXPECT_EQ(parse_scene(write_scene(scene), "written.toml"), scene);
  EXPECT_EQ(contacts_of(load(with(chain_scene, "gap = 1e-4", "gap = 1"))).at(1).gap, 1.0);
  expect_error(with(chain_scene, "gap = 1e-4", "gap = [1, 2, 3]"), 10, "contact.gap", "each of 2 degrees");
  expect_error(with(chain_scene, "gap = 1e-4", "gap = [1, inf]"), 10, "contact.gap", "finite");
  expect_error(with(chain_scene, "gap = 1e-4", "gap = [\"a\"]"), 10, "contact.gap", "or a list of them");
  const auto bar = error_of(with(bar_scene, "gap = 1e-3", "gap = [1e-3, 2e-3]"));
  EXPECT_NE(bar.allowed.find("each of 1 degree of freedom"), std::string::npos) << bar.allowed;
}

TEST_F(ChainScene, LoadsAreAFileOrAList) {
  const std::string file = with(chain_scene, "load_dofs = [3]", "load = \"f.mtx\"");
  EXPECT_EQ(make_model(load(file)).structure.load, make_model(load(chain_scene)).structure.load);
  folder_.write("short.mtx", "%%MatrixMarket matrix array real general\n2 1\n0\n1\n");
  expect_error(with(file, "f.mtx", "short.mtx"), 12, "forcing.load", "2 entries; expected 3");
  for (const char* name : {"short.mtx", "k.mtx"})  // both files
    expect_error(with(file, "f.mtx", "short.mtx"), 12, "forcing.load", (folder_ / name).string());
  expect_error(with(file, "f.mtx", "k.mtx"), 12, "forcing.load", "the count of columns is 3; it must be 1");
  folder_.write("sparse.mtx", "%%MatrixMarket matrix coordinate real general\n3 1 1\n3 1 1\n");
  EXPECT_EQ(make_model(load(with(file, "f.mtx", "sparse.mtx"))).structure.load,
            make_model(load(chain_scene)).structure.load);
  expect_error(with(file, "[time]", "load_dofs = [1]\n[time]"), 15, "forcing.load_dofs", "not both");
  expect_error(with(chain_scene, "load_dofs = [3]", ""), 11, "forcing.load", "missing; expected load");
  expect_error(with(chain_scene, "load_dofs = [3]", "load_dofs = [-5]"), 12, "forcing.load_dofs",
               "no degree of freedom -5");
}

TEST_F(ChainScene, OneDampingIsGivenAtMost) {
  expect_error(with(chain_scene, "[contact]", "stiffness_damping = 1e-5\n[contact]"), 6,
               "structure.modal_damping", "another damping");
  expect_error(with(chain_scene, "[contact]", "damping = \"k.mtx\"\n[contact]"), 7, "structure.damping",
               "another damping");
}

TEST_F(ChainScene, ReductionsKeepWhatIsThere) {
  EXPECT_EQ(make_model(load(chain_scene, {"structure.kept_modes=1"})).size(), 3);
  EXPECT_EQ(make_model(load(chain_scene, {"structure.kept_modes=0"})).size(), 2);
  const auto many = error_of(chain_scene, {"structure.kept_modes=2"});
  EXPECT_EQ(many.key, "structure.kept_modes");
  EXPECT_NE(many.allowed.find("at most 1"), std::string::npos) << many.allowed;
  EXPECT_EQ(error_of(chain_scene, {"structure.kept_modes=0", "structure.contact_dofs=[1,2,3]"}).key,
            "structure.kept_modes");
}

TEST_F(ChainScene, KeysOfAnotherTypeAreErrorsThatNameIt) {
  expect_error(with(chain_scene, "modal_damping = 0.01 ", "elements = 3 "), 6, "structure.elements",
               "structure.type = \"matrices\"; only with structure.type = \"bar\"");
  expect_error(with(chain_scene, "modal_damping = 0.01 ", "chord = [1, 2] "), 6, "structure.chord",
               "only with structure.type = \"blade\"");
  expect_error(with(bar_scene, "[contact]", "contact_dofs = [1]\n[contact]"), 9, "structure.contact_dofs",
               "only with structure.type = \"matrices\"");
}

TEST_F(ChainScene, NonlinearModesAreWithoutDampingAndWithPositiveGaps) {
  const std::string mode = "analysis.type=nonlinear_mode",
                    rigid = with(with(chain_scene, "\"linear\"", "\"rigid\""), "stiffness = 1e7", "# ");
  EXPECT_EQ(error_of(rigid, {mode}).key, "structure.modal_damping");
  const std::string undamped = with(rigid, "modal_damping = 0.01", "");
  EXPECT_EQ(load(undamped, {mode}).analysis.samples, 20);
  EXPECT_EQ(error_of(with(undamped, "gap = 1e-4", "gap = [1e-4, 0]"), {mode}).key, "contact.gap");
  EXPECT_EQ(error_of(undamped, {mode, "analysis.mode=4"}).key, "analysis.mode");
  EXPECT_EQ(error_of(undamped, {mode, "structure.damping=k.mtx"}).key, "structure.damping");
}

TEST_F(ChainScene, CheckSaysHowLargeItIs) {
  const std::string text = describe_scene(load(chain_scene, {"structure.kept_modes=1"}));
  for (const char* part : {"matrices, 3 degrees of freedom", "reduced to 3 (1 mode)",
                           "at 2 degrees of freedom", "64 unknowns", "on 1 degree of freedom"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " is not in\n" << text;
}

TEST(BladeScene, TypeAloneIsTheOpenBlade) {
  const Scene scene = parse_scene(blade_scene, "blade.toml");
  const auto options = blade_options(scene.structure);
  const wavebalance::fem::BladeOptions defaults;
  EXPECT_EQ(options.chord, defaults.chord);
  EXPECT_EQ(options.thickness_ratio, defaults.thickness_ratio);
  EXPECT_EQ(options.camber_ratio, defaults.camber_ratio);
  EXPECT_EQ(options.angle_degrees, defaults.angle_degrees);
  EXPECT_EQ(options.edge_thickness, defaults.edge_thickness);
  EXPECT_EQ(options.length, defaults.length);
  EXPECT_EQ(options.material.youngs_modulus, defaults.material.youngs_modulus);
  EXPECT_EQ(options.material.poissons_ratio, defaults.material.poissons_ratio);
  EXPECT_EQ(options.material.density, defaults.material.density);
  EXPECT_EQ(options.element, defaults.element);
  EXPECT_EQ(options.chord_elements, defaults.chord_elements);
  EXPECT_EQ(options.thickness_elements, defaults.thickness_elements);
  EXPECT_EQ(options.span_elements, defaults.span_elements);
  EXPECT_EQ(scene.structure.kept_modes, 40);
  EXPECT_EQ(scene.analysis.motion_points, 32);
  EXPECT_EQ(structure_dofs(scene), 3936);
  EXPECT_EQ(reduced_size(scene), 112);
  EXPECT_EQ(contact_count(scene), 24);
  EXPECT_EQ(parse_scene(write_scene(scene), "written.toml"), scene);
}

// 24 contacts: counts of 15 functions take three points of the curve, those of 63 tens of them.
TEST(BladeScene, CountsMultipliersAlongCurvesByDefaultWhereThatCostsAFewPoints) {
  const std::filesystem::path path = std::filesystem::path(WAVEBALANCE_SCENES) / "blade" / "sweep.toml";
  const auto counts = [&](const std::vector<std::string>& overrides) {
    return load_scene(path, overrides).analysis.stability;
  };
  EXPECT_TRUE(counts({"time.functions=15"}));
  EXPECT_FALSE(counts({"time.functions=63"}));
  EXPECT_TRUE(counts({"time.functions=63", "analysis.stability=true"}));
  EXPECT_TRUE(counts({"time.functions=63", "structure.chord_elements=2"}));
}

TEST(BladeScene, WrongValuesAreErrorsAtTheirPlace) {
  const auto message = [](const std::string& line) {
    try {
      parse_scene(with(blade_scene, "[contact]", line + "\n[contact]"), "blade.toml");
    } catch (const SceneError& error) {
      EXPECT_EQ(error.details().line, 3);
      return error.details().key + ": " + error.details().allowed;
    }
    return std::string("no error");
  };
  EXPECT_NE(
      message("chord = [0.05]").find("structure.chord: there are 1; expected a list of 2 numbers in m, > 0"),
      std::string::npos);
  EXPECT_NE(message("chord = [0.05, -1]").find("out of range"), std::string::npos);
  EXPECT_NE(message("element = \"hexahedron\"").find("did you mean"), std::string::npos);
  EXPECT_NE(message("kept_modes = 4000").find("at most 3864"), std::string::npos);
  EXPECT_NE(message("rotation_axis = [0, 0, 0]").find("not zero"), std::string::npos);
  EXPECT_NE(message("poissons_ratio = 0.5").find("out of range"), std::string::npos);
  EXPECT_NE(message("area = 1").find("only with structure.type = \"bar\""), std::string::npos);
}

TEST(BladeScene, UnknownsAreThoseOfTheMesh) {
  for (const char* element : {"hexahedron20", "hexahedron20_reduced", "hexahedron8"}) {
    const Scene scene = parse_scene(
        blade_scene, "blade.toml",
        std::vector<std::string>{"structure.chord_elements=3", "structure.thickness_elements=2",
                                 "structure.span_elements=4", std::string("structure.element=") + element});
    const auto blade = wavebalance::fem::blade(blade_options(scene.structure));
    EXPECT_EQ(structure_dofs(scene), blade.model.dofs.count()) << element;
    EXPECT_EQ(contact_count(scene), static_cast<int>(blade.contact_nodes.size()));
  }
}

}  // namespace
