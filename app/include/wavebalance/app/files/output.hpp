#pragma once
#include <filesystem>
#include <mutex>
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

/// A set of files in one folder that appears as a whole or not at all. Each is written to a hidden temporary
/// beside its final place, flushed to the disk and checked; commit() then renames them all. Whatever was not
/// committed is removed with the object, and so is the folder if this object made it.
///
///     OutputFiles files("results/mine");          // throws IoError now if the folder cannot be written to
///     files.add("response.csv", text);
///     files.commit();
///
/// discard() may be called from another thread than the one that writes.
class OutputFiles {
 public:
  /// Makes the folder, with its parents, if it is missing, and writes a probe into it. Throws IoError.
  explicit OutputFiles(std::filesystem::path directory);
  ~OutputFiles();
  OutputFiles(const OutputFiles&) = delete;
  OutputFiles& operator=(const OutputFiles&) = delete;

  /// Writes `contents` to a temporary that will become directory()/name. Throws IoError (unwritable folder,
  /// full disk, a folder of that name) and std::invalid_argument if `name` is not a plain file name.
  void add(const std::string& name, std::string_view contents);
  /// Renames every temporary to its final name, replacing older files. Throws IoError.
  void commit();
  /// Removes what was not committed; add() and commit() then do nothing.
  void discard() noexcept;

  const std::filesystem::path& directory() const { return directory_; }

 private:
  struct Staged {
    std::filesystem::path temporary;
    std::filesystem::path target;
  };

  void remove_staged() noexcept;

  std::filesystem::path directory_;
  std::vector<std::filesystem::path> created_;  // folders made by this object, outermost first
  std::vector<Staged> staged_;
  bool committed_ = false;
  bool discarded_ = false;
  std::mutex mutex_;
};

/// Writes one file so that it appears complete or not at all; its folder is made if missing. Throws IoError.
void write_file(const std::filesystem::path& file, std::string_view contents);

/// The whole of `file`. Throws IoError.
std::string read_file(const std::filesystem::path& file);

/// "0.1.0"
std::string_view version();

}  // namespace wavebalance::app
