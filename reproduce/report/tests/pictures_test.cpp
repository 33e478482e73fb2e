// SVG pictures as chromium draws them, measured in px. The thresholds are rules of legibility and were fixed
// before any picture was measured.
#include <gtest/gtest.h>

#include <algorithm>

#include "chromium.hpp"
#include "temporary_folder.hpp"

namespace wavebalance::report {
namespace {

using Path = std::filesystem::path;
using Json = nlohmann::json;

/// Axes are at least as wide and as high as this share of the column and the row in which they stand.
constexpr double least_share = 0.5;

class Pictures : public NeedsChromium {};

/// Of `make reproduce`; CTest says by its name that they were skipped.
class PicturesOfResults : public NeedsChromium {};

std::vector<Path> pictures_below(const Path& folder) {
  std::vector<Path> found;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".svg") found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  return found;
}

/// How many different places there are, of which those within `near` px are one.
int places(const Json& areas, const char* edge, double near) {
  std::vector<double> values;
  for (const Json& area : areas) values.push_back(area[edge]);
  std::sort(values.begin(), values.end());
  int count = 0;
  for (std::size_t i = 0; i < values.size(); ++i) count += i == 0 || values[i] > values[i - 1] + near ? 1 : 0;
  return count;
}

void expect_wide_axes(const Json& picture) {
  const Json& areas = picture["areas"];
  if (areas.empty()) return;  // a sketch or bodies in space
  const double column = picture["width"].get<double>() / places(areas, "left", 40.0),
               row = picture["height"].get<double>() / places(areas, "bottom", 40.0);
  for (const Json& area : areas) {
    EXPECT_GE(area["right"].get<double>() - area["left"].get<double>(), least_share * column)
        << picture["page"];
    EXPECT_GE(area["bottom"].get<double>() - area["top"].get<double>(), least_share * row) << picture["page"];
  }
}

/// No two texts of a picture lie on each other, none is cut by its edge, and no curve or symbol passes
/// through a name of the legend.
void expect_legible(const std::vector<Path>& pictures) {
  const TemporaryFolder folder;
  std::string log;
  const Json found = found_by(WAVEBALANCE_PICTURES, pictures, folder.path(), log);
  ASSERT_EQ(found.size(), pictures.size()) << found.back();
  for (const Json& picture : found) {
    ASSERT_FALSE(picture.contains("error")) << picture["error"];
    EXPECT_GT(picture["texts"].get<int>(), 0) << picture["page"];
    expect_wide_axes(picture);
    EXPECT_EQ(picture["overlapping"], Json::array()) << picture["page"];
    EXPECT_EQ(picture["cut"], Json::array()) << picture["page"];
    EXPECT_EQ(picture["covered"], Json::array()) << picture["page"];
    EXPECT_EQ(picture["unlabelled"], 0) << picture["page"];
  }
}

/// Runs the command; some of the runs may end without convergence, whose pictures are measured, too.
void run(const std::string& arguments) {
  const int status =
      std::system(("'" WAVEBALANCE_COMMAND "' " + arguments + " --quiet > /dev/null 2>&1").c_str());
  const int code = WEXITSTATUS(status);
  ASSERT_TRUE(code == 0 || code == 3) << arguments << " ended with status " << code;
}

TEST_F(Pictures, OfEachKindOfAnalysisAreLegible) {
  const TemporaryFolder folder;
  const std::string scenes = "'" WAVEBALANCE_SCENES "/", here = folder.path().string() + "/";
  const auto into = [&](const std::string& name) { return " --output '" + here + name + "'"; };
  run("run " + scenes + "jones_legrand_2014/case1.toml'" + into("response"));
  run("run " + scenes + "jones_legrand_2014/case1.toml' --set forcing.amplitude=1" +
      into("far_from_the_gap"));
  run("run " + scenes + "jones_legrand_2014/case2_sweep.toml' --set analysis.stability=true" + into("sweep"));
  run("run " + scenes + "cases_of_others/small_gap_bar.toml'" + into("branches"));
  run("run " + scenes + "laxalde_legrand_2010/rod.toml'" + into("mode"));
  run("run " + scenes + "matrices/strip_mode.toml'" + into("stable_mode"));
  run("overlay '" + here + "sweep' '" + here + "branches'" + into("overlay"));
  const std::string pairs = " --budget 2 --pairs fourier:fourier,haar:fourier,daubechies6:daubechies6";
  run("compare " + scenes + "jones_legrand_2014/case1.toml'" + pairs + into("comparison"));
  run("compare " + scenes + "jones_legrand_2014/case2_sweep.toml'" + pairs + into("comparison_of_sweeps"));
  const std::string study = "scene = \"" WAVEBALANCE_SCENES
                            "/jones_legrand_2014/case1.toml\"\n"
                            "set = [\"time.functions=15\"]\nquantity = \"max_displacement_m\"\n";
  const auto over = [](const std::string& key, const std::string& range) {
    return "[[parameters]]\nkey = \"" + key + "\"\n" + range + "\n";
  };
  const std::string frequency = over("forcing.frequency", "from = 100.0\nto = 200.0\ncount = 11"),
                    gap = over("contact.gap", "from = 1e-4\nto = 1e-2\ncount = 5\nspacing = \"logarithmic\""),
                    constant = over("contact.constant", "values = [1e7, 3e7, 1e8, 3e8]"),
                    decades = over("contact.constant", "from = 1e7\nto = 4e8\nspacing = \"logarithmic\"");
  app::write_file(folder / "map.toml", study + frequency + gap);
  app::write_file(folder / "curves.toml", study + frequency + constant);
  app::write_file(folder / "samples.toml", study + "sampling = \"sobol\"\nsamples = 16\n" +
                                               over("forcing.frequency", "from = 100.0\nto = 200.0") +
                                               decades);
  for (const char* name : {"map", "curves", "samples"})
    run("study '" + here + name + ".toml'" + into(std::string("study_") + name));
  const auto pictures = pictures_below(folder.path());
  EXPECT_GE(pictures.size(), 13u);
  expect_legible(pictures);
}

TEST_F(PicturesOfResults, AreLegible) {
  const Path results = WAVEBALANCE_RESULTS;
  if (!std::filesystem::exists(results / "index.html")) GTEST_SKIP() << "make reproduce has not been run";
  const auto pictures = pictures_below(results);
  for (const Path& picture : pictures)
    if (std::filesystem::last_write_time(picture) < std::filesystem::last_write_time(WAVEBALANCE_LIBRARY))
      GTEST_SKIP() << picture << " is of an earlier build: make reproduce";
  expect_legible(pictures);
}

}  // namespace
}  // namespace wavebalance::report
