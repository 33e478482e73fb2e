#pragma once
#include <cstdlib>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <string>

#include "temporary_folder.hpp"
#include "wavebalance/app/files/output.hpp"
#include "wavebalance/report/artefact.hpp"
#include "wavebalance/report/program.hpp"

namespace wavebalance::report {

/// What the steps of a paper wrote, each made once: by CTest in the folder that the variable
/// WAVEBALANCE_RESULTS names, before any test; or, where a test program is started by hand, here in a
/// temporary folder.
class PaperResults {
 public:
  explicit PaperResults(const std::vector<Step>& steps) : steps_(steps) {
    if (const char* folder = std::getenv("WAVEBALANCE_RESULTS")) made_by_ctest_ = folder;
  }

  /// Makes what is not made yet, in this order. Throws what a step throws.
  void need(const std::vector<std::string>& names) {
    if (!made_by_ctest_.empty()) return;
    for (const auto& name : names)
      if (made_.insert(name).second) run_step(steps_, name, folder());
  }
  std::filesystem::path folder() const { return made_by_ctest_.empty() ? temporary_.path() : made_by_ctest_; }
  app::Table read(const std::string& file) const { return app::read_csv(folder() / file); }
  bool has(const std::string& file) const { return std::filesystem::is_regular_file(folder() / file); }
  Record record(const std::string& stem) const {
    const auto file = folder() / "records" / (stem + ".json");
    return parse_record(app::read_file(file), file);
  }
  /// The statement that holds `words`.
  Statement statement(const std::string& stem, const std::string& words) const {
    for (const auto& one : record(stem).statements)
      if (one.quote.find(words) != std::string::npos) return one;
    throw std::runtime_error(stem + ": no statement holds \"" + words + "\"");
  }
  Verdict verdict(const std::string& stem, const std::string& words) const {
    return statement(stem, words).verdict;
  }
  /// The result of the check whose sentence holds `words`.
  bool passes(const std::string& stem, const std::string& words) const {
    for (const auto& one : record(stem).checks)
      if (one.sentence.find(words) != std::string::npos) return one.passes;
    throw std::runtime_error(stem + ": no check holds \"" + words + "\"");
  }

 private:
  const std::vector<Step>& steps_;
  std::filesystem::path made_by_ctest_;
  TemporaryFolder temporary_;
  std::set<std::string> made_;
};

}  // namespace wavebalance::report
