#include "wavebalance/app/compose/scene_loader.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "support/scene_error.hpp"
#include "support/scene_texts.hpp"
#include "temporary_folder.hpp"
#include "wavebalance/app/scene/scene_keys.hpp"

namespace {

using namespace wavebalance::app;

TEST(SceneLoader, ReadsEveryValue) {
  const Scene scene = parse_scene(bar_scene, "case.toml");
  EXPECT_EQ(scene.structure.youngs_modulus, 70e9);
  EXPECT_EQ(scene.structure.density, 2700.0);
  EXPECT_EQ(scene.structure.elements, 25);
  EXPECT_EQ(scene.contact.law, "exponential");
  EXPECT_EQ(scene.contact.number("exponent"), 50.0);
  EXPECT_EQ(scene.contact.gap, 1e-3);
  EXPECT_EQ(scene.forcing.frequency, 150.0);
  EXPECT_EQ(scene.time.trial, "fourier");
  EXPECT_EQ(scene.time.quadrature_points, 256);
  EXPECT_EQ(scene.analysis.type, AnalysisType::forced_response);
}

TEST(SceneLoader, FillsInDefaults) {
  const Scene scene = parse_scene(with(bar_scene, "quadrature_points = 256", ""), "case.toml");
  EXPECT_EQ(scene.time.quadrature_points, 4 * 64);
  EXPECT_EQ(scene.time.formulation, Formulation::distributional);
  EXPECT_EQ(scene.time.inner_products, InnerProducts::quadrature);
  EXPECT_EQ(scene.structure.lumped_mass_fraction, 0.0);
  EXPECT_EQ(scene.analysis.output_points, 1024);
}

TEST(SceneLoader, SceneWithoutContactSectionHasNoContact) {
  const auto begin = bar_scene.find("[contact]");
  std::string text = bar_scene;
  text.erase(begin, bar_scene.find("[forcing]") - begin);
  EXPECT_EQ(parse_scene(text, "case.toml").contact.law, "none");
}

TEST(SceneLoader, MessageHoldsFileLineKeyValueAndWhatIsAllowed) {
  EXPECT_EQ(message_of(with(bar_scene, "gap = 1e-3", "gap = \"big\"")),
            "case.toml:13: contact.gap = \"big\": expected a number in m");
}

TEST(SceneLoader, ToleranceStandsInPlaceOfPairFunctionsAndPoints) {
  const Scene scene = parse_scene(tolerance_scene("1e-4"), "case.toml");
  EXPECT_EQ(scene.time.tolerance, 1e-4);
  EXPECT_EQ(scene.time.trial + scene.time.weight, "");
  EXPECT_EQ(scene.time.functions + scene.time.quadrature_points, 0);
  EXPECT_EQ(parse_scene(write_scene(scene), "written"), scene);
  EXPECT_EQ(write_scene(parse_scene(bar_scene, "case.toml")).find("tolerance"), std::string::npos);
}

TEST(SceneLoader, ToleranceMayStandBesideAPair) {
  const Scene scene =
      parse_scene(tolerance_scene("1e-4\ntrial = \"haar\"\nweight = \"fourier\""), "case.toml");
  EXPECT_EQ(scene.time.trial, "haar");
  EXPECT_EQ(parse_scene(write_scene(scene), "written"), scene);
}

TEST(SceneLoader, ToleranceBesideWhatItChoosesIsAnError) {
  expect_error(tolerance_scene("1e-4\nfunctions = 64"), 19, "time.functions", "64",
               "not beside time.tolerance");
  expect_error(tolerance_scene("1e-4\nquadrature_points = 64"), 19, "time.quadrature_points", "64",
               "not beside time.tolerance");
  expect_error(tolerance_scene("1e-4\ntrial = \"haar\""), 19, "time.trial", "\"haar\"",
               "both time.trial and time.weight");
  expect_error(tolerance_scene("1e-4\ntrial = \"haar\"\nweight = \"haar\""), 19, "time.trial", "\"haar\"",
               "not an admissible");
  expect_error(tolerance_scene("2.0"), 18, "time.tolerance", "2.0", "out of range");
  expect_error(tolerance_scene("0.0"), 17, "time.trial", "", "missing");
}

TEST(SceneLoader, ToleranceIsForForcedResponses) {
  const std::string stepping = with(tolerance_scene("1e-4"), "forced_response", "time_stepping");
  expect_error(stepping, 18, "time.tolerance", "1e-4", "only with analysis.type = \"forced_response\"");
}

TEST(SceneLoader, SampleOffsetIsALeftEndOrAMiddle) {
  const auto at = [](const std::string& offset) {
    return parse_scene(with(bar_scene, "[time]", "[time]\nsample_offset = " + offset), "case.toml");
  };
  EXPECT_EQ(parse_scene(bar_scene, "case.toml").time.sample_offset, 0.0);
  EXPECT_EQ(at("0").time.sample_offset, 0.0);
  EXPECT_EQ(at("0.5").time.sample_offset, 0.5);
  EXPECT_EQ(parse_scene(write_scene(at("0.5")), "written"), at("0.5"));
  for (const std::string value : {"0.25", "1", "-0.5"})
    EXPECT_NE(message_of(bar_scene, {"time.sample_offset=" + value}).find("expected 0 or 0.5"),
              std::string::npos)
        << value;
}

TEST(SceneLoader, SampleOffsetIsRefusedWhereItHasNoMeaning) {
  EXPECT_NE(message_of(tolerance_scene("1e-4"), {"time.sample_offset=0.5"})
                .find("time.sample_offset = 0.5: not beside time.tolerance"),
            std::string::npos);
  for (const std::string type : {"time_stepping", "nonlinear_mode"})
    EXPECT_NE(message_of(bar_scene, {"time.sample_offset=0.5", "analysis.type=" + type})
                  .find("time.sample_offset = 0.5: does not belong to a scene with analysis.type"),
              std::string::npos)
        << type;
}

TEST(SceneLoader, MiddlesAtWhichTheNyquistCoefficientVanishesRefuseToKeepIt) {
  const std::vector<std::string> as_many{"time.quadrature_points=64", "time.sample_offset=0.5"};
  EXPECT_EQ(parse_scene(bar_scene, "case.toml", as_many).time.nyquist, NyquistCoefficient::drop);
  auto kept = as_many;
  kept.emplace_back("time.nyquist=keep");
  EXPECT_NE(message_of(bar_scene, kept).find("vanishes at the middles of 64 intervals"), std::string::npos);
  kept.emplace_back("time.inner_products=exact");
  EXPECT_EQ(parse_scene(bar_scene, "case.toml", kept).time.sample_offset, 0.5);
}

TEST(SceneLoader, WrongTypesAreErrors) {
  expect_error(with(bar_scene, "area = 25e-4", "area = true"), 5, "structure.area", "true",
               "a number in m^2, > 0");
  expect_error(with(bar_scene, "elements = 25", "elements = 25.0"), 7, "structure.elements", "25.0",
               "an integer");
  expect_error(with(bar_scene, "law = \"exponential\"", "law = 3"), 10, "contact.law", "3",
               "\"exponential\"");
  expect_error(with(bar_scene, "length = 1.0", "length = [1.0]"), 6, "structure.length", "[ 1.0 ]",
               "a number in m");
  expect_error(with(bar_scene, "length = 1.0", "length = 2020-01-01"), 6, "structure.length", "2020-01-01",
               "a number");
}

TEST(SceneLoader, NumbersOutOfRangeAreErrors) {
  expect_error(with(bar_scene, "density = 2700", "density = -1"), 4, "structure.density", "-1", "> 0");
  expect_error(with(bar_scene, "density = 2700", "density = 0.0"), 4, "structure.density", "0.0", "> 0");
  expect_error(with(bar_scene, "elements = 25", "elements = 0"), 7, "structure.elements", "0", "in 1..");
  expect_error(with(bar_scene, "functions = 64", "functions = 99999999999"), 20, "time.functions",
               "99999999999", "in 1..");
  expect_error(with(bar_scene, "stiffness_damping = 1e-4", "lumped_mass_fraction = 1.5"), 8,
               "structure.lumped_mass_fraction", "1.5", "in 0..1");
}

TEST(SceneLoader, NumbersThatAreNotFiniteAreErrors) {
  expect_error(with(bar_scene, "gap = 1e-3", "gap = nan"), 13, "contact.gap", "nan", "finite");
  expect_error(with(bar_scene, "amplitude = 250e3", "amplitude = -inf"), 15, "forcing.amplitude", "-inf",
               "finite");
}

TEST(SceneLoader, UnknownKeysAreErrorsWithASuggestion) {
  expect_error(with(bar_scene, "gap = 1e-3", "gpa = 1e-3"), 13, "contact.gpa", "0.001",
               "did you mean contact.gap?");
  expect_error(with(bar_scene, "youngs_modulus", "young_modulus"), 3, "structure.young_modulus", "7e10",
               "did you mean structure.youngs_modulus?");
  expect_error(with(bar_scene, "gap = 1e-3", "wall_thickness = 1"), 13, "contact.wall_thickness", "1",
               "known are law, constant, exponent, stiffness, ");
  expect_error(with(bar_scene, "[forcing]", "[forcings]"), 14, "[forcings]", "", "did you mean [forcing]?");
  expect_error("gap = 1\n" + bar_scene, 1, "gap", "1", "outside of any section");
  expect_error("contact = 1\n", 1, "contact", "1", "a section [contact]");
  expect_error(bar_scene + "[extra]\n", 24, "[extra]", "", "unknown section");
}

TEST(SceneLoader, UnknownChoicesAreErrorsWithASuggestion) {
  expect_error(with(bar_scene, "trial = \"fourier\"", "trial = \"fourrier\""), 18, "time.trial",
               "\"fourrier\"", "did you mean \"fourier\"?");
  expect_error(with(bar_scene, "trial = \"fourier\"", "trial = \"daubechies7\""), 18, "time.trial",
               "\"daubechies7\"", "\"daubechiesN\" with an even N in 2..40");
}

TEST(SceneLoader, MissingKeysAreErrorsAtTheirSection) {
  expect_error(with(bar_scene, "amplitude = 250e3", ""), 14, "forcing.amplitude", "",
               "missing; expected a number in N");
  expect_error(with(bar_scene, "exponent = 50.0", ""), 9, "contact.exponent", "", "missing");
  expect_error(with(bar_scene, "frequency = 150.0", ""), 14, "forcing.frequency", "", "missing");
  expect_error(with(bar_scene, "functions = 64", ""), 17, "time.functions", "", "missing");
  expect_error("", 0, "structure.type", "", "in a section [structure]");
}

TEST(SceneLoader, KeysOfAnotherLawOrAnalysisAreErrors) {
  expect_error(with(bar_scene, "exponent = 50.0", "exponent = 50.0\nstiffness = 1e8"), 13,
               "contact.stiffness", "1e8", "only with contact.law = \"linear\"");
  expect_error(with(bar_scene, "law = \"exponential\"", "law = \"none\""), 11, "contact.constant", "1e8",
               "only with contact.law = \"exponential\"");
  expect_error(bar_scene + "max_periods = 10\n", 24, "analysis.max_periods", "10",
               "only with analysis.type = \"time_stepping\"");
}

TEST(SceneLoader, WaveletsNeedPowersOfTwo) {
  const std::string haar = with(bar_scene, "trial = \"fourier\"", "trial = \"haar\"");
  EXPECT_NO_THROW(parse_scene(haar, "case.toml"));
  expect_error(with(haar, "functions = 64", "functions = 48"), 20, "time.functions", "48", "power of two");
  expect_error(with(haar, "quadrature_points = 256", "quadrature_points = 100"), 21, "time.quadrature_points",
               "100", "power of two");
  expect_error(haar + "output_points = 1000\n", 24, "analysis.output_points", "1000", "power of two");
  EXPECT_NO_THROW(
      parse_scene(with(with(bar_scene, "functions = 64", "functions = 63"), "= 256", "= 100"), "case.toml"));
}

TEST(SceneLoader, FewerQuadraturePointsThanFunctionsAreAnError) {
  expect_error(with(bar_scene, "quadrature_points = 256", "quadrature_points = 63"), 21,
               "time.quadrature_points", "63", "functions = 64");
}

TEST(SceneLoader, InadmissiblePairsAreErrors) {
  const std::string haar = with(bar_scene, "trial = \"fourier\"", "trial = \"haar\"");
  for (const std::string weight : {"haar", "daubechies6"})
    expect_error(with(haar, "weight = \"fourier\"", "weight = \"" + weight + "\""), 18, "time.trial",
                 "\"haar\"", "not an admissible trial basis");
  EXPECT_NO_THROW(parse_scene(with(haar, "weight = \"fourier\"", "weight = \"bspline\""), "case.toml"));
}

TEST(SceneLoader, SweepsNeedAnInterval) {
  const std::string sweep = with(bar_scene, "\"forced_response\"        # 23",
                                 "\"frequency_sweep\"\nfrequency_from = 1100\nfrequency_to = 1700");
  const Scene scene = parse_scene(sweep, "case.toml");
  EXPECT_EQ(scene.analysis.first_step, 0.6);
  EXPECT_EQ(scene.analysis.largest_step, 7.5);
  expect_error(with(sweep, "_to = 1700", "_to = 1100"), 25, "analysis.frequency_to", "1100",
               "another frequency");
  expect_error(with(sweep, "frequency_to = 1700", ""), 22, "analysis.frequency_to", "", "missing");
  expect_error(sweep + "first_step = 8\n", 26, "analysis.first_step", "8", "largest_step = 7.5");
}

TEST(SceneLoader, TimeSteppingNeedsNoBases) {
  const auto begin = bar_scene.find("[time]");
  std::string text = with(bar_scene, "forced_response", "time_stepping");
  text.erase(begin, text.find("[analysis]") - begin);
  EXPECT_EQ(parse_scene(text, "case.toml").analysis.tolerance, 1e-7);
  expect_error(with(text, "elements = 25", "elements = 5000"), 7, "structure.elements", "5000",
               "at most 2000");
}

TEST(SceneLoader, NonlinearModesNeedNeitherForcingNorBases) {
  const Scene scene = parse_scene(rod_scene, "rod.toml");
  EXPECT_EQ(scene.analysis.type, AnalysisType::nonlinear_mode);
  EXPECT_EQ(scene.analysis.samples, 20);
  EXPECT_FALSE(scene.analysis.cosine_only);
  EXPECT_EQ(scene.analysis.energy_ratio, 0.0);
  EXPECT_EQ(parse_scene(write_scene(scene), "written"), scene);
}

TEST(SceneLoader, NonlinearModesHaveContactAndNoDamping) {
  expect_error(
      with(with(rod_scene, "law = \"rigid\"                   # 10", "law = \"none\""), "gap = 1e-3", "#"),
      10, "contact.law", "\"none\"", "\"exponential\"");
  expect_error(with(rod_scene, "gap = 1e-3", "gap = 0.0"), 11, "contact.gap", "0.0", "> 0");
  expect_error(with(rod_scene, "# 8", "\nstiffness_damping = 1e-6"), 9, "structure.stiffness_damping", "1e-6",
               "expected 0");
  expect_error(with(rod_scene, "points = 200 ", "mode = 21 "), 14, "analysis.mode", "21", "at most");
  expect_error(with(rod_scene, "points = 200 ", "samples = 19 "), 14, "analysis.samples", "19", "= 20");
  expect_error(with(rod_scene, "points = 200 ", "cosine_only = 1 "), 14, "analysis.cosine_only", "1",
               "true or false");
  expect_error(with(rod_scene, "points = 200 ", "tolerance = 1e-3 "), 14, "analysis.tolerance", "0.001",
               "time_stepping");
}

TEST(SceneLoader, RigidContactTakesAGapAlone) {
  const std::string rigid =
      with(with(with(bar_scene, "\"exponential\"", "\"rigid\""), "constant = 1e8  ", "# "), "exponent", "#");
  const Scene scene = parse_scene(rigid, "case.toml");
  EXPECT_EQ(scene.contact.law, "rigid");
  EXPECT_EQ(parse_scene(write_scene(scene), "written"), scene);
  expect_error(with(bar_scene, "\"exponential\"", "\"rigid\""), 11, "contact.constant", "1e8",
               "contact.law = \"exponential\"");
  const auto stepping = error_of(rigid, {"analysis.type=time_stepping"});
  EXPECT_EQ(stepping.key, "contact.law");
  EXPECT_NE(stepping.allowed.find("law of impact"), std::string::npos) << stepping.allowed;
  EXPECT_EQ(error_of(rigid, {"structure.massless_tip=true", "structure.elements=1"}).key,
            "structure.elements");
  EXPECT_EQ(error_of(bar_scene, {"structure.massless_tip=true", "analysis.type=time_stepping"}).key,
            "structure.massless_tip");
}

TEST(SceneLoader, SyntaxErrorsCarryTheirLine) {
  const auto details = error_of(with(bar_scene, "gap = 1e-3", "gap = "));
  EXPECT_EQ(details.line, 13);
  EXPECT_NE(details.allowed.find("not valid TOML"), std::string::npos);
  EXPECT_NE(message_of("a = 1\na = 2\n").find("case.toml:2"), std::string::npos);
}

TEST(SceneLoader, OverridesAreAppliedBeforeChecks) {
  const std::vector<std::string> overrides{"contact.gap=2e-3", "time.trial=haar", "time.weight=\"fourier\"",
                                           "time.functions=32", "contact.gap=3e-3"};
  const Scene scene = parse_scene(bar_scene, "case.toml", overrides);
  EXPECT_EQ(scene.contact.gap, 3e-3);
  EXPECT_EQ(scene.time.trial, "haar");
  EXPECT_EQ(scene.time.functions, 32);
  EXPECT_NO_THROW(parse_scene(with(bar_scene, "gap = 1e-3", "gap = \"big\""), "x", {{"contact.gap=1"}}));
}

TEST(SceneLoader, ErrorsOfOverridesNameTheOverride) {
  EXPECT_EQ(message_of(bar_scene, {"contact.gap=big"}),
            "--set contact.gap=big: contact.gap = \"big\": expected a number in m");
  EXPECT_NE(message_of(bar_scene, {"contact.gab=1"}).find("did you mean contact.gap?"), std::string::npos);
  EXPECT_EQ(message_of(bar_scene, {"gap"}), "--set gap: expected section.key=value, as in contact.gap=2e-3");
  EXPECT_NE(message_of(bar_scene, {".gap=1"}).find("expected section.key=value"), std::string::npos);
  EXPECT_NE(message_of(bar_scene, {"contact.=1"}).find("expected section.key=value"), std::string::npos);
  EXPECT_NE(message_of(bar_scene, {"contact.gap="}).find("contact.gap = \"\""), std::string::npos);
}

TEST(SceneLoader, OverrideCannotSmuggleInASecondKey) {
  EXPECT_NE(message_of(bar_scene, {"contact.gap=1\nother=2"}).find("expected a number in m"),
            std::string::npos);
}

TEST(SceneLoader, UnreadableFilesAreErrors) {
  const TemporaryFolder folder;
  EXPECT_THROW(load_scene(folder / "missing.toml"), SceneError);
  EXPECT_THROW(load_scene(folder.path()), SceneError);
  try {
    load_scene(folder / "missing.toml");
  } catch (const SceneError& error) {
    EXPECT_NE(std::string(error.what()).find("missing.toml: cannot be read: No such file"),
              std::string::npos);
  }
}

TEST(SceneLoader, LoadsAFileWhoseNameHoldsSpacesAndQuotes) {
  const TemporaryFolder folder;
  EXPECT_EQ(load_scene(folder.write("a 'scene'\".toml", bar_scene)), parse_scene(bar_scene, "x"));
}

TEST(CompleteScene, FillsInDerivedDefaultsAndChecks) {
  Scene scene = parse_scene(bar_scene, "x");
  scene.time.quadrature_points = 0;
  EXPECT_EQ(complete_scene(scene).time.quadrature_points, 256);
  scene.time.functions = -1;
  EXPECT_THROW(complete_scene(scene), SceneError);
}

TEST(SceneKeys, EveryKeyIsDescribed) {
  const std::string text = describe_scene_keys();
  for (const SceneKey& key : scene_keys()) {
    EXPECT_FALSE(key.help.empty()) << key.full_name();
    EXPECT_NE(text.find("  " + std::string(key.name) + "\n"), std::string::npos) << key.full_name();
    EXPECT_EQ(find_scene_key(key.full_name()), &key);
  }
  EXPECT_EQ(find_scene_key("contact.nothing"), nullptr);
}

TEST(SceneKeys, LinesKeepToTheWidth) {
  std::istringstream lines(describe_scene_keys(80));
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80u) << line;
}

