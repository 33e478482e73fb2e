#include "command/commands.hpp"

#include <fmt/format.h>

#include "plot/plot_parts.hpp"
#include "report/overlay.hpp"
#include "report/page_parts.hpp"
#include "report/reports.hpp"
#include "wavebalance/app/files/output.hpp"
#include "wavebalance/app/files/record_folder.hpp"
#include "wavebalance/app/files/summary.hpp"
#include "wavebalance/app/page/html.hpp"
#include "wavebalance/app/plot/figure_script.hpp"

namespace wavebalance::app {
namespace {

namespace fs = std::filesystem;

void check(const OverlayArguments& arguments) {
  require_output(arguments.output);
  std::error_code ignored;
  for (const fs::path& folder : arguments.folders)
    if (fs::equivalent(folder, arguments.output, ignored))
      throw std::invalid_argument("--output " + arguments.output.string() +
                                  " holds results that are to be drawn; expected another folder");
}

std::string page_text(const OverlayArguments& arguments, const Overlay& overlay,
                      const std::vector<RecordFile>& files) {
  std::string list;
  for (const fs::path& folder : arguments.folders) list += "<li>" + escaped(folder.string()) + "</li>\n";
  std::string warnings;
  for (const std::string& one : overlay.warnings) warnings += "<p>" + escaped(one) + ".</p>\n";
  const bool has_unstable = std::ranges::any_of(overlay.curves, [](const OverlayCurve& curve) {
    return std::ranges::any_of(curve.unstable, [](double count) { return count > 0.0; });
  });
  PageParts page;
  page.title = "Responses and modes, Wavebalance";
  page.assets = "";
  page.libraries = {Library::d3};
  page.body = "<main>\n<h1>Responses and modes of one structure</h1>\n" + warnings +
              (holds_file(files, "overlay.svg")
                   ? picture_html(files, "overlay",
                                  (overlay.quantity.is_output() ? capitalised(overlay.quantity.name)
                                                                : "Displacement") +
                                      (is_over_time(overlay) ? " over a period, of all folders"
                                                             : " over the frequency, of all folders"))
                   : "<p>There is no picture: gnuplot was not found.</p>\n") +
              (has_unstable ? "<p>Lines are dashed where a motion is unstable. Results folders:</p>\n<ul>\n"
                            : "<p>Results folders:</p>\n<ul>\n") +
              list + "</ul>\n<p><a href=\"overlay.csv\">overlay.csv</a> holds their points.</p>\n" +
              fmt::format("<p class=\"quiet\">Wavebalance {}</p>\n</main>\n", version());
  return page_html(page);
}

std::vector<RecordFile> files_of(const OverlayArguments& arguments, const Overlay& overlay) {
  const Figure figure = overlay_figure(overlay);
  std::vector<RecordFile> files;
  try {
    files.push_back({"overlay.svg", render(figure, PictureFormat::svg), "the picture"});
    files.push_back({"overlay.png", render(figure, PictureFormat::png), "the picture"});
    files.push_back({"overlay.figure.js", figure_script(figure, "overlay"), "the curves of overlay.html"});
  } catch (const PlotError& error) {
    say_no_picture(error.what());
  }
  files.push_back(
      {"overlay.html", page_text(arguments, overlay, files), "the picture, with curves that zoom"});
  files.push_back({"overlay.csv", csv_text(overlay_table(overlay)), "the points of all curves"});
  return files;
}

std::string summary_of(const OverlayArguments& arguments, const Overlay& overlay,
                       const std::vector<RecordFile>& files) {
  std::vector<std::string> folders;
  for (const fs::path& folder : arguments.folders) folders.push_back(folder.string());
  Summary summary{{"folders", folders},
                  {"quantity", overlay.quantity.name},
                  {"curves", static_cast<std::int64_t>(overlay.curves.size())},
                  {"warnings", overlay.warnings}};
  append_files(summary, files);
  return json_text(summary);
}

}  // namespace

int overlay_results(const OverlayArguments& arguments) {
  check(arguments);
  const Overlay overlay = read_overlay(arguments.folders, arguments.quantity);
  require_replaceable(
      arguments.output,
      [](const std::string& name) { return name == "summary.json" || name.starts_with("overlay."); }, {});
  OutputFiles output(arguments.output);
  const std::vector<RecordFile> files = files_of(arguments, overlay);
  output.replace(files_of_record(output.directory() / "summary.json"));
  for (const RecordFile& file : files) output.add(file.name, file.contents);
  output.add("summary.json", summary_of(arguments, overlay, files));
  output.commit();
  say_warnings(overlay.warnings);
  if (arguments.quiet) return solved;
  return print(fmt::format("{} curve{} written to {}: {}\n", overlay.curves.size(),
                           overlay.curves.size() == 1 ? "" : "s", arguments.output.string(),
                           names_of(files)));
}

}  // namespace wavebalance::app
