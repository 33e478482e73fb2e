#pragma once
#include <string>
#include <vector>

#include "wavebalance/report/record.hpp"

namespace wavebalance::report {

/// What the page says of a paper as a whole, or of results of this project's own.
struct Paper {
  std::string folder;    ///< below results/ and reproduce/scenes/
  std::string citation;  ///< authors, title, where and when
  std::string link;      ///< to its text; empty: results of this project's own
  std::string licence;   ///< of the sentences quoted
};

/// The papers that are regenerated, in the order of the page.
const std::vector<Paper>& papers();

/// The results of one paper.
struct Section {
  Paper paper;
  std::vector<Record> records;
};

/// The whole page, HTML and CSS without scripts; pictures and data are linked relative to its folder.
std::string page_html(const std::vector<Section>& sections);

/// `text` with &, <, > and " as entities.
std::string escaped(const std::string& text);

}  // namespace wavebalance::report
