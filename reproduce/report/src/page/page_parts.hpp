#pragma once
#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "wavebalance/report/page.hpp"

/// The parts of the report's pages, each a piece of HTML.
namespace wavebalance::report {

inline constexpr std::array all_verdicts{Verdict::agrees, Verdict::differs, Verdict::partly,
                                         Verdict::misprint, Verdict::depends};

/// How many statements have each verdict, in the order of all_verdicts.
struct Tally {
  std::array<int, all_verdicts.size()> counts{};

  void add(const Record& record);
  int of(Verdict verdict) const { return counts[static_cast<std::size_t>(verdict)]; }
  int all() const;
};

/// Class in the style sheet: "agrees", "differs", "partly", "misprint", "depends".
std::string_view kind(Verdict verdict);
/// What stands for a verdict where there is no room for a word. `readings`: "2/8" in place of "?" for
/// depends.
std::string sign(Verdict verdict, const std::vector<Reading>& readings = {});
/// The id of the index-th statement of a record, from 0.
std::string anchor(const Record& record, std::size_t index);
/// "Fig. 6" of "JL14 Fig. 6" in the section of a paper, else the whole.
std::string short_number(const Record& record, const Paper& paper);
/// "3 agree, 1 differs"; empty for none.
std::string tally_text(const Tally& tally);
/// `text` cut at a blank after at most `length` bytes, with an ellipsis if something is left out.
std::string shortened(const std::string& text, std::size_t length);
/// Records whose stems begin as `order` says come first, in that order.
std::vector<Record> ordered(std::vector<Record> records, const std::vector<std::string>& order);

/// The statements of a record as cards, and its checks, folded.
std::string statements_html(const Record& record);
std::string checks_html(const Record& record);

/// Where a page stands: how it finds the files of a section, and what is said of their origin.
struct Place {
  const Section& section;
  const Origin& origin;
  std::string folder;  ///< of the section's files as seen from the page: "extremes/", or empty beside them
  std::string assets;  ///< the folder of styles and scripts as seen from the page
};

/// The files of a record, the commands that compute it again, and their origin, folded.
std::string origin_html(const Record& record, const Place& place);

/// The motions that belong to a record, where their scripts have been written.
std::string moving_html(const Record& record, const Place& place);
/// Writes the scripts of motions beside the files from which they are made: motion_<case>.json, the motion of
/// a bar, and the series <stem>.pvd of the records. Throws app::IoError.
void write_moving(const std::filesystem::path& folder, const std::vector<Record>& records);

/// A figure or table with its statements.
std::string artefact_html(const Record& record, const Place& place);

/// What holds, what does not and why, in ten lines at most.
std::string brief_html(const std::vector<Section>& sections);
/// Figure by statement, in colours and signs.
std::string matrix_html(const std::vector<Section>& sections);
/// All statements that do not agree, folded.
std::string not_agreeing_html(const std::vector<Section>& sections);
/// The rule, and the statements whose criterion or verdict was another one earlier.
std::string rule_html(const std::vector<Section>& sections);

}  // namespace wavebalance::report
