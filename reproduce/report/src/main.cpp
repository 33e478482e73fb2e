// Gathers the records below a results folder into its index.html, and into the pages that it links to.
#include <filesystem>
#include <iostream>

#include "command_line.hpp"
#include "wavebalance/app/files/output.hpp"
#include "wavebalance/report/page.hpp"

using namespace wavebalance;

int main(int argc, char** argv) {
  std::string results = "results";
  const auto code = report::read_arguments(argc, argv, "Writes index.html over the results of the papers", "",
                                           {{"--results", &results, "folder with one folder per paper"}});
  if (code) return *code;
  try {
    std::vector<report::Section> sections;
    for (const auto& paper : report::papers()) {
      const auto folder = std::filesystem::path(results) / paper.folder / "records";
      if (std::filesystem::is_directory(folder)) sections.push_back({paper, report::read_records(folder)});
    }
    if (sections.empty()) throw app::IoError(results, "holds no results of a paper");
    for (const auto& section : sections)
      if (section.paper.own_page)
        app::write_file(std::filesystem::path(results) / section.paper.folder / "index.html",
                        report::own_page_html(section));
    app::write_file(std::filesystem::path(results) / "index.html", report::page_html(sections));
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "wavebalance_report: " << error.what() << "\n";
    return 2;
  }
}
