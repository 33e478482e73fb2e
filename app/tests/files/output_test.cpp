#include "wavebalance/app/files/output.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "temporary_folder.hpp"

namespace {

using namespace wavebalance::app;
namespace fs = std::filesystem;

TEST(OutputFiles, AppearTogetherOnCommit) {
  const TemporaryFolder folder;
  OutputFiles files(folder / "out");
  files.add("a.csv", "1\n");
  files.add("b with 'quotes'.csv", "2\n");
  EXPECT_FALSE(fs::exists(folder / "out" / "a.csv"));
  files.commit();
  EXPECT_EQ(read_file(folder / "out" / "a.csv"), "1\n");
  EXPECT_EQ(read_file(folder / "out" / "b with 'quotes'.csv"), "2\n");
  EXPECT_EQ(TemporaryFolder::count(folder / "out"), 2);
}

TEST(OutputFiles, NameThatIsNoPlainFileNameIsRefused) {
  const TemporaryFolder folder;
  OutputFiles files(folder.path());
  for (const char* name : {"", ".", "..", "a/b", "/etc/passwd"})
    EXPECT_THROW(files.add(name, "x"), std::invalid_argument) << name;
  EXPECT_THROW(files.replace({"../foreign.csv"}), std::invalid_argument);
}

}  // namespace
