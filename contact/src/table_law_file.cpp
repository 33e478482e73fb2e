#include <charconv>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

#include "wavebalance/contact/table_law.hpp"

namespace wavebalance::contact {
namespace {

constexpr std::size_t most_rows = 100'000;
constexpr std::uintmax_t most_bytes = std::uintmax_t{1} << 24;  // 160 for each row

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blank = " \t\r";
  const auto first = text.find_first_not_of(blank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blank) - first + 1);
}

// Not a number where the text is no finite one.
double number(std::string_view text) {
  text = trimmed(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
  return whole ? value : std::numeric_limits<double>::quiet_NaN();
}

/// Refuses devices and pipes before they are opened, since one may have no end and the other no writer.
std::ifstream open_table(const std::filesystem::path& file) {
  std::error_code failure;
  const auto status = std::filesystem::status(file, failure);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw std::runtime_error(file.string() + ": cannot be read: it is not a regular file");
  const std::uintmax_t size = std::filesystem::file_size(file, failure);
  std::ifstream stream(file);
  if (failure || !stream)
    throw std::runtime_error(file.string() +
                             ": cannot be read; expected a CSV file of displacement and force");
  if (size > most_bytes)
    throw std::runtime_error(file.string() + ": cannot be read: it has " + std::to_string(size) +
                             " bytes; expected at most " + std::to_string(most_bytes));
  return stream;
}

class TableFile {
 public:
  explicit TableFile(const std::filesystem::path& file) : name_(file.string()), stream_(open_table(file)) {}

  TableLaw read() {
    for (std::string text; std::getline(stream_, text);) {
      ++line_;
      const std::string_view row = trimmed(text);
      if (!row.empty() && !row.starts_with('#')) add(row);
    }
    if (displacements_.size() < 2)
      throw std::runtime_error(name_ + ": has " + std::to_string(displacements_.size()) +
                               " rows of numbers; expected 2 or more");
    return {std::move(displacements_), std::move(forces_)};
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const {
    throw std::runtime_error(name_ + ":" + std::to_string(line_) + ": " + reason);
  }

  void add(std::string_view row) {
    const auto comma = row.find_first_of(",;");
    const double u = number(row.substr(0, comma));
    const double f = number(comma == std::string_view::npos ? std::string_view() : row.substr(comma + 1));
    const bool header = displacements_.empty() && !header_ && std::isnan(u) && std::isnan(f);
    header_ = header_ || header;
    if (header) return;
    if (std::isnan(u) || std::isnan(f))
      fail("\"" + std::string(row) +
           "\"; expected two finite numbers, displacement in m and force in N, separated by a comma");
    if (!displacements_.empty() && !(u > displacements_.back()))
      fail("displacement " + std::string(trimmed(row.substr(0, comma))) +
           "; expected one above that of the row before");
    if (displacements_.size() == most_rows) fail("expected at most " + std::to_string(most_rows) + " rows");
    displacements_.push_back(u);
    forces_.push_back(f);
  }

  std::string name_;
  std::ifstream stream_;
  int line_ = 0;
  bool header_ = false;
  std::vector<double> displacements_, forces_;
};

}  // namespace

TableLaw read_table_law(const std::filesystem::path& file) { return TableFile(file).read(); }

}  // namespace wavebalance::contact
