#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace wavebalance::report {

/// A statement of a paper and its verdict by the values of this run.
struct Claim {
  std::string place;      ///< "section 5.5"
  std::string quote;      ///< the paper's own words
  std::string criterion;  ///< what was measured, and the threshold that decides
  std::string measured;   ///< what was found
  bool holds = false;     ///< the criterion is met
};

/// Names of an artefact and of its paper.
struct Identity {
  std::string paper;   ///< folder below results/, "jones_legrand_2014"
  std::string number;  ///< "JL14 Fig. 6"
  std::string title;   ///< "Tip displacement, case 1"
  std::string stem;    ///< of its files, "fig06_tip_displacement_case1"
};

/// A table as text, its first row the names of the columns.
using TextTable = std::vector<std::vector<std::string>>;

/// A CSV file of an artefact: what its columns are in, and remarks.
struct DataFile {
  std::string name;
  std::string units;  ///< "SI; a column's name ends in its unit"
  std::vector<std::string> notes;
};

/// The text of an artefact on the report page.
struct Record {
  Identity identity;
  std::string caption;
  std::vector<std::string> files;   ///< names, in results/<paper>/
  std::vector<DataFile> data;       ///< the CSV files among them
  std::vector<std::string> scenes;  ///< names of the scene files it comes from
  std::vector<std::string> notes;   ///< choices made, and what is missing
  std::vector<Claim> claims;
  TextTable table;  ///< shown on the page; empty for figures
  double wall_seconds = 0.0;
  std::string version;  ///< of wavebalance
};

/// `record` as JSON, and back. parse_record throws app::IoError naming `file` for anything else.
std::string record_text(const Record& record);
Record parse_record(const std::string& text, const std::filesystem::path& file);

/// All records in `folder`, in the order of their file names. Throws app::IoError.
std::vector<Record> read_records(const std::filesystem::path& folder);

}  // namespace wavebalance::report
