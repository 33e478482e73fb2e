#pragma once
#include <array>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "wavebalance/app/files/table.hpp"
#include "wavebalance/report/page.hpp"

/// The parts of the report's pages, each a piece of HTML.
namespace wavebalance::report {

inline constexpr std::array all_verdicts{Verdict::agrees, Verdict::differs,  Verdict::partly,
                                         Verdict::ties,   Verdict::misprint, Verdict::depends};

/// How many of the statements that are counted have each verdict, in the order of all_verdicts.
struct Tally {
  std::array<int, all_verdicts.size()> counts{};

  void add(const Record& record);
  int of(Verdict verdict) const { return counts[static_cast<std::size_t>(verdict)]; }
  int all() const;
};

/// Class in the style sheet: "agrees", "differs", "partly" (a tie too), "misprint", "depends".
std::string_view kind(Verdict verdict);
/// Symbol of a verdict where there is no room for a word. `readings`: "1/2" instead of "?" for depends, of
/// those that the text allows.
std::string sign(Verdict verdict, const std::vector<Reading>& readings = {});
/// The id of the index-th statement of a record, from 0.
std::string anchor(const Record& record, std::size_t index);
/// "Fig. 6" of "JL14 Fig. 6" in the section of a paper, else the whole.
std::string short_number(const Record& record, const Paper& paper);
/// "3 agree, 1 differs"; empty for none.
std::string tally_text(const Tally& tally);
/// `text` cut at a blank after at most `length` bytes, with an ellipsis if something is left out.
std::string shortened(const std::string& text, std::size_t length);
/// Records whose stems begin as in `order` come first, in that order.
std::vector<Record> ordered(std::vector<Record> records, const std::vector<std::string>& order);

/// A table with these heads, and one below a summary that unfolds it. `attributes` of the element begin with
/// a blank.
std::string table_of(const std::vector<std::string>& heads, const std::string& rows);
std::string folded(const std::string& summary, const std::vector<std::string>& heads, const std::string& rows,
                   const std::string& attributes = "");
/// A row of a table, each text escaped and with its formulas.
std::string row_of(const std::vector<std::string>& texts);

/// The statements of a record as cards, and its checks, folded.
std::string statements_html(const Record& record);
std::string checks_html(const Record& record);

/// Location of a page: how it finds the files of a section, and the text on their origin.
struct Place {
  const Section& section;
  const Origin& origin;
  std::string folder;  ///< of the section's files as seen from the page: "extremes/", or empty in the same
                       ///< folder
  std::string assets;  ///< the folder of styles and scripts as seen from the page
};

/// The files of a record, the commands that compute it again, and their origin, folded.
std::string origin_html(const Record& record, const Place& place);

/// The motions of a record: <stem>.motion.js, the motion of a bar, and a <name>.body.js for each series
/// <name>.pvd.
std::string moving_html(const Record& record, const Place& place);

/// A figure or table with its statements.
std::string artefact_html(const Record& record, const Place& place);

/// Findings of this run in single sentences: most_agreeing of statements that agree and most_others of
/// others.
inline constexpr std::size_t most_agreeing = 6, most_others = 3;
std::string brief_html(const std::vector<Section>& sections);
/// Figure by statement, in colours and signs.
std::string matrix_html(const std::vector<Section>& sections);
/// The rule, what is not judged, and the misprints.
std::string rule_html(const std::vector<Section>& sections);

/// verdicts.csv: a row for each statement of the sections without a separate page.
app::Table verdicts_table(const std::vector<Section>& sections);

/// A statement and its place.
struct Found {
  const Section& section;
  const Record& record;
  std::size_t index;

  const Statement& statement() const { return record.statements[index]; }
};
/// Statements of the sections without a separate page.
std::vector<Found> all_statements(const std::vector<Section>& sections,
                                  const std::function<bool(const Statement&)>& wanted);

}  // namespace wavebalance::report
