#include "wavebalance/app/files/output.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>

#include "temporary_folder.hpp"

namespace {

using namespace wavebalance::app;
namespace fs = std::filesystem;

/// Makes writes fail half-way as on a full disk, by a limit on the size of files.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) {
    previous_handler_ = std::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &previous_);
    rlimit limit = previous_;
    limit.rlim_cur = bytes;
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() {
    ::setrlimit(RLIMIT_FSIZE, &previous_);
    std::signal(SIGXFSZ, previous_handler_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  rlimit previous_{};
  void (*previous_handler_)(int) = SIG_DFL;
};

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

TEST(OutputFiles, LeaveNothingWithoutCommit) {
  const TemporaryFolder folder;
  { OutputFiles(folder / "deep" / "down").add("a.csv", "1\n"); }
  EXPECT_EQ(TemporaryFolder::count(folder.path()), 0);
}

TEST(OutputFiles, KeepWhatWasThereWithoutCommit) {
  const TemporaryFolder folder;
  folder.write("a.csv", "old\n");
  { OutputFiles(folder.path()).add("a.csv", "new\n"); }
  EXPECT_EQ(read_file(folder / "a.csv"), "old\n");
  EXPECT_EQ(TemporaryFolder::count(folder.path()), 1);
}

TEST(OutputFiles, FolderAppearsWithTheFirstFile) {
  const TemporaryFolder folder;
  OutputFiles files(folder / "deep" / "down");
  EXPECT_EQ(TemporaryFolder::count(folder.path()), 0);
  files.add("a.csv", "1\n");
  files.commit();
  EXPECT_EQ(read_file(folder / "deep" / "down" / "a.csv"), "1\n");
}

TEST(OutputFiles, FilesOfTheEarlierRecordGoWithTheCommitAndOthersStay) {
  const TemporaryFolder folder;
  for (const char* name : {"kept.csv", "stale.csv", "foreign.csv"}) folder.write(name, "old\n");
  {
    OutputFiles files(folder.path());
    files.replace({"kept.csv", "stale.csv", "gone_already.csv"});
    files.add("kept.csv", "new\n");
    EXPECT_TRUE(fs::exists(folder / "stale.csv"));
  }
  EXPECT_TRUE(fs::exists(folder / "stale.csv")) << "nothing was committed";
  OutputFiles files(folder.path());
  files.replace({"kept.csv", "stale.csv", "gone_already.csv"});
  files.add("kept.csv", "new\n");
  files.commit();
  EXPECT_EQ(read_file(folder / "kept.csv"), "new\n");
  EXPECT_FALSE(fs::exists(folder / "stale.csv"));
  EXPECT_EQ(read_file(folder / "foreign.csv"), "old\n");
  EXPECT_THROW(files.replace({"../foreign.csv"}), std::invalid_argument);
}

TEST(OutputFiles, FolderUnderAFileIsAnError) {
  const TemporaryFolder folder;
  const fs::path file = folder.write("file", "");
  EXPECT_THROW(OutputFiles{file}, IoError);
  EXPECT_THROW(OutputFiles{file / "below"}, IoError);
  EXPECT_THROW(OutputFiles("/proc/wavebalance/out"), IoError);
  try {
    OutputFiles files("/proc/wavebalance/out");
  } catch (const IoError& error) {
    EXPECT_EQ(error.path(), "/proc/wavebalance/out");
    EXPECT_FALSE(error.reason().empty());
  }
}

TEST(OutputFiles, FullDiskIsAnErrorAndLeavesNothing) {
  const TemporaryFolder folder;
  {
    OutputFiles files(folder / "out");
    files.add("small.csv", "1\n");
    const FullDisk full(1000);
    EXPECT_THROW(files.add("large.csv", std::string(100'000, 'x')), IoError);
    EXPECT_EQ(TemporaryFolder::count(folder / "out"), 1) << "the temporary of the large file stays";
  }
  EXPECT_EQ(TemporaryFolder::count(folder.path()), 0);
}

TEST(OutputFiles, DeviceThatIsFullIsAnErrorBeforeWorkStarts) {
  const TemporaryFolder folder;
  const FullDisk full(1);
  EXPECT_THROW(OutputFiles(folder / "out"), IoError);
  EXPECT_EQ(TemporaryFolder::count(folder.path()), 0);
}

TEST(OutputFiles, NameThatIsNoPlainFileNameIsRefused) {
  const TemporaryFolder folder;
  OutputFiles files(folder.path());
  for (const char* name : {"", ".", "..", "a/b", "/etc/passwd"})
    EXPECT_THROW(files.add(name, "x"), std::invalid_argument) << name;
}

TEST(OutputFiles, FolderInPlaceOfAFileIsAnError) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "a.csv");
  OutputFiles files(folder.path());
  EXPECT_THROW(files.add("a.csv", "x"), IoError);
}

TEST(ReadFile, RefusesDevicesPipesAndFilesThatAreTooLarge) {
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  const auto reason = [](const fs::path& file, std::size_t max_bytes) -> std::string {
    try {
      read_file(file, max_bytes);
    } catch (const IoError& error) {
      return error.reason();
    }
    return "";
  };
  EXPECT_EQ(reason(folder / "pipe", 10), "cannot be read: it is not a regular file");
  EXPECT_EQ(reason("/dev/zero", 10), "cannot be read: it is not a regular file");
  EXPECT_EQ(reason(folder.path(), 10), "cannot be read: it is a folder");
  EXPECT_EQ(reason(folder.write("ten", "0123456789"), 10), "");
  EXPECT_EQ(reason(folder.write("eleven", "0123456789a"), 10), "cannot be read: it has more than 10 bytes");
}

TEST(WriteFile, ReplacesAFileAndKeepsLinksTargetsSafe) {
  const TemporaryFolder folder;
  folder.write("a.txt", "old");
  write_file(folder / "a.txt", "new");
  EXPECT_EQ(read_file(folder / "a.txt"), "new");
  EXPECT_THROW(read_file(folder / "b.txt"), IoError);
  EXPECT_THROW(read_file(folder.path()), IoError);
}

}  // namespace
