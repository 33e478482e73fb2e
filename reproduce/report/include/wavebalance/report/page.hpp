#pragma once
#include <string>
#include <vector>

#include "wavebalance/report/record.hpp"

namespace wavebalance::report {

/// The heading of a section: a paper, or results of this project's own.
struct Paper {
  std::string folder;     ///< below results/ and reproduce/scenes/
  std::string citation;   ///< authors, title, where and when
  std::string link;       ///< to its text; empty: results of this project's own
  std::string licence;    ///< of the sentences quoted
  bool own_page = false;  ///< shown on results/<folder>/index.html, to which results/index.html links
};

/// The papers that are regenerated, in the order of the page.
const std::vector<Paper>& papers();

/// The results of one paper.
struct Section {
  Paper paper;
  std::vector<Record> records;
};

/// results/index.html: the sections, and links to those that have their own page. HTML and CSS without
/// scripts; pictures and data are linked relative to the folder of the page.
std::string page_html(const std::vector<Section>& sections);

/// results/<folder>/index.html of a section that has its own page.
std::string own_page_html(const Section& section);

/// `text` with &, <, > and " as entities.
std::string escaped(const std::string& text);

}  // namespace wavebalance::report
