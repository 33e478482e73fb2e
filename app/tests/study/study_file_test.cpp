#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "study/samples.hpp"
#include "support/bar_scene.hpp"
#include "support/scene_texts.hpp"
#include "temporary_folder.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"
#include "wavebalance/app/study/study.hpp"

namespace {

using namespace wavebalance::app;

Study study_of(const std::string& text) { return parse_study(text, "study.toml", bar_scene); }

TEST(StudyFile, GridHasEveryCombinationAndTheLastParameterVariesFastest) {
  const Study study = study_of(R"(
    [[parameters]]
    key = "contact.gap"
    from = 1e-4
    to = 1e-2
    count = 3
    spacing = "logarithmic"
    [[parameters]]
    key = "time.functions"
    values = [15, 31]
  )");
  const StudyRuns runs(study);
  ASSERT_EQ(runs.size(), 6);
  EXPECT_EQ(runs.overrides(0), (std::vector<std::string>{"contact.gap=1e-4", "time.functions=15"}));
  EXPECT_EQ(runs.overrides(1), (std::vector<std::string>{"contact.gap=1e-4", "time.functions=31"}));
  EXPECT_EQ(runs.overrides(2).front(), "contact.gap=0.001");
  EXPECT_EQ(runs.overrides(5), (std::vector<std::string>{"contact.gap=0.01", "time.functions=31"}));
  EXPECT_EQ(std::get<double>(runs.cell(2, 0)), 1e-3);
  EXPECT_EQ(std::get<std::int64_t>(runs.cell(3, 1)), 31);
}

TEST(StudyFile, ListTakesTheValuesOfAllParametersTogether) {
  const Study study = study_of(R"(
    sampling = "list"
    [[parameters]]
    key = "time.trial"
    values = ["fourier", "bspline"]
    [[parameters]]
    key = "forcing.frequency"
    values = [120, 150.5]
  )");
  const StudyRuns runs(study);
  ASSERT_EQ(runs.size(), 2);
  EXPECT_EQ(runs.overrides(1),
            (std::vector<std::string>{"time.trial=\"bspline\"", "forcing.frequency=150.5"}));
  EXPECT_EQ(std::get<std::string>(runs.cell(0, 0)), "fourier");
}

TEST(StudyFile, RunsAreTheScenesThatTheCommandSolves) {
  const Study study = study_of(
      "set = [\"time.functions=15\"]\n[[parameters]]\nkey = \"contact.gap\"\nvalues = [2e-3, 3e-3]\n");
  const StudyRuns runs(study);
  const std::vector<std::string> overrides{"time.functions=15", "contact.gap=3e-3"};
  EXPECT_EQ(scene_of_run(study, runs, 1), parse_scene(bar_scene, "study.toml", overrides));
}

TEST(StudyFile, IntervalsOfWholeNumbersAreRounded) {
  const Study study = study_of("[[parameters]]\nkey = \"time.functions\"\nfrom = 15\nto = 30\ncount = 4\n");
  const StudyRuns runs(study);
  EXPECT_EQ(runs.value(1, 0), "20");
  EXPECT_EQ(runs.value(3, 0), "30");
}

TEST(StudyFile, LatinHypercubeHasOneRunInEachStratumAndDependsOnItsSeedAlone) {
  constexpr int size = 50;
  const std::vector<double> points = latin_hypercube_points(size, 3, 7);
  for (std::size_t j = 0; j < 3; ++j) {
    std::set<int> strata;
    for (std::size_t i = 0; i < size; ++i) strata.insert(static_cast<int>(points[3 * i + j] * size));
    EXPECT_EQ(strata.size(), std::size_t{size});
    EXPECT_EQ(*strata.rbegin(), size - 1);
  }
  EXPECT_EQ(points, latin_hypercube_points(size, 3, 7));
  EXPECT_NE(points, latin_hypercube_points(size, 3, 8));
}

// Each dyadic interval of length 2^-k holds 2^(m-k) of the 2^m - 1 points, the first one less, as 0 is left
// out.
TEST(StudyFile, SobolPointsFillDyadicIntervalsEvenly) {
  constexpr int size = 63, parts = 8;
  const std::vector<double> points = sobol_points(size, 5);
  for (std::size_t j = 0; j < 5; ++j) {
    std::vector<int> counts(parts);
    for (std::size_t i = 0; i < size; ++i) ++counts[static_cast<std::size_t>(points[5 * i + j] * parts)];
    EXPECT_EQ(counts.front(), size / parts);
    for (std::size_t k = 1; k < parts; ++k) EXPECT_EQ(counts[k], size / parts + 1);
  }
}

TEST(StudyFile, SamplesStayInTheirIntervalsAndTakeAllValues) {
  for (const char* sampling : {"sobol", "latin_hypercube"}) {
    const Study study = study_of(std::string("sampling = \"") + sampling + R"("
      samples = 64
      [[parameters]]
      key = "contact.gap"
      from = 1e-4
      to = 1e-2
      spacing = "logarithmic"
      [[parameters]]
      key = "time.trial"
      values = ["fourier", "bspline"]
    )");
    const StudyRuns runs(study);
    ASSERT_EQ(runs.size(), 64);
    std::multiset<std::string> trials;
    int below = 0;
    for (std::int64_t i = 0; i < runs.size(); ++i) {
      const double gap = std::get<double>(runs.cell(i, 0));
      EXPECT_GE(gap, 1e-4);
      EXPECT_LE(gap, 1e-2);
      below += gap < 1e-3 ? 1 : 0;
      trials.insert(runs.value(i, 1));
    }
    EXPECT_NEAR(below, 32, 1);  // half of the ratios
    EXPECT_NEAR(static_cast<double>(trials.count("\"fourier\"")), 32.0, 1.0);
  }
}

TEST(StudyFile, WrongKeysAndValuesNameLineKeyAndWhatIsAllowed) {
  struct Wrong {
    const char* text;
    const char* message;
  };
  const std::vector<Wrong> wrong{
      {"", "study.toml:1: parameters: expected tables [[parameters]]"},
      {"sampling = \"gird\"\n", "study.toml:1: sampling = \"gird\": expected one of \"grid\", \"list\""},
      {"[[parameters]]\nkey = \"contact.gab\"\nvalues = [1]\n",
       "study.toml:2: parameters[1].key = \"contact.gab\": no key of a scene; did you mean contact.gap?"},
      {"[[parameters]]\nkey = \"contact.gap\"\n", "study.toml:1: parameters[1].from: missing"},
      {"[[parameters]]\nkey = \"contact.gap\"\nfrom = 1\nto = 2\n", "parameters[1].count: missing"},
      {"[[parameters]]\nkey = \"contact.gap\"\nfrom = 0\nto = 2\ncount = 3\nspacing = \"logarithmic\"\n",
       "expected from and to of one sign"},
      {"[[parameters]]\nkey = \"contact.gap\"\nvalue = [1]\nvalues = [1]\n",
       "study.toml:3: parameters[1].value = [ 1 ]: unknown key; did you mean values?"},
      {"[[parameters]]\nkey = \"contact.gap\"\nvalues = []\n", "expected a list of values of contact.gap"},
      {"sampling = \"sobol\"\n[[parameters]]\nkey = \"contact.gap\"\nfrom = 1\nto = 2\n", "samples: missing"},
      {"samples = 3\n[[parameters]]\nkey = \"contact.gap\"\nvalues = [1]\n", "samples = 3: has no meaning"},
      {"sampling = \"list\"\n[[parameters]]\nkey = \"contact.gap\"\nvalues = [1]\n[[parameters]]\n"
       "key = \"forcing.frequency\"\nvalues = [1, 2]\n",
       "1 values of contact.gap and 2 of forcing.frequency"},
      {"[[parameters]]\nkey = \"contact.gap\"\nvalues = [1]\n[[parameters]]\nkey = \"contact.gap\"\n"
       "values = [1]\n",
       "contact.gap is there twice"},
      {"[[parameters]]\nkey = \"contact.gap\"\nfrom = 1\nto = 2\ncount = 1000\n[[parameters]]\n"
       "key = \"forcing.frequency\"\nfrom = 1\nto = 2\ncount = 1001\n",
       "expected at most 1000000 runs"},
      {"a = [[parameters\n", "study.toml:1: not valid TOML"},
  };
  for (const Wrong& one : wrong) try {
      StudyRuns(study_of(one.text));
      ADD_FAILURE() << one.text;
    } catch (const SceneError& error) {
      EXPECT_NE(std::string(error.what()).find(one.message), std::string::npos) << error.what() << "\n"
                                                                                << one.message;
    }
}

TEST(StudyFile, AValueThatNoSceneMayHoldIsRefusedBeforeAnythingIsSolved) {
  const Study study = study_of("[[parameters]]\nkey = \"time.functions\"\nvalues = [15, -1]\n");
  EXPECT_THROW(check_study(study, StudyRuns(study)), SceneError);
}

TEST(StudyFile, NamesItsSceneRelativeToItself) {
  const TemporaryFolder folder;
  folder.write("bar.toml", bar_scene);
  const auto file = folder.write(
      "study.toml", "scene = \"bar.toml\"\n[[parameters]]\nkey = \"contact.gap\"\nvalues = [1e-3]\n");
  EXPECT_EQ(load_study(file).scene_text, bar_scene);
  EXPECT_THROW(load_study(folder / "none.toml"), SceneError);
}

TEST(StudyFile, ASceneInItsPlaceIsNamedAsOne) {
  const TemporaryFolder folder;
  try {
    load_study(folder.write("bar.toml", bar_scene));
    ADD_FAILURE() << "a scene was read as a study";
  } catch (const SceneError& error) {
    EXPECT_NE(std::string(error.what()).find("this is a scene, and a study names one"), std::string::npos)
        << error.what();
  }
}

}  // namespace
