#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace wavebalance::report {

/// Finding of a run about a statement of a paper.
enum class Verdict {
  agrees,
  differs,
  partly,    ///< a part of the sentence holds
  ties,      ///< the values compared are equal to within report::tie_share
  misprint,  ///< a slip of the pen that the paper's own text or figures correct
  depends,   ///< holds under some of the readings that the paper's text allows, but not under all
};
/// "agrees", "differs", "holds in part", "ties", "misprint", "depends".
std::string_view to_string(Verdict verdict);

/// The verdict under one reading of a detail that the paper leaves open.
struct Reading {
  std::string name;  ///< "512 samples at the left ends"
  Verdict verdict = Verdict::differs;
  std::string measured;  ///< what was found under it
  /// Whether the paper's text allows it. Only such readings decide; the others show the findings if
  /// something were done differently from the paper.
  bool of_text = true;
};

/// A statement of a paper and what this run finds. See rule.hpp for what decides.
struct Statement {
  std::string place;          ///< "section 5.5"
  std::string quote;          ///< the paper's own words
  std::string criterion;      ///< what was measured, and what decides
  std::string measured = {};  ///< what was found
  Verdict verdict = Verdict::differs;
  std::string because = {};            ///< the reason; needed unless it agrees
  std::vector<Reading> readings = {};  ///< empty where the paper leaves nothing open
  std::string panel = {};              ///< which part of the picture shows it, "(e)"; empty: the whole
  std::string apart = {};     ///< why it is judged but not counted, "on another blade"; empty: counted
  std::string claim = {};     ///< what the paper claims in some five words, for the opening of the page
  std::string headline = {};  ///< what was found of it in one sentence
};

/// A sentence on results that no verdict is given on, and why.
struct Unjudged {
  std::string place;
  std::string quote;
  std::string reason;
  std::string found = {};  ///< what this run computed of it, if anything
};

/// A misprint of a paper that no figure depends on.
struct Slip {
  std::string place;    ///< "eq. (20)"
  std::string printed;  ///< the text there
  std::string meant;    ///< what it should be
  std::string shown;    ///< what in the paper shows it
};

/// A check of the code, or a sentence of this project's own. Not counted among the statements.
struct Check {
  std::string place;      ///< where the sentence is; "" for this project's statements
  std::string sentence;   ///< what is checked
  std::string criterion;  ///< what was measured, and the threshold that decides
  std::string measured;   ///< what was found
  bool passes = false;
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

/// A scene file that an artefact reads, and the overrides "section.key=value", or other options of the
/// command as "--analysis=time_stepping", of every reading that has some.
struct SceneUse {
  std::string name;
  std::vector<std::vector<std::string>> overrides;
};

/// The text of an artefact on the report page.
struct Record {
  Identity identity;
  std::string caption;
  std::vector<std::string> files;  ///< names, in results/<paper>/
  std::vector<DataFile> data;      ///< the CSV files among them
  std::vector<SceneUse> scenes;    ///< what it comes from
  std::vector<std::string> notes;  ///< choices made, and what is missing
  std::vector<Statement> statements;
  std::vector<Check> checks;
  std::vector<Unjudged> unjudged;
  std::vector<Slip> slips;
  TextTable table;      ///< shown on the page; empty for figures
  std::string program;  ///< what makes it, "jl14 fig06"
  double wall_seconds = 0.0;
  std::string version;  ///< of wavebalance
};

/// `record` as JSON, and back. parse_record throws app::IoError naming `file` for anything else.
std::string record_text(const Record& record);
Record parse_record(const std::string& text, const std::filesystem::path& file);

/// All records in `folder`, in the order of their file names. Throws app::IoError.
std::vector<Record> read_records(const std::filesystem::path& folder);

}  // namespace wavebalance::report
