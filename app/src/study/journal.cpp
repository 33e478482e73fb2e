#include "wavebalance/app/study/study.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "files/json_line.hpp"
#include "wavebalance/app/files/output.hpp"

namespace wavebalance::app {
namespace {

namespace fs = std::filesystem;

std::string header_of(const Study& study, const StudyRuns& runs) {
  return json_line(Summary{{"wavebalance_study", std::string(version())},
                           {"runs", runs.size()},
                           {"identity", study_identity(study)}});
}

int open_locked(const fs::path& file) {
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor < 0) throw IoError(file, std::string("cannot be opened: ") + std::strerror(errno));
  if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return descriptor;
  const bool in_use = errno == EWOULDBLOCK;
  const std::string reason = in_use ? "another study writes to this folder now"
                                    : std::string("cannot be locked: ") + std::strerror(errno);
  ::close(descriptor);
  throw IoError(file, reason);
}

/// Why a journal that begins with this line belongs to another study.
std::string difference_text(const std::string& found) {
  const std::optional<Summary> header = parse_summary(found);
  if (!header || header->empty() || header->front().name != "wavebalance_study")
    return "is no journal of a study";
  const auto* written = std::get_if<std::string>(&header->front().value);
  if (written != nullptr && *written != version())
    return "was written by version " + *written + "; name another folder, or remove the file to begin anew";
  return "belongs to another study or scene; name another folder, or remove the file to begin anew";
}

}  // namespace

StudyJournal::StudyJournal(const fs::path& folder, const Study& study, const StudyRuns& runs)
    : file_(folder / file_name), flushed_(std::chrono::steady_clock::now()) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw IoError(folder, "cannot be created: " + error.message());
  descriptor_ = open_locked(file_);
  try {
    const std::string header = header_of(study, runs);
    read(header, runs.size());
    if (size_ == 0) write_line(header);
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

StudyJournal::~StudyJournal() {
  ::fdatasync(descriptor_);
  ::close(descriptor_);
}

void StudyJournal::read(const std::string& header, std::int64_t runs) {
  const std::string text = read_file(file_);
  const std::size_t last = text.rfind('\n');
  const std::size_t whole = last == std::string::npos ? 0 : last + 1;
  if (whole > 0) {
    const std::size_t begin = text.find('\n') + 1;
    const std::string first = text.substr(0, begin - 1);
    if (first != header) throw IoError(file_, difference_text(first));
    read_rows(std::string_view(text).substr(begin, whole - begin), runs);
  }
  size_ = static_cast<std::int64_t>(whole);
  if (whole < text.size() && ::ftruncate(descriptor_, size_) != 0)
    throw IoError(file_, std::string("cannot be shortened: ") + std::strerror(errno));
}

/// `text` ends with a line. A run whose line cannot be read has no row, so that it is solved again.
void StudyJournal::read_rows(std::string_view text, std::int64_t runs) {
  std::vector<bool> seen(static_cast<std::size_t>(runs));
  for (std::size_t begin = 0, end = 0; begin < text.size(); begin = end + 1) {
    end = text.find('\n', begin);
    try {
      StudyRow row = parse_row(text.substr(begin, end - begin));
      if (row.run < 0 || row.run >= runs) throw std::invalid_argument("its run is not one of the study");
      const auto index = static_cast<std::size_t>(row.run);
      if (!seen[index]) rows_.push_back(std::move(row));
      seen[index] = true;
    } catch (const std::invalid_argument&) {
      ++unreadable_lines_;
    }
  }
}

void StudyJournal::write_line(const std::string& line) {
  const std::string text = line + "\n";
  for (std::string_view rest = text; !rest.empty();) {
    const ssize_t written = ::write(descriptor_, rest.data(), rest.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      const std::string reason = std::strerror(errno);
      [[maybe_unused]] const int ignored = ::ftruncate(descriptor_, size_);
      throw IoError(file_, "cannot be written: " + reason);
    }
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
  size_ += static_cast<std::int64_t>(text.size());
}

void StudyJournal::append(const StudyRow& row) {
  write_line(json_line(row));
  const auto now = std::chrono::steady_clock::now();
  if (now - flushed_ < std::chrono::seconds(1)) return;
  ::fdatasync(descriptor_);
  flushed_ = now;
}

std::vector<std::int64_t> missing_runs(const std::vector<StudyRow>& rows, std::int64_t runs) {
  std::vector<bool> there(static_cast<std::size_t>(runs));
  for (const StudyRow& row : rows) there[static_cast<std::size_t>(row.run)] = true;
  std::vector<std::int64_t> left;
  for (std::int64_t run = 0; run < runs; ++run)
    if (!there[static_cast<std::size_t>(run)]) left.push_back(run);
  return left;
}

}  // namespace wavebalance::app
