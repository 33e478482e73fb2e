#include "wavebalance/app/files/output.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <utility>

namespace wavebalance::app {
namespace {

namespace fs = std::filesystem;

std::string reason_of(int error) { return std::strerror(error); }

/// Closes a descriptor on every way out; close() reports whether that worked, since a full disk may show only
/// there.
class Descriptor {
 public:
  explicit Descriptor(int descriptor) : descriptor_(descriptor) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return descriptor_; }
  bool close() {
    const int descriptor = std::exchange(descriptor_, -1);
    return descriptor < 0 || ::close(descriptor) == 0;
  }

 private:
  int descriptor_;
};

/// A new file in the folder of `target`; O_EXCL makes sure that nothing is overwritten and no link is
/// followed.
std::pair<int, fs::path> open_temporary(const fs::path& target) {
  static std::atomic<unsigned> counter{0};
  for (;;) {
    const std::string suffix = "." + std::to_string(::getpid()) + "-" + std::to_string(counter++) + ".tmp";
    // A long name keeps its temporary within what file systems allow.
    const fs::path temporary =
        target.parent_path() / ("." + target.filename().string().substr(0, 200) + suffix);
    const int descriptor = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0) return {descriptor, temporary};
    if (errno != EEXIST) throw IoError(target, "cannot be created: " + reason_of(errno));
  }
}

int write_all(int descriptor, std::string_view contents) {
  while (!contents.empty()) {
    const ssize_t written = ::write(descriptor, contents.data(), contents.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    contents.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

/// fsync() does not exist for pipes and devices, which is no failure.
int flush(int descriptor) {
  if (::fsync(descriptor) == 0 || errno == EINVAL || errno == EROFS) return 0;
  return errno;
}

/// Writes contents to the disk and closes the file. The number of the error, 0 without one.
int write_through(Descriptor& descriptor, std::string_view contents) {
  int error = write_all(descriptor.get(), contents);
  if (error == 0) error = flush(descriptor.get());
  if (!descriptor.close() && error == 0) error = errno;
  return error;
}

/// Writes a temporary for `target` and returns its path; removes it again on failure.
fs::path write_temporary(const fs::path& target, std::string_view contents) {
  auto [raw, temporary] = open_temporary(target);
  Descriptor descriptor(raw);
  const int error = write_through(descriptor, contents);
  if (error == 0) return temporary;
  ::unlink(temporary.c_str());
  throw IoError(target, "cannot be written: " + reason_of(error));
}

/// Whether a file can be written in the folder of `target`. Its name is gone before any signal is
/// delivered, so that one that ends the process leaves nothing.
void require_writable(const fs::path& target) {
  sigset_t all, before;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_BLOCK, &all, &before);
  int opened = -1;
  try {
    const auto [descriptor, temporary] = open_temporary(target);
    ::unlink(temporary.c_str());
    opened = descriptor;
  } catch (...) {
    ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
    throw;
  }
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  Descriptor descriptor(opened);
  if (const int error = write_through(descriptor, "wavebalance\n"); error != 0)
    throw IoError(target, "cannot be written: " + reason_of(error));
}

void flush_directory(const fs::path& directory) {
  Descriptor descriptor(::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (descriptor.get() >= 0) ::fsync(descriptor.get());  // a courtesy: the files themselves are safe
}

/// Makes `directory` and returns the folders that had to be made, outermost first.
std::vector<fs::path> make_directories(const fs::path& directory) {
  std::vector<fs::path> missing;
  std::error_code error;
  for (fs::path path = directory; !path.empty() && !fs::exists(path, error); path = path.parent_path())
    missing.insert(missing.begin(), path);
  for (std::size_t i = 0; i < missing.size(); ++i) {
    if (::mkdir(missing[i].c_str(), 0777) == 0 || errno == EEXIST) continue;
    const std::string reason = reason_of(errno);
    for (std::size_t made = i; made-- > 0;) ::rmdir(missing[made].c_str());
    throw IoError(directory, "cannot be created: " + reason);
  }
  if (!fs::is_directory(directory, error)) throw IoError(directory, "is not a folder");
  return missing;
}

/// Refuses folders, devices and pipes, both before it is opened, which may have effects, and after.
int open_regular(const fs::path& file) {
  const auto check = [&](const struct stat& status) {
    if (S_ISDIR(status.st_mode)) throw IoError(file, "cannot be read: it is a folder");
    if (!S_ISREG(status.st_mode)) throw IoError(file, "cannot be read: it is not a regular file");
  };
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) throw IoError(file, "cannot be read: " + reason_of(errno));
  check(status);
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) throw IoError(file, "cannot be read: " + reason_of(errno));
  if (::fstat(descriptor, &status) != 0) status.st_mode = S_IFREG;  // as it was a moment ago
  try {
    check(status);
  } catch (...) {
    ::close(descriptor);
    throw;
  }
  return descriptor;
}

/// Those that are empty: others stay where somebody else put files.
void remove_directories(const std::vector<fs::path>& made) {
  for (std::size_t i = made.size(); i-- > 0;) ::rmdir(made[i].c_str());
}

void require_plain_name(const char* function, const std::string& name) {
  if (name.empty() || name == "." || name == ".." || name.find('/') != std::string::npos)
    throw std::invalid_argument("OutputFiles::" + std::string(function) + ": name is \"" + name +
                                "\"; it must be a plain file name");
}

/// A trailing slash would make the last component empty.
fs::path without_trailing_slash(const fs::path& path) {
  fs::path result = path.lexically_normal();
  if (result.filename().empty() && result.has_relative_path()) result = result.parent_path();
  return result.empty() ? fs::path(".") : result;
}

}  // namespace

