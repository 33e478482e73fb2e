#include "command/commands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <span>

#include "command/bar_motion.hpp"
#include "command/interrupt_guard.hpp"
#include "command/progress_bar.hpp"
#include "command/run_report.hpp"
#include "wavebalance/app/analysis/analysis.hpp"
#include "wavebalance/app/analysis/cost_estimate.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"
#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/app/files/output.hpp"
#include "wavebalance/app/plot/figure_script.hpp"

namespace wavebalance::app {
namespace {

constexpr const char* report_name = "report.html";

/// Without gnuplot the numbers are still written. The picture is left out, with a message on standard error.
std::string picture(const Figure& figure) {
  try {
    return render(figure, PictureFormat::svg);
  } catch (const PlotError& error) {
    std::fprintf(stderr, "wavebalance: no picture: %s\n", error.what());
    return "";
  }
}

void append_table(std::vector<ResultFile>& files, const std::string& name, const Table& table,
                  const std::string& about) {
  if (!table.empty()) files.push_back({name, csv_text(table), about});
}

void append_picture(std::vector<ResultFile>& files, const Record& record, bool report) {
  if (record.figure.panels.empty()) return;
  const std::string stem = !record.sweep.empty()      ? "sweep"
                           : !record.backbone.empty() ? "backbone"
                                                      : "response";
  const std::string drawn = picture(record.figure);
  if (drawn.empty()) return;
  files.push_back({stem + ".svg", drawn, "the picture"});
  if (report && has_curves(record.figure))
    files.push_back({stem + ".figure.js", figure_script(record.figure, stem), "the curves of report.html"});
}

/// All files but the summary; with `report` first the report, still without contents.
std::vector<ResultFile> result_files(const Scene& scene, const Record& record, bool report) {
  std::vector<ResultFile> files;
  if (report) files.push_back({report_name, "", "what was asked and what came out, to read in a browser"});
  files.push_back({"scene.toml", write_scene(scene), "the scene as it was solved"});
  append_table(files, "response.csv", record.response,
               "motion of the leading contact degree of freedom over one period");
  append_table(files, "contacts.csv", record.contacts,
               "every contact degree of freedom over one period; displacements towards the obstacles");
  for (const RecordFile& file : record.files) files.push_back({file.name, file.contents, file.about});
  append_table(files, "sweep.csv", record.sweep, "periodic responses along the curve");
  append_table(files, "backbone.csv", record.backbone, "a nonlinear mode over its energy");
  append_picture(files, record, report);
  if (report && has_bar_motion(scene, record))
    files.push_back({"response.motion.js", bar_motion_script(scene, record, "response"),
                     "the moving bar of report.html"});
  return files;
}

/// The record's summary, with its scene and the list of its files.
Summary whole_summary(const RunArguments& arguments, const Record& record,
                      const std::vector<ResultFile>& files) {
  Summary summary = record.summary;
  summary.emplace_back("scene", arguments.scene.string());
  summary.emplace_back("set", arguments.overrides);
  summary.emplace_back("unset", arguments.removed);
  summary.emplace_back("version", std::string(version()));
  Table list({"name", "about"});
  for (const ResultFile& file : files) list.append_row({file.name, file.about});
  summary.emplace_back("files", std::move(list));
  return summary;
}

std::string shown_value(const Cell& value) { return cell_text(value); }

std::string shown_value(const std::vector<double>& list) {
  constexpr std::size_t most = 6;
  if (list.empty()) return "none";
  const std::string shown =
      fmt::format("{:.6g}", fmt::join(std::span(list).first(std::min(most, list.size())), ", "));
  return list.size() <= most ? shown : fmt::format("{}, ... ({} in summary.json)", shown, list.size());
}

std::string shown_value(const std::vector<std::string>& list) {
  return list.empty() ? "none" : fmt::format("{}", fmt::join(list, "; "));
}

std::string shown_value(const Table& table) { return std::to_string(table.rows()) + " rows in summary.json"; }

std::string summary_text(const Summary& summary) {
  std::string text;
  for (const auto& [name, value] : summary) {
    const std::string shown = std::visit([](const auto& one) { return shown_value(one); }, value);
    text += name + std::string(name.size() < 22 ? 22 - name.size() : 1, ' ') + shown + "\n";
  }
  return text;
}

void report(const RunArguments& arguments, const Record& record, const std::vector<ResultFile>& files) {
  if (!arguments.quiet) {
    std::fputs(summary_text(record.summary).c_str(), stdout);
    std::string list = "summary.json";
    for (const ResultFile& file : files)
      if (!file.name.ends_with(".vtu")) list += ", " + file.name;
    std::printf("written to %s: %s\n", arguments.output.c_str(), list.c_str());
  }
  for (const auto& warning : record.warnings)
    std::fprintf(stderr, "wavebalance: warning: %s\n", warning.c_str());
  if (record.interrupted)
    std::fputs("wavebalance: interrupted; the record holds the points so far\n", stderr);
  else if (!record.converged)
    std::fprintf(stderr, "wavebalance: not converged (%s); the record says so\n", record.status.c_str());
}

/// Throws if a scene is expected to take more memory than the machine has, before any is allocated.
void check_memory(const Scene& scene, double max_gigabytes) {
  const double needed = estimate_cost(scene).bytes;
  const double limit = max_gigabytes > 0.0 ? 1e9 * max_gigabytes : available_memory();
  if (needed <= limit) return;
  const std::string there = max_gigabytes > 0.0 ? "--max-memory allows " : "there are ";
  throw std::invalid_argument("this scene would take about " + memory_text(needed) + " of memory and " +
                              there + memory_text(limit) +
                              "; fewer functions, quadrature_points or output_points take less");
}

/// Solves with a progress bar, unless `quiet`, until the guard has noted a signal. Ends the program if that
/// was before anything was solved.
Record solve(const Scene& scene, const StartMotion& start, const InterruptGuard& guard, bool quiet) {
  ProgressBar bar;
  try {
    return analyse(scene, start, [&](const Progress& progress) {
      if (!quiet) bar.show(progress);
      return guard.signal() == 0;
    });
  } catch (const ReductionCancelled&) {
    bar.finish();
    guard.end_program();
  }
}

/// Writes all files at once, in place of those of an earlier record. The summary is last, so that it exists
/// only if the others do.
void write(OutputFiles& files, const std::vector<ResultFile>& results, const std::string& summary) {
  files.replace(files_of_record(files.directory() / "summary.json"));
  for (const ResultFile& file : results) files.add(file.name, file.contents);
  files.add("summary.json", summary);
  files.commit();
}

}  // namespace

int run_scene(const RunArguments& arguments) {
  if (arguments.output.empty())
    throw std::invalid_argument(
        "--output is \"\"; expected the name of a folder, which is made if it is missing");
  const Scene scene = load_scene(arguments.scene, arguments.overrides, arguments.removed);
  check_memory(scene, arguments.max_memory);
  const StartMotion start =
      arguments.start_from.empty() ? StartMotion{} : read_start_motion(arguments.start_from);
  require_start_fits(start, scene);
  const std::string advice = slow_stepping_advice(scene);
  if (!advice.empty() && !arguments.quiet) std::fprintf(stderr, "wavebalance: %s\n", advice.c_str());
  OutputFiles files(arguments.output);
  InterruptGuard guard(scene.analysis.type == AnalysisType::frequency_sweep ||
                       scene.analysis.type == AnalysisType::amplitude_sweep);
  const Record record = solve(scene, start, guard, arguments.quiet);
  if (record.interrupted && record.sweep.empty()) guard.end_program();
  std::vector<ResultFile> results = result_files(scene, record, arguments.report);
  const Summary summary = whole_summary(arguments, record, results);
  if (arguments.report) results.front().contents = report_text(arguments, scene, record, summary, results);
  guard.defer();
  write(files, results, json_text(summary));
  report(arguments, record, results);
  if (record.interrupted) return interrupted + guard.signal();
  return record.converged ? solved : not_converged;
}

int check_scene(const RunArguments& arguments) {
  return print(describe_scene(load_scene(arguments.scene, arguments.overrides, arguments.removed)));
}

int print(const std::string& text) {
  if (std::fputs(text.c_str(), stdout) < 0 || std::fflush(stdout) != 0)
    throw IoError("standard output", std::string("cannot be written: ") + std::strerror(errno));
  return solved;
}

Scene example_scene() {
  Scene scene;
  scene.structure.youngs_modulus = 70e9;
  scene.structure.density = 2700.0;
  scene.structure.area = 25e-4;
  scene.structure.length = 1.0;
  scene.structure.elements = 25;
  scene.structure.stiffness_damping = 1e-4;
  scene.contact = {.law = ContactLawType::exponential, .constant = 1e8, .exponent = 50.0, .gap = 1e-3};
  scene.forcing = {.amplitude = 250e3, .frequency = 150.0};
  scene.time = {"fourier", "fourier", 63, Formulation::distributional, 256, InnerProducts::quadrature};
  return scene;
}

}  // namespace wavebalance::app
