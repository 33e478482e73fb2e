// [[contact.pairs]]: directions of contact with their own laws.
#include <gtest/gtest.h>

#include "support/chain_files.hpp"
#include "support/scene_error.hpp"
#include "support/scene_texts.hpp"
#include "support/summary_value.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/analysis/modes.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"
#include "wavebalance/app/results/record.hpp"
#include "wavebalance/app/scene/contacts.hpp"
#include "wavebalance/app/scene/scene_keys.hpp"

namespace {

using namespace wavebalance::app;

// The chain of chain_files.hpp: relative motion, both sides of one mass, a weighted sum with a law of its
// own.
const std::string pair_scene = R"([structure]
type = "matrices"               # 2
mass = "m.mtx"                  # 3
stiffness = "k.mtx"             # 4
modal_damping = 0.1             # 5
[contact]
law = "linear"                  # 7
stiffness = 1e6                 # 8
gap = 2e-5                      # 9
[[contact.pairs]]               # 10
dofs = [3, 1]                   # 11
[[contact.pairs]]               # 12
dofs = [2]                      # 13
side = "both"                   # 14
gap = 5e-5                      # 15
[[contact.pairs]]               # 16
dofs = [1, 2, 3]                # 17
coefficients = [0.5, -1, 2.0]   # 18
side = "negative"               # 19
law = "exponential"             # 20
constant = 1e4                  # 21
exponent = 100.0                # 22
[forcing]
load_dofs = [3]                 # 24
amplitude = 100.0               # 25
frequency = 35.0                # 26
[time]
trial = "fourier"
weight = "fourier"
functions = 63
[analysis]
type = "forced_response"        # 32
)";

class ContactPairs : public testing::Test {
 protected:
  ContactPairs() { write_chain(folder_); }

  Scene load(const std::string& text, const std::vector<std::string>& overrides = {},
             const std::vector<std::string>& removed = {}) const {
    return load_scene(folder_.write("case.toml", text), overrides, removed);
  }

  SceneError::Details error_of(const std::string& text,
                               const std::vector<std::string>& overrides = {}) const {
    return details_of_error([&](const std::string& one) { load(one, overrides); }, text);
  }

  TemporaryFolder folder_;
};

TEST_F(ContactPairs, AreDirectionsWithTheirOwnLawsAndGaps) {
  const Scene scene = load(pair_scene);
  ASSERT_EQ(contact_count(scene), 4);
  const StructureModel model = make_model(scene);
  Eigen::MatrixXd expected(4, 3);
  expected << -1.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, -1.0, 0.0, -0.5, 1.0, -2.0;
  EXPECT_EQ(Eigen::MatrixXd(model.structure.contact_directions), expected);
  EXPECT_EQ(model.gaps, Eigen::Vector4d(2e-5, 5e-5, 5e-5, 2e-5));
  const auto laws = make_laws(scene);
  for (const int contact : {0, 1, 2}) EXPECT_DOUBLE_EQ(laws[contact].tangent(1.0), 1e6) << contact;
  EXPECT_DOUBLE_EQ(laws[3].force(2e-5 + 1e-3), 1e4 * std::expm1(100.0 * 1e-3));
  EXPECT_EQ(laws[2].gap(), 5e-5);
}

TEST_F(ContactPairs, AreWrittenAndReadBackEqual) {
  for (const char* law : {"\"linear\"", "\"rigid\"", "\"none\""}) {
    std::string text = with(pair_scene, "\"linear\"                  # 7", law);
    if (std::string(law) != "\"linear\"") {
      text = with(with(text, "stiffness = 1e6", "# "), "law = \"exponential\"", "# ");
      text = with(with(text, "constant = 1e4", "# "), "exponent = 100.0", "# ");
    }
    if (std::string(law) == "\"none\"") text = with(with(text, "gap = 2e-5", "# "), "gap = 5e-5", "# ");
    const Scene scene = load(text);
    const std::string written = write_scene(scene);
    EXPECT_EQ(parse_scene(written, "written.toml"), scene) << written;
    EXPECT_EQ(complete_scene(scene), scene);
  }
}

