#pragma once
#include <cstddef>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace wavebalance::app {

/// A file or folder that could not be written or read: which one and why.
class IoError : public std::runtime_error {
 public:
  IoError(std::filesystem::path path, std::string reason);
  const std::filesystem::path& path() const { return path_; }
  const std::string& reason() const { return reason_; }

 private:
  std::filesystem::path path_;
  std::string reason_;
};

/// A set of files in one folder that appears as a whole or not at all. Each is written to a hidden
/// temporary file in the same folder, flushed to the disk and checked; commit() then renames them all.
/// Files that were not committed are removed with the object, and so is the folder if this object made it.
///
///     OutputFiles files("results/mine");          // throws IoError now if the folder cannot be written to
///     files.add("response.csv", text);
///     files.commit();
class OutputFiles {
 public:
  /// Checks that the folder can be made, with its parents, and written to; a folder that is missing is made
  /// for good by the first add(). Throws IoError.
  explicit OutputFiles(std::filesystem::path directory);
  ~OutputFiles();
  OutputFiles(const OutputFiles&) = delete;
  OutputFiles& operator=(const OutputFiles&) = delete;

  /// Writes `contents` to a temporary that will become directory()/name. Throws IoError (unwritable folder,
  /// full disk, a folder of that name) and std::invalid_argument if `name` is not a plain file name.
  void add(const std::string& name, std::string_view contents);
  /// Names the files of an earlier record in this folder, which commit() removes unless they are added anew.
  /// Throws std::invalid_argument if one is not a plain file name.
  void replace(const std::vector<std::string>& names);
  /// Removes the files of the earlier record, then renames every temporary to its final name in the order of
  /// add(), replacing older files. Throws IoError.
  void commit();

  const std::filesystem::path& directory() const { return directory_; }

 private:
  struct Staged {
    std::filesystem::path temporary;
    std::filesystem::path target;
  };

  void remove_earlier();

  std::filesystem::path directory_;
  std::vector<std::filesystem::path> created_;  // folders made by this object, outermost first
  std::vector<Staged> staged_;
  std::vector<std::string> earlier_;
  bool committed_ = false;
};

/// Writes one file so that it appears complete or not at all; its folder is made if missing. Throws IoError.
void write_file(const std::filesystem::path& file, std::string_view contents);

/// The whole of `file`. Throws IoError, also if it is no regular file or has more than `max_bytes`; a pipe is
/// not waited for.
std::string read_file(const std::filesystem::path& file,
                      std::size_t max_bytes = std::numeric_limits<std::size_t>::max());

/// "0.1.0"
std::string_view version();

}  // namespace wavebalance::app