IoError::IoError(fs::path path, std::string reason)
    : std::runtime_error(path.string() + ": " + reason), path_(std::move(path)), reason_(std::move(reason)) {}

OutputFiles::OutputFiles(fs::path directory) : directory_(without_trailing_slash(directory)) {
  const std::vector<fs::path> made = make_directories(directory_);
  try {
    require_writable(directory_ / "probe");
  } catch (const IoError& error) {
    remove_directories(made);
    throw IoError(directory_, "cannot be written to: " + error.reason());
  }
  remove_directories(made);
}

OutputFiles::~OutputFiles() {
  for (const Staged& file : staged_) ::unlink(file.temporary.c_str());
  if (!committed_) remove_directories(created_);
}

void OutputFiles::add(const std::string& name, std::string_view contents) {
  require_plain_name("add", name);
  if (staged_.empty() && created_.empty()) created_ = make_directories(directory_);
  const fs::path target = directory_ / name;
  std::error_code ignored;
  if (fs::is_directory(target, ignored)) throw IoError(target, "cannot be written: it is a folder");
  staged_.push_back({write_temporary(target, contents), target});
}

void OutputFiles::replace(const std::vector<std::string>& names) {
  for (const std::string& name : names) require_plain_name("replace", name);
  earlier_ = names;
}

void OutputFiles::remove_earlier() {
  for (const std::string& name : earlier_) {
    const fs::path file = directory_ / name;
    const auto same = [&](const Staged& staged) { return staged.target == file; };
    if (std::ranges::any_of(staged_, same)) continue;
    if (::unlink(file.c_str()) != 0 && errno != ENOENT)
      throw IoError(file, "cannot be removed: " + reason_of(errno));
  }
}

void OutputFiles::commit() {
  remove_earlier();
  while (!staged_.empty()) {
    const Staged& file = staged_.front();
    if (::rename(file.temporary.c_str(), file.target.c_str()) != 0)
      throw IoError(file.target, "cannot be written: " + reason_of(errno));
    staged_.erase(staged_.begin());
    committed_ = true;
  }
  flush_directory(directory_);
}

void write_file(const fs::path& file, std::string_view contents) {
  OutputFiles files(file.has_parent_path() ? file.parent_path() : fs::path("."));
  files.add(file.filename().string(), contents);
  files.commit();
}

std::string read_file(const fs::path& file, std::size_t max_bytes) {
  const Descriptor descriptor(open_regular(file));
  const auto too_large = [&] {
    return IoError(file, "cannot be read: it has more than " + std::to_string(max_bytes) + " bytes");
  };
  struct ::stat status {};
  // A known size is checked without reading. Files of the system report 0, and others may grow meanwhile.
  if (::fstat(descriptor.get(), &status) == 0 && std::size_t(status.st_size) > max_bytes) throw too_large();
  std::string text;
  for (;;) {
    constexpr std::size_t block = 1 << 16;
    const std::size_t size = text.size();
    text.resize(size + block);
    const ssize_t got = ::read(descriptor.get(), text.data() + size, block);
    text.resize(size + static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
    if (got == 0) return text;
    if (got < 0 && errno != EINTR) throw IoError(file, "cannot be read: " + reason_of(errno));
    if (text.size() > max_bytes) throw too_large();
  }
}

std::string_view version() { return WAVEBALANCE_VERSION; }

}  // namespace wavebalance::app
