// Gathers the records below a results folder into its index.html, and into the pages that it links to.
#include <iostream>

#include "command_line.hpp"
#include "wavebalance/report/page.hpp"

using namespace wavebalance;

int main(int argc, char** argv) {
  std::string results = "results";
  report::Origin origin;
  origin.machine = report::this_machine();
  const auto code = report::read_arguments(
      argc, argv, "Writes index.html over the results of the papers", "",
      {{"--results", &results, "folder with one folder per paper"},
       {"--commit", &origin.commit, "of the sources, for the page"},
       {"--compiler", &origin.compiler, "with which they were compiled, for the page"}});
  if (code) return *code;
  try {
    report::write_pages(results, origin);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "wavebalance_report: " << error.what() << "\n";
    return 2;
  }
}
