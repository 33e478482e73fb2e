#include "report/reports.hpp"

#include <fmt/format.h>

#include "report/page_parts.hpp"
#include "wavebalance/app/files/record_folder.hpp"
#include "wavebalance/app/plot/figure_script.hpp"
#include "wavebalance/app/scene/scene_writer.hpp"

namespace wavebalance::app {
namespace {

constexpr const char* report_name = "report.html";

void append_record_pictures(RunFiles& run, const Record& record, bool report) {
  if (record.figure.panels.empty()) return;
  const std::string stem = !record.sweep.empty()                                ? "sweep"
                           : !record.backbone.empty()                           ? "backbone"
                           : !record.section.empty() && record.response.empty() ? "bifurcation"
                                                                                : "response";
  std::vector<RecordPicture> pictures{{stem, record.figure, "the picture"}};
  for (const auto* more : {&record.output_pictures, &record.motion_pictures})
    pictures.insert(pictures.end(), more->begin(), more->end());
  run.no_picture = append_pictures(run.files, pictures, report);
}

constexpr std::string_view copied = "input_";  // how the names of copies begin

/// All files but the summary; with arguments.report first the report, still without contents. `scene`
/// belongs to the record; `inputs` are copies of its files.
RunFiles result_files(const RunArguments& arguments, const Scene& scene, const Record& record,
                      std::vector<RecordFile> inputs) {
  const bool report = arguments.report;
  RunFiles run;
  std::vector<RecordFile>& files = run.files;
  if (report) files.push_back({report_name, "", "the report of this run"});
  files.push_back({"scene.toml", write_scene(scene), "the scene as it was solved"});
  for (RecordFile& input : inputs) files.push_back(std::move(input));
  for (const auto& [name, table, about] : record_tables)
    if (!(record.*table).empty())
      files.push_back({std::string(name) + ".csv", csv_text(record.*table), about});
  files.insert(files.end(), record.files.begin(), record.files.end());
  append_record_pictures(run, record, report);
  if (report && has_bar_motion(scene, record))
    files.push_back({"response.motion.js", bar_motion_script(scene, record, "response"),
                     "the moving bar of report.html"});
  return run;
}

/// Whether a run of the scene may write a file of this name.
bool may_write(const RunArguments& arguments, const Scene& scene, const std::string& name) {
  const bool report = arguments.report;
  if (is_copy(name)) return arguments.copy_inputs;
  if (name == "summary.json" || name == "scene.toml") return true;
  if (name == report_name) return report;
  const AnalysisType type = scene.analysis.type;
  const bool sweep = type == AnalysisType::frequency_sweep || type == AnalysisType::amplitude_sweep;
  const bool curve = sweep || (type == AnalysisType::nonlinear_mode && scene.analysis.energy_ratio == 0.0 &&
                               scene.analysis.amplitude_ratio == 0.0);
  const std::string stem = sweep ? "sweep" : curve ? "backbone" : "response";
  for (const char* end : {".csv", ".svg", ".figure.js", ".motion.js"})
    if (name == stem + end) return true;
  if (integrates_in_time(type) && (name == "section.csv" || name.starts_with("bifurcation."))) return true;
  if (name == "contacts.csv") return !curve;
  if (name.starts_with("outputs.")) return scene.analysis.has_outputs();
  if (name.starts_with("campbell.") || name.starts_with("orbits."))  // of a rotor
    return scene.structure.type == StructureType::matrices;
  const bool motions =
      scene.analysis.motion_points > 0 || !scene.analysis.motion_at.empty() || type == AnalysisType::motions;
  return motions && (name.starts_with("motion.") || name.starts_with("motion_"));
}

/// The record's summary, with its scene and the list of its files.
Summary whole_summary(const RunArguments& arguments, const Record& record,
                      const std::vector<RecordFile>& files) {
  Summary summary = record.summary;
  summary.emplace_back("scene", arguments.scene.string());
  summary.emplace_back("set", arguments.overrides);
  summary.emplace_back("unset", arguments.removed);
  append_files(summary, files);
  return summary;
}

}  // namespace

bool is_copy(std::string_view name) { return name.starts_with(copied); }

Scene scene_of_record(const RunArguments& arguments, const Scene& scene, std::vector<RecordFile>& files) {
  if (!arguments.copy_inputs)
    return relative_to(scene, arguments.output, std::filesystem::absolute(arguments.scene).parent_path());
  std::map<std::string, std::string> names;
  return with_files(scene, [&](const std::string& place) {
    const std::string file = file_of_input(place), of_several = place.substr(file.size());
    std::string& name = names[file];
    if (!name.empty()) return name + of_several;
    const std::string base = std::filesystem::path(file).filename().string();
    name = std::string(copied) + base;
    for (int number = 2; holds_file(files, name); ++number)
      name = fmt::format("{}{}_{}", copied, number, base);
    files.push_back({name, read_file(file), "copy of " + base + ", which the scene names"});
    return name + of_several;
  });
}

RunFiles run_files(const RunArguments& arguments, const Scene& scene, const Record& record) {
  std::vector<RecordFile> inputs;
  const Scene written = scene_of_record(arguments, scene, inputs);
  RunFiles run = result_files(arguments, written, record, std::move(inputs));
  const Summary summary = whole_summary(arguments, record, run.files);
  if (arguments.report)
    run.files.front().contents =
        report_text(arguments, scene, write_scene(written), record, summary, run.files);
  run.summary = json_text(summary);
  return run;
}

std::string append_pictures(std::vector<RecordFile>& files, const std::vector<RecordPicture>& pictures,
                            bool curves) {
  try {
    for (const RecordPicture& picture : pictures) {
      files.push_back({picture.stem + ".svg", render(picture.figure, PictureFormat::svg), picture.about});
      if (curves && has_curves(picture.figure))
        files.push_back({picture.stem + ".figure.js", figure_script(picture.figure, picture.stem),
                         "the curves of report.html"});
    }
  } catch (const PlotError& error) {
    return error.what();
  }
  return "";
}

InputFiles inputs_of(const std::filesystem::path& file, const Scene& scene,
                     const std::filesystem::path& start) {
  InputFiles inputs{file};
  for (const std::string& named : input_files(scene)) inputs.emplace_back(named);
  if (start.empty()) return inputs;
  std::error_code ignored;
  if (!std::filesystem::is_directory(start, ignored)) inputs.push_back(start);
  for (const char* name : {"summary.json", "response.csv", "contacts.csv"})
    inputs.push_back((std::filesystem::is_directory(start, ignored) ? start : start.parent_path()) / name);
  return inputs;
}

void check_run_output(const RunArguments& arguments, const Scene& scene) {
  require_replaceable(
      arguments.output, [&](const std::string& name) { return may_write(arguments, scene, name); },
      inputs_of(arguments.scene, scene, arguments.start_from));
}

void write_run_files(OutputFiles& output, const RunFiles& files, const InputFiles& inputs) {
  const auto writes = [&](const std::string& name) {
    return name == "summary.json" || holds_file(files.files, name);
  };
  require_replaceable(output.directory(), writes, inputs);
  output.replace(files_of_record(output.directory() / "summary.json"));
  for (const RecordFile& file : files.files) output.add(file.name, file.contents);
  output.add("summary.json", files.summary);
  output.commit();
}

}  // namespace wavebalance::app
