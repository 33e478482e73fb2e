#pragma once
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "ll10.hpp"
#include "wavebalance/report/record.hpp"
#include "wavebalance/app/files/output.hpp"

namespace wavebalance::ll10 {

/// Runs the programs of the figures into a folder of their own and reads what they write.
class Programs : public testing::Test {
 protected:
  Programs() {
    std::string name = (std::filesystem::temp_directory_path() / "wavebalance_ll10_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    folder_ = name;
  }
  ~Programs() override { std::filesystem::remove_all(folder_); }

  int run(const std::string& program) const {
    const std::string command =
        std::string(LL10_PROGRAMS) + "/ll10_" + program + " --output '" + folder_.string() + "'";
    return WEXITSTATUS(std::system(command.c_str()));
  }
  Table read(const std::string& file) const { return app::read_csv(folder_ / file); }
  bool has(const std::string& file) const { return std::filesystem::is_regular_file(folder_ / file); }
  /// The verdict on the statement that holds `words`.
  bool verdict(const std::string& stem, const std::string& words) const {
    const auto file = folder_ / "records" / (stem + ".json");
    for (const auto& claim : report::parse_record(app::read_file(file), file).claims)
      if (claim.quote.find(words) != std::string::npos) return claim.holds;
    throw std::runtime_error("no statement holds \"" + words + "\"");
  }

  std::filesystem::path folder_;
};

}  // namespace wavebalance::ll10
