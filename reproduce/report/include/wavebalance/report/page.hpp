#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "wavebalance/report/record.hpp"

namespace wavebalance::report {

/// The heading of a section: a paper, or results of this project's own.
struct Paper {
  std::string folder;     ///< below results/ and reproduce/scenes/
  std::string name;       ///< short, "Jones & Legrand 2014"
  std::string citation;   ///< authors, title, where and when
  std::string link;       ///< to its page; empty: results of this project's own
  std::string licence;    ///< of the sentences quoted
  bool own_page = false;  ///< shown on results/<folder>/index.html, to which results/index.html links
  std::vector<std::string> order;  ///< how stems begin, in the order of the page; others follow by name
};

/// The papers that are regenerated, in the order of the page.
const std::vector<Paper>& papers();

/// The results of one paper.
struct Section {
  Paper paper;
  std::vector<Record> records;  ///< in the order of the page
  std::map<std::string, std::uintmax_t>
      files;  ///< what its folder holds, "scenes/" too, and the bytes of each
  std::map<std::string, std::string> sizes{};  ///< app::picture_size() of its pictures
};

/// Where results come from. The page shows these texts at every artefact.
struct Origin {
  std::string commit = "unknown";    ///< "1a2b3c4d5e6f", of the sources
  std::string compiler = "unknown";  ///< "GNU 12.2.0, Release"
  std::string machine = "unknown";   ///< "the processor's name, 2 cores"; see this_machine()
};

/// Name of the processor and number of its cores, "unknown" if the system does not report it.
std::string this_machine();

/// results/index.html: what holds in brief, a matrix of verdicts, the rule, and the sections with figures
/// next to their statements; links to the sections that have their own page. It shows all of that without
/// scripts too. `measured`: whether results/bench/index.html is there to be linked.
std::string page_html(const std::vector<Section>& sections, const Origin& origin, bool measured = false);

/// results/<folder>/index.html of a section that has its own page.
std::string own_page_html(const Section& section, const Origin& origin);

/// Writes index.html of all papers that have records below `results`, the pages of those that have their
/// own, and what the pages load: results/assets/, and scripts with motions in the folders of their results.
/// Throws app::IoError, also if no paper has results.
void write_pages(const std::filesystem::path& results, const Origin& origin);

}  // namespace wavebalance::report
