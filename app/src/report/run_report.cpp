#include "report/reports.hpp"

#include <sstream>

#include "report/page_parts.hpp"
#include "report/words.hpp"
#include "results/record_parts.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/compose/outputs.hpp"
#include "wavebalance/app/files/quantity_text.hpp"
#include "wavebalance/app/page/html.hpp"
#include "wavebalance/app/scene/contacts.hpp"
#include "wavebalance/app/scene/scene_writer.hpp"

namespace wavebalance::app {
namespace {

std::string heading_of(const RunArguments& arguments, const Scene& scene) {
  const std::string structure = scene.structure.type == StructureType::matrices
                                    ? "of a structure of matrices"
                                    : "of a " + name_of(scene.structure.type);
  const std::string name = arguments.scene.stem().string();
  return (name.empty() ? "" : name + ": ") + std::string(kind_of(scene.analysis.type).heading) + " " +
         structure;
}

std::string command_of(const RunArguments& arguments) {
  std::string text = "wavebalance run " + shell_word(arguments.scene.string());
  for (const auto& one : arguments.overrides) text += " --set " + shell_word(one);
  for (const auto& one : arguments.removed) text += " --unset " + shell_word(one);
  if (!arguments.start_from.empty()) text += " --start-from " + shell_word(arguments.start_from.string());
  return text + " --output " + shell_word(arguments.output.string());
}

/// A table of the summary, folded below its title.
std::string folded_table(const Summary& summary, const std::string& name, const std::string& title) {
  const Table* table = table_of(summary, name);
  return table == nullptr ? "" : folded(title, table_html(shown_rows(*table)));
}

/// The statistics of an aperiodic motion, in units with prefixes.
std::string statistics_of_record(const Summary& summary) {
  const Table* table = table_of(summary, "statistics");
  if (table == nullptr) return "";
  std::vector<std::vector<std::string>> rows{{"place", "quantity", "value", "error"}};
  for (std::size_t i = 0; i < table->rows(); ++i) {
    const std::string unit = cell_text(table->at(i, "unit"));
    rows.push_back({cell_text(table->at(i, "place")), cell_text(table->at(i, "quantity")),
                    quantity(table->numbers("value")[i], unit),
                    quantity(table->numbers("error")[i], unit, 2)});
  }
  return folded("Statistics", table_html(rows));
}

/// The picture of the record.
std::string record_picture(const std::vector<RecordFile>& files, const std::string& heading) {
  const auto drawn =
      std::ranges::find_if(files, [](const auto& file) { return file.name.ends_with(".svg"); });
  return drawn == files.end()
             ? "<p>There is no picture: gnuplot was not found.</p>\n"
             : picture_html(files, std::filesystem::path(drawn->name).stem().string(), heading);
}

/// How many contacts are closed at rest; empty where static loads move none.
std::vector<std::string> rest_sentences(const Scene& scene, const Summary& summary) {
  const Table* rest = table_of(summary, "at_rest");
  if (rest == nullptr) return {};
  const std::vector<double> forces = rest->numbers("contact_force_N");
  const std::int64_t closed = closed_contacts(scene, forces);
  if (closed == 0) return {"At rest under the static loads no contact is closed."};
  const solvers::Motion at_rest{{}, {}, Eigen::Map<const Eigen::VectorXd>(forces.data(), std::ssize(forces))};
  double largest = 0.0;
  for (int row = 0; row < int(forces.size()); ++row)
    largest = std::max(largest, largest_contact_force(scene, at_rest, row));
  return {fmt::format("At rest under the static loads {} of {} contacts {} closed, with at most {}.", closed,
                      whole_contact_count(scene), closed == 1 ? "is" : "are",
                      quantity(largest, force_unit(displacement_unit(scene))))};
}

/// The pictures of the outputs, with what was measured of them; empty without any.
std::string outputs_of_record(const Record& record, const std::vector<RecordFile>& files,
                              const Summary& summary) {
  std::string pictures = paragraph(output_sentences(summary, record.axis));
  for (const RecordPicture& one : record.output_pictures)
    if (holds_file(files, one.stem + ".svg")) pictures += picture_html(files, one.stem, one.figure.title);
  return pictures + folded_table(summary, "outputs", "Outputs") +
         folded_table(summary, "critical_speeds", "Critical speeds");
}

/// The table of coexisting motions, the main result, or folded the motions at points of a curve.
std::string motions_of_record(const Scene& scene, const Summary& summary) {
  if (scene.analysis.type != AnalysisType::motions)
    return folded_table(summary, "motions", "Motions at points of the curve");
  const Table* table = table_of(summary, "motions");
  return table == nullptr
             ? ""
             : "<h3>Motions at this frequency</h3>\n" + table_html(transposed(shown_rows(*table)), true);
}

/// The pictures of single motions, and when each is in contact; empty without any.
std::string motions_of_points(const Record& record, const std::vector<RecordFile>& files,
                              const Summary& summary) {
  std::string pictures;
  for (const RecordPicture& motion : record.motion_pictures)
    if (holds_file(files, motion.stem + ".svg"))
      pictures += "<h3>" + escaped(motion.figure.title) + "</h3>\n" +
                  picture_html(files, motion.stem, motion.figure.title);
  return pictures.empty() ? "" : pictures + folded_table(summary, "phases", "Contact intervals");
}

/// The box in which motion.js moves the bar, where its data are among the files.
std::string motion(const std::vector<RecordFile>& files) {
  const auto found =
      std::ranges::find_if(files, [](const auto& file) { return file.name.ends_with(".motion.js"); });
  return found == files.end()
             ? ""
             : fmt::format("<h3>Motion</h3>\n<div class=\"motion\" data-motion=\"{}\"></div>\n", found->name);
}

/// The box in which body.js moves the structure in space, where its data are among the files.
std::string motion_in_space(const std::vector<RecordFile>& files) {
  std::string scripts;
  for (const RecordFile& file : files)
    if (file.name.ends_with(".body.js")) scripts += (scripts.empty() ? "" : " ") + file.name;
  return scripts.empty()
             ? ""
             : fmt::format("<div class=\"body-motion\" data-library=\"\" data-bodies=\"{}\"></div>\n",
                           scripts);
}

/// The lines of describe_scene() as a list of names, which fill so many columns, and what they are. A line
/// that begins with blanks continues the previous one.
std::string facts_html(const std::string& description) {
  std::string html;
  std::istringstream lines(description);
  for (std::string line; std::getline(lines, line);) {
    constexpr std::size_t columns = 11;
    const std::string name = line.substr(0, std::min(line.find_last_not_of(' ', columns - 1) + 1, columns));
    const std::string what = escaped(line.substr(std::min(columns, line.size())));
    html += name.empty() && !html.empty()
                ? "<br>" + what
                : fmt::format("{}<dt>{}</dt><dd>{}", html.empty() ? "" : "</dd>\n", escaped(name), what);
  }
  return "<dl>\n" + html + (html.empty() ? "" : "</dd>\n") + "</dl>\n";
}

std::string asked(const RunArguments& arguments, const Scene& scene, const std::string& text) {
  return code_html(command_of(arguments)) + folded("The problem", facts_html(describe_scene(scene))) +
         folded("The scene as it was solved", code_html(text));
}

}  // namespace

std::string report_text(const RunArguments& arguments, const Scene& scene, const std::string& scene_text,
                        const Record& record, const Summary& summary, const std::vector<RecordFile>& files) {
  const std::string heading = heading_of(arguments, scene);
  PageParts page{.title = heading + ", Wavebalance", .scripts = {"motion.js"}};
  const std::string in_space = motion_in_space(files);
  if (!in_space.empty()) {
    page.libraries.push_back(Library::three);
    page.scripts.push_back("body.js");
  }
  page.body =
      section_html(
          "Results",
          paragraph(record.sentences.empty() ? finding_sentences(summary, common_gap(scene), record.axis)
                                             : record.sentences) +
              (record.figure.panels.empty() ? "" : record_picture(files, heading)) + motion(files) +
              in_space + paragraph(rest_sentences(scene, summary)) +
              folded_table(summary, "at_rest", "At rest under the static loads") +
              statistics_of_record(summary) +
              folded_table(summary, "period_intervals", "Intervals of one period") +
              folded_table(summary, "hysteresis", "Hysteresis") + motions_of_record(scene, summary)) +
      section_html(
          "Stability",
          sentences_html(stability_sentences(summary, record.axis)) +
              folded_table(summary, "structure_special_points", "Exact bifurcation and grazing points") +
              folded_table(summary, "special_points", "Bifurcation and grazing points") +
              folded_table(summary, "isolas", "Isolated branches (isolas)") +
              folded_table(summary, "special_points_of_isolas", "Bifurcation and grazing points of isolas")) +
      section_html("Accuracy", record.sentences.empty() ? sentences_html(accuracy_sentences(summary)) : "") +
      section_html("Outputs", outputs_of_record(record, files, summary)) +
      section_html("Motions at points of the curve", motions_of_points(record, files, summary)) +
      last_sections(record.warnings, asked(arguments, scene, scene_text), files, summary);
  return report_page(std::move(page), heading);
}

}  // namespace wavebalance::app