TEST_F(ContactPairs, AreContactsOfTheOneListWithTheirSidesAndLaws) {
  const std::vector<SceneContact> contacts = contacts_of(load(pair_scene));
  ASSERT_EQ(contacts.size(), 4u);
  EXPECT_EQ(contacts[1].pair, contacts[2].pair);  // both sides of the second
  ASSERT_EQ(contacts[2].coefficients.size(), contacts[1].coefficients.size());
  EXPECT_EQ(contacts[2].coefficients[0], -contacts[1].coefficients[0]);
  EXPECT_EQ(contacts[1].gap, contacts[2].gap);
  EXPECT_EQ(contacts[3].law, "exponential");
  EXPECT_EQ(contacts[3].values.count("stiffness"), 0u);
  EXPECT_EQ(std::get<double>(contacts[3].values.at("gap")), contacts[3].gap);
  EXPECT_TRUE(contacts[1].same_law(contacts[2]));
  EXPECT_FALSE(contacts[1].same_law(contacts[3]));
}

TEST_F(ContactPairs, TakeOverridesByTheirNumberFromOne) {
  const Scene scene = load(pair_scene, {"contact.pairs[2].side=positive", "contact.pairs[1].gap=3e-5"},
                           {"contact.pairs[2].gap"});
  EXPECT_EQ(contact_count(scene), 3);
  EXPECT_EQ(contacts_of(scene).at(0).gap, 3e-5);
  EXPECT_EQ(contacts_of(scene).at(1).gap, 2e-5);
  const auto missing = error_of(pair_scene, {"contact.pairs[4].gap=1e-5"});
  EXPECT_EQ(missing.key, "contact.pairs[4].gap");
  EXPECT_NE(missing.allowed.find("the scene has 3 [[contact.pairs]]"), std::string::npos) << missing.allowed;
  EXPECT_NE(
      error_of(pair_scene, {"contact.pairs[1].gab=1e-5"}).allowed.find("did you mean contact.pairs[1].gap?"),
      std::string::npos);
}

TEST_F(ContactPairs, NeedNoDefaultsWhereEachHasItsOwn) {
  const std::string own =
      with(with(pair_scene, "gap = 2e-5  ", "#"), "dofs = [3, 1]", "gap = 1e-5\ndofs = [3, 1]");
  const std::string all = with(own, "exponent = 100.0", "gap = -1e-5\nexponent = 100.0");
  EXPECT_EQ(contacts_of(load(all)).at(3).gap, -1e-5);
  const auto error = error_of(own);
  EXPECT_EQ(error.key, "contact.pairs[3].gap");
  EXPECT_EQ(error.line, 17);
  EXPECT_NE(error.allowed.find("missing; expected a number in m, here or in [contact]"), std::string::npos)
      << error.allowed;
}

