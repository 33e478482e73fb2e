#pragma once
#include <filesystem>
#include <string>
#include <vector>

/// The arguments of the commands, which reports quote.
namespace wavebalance::app {

struct RunArguments {
  std::filesystem::path scene;
  std::filesystem::path output;
  std::vector<std::string> overrides;  ///< "section.key=value"
  std::vector<std::string> removed;    ///< "section.key"
  std::string analysis;                ///< --analysis; empty: as in the scene
  std::filesystem::path start_from;    ///< a motion to start near, see read_start_motion(); empty: none
  double max_memory = 0.0;             ///< limit of the expected memory, GB; 0: memory of the machine
  int threads = 0;                     ///< AnalysisOptions::threads, ComparisonOptions::threads
  bool quiet = false;
  bool verbose = false;      ///< prints all values of the summary, not sentences
  bool report = true;        ///< whether report.html is written
  bool copy_inputs = false;  ///< whether the record gets copies of the files that the scene names
};

struct CompareArguments {
  RunArguments run;      ///< scene, its changes, output and quiet
  std::string pairs;     ///< "fourier:fourier,haar:fourier"; empty: every admissible common one
  std::string error;     ///< "displacement", "force" or "both"; empty: ComparisonOptions::measure
  double budget = 10.0;  ///< s
};

struct StudyArguments {
  std::filesystem::path study;
  std::filesystem::path output;
  int threads = 0;  ///< that solve runs; 0: one per core, or with mpirun one per process
  bool quiet = false;
  bool report = true;  ///< whether report.html is written
};

}  // namespace wavebalance::app
