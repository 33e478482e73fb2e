#pragma once

#include "report/reports.hpp"
#include "wavebalance/app/files/summary.hpp"
#include "wavebalance/app/files/table.hpp"
#include "wavebalance/app/page/html.hpp"
#include "wavebalance/app/results/record.hpp"

/// Parts that the pages of all commands share, as HTML.
namespace wavebalance::app {

/// Whether the record has the motion of a bar, and a load to which its contact force is related.
bool has_bar_motion(const Scene& scene, const Record& record);

/// The motion as a script, `wavebalance.motions["name"] = {...}`, which motion.js of app/page moves: at each
/// instant the displacements of all nodes and of the tip (m) and the contact force over the amplitude of the
/// load. Values have 6 significant digits.
std::string bar_motion_script(const Scene& scene, const Record& record, const std::string& name);

/// Sentences as one paragraph, with their characters escaped; empty without any.
std::string paragraph(const std::vector<std::string>& sentences);
/// The same, or as a list where there are more than two.
std::string sentences_html(const std::vector<std::string>& sentences);
/// Items of a list, escaped.
std::string list_html(const std::vector<std::string>& items);
/// A section with its heading; empty without a body, which is HTML.
std::string section_html(const std::string& title, const std::string& body);
/// A body of HTML that opens below its title.
std::string folded(const std::string& title, const std::string& body);
/// Preformatted text in a box.
std::string code_html(const std::string& text);

/// An argument quoted for a shell.
std::string shell_word(const std::string& text);

/// The cells of a table as text below the names of its columns: frequencies and amplitudes with ten digits,
/// other numbers with six; columns without a value are left out.
std::vector<std::vector<std::string>> shown_rows(const Table& table);
/// Rows as columns.
std::vector<std::vector<std::string>> transposed(const std::vector<std::vector<std::string>>& rows);
/// The table `name` of a summary; null if there is none or it is empty.
const Table* table_of(const Summary& summary, const std::string& name);
/// All values of a summary, lists in one cell.
std::string values_table(const Summary& summary);
/// Columns of a table under other names, numbers with three digits, places along a
/// curve with six.
std::string columns_html(const Table& table, const std::vector<std::pair<std::string, std::string>>& columns);
/// A sentence from what a picture shows.
std::string sentence(std::string about);
/// The picture of that stem, of which the files hold the SVG, with curves that zoom where its data are among
/// them; `caption` is a sentence.
std::string picture_html(const std::vector<RecordFile>& files, const std::string& stem,
                         const std::string& alternative, const std::string& caption = "");
/// The pictures whose files there are, with what they show; a sentence if there should be some.
std::string pictures_html(const std::vector<RecordPicture>& pictures, const std::vector<RecordFile>& files);
/// Links to summary.json and to the files, each with its sentence.
std::string files_list(const std::vector<RecordFile>& files);
/// Whether one of the files has this name.
bool holds_file(const std::vector<RecordFile>& files, const std::string& name);

/// The sections with which all reports end; `asked` is HTML.
std::string last_sections(const std::vector<std::string>& warnings, const std::string& asked,
                          const std::vector<RecordFile>& files, const Summary& summary);
/// A self-contained report with the heading, the sections of page.body and the version.
std::string report_page(PageParts page, const std::string& heading);
/// The version and the list of the files of a record, as its summary ends.
void append_files(Summary& summary, const std::vector<RecordFile>& files);

}  // namespace wavebalance::app
