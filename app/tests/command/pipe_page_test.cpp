// The page of a pipe on supports, whose commands are run as they stand there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "temporary_folder.hpp"
#include "wavebalance/app/files/output.hpp"
#include "wavebalance/app/files/table.hpp"

namespace {

using namespace wavebalance::app;
namespace fs = std::filesystem;

/// What stands between ```sh and ``` on a page.
std::string commands_of(const std::string& page) {
  const std::string open = "```sh\n";
  const std::size_t begin = page.find(open) + open.size();
  return page.substr(begin, page.find("```", begin) - begin);
}

TEST(PipePage, HasCommandsThatRun) {
  if (std::system("command -v ccx > /dev/null 2>&1") != 0) GTEST_SKIP() << "CalculiX is not installed";
  const TemporaryFolder folder;
  const fs::path page = fs::path(WAVEBALANCE_SCENES) / "matrices" / "pipe";
  for (const char* name : {"pipe.inp", "rubbing.toml"}) fs::copy_file(page / name, folder / name);
  // Its curve is followed without stability, which takes most of the time; that of rubbing.toml has it.
  folder.write("pipe.toml", read_file(page / "pipe.toml") + "stability = false\n");
  folder.write("commands.sh", commands_of(read_file(page / "README.md")));
  const std::string path = fs::path(WAVEBALANCE_COMMAND).parent_path().string();
  const std::string line =
      "cd '" + folder.path().string() + "' && PATH='" + path + "':$PATH sh -e commands.sh > log 2>&1";
  ASSERT_EQ(std::system(line.c_str()), 0) << read_file(folder / "log");
  const std::string log = read_file(folder / "log");
  for (const char* words :
       {"2 of 3 contacts are closed under the static loads", "707.01 N in all", "48.31 N", "217 N"})
    EXPECT_NE(log.find(words), std::string::npos) << words << " is not in\n" << log;
  EXPECT_TRUE(read_csv(folder / "curve" / "sweep.csv").has_column("node_19_z_1_half_peak_to_peak_m"));
  EXPECT_TRUE(fs::exists(folder / "at_20" / "input_pipe.mas"));
  const std::vector<double> rubs =
      read_csv(folder / "rubbing" / "sweep.csv").numbers("node_19_y_1_half_peak_to_peak_m");
  EXPECT_NEAR(*std::max_element(rubs.begin(), rubs.end()), 0.79e-3, 0.01e-3);
}

}  // namespace