std::string outcome_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    parse_scene(text, "case.toml", overrides);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "no error";
}

std::string dotted(int parts) {
  std::string key = "a";
  for (int i = 1; i < parts; ++i) key += ".a";
  return key;
}

TEST(LoadScene, KeysOfManyPartsAreRefusedWithTheirLine) {
  const std::string expected = "a key has more than 8 parts between dots; expected section.key or [section]";
  for (const int parts : {9, 100000, 400000}) {
    EXPECT_EQ(outcome_of(bar_scene + dotted(parts) + " = 1\n"), "case.toml:24: " + expected);
    EXPECT_EQ(outcome_of(bar_scene + "[" + dotted(parts) + "]\n"), "case.toml:24: " + expected);
    EXPECT_NE(outcome_of(bar_scene, {"time.trial={" + dotted(parts) + " = 1}"}).find(expected),
              std::string::npos);
  }
  EXPECT_EQ(outcome_of(bar_scene + dotted(8) + " = 1\n").find(expected), std::string::npos);
}

TEST(LoadScene, DotsInTextCommentsAndNumbersAreNoKeys) {
  const std::string dots(1000, '.');
  EXPECT_EQ(outcome_of(bar_scene + "# " + dots + "\n"), "no error");
  for (const std::string& text : {"'" + dots + "'", "\"\\\"" + dots + "\"", "\"\"\"\n" + dots + "\n\"\"\"",
                                  std::string("[1.5, 2.5, 3.5, 4.5, 5.5, 6.5, 7.5, 8.5, 9.5, 1.5]")})
    EXPECT_NE(
        outcome_of(with(bar_scene, "\"fourier\"               # 18", text)).find("case.toml:18: time.trial"),
        std::string::npos)
        << outcome_of(with(bar_scene, "\"fourier\"               # 18", text));
}

TEST(LoadScene, DevicesPipesAndLargeFilesAreRefusedByName) {
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo((folder / "pipe.toml").c_str(), 0600), 0);
  const auto error = [](const std::filesystem::path& file) -> std::string {
    try {
      load_scene(file);
    } catch (const SceneError& failure) {
      return failure.what();
    }
    return "no error";
  };
  EXPECT_EQ(error("/dev/zero"), "/dev/zero: cannot be read: it is not a regular file");
  EXPECT_EQ(error(folder / "pipe.toml"),
            (folder / "pipe.toml").string() + ": cannot be read: it is not a regular file");
  EXPECT_NE(error(folder.write("large.toml", std::string(2'000'000, '\n'))).find("more than 1048576 bytes"),
            std::string::npos);
}

}  // namespace