TEST_F(ContactPairs, ThatAreWrongAreErrorsAtTheirPlace) {
  struct Wrong {
    std::string old_text, new_text;
    int line;
    std::string key, allowed;
  };
  const std::string coefficients = "[0.5, -1, 2.0]";
  for (const auto& [old_text, new_text, line, key, allowed] : std::vector<Wrong>{
           {"dofs = [3, 1] ", "# ", 10, "contact.pairs[1].dofs", "missing; expected a list of integers"},
           {"[3, 1]", "[]", 11, "contact.pairs[1].dofs", "there are 0"},
           {"[3, 1]", "[3, 4]", 11, "contact.pairs[1].dofs", "no degree of freedom 4; expected 1..3"},
           {"[3, 1]", "[3, 0]", 11, "contact.pairs[1].dofs", "out of range"},
           {"[3, 1]", "[3, -1]", 11, "contact.pairs[1].dofs", "out of range"},
           {"[3, 1]", "[3, 3]", 11, "contact.pairs[1].dofs", "twice; expected each once"},
           {"[3, 1]", "[3, 1.5]", 11, "contact.pairs[1].dofs", "a list of integers"},
           {"[3, 1]", "3", 11, "contact.pairs[1].dofs", "a list of integers"},
           {coefficients, "[0.5, -1]", 18, "contact.pairs[3].coefficients",
            "there are 2; expected a list of numbers, one for each of 3 dofs"},
           {coefficients, "[0, 0, 0.0]", 18, "contact.pairs[3].coefficients", "all are zero"},
           {coefficients, "[1, nan, 0.0]", 18, "contact.pairs[3].coefficients", "finite"},
           {coefficients, "[]", 18, "contact.pairs[3].coefficients", "there are 0"},
           {"coefficients = [0.5, -1, 2.0]", "# ", 16, "contact.pairs[3].coefficients",
            "one for each of 3 dofs"},
           {"\"negative\"", "\"left\"", 19, "contact.pairs[3].side",
            "\"positive\", \"negative\" or \"both\""},
           {"\"exponential\"", "\"rigid\"", 20, "contact.pairs[3].law",
            "\"exponential\", \"linear\", \"bilinear\""},
           {"constant = 1e4", "#", 16, "contact.pairs[3].constant",
            "missing; expected a number in N, > 0, here or in [contact]"},
           {"constant = 1e4", "constant = 0", 21, "contact.pairs[3].constant", "> 0"},
           {"side = \"both\"", "exponent = 50", 14, "contact.pairs[2].exponent",
            "does not belong to a pair with the law \"linear\""},
           {"side = \"both\"", "sides = \"both\"", 14, "contact.pairs[2].sides",
            "did you mean contact.pairs[2].side?"},
           {"gap = 5e-5", "gap = \"big\"", 15, "contact.pairs[2].gap", "a number in m"},
           {"gap = 2e-5", "gap = [2e-5, 1e-5]", 9, "contact.gap",
            "may have its own gap; expected one number"},
           {"modal_damping = 0.1 ", "contact_dofs = [1] ", 5, "structure.contact_dofs",
            "[[contact.pairs]] too"}}) {
    SCOPED_TRACE(new_text);
    const auto details = error_of(with(pair_scene, old_text, new_text));
    EXPECT_EQ(details.line, line) << details.allowed;
    EXPECT_EQ(details.key, key) << details.allowed;
    EXPECT_NE(details.allowed.find(allowed), std::string::npos) << details.allowed;
  }
}

TEST_F(ContactPairs, BelongToMatricesAndToALaw) {
  const std::string bar = with(bar_scene, "[forcing]", "[[contact.pairs]]\ndofs = [1]\n[forcing]");
  const auto of_bar = error_of(bar);
  EXPECT_EQ(of_bar.key, "contact.pairs");
  EXPECT_NE(of_bar.allowed.find("only with structure.type = \"matrices\""), std::string::npos)
      << of_bar.allowed;
  for (const char* law : {"\"none\"", "\"rigid\""}) {
    std::string text =
        with(with(pair_scene, "\"linear\"                  # 7", law), "stiffness = 1e6", "# ");
    if (std::string(law) == "\"none\"") text = with(with(text, "gap = 2e-5", "# "), "gap = 5e-5", "# ");
    const auto error = error_of(text);
    EXPECT_EQ(error.key, "contact.pairs[3].law");
    EXPECT_EQ(error.line, 20);
  }
  const std::string one_table = with(chain_scene, "gap = 1e-4", "gap = 1e-4\npairs = [1, 2]\n#");
  EXPECT_NE(error_of(one_table).allowed.find("expected tables [[contact.pairs]]"), std::string::npos);
  std::string many;
  for (int i = 0; i < 2001; ++i) many += "[[contact.pairs]]\ndofs = [1]\n";
  const auto too_many = error_of(with(pair_scene, "[forcing]", many + "[forcing]"));
  EXPECT_NE(too_many.allowed.find("there are 2004; expected at most 2000"), std::string::npos);
  const auto none = error_of(with(chain_scene, "contact_dofs = [2, 3]", "# "));
  EXPECT_EQ(none.key, "structure.contact_dofs");
  EXPECT_NE(none.allowed.find("missing; expected a list of integers, or [[contact.pairs]]"),
            std::string::npos);
}

TEST_F(ContactPairs, AreDescribedAsContacts) {
  const std::string text = describe_scene(load(pair_scene));
  for (const char* part : {"linear and exponential laws at 4 contacts, gaps 2e-5 to 5e-5 m", "252 unknowns"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " is not in\n" << text;
  EXPECT_NE(describe_scene_keys().find("[[contact.pairs]]"), std::string::npos);
}

TEST_F(ContactPairs, OfSingleDegreesOfFreedomAreThoseOfTheShorthand) {
  const auto pairs = [](const std::string& text) {
    return with(
        with(text, "contact_dofs = [2, 3]", "# "), "[forcing]",
        "[[contact.pairs]]\ndofs = [2]\nside = \"negative\"\n[[contact.pairs]]\ndofs = [3]\n[forcing]");
  };
  const std::string shorthand = with(chain_scene, "[2, 3]", "[-2, 3]");
  const std::vector<std::string> damped{"forcing.frequency=35", "structure.modal_damping=0.1",
                                        "contact.gap=5e-5", "time.functions=63"};
  const Response expected = weighted_residual_response(load(shorthand, damped));
  const Response found = weighted_residual_response(load(pairs(chain_scene), damped));
  ASSERT_TRUE(found.converged && expected.converged);
  EXPECT_EQ(found.contacts.displacement, expected.contacts.displacement);
  const std::string rigid = with(with(shorthand, "\"linear\"", "\"rigid\""), "stiffness = 1e7", "# "),
                    undamped = with(rigid, "modal_damping = 0.01", "");
  const std::vector<std::string> mode{"analysis.type=nonlinear_mode"};
  const Table a = analyse(load(undamped, mode)).backbone,
              b = analyse(load(pairs(with(undamped, "[-2, 3]", "[2, 3]")), mode)).backbone;
  EXPECT_EQ(a.numbers("frequency_ratio").size(), b.numbers("frequency_ratio").size());
  EXPECT_EQ(a.texts("status"), b.texts("status"));
  for (std::size_t i = 0; i < a.rows(); ++i)
    if (a.texts("status")[i] == "converged") {
      EXPECT_EQ(a.numbers("energy_ratio")[i], b.numbers("energy_ratio")[i]);
    }
}

TEST_F(ContactPairs, MoveAsTimeSteppingSays) {
  const Response found = weighted_residual_response(load(pair_scene, {"time.functions=127"}));
  const Response reference =
      time_stepping_response(load(pair_scene, {"analysis.type=time_stepping", "analysis.tolerance=1e-8"}));
  ASSERT_TRUE(found.converged && reference.converged) << found.status;
  for (int contact = 0; contact < 4; ++contact) {
    const auto a = found.contacts.contact(contact), b = reference.contacts.contact(contact);
    EXPECT_LT(relative_rms_error(a.displacement.row(0), b.displacement.row(0)), 1e-4) << contact;
    EXPECT_GT(b.force.maxCoeff(), 0.0) << contact;
  }
}

// A reduction keeps the rows that pairs touch and the loaded ones: nothing is lost when all modes are kept.
TEST_F(ContactPairs, AreKeptByAReduction) {
  const std::string one = with(pair_scene, "dofs = [1, 2, 3]", "dofs = [2, 3]");
  const std::string two = with(with(one, "[0.5, -1, 2.0]", "[0.5, -1]"), "dofs = [3, 1]", "dofs = [3, 2]");
  const StructureModel whole = make_model(load(two)),
                       reduced = make_model(load(two, {"structure.kept_modes=1"}));
  EXPECT_EQ(make_model(load(two, {"structure.kept_modes=0"})).size(), 2);
  EXPECT_EQ(reduced.size(), 3);
  const Eigen::MatrixXd projected = whole.structure.contact_directions * reduced.recovery;
  EXPECT_LT((Eigen::MatrixXd(reduced.structure.contact_directions) - projected).norm(), 1e-15);
  const Response a = weighted_residual_response(load(two)),
                 b = weighted_residual_response(load(two, {"structure.kept_modes=1"}));
  ASSERT_TRUE(a.converged && b.converged);
  EXPECT_LT((a.contacts.displacement - b.contacts.displacement).norm(),
            1e-9 * a.contacts.displacement.norm());
  EXPECT_EQ(error_of(pair_scene, {"structure.kept_modes=0"}).key, "structure.kept_modes");
}

TEST_F(ContactPairs, AreSweptAndRecordedAsContacts) {
  const Record response = analyse(load(pair_scene));
  EXPECT_TRUE(response.converged);
  EXPECT_EQ(response.contacts.texts("contact").back(), "4");
  const Record sweep =
      analyse(load(pair_scene, {"analysis.type=frequency_sweep", "analysis.frequency_from=30",
                                "analysis.frequency_to=40", "analysis.stability=false"}));
  EXPECT_TRUE(sweep.converged) << sweep.status;
  EXPECT_GT(value_of<double>(sweep.summary, "max_contact_force_N"), 1.0);
}

}  // namespace
