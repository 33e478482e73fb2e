#include "command/commands.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "files/contains.hpp"
#include "report/words.hpp"
#include "wavebalance/app/analysis/cost_estimate.hpp"
#include "wavebalance/app/files/output.hpp"
#include "wavebalance/app/files/quantity_text.hpp"
#include "wavebalance/app/results/record.hpp"
#include "wavebalance/app/scene/contacts.hpp"

namespace wavebalance::app {
namespace {

std::string shown_value(const Cell& value) { return cell_text(value); }

std::string shown_value(const std::vector<double>& list) {
  constexpr std::size_t most = 6;
  if (list.empty()) return "none";
  const std::string shown = short_numbers(std::span(list).first(std::min(most, list.size())), 6);
  return list.size() <= most ? shown : fmt::format("{}, ... ({} in summary.json)", shown, list.size());
}

std::string shown_value(const std::vector<std::string>& list) {
  return list.empty() ? "none" : fmt::format("{}", fmt::join(list, "; "));
}

std::string shown_value(const Table& table) { return std::to_string(table.rows()) + " rows in summary.json"; }

std::string summary_text(const Summary& summary) {
  std::string text;
  for (const Entry& entry : summary) {
    const std::string shown = std::visit([](const auto& one) { return shown_value(one); }, entry.value);
    text += entry.name + std::string(entry.name.size() < 22 ? 22 - entry.name.size() : 1, ' ') + shown + "\n";
  }
  return text;
}

/// The first sentences of the report, a line each, and where to read on: eight lines at most.
std::string outcome_text(const RunArguments& arguments, const Scene& scene, const Record& record) {
  constexpr std::size_t most = 7, most_beside_stability = 4;
  const Summary& summary = record.summary;
  const auto outcome = record.sentences.empty() ? outcome_sentences(summary, common_gap(scene), record.axis)
                                                : record.sentences,
             stability = stability_sentences(summary, record.axis);
  const std::size_t first = std::min(outcome.size(), std::max(most_beside_stability,
                                                              most - std::min(most, stability.size()))),
                    second = std::min(stability.size(), most - first),
                    left_out = outcome.size() + stability.size() - first - second;
  std::string text;
  for (const std::string& one : std::span(outcome).first(first)) text += one + "\n";
  for (const std::string& one : std::span(stability).first(second)) text += one + "\n";
  const auto path = [&](const char* name) { return (arguments.output / name).string(); };
  if (!arguments.report) return text + "All values: " + path("summary.json") + "\n";
  return text + fmt::format("Report{}: {}; all values: summary.json, --verbose\n",
                            left_out > 0
                                ? fmt::format(" with {} more finding{}", left_out, left_out == 1 ? "" : "s")
                                : "",
                            path("report.html"));
}

void say_not_converged(const Scene& scene, const std::string& status) {
  std::fprintf(stderr, "wavebalance: not converged (%s)\n", status.c_str());
  std::string texts;
  for (const NextStep& step : next_steps(scene, status)) texts += (texts.empty() ? "" : "; ") + step.text;
  if (!texts.empty()) std::fprintf(stderr, "wavebalance: what may help: %s\n", texts.c_str());
}

void report(const RunArguments& arguments, const Scene& scene, const Record& record,
            const std::vector<RecordFile>& files) {
  if (!arguments.quiet && arguments.verbose)
    std::printf("%swritten to %s: %s\n", summary_text(record.summary).c_str(), arguments.output.c_str(),
                names_of(files).c_str());
  else if (!arguments.quiet)
    std::fputs(outcome_text(arguments, scene, record).c_str(), stdout);
  say_warnings(record.warnings);
  if (record.interrupted)
    std::fputs("wavebalance: interrupted; the results so far are written\n", stderr);
  else if (!record.converged)
    say_not_converged(scene, record.status);
}

void require_file(const std::filesystem::path& scene) {
  std::error_code ignored;
  if (std::filesystem::status(scene, ignored).type() == std::filesystem::file_type::not_found)
    throw std::invalid_argument(scene.string() +
                                ": there is no such file; `wavebalance init` writes a scene to start from");
}

}  // namespace

void take_analysis(RunArguments& arguments) {
  if (arguments.analysis.empty()) return;
  require_file(arguments.scene);
  std::vector<std::string> names =
      keys_beside_analysis(arguments.scene, arguments.analysis, arguments.overrides);
  std::erase_if(names, [&](const std::string& name) { return contains(arguments.removed, name); });
  if (!names.empty() && !arguments.quiet)
    std::fprintf(stderr, "wavebalance: left out for analysis.type = \"%s\": %s\n", arguments.analysis.c_str(),
                 fmt::format("{}", fmt::join(names, ", ")).c_str());
  arguments.removed.insert(arguments.removed.end(), names.begin(), names.end());
  arguments.overrides.insert(arguments.overrides.begin(), "analysis.type=" + arguments.analysis);
}

Scene given_scene(const RunArguments& arguments) {
  require_file(arguments.scene);
  return load_scene(arguments.scene, arguments.overrides, arguments.removed);
}

int run_scene(const RunArguments& arguments) {
  require_output(arguments.output);
  const Scene scene = given_scene(arguments);
  check_memory(scene, arguments.max_memory);
  const StartMotion start =
      arguments.start_from.empty() ? StartMotion{} : read_start_motion(arguments.start_from);
  require_start_fits(start, scene);
  const std::string advice = slow_stepping_advice(scene);
  if (!advice.empty() && !arguments.quiet) std::fprintf(stderr, "wavebalance: %s\n", advice.c_str());
  check_run_output(arguments, scene);
  OutputFiles files(arguments.output);
  InterruptGuard guard(kind_of(scene.analysis.type).keeps_part);
  const Record record = until_signal(guard, arguments.quiet, [&](const Observer& observer) {
    return analyse(scene, {.start = start, .observer = observer, .threads = arguments.threads});
  });
  if (record.interrupted && record.sweep.empty() && record.section.empty() && record.files.empty())
    guard.end_program();
  const RunFiles results = run_files(arguments, scene, record);
  say_no_picture(results.no_picture);
  guard.defer();
  write_run_files(files, results, inputs_of(arguments.scene, scene, arguments.start_from));
  report(arguments, scene, record, results.files);
  if (record.interrupted) return interrupted + guard.signal();
  return record.converged ? solved : not_converged;
}

int check_scene(const RunArguments& arguments) { return print(describe_scene(given_scene(arguments))); }

int print(const std::string& text) {
  if (std::fputs(text.c_str(), stdout) < 0 || std::fflush(stdout) != 0)
    throw IoError("standard output", std::string("cannot be written: ") + std::strerror(errno));
  return solved;
}

void require_output(const std::filesystem::path& output) {
  if (output.empty())
    throw std::invalid_argument(
        "--output is \"\"; expected the name of a folder, which is made if it is missing");
}

std::string names_of(const std::vector<RecordFile>& files) {
  std::string list = "summary.json";
  for (const RecordFile& file : files)
    if (!file.name.ends_with(".vtu")) list += ", " + file.name;
  return list;
}

void say_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& one : warnings) std::fprintf(stderr, "wavebalance: warning: %s\n", one.c_str());
}

void say_no_picture(const std::string& reason) {
  if (!reason.empty()) std::fprintf(stderr, "wavebalance: no picture: %s\n", reason.c_str());
}

Scene example_scene() {
  Scene scene;
  scene.structure.youngs_modulus = 70e9;
  scene.structure.density = 2700.0;
  scene.structure.area = 25e-4;
  scene.structure.length = 1.0;
  scene.structure.elements = 25;
  scene.structure.stiffness_damping = 1e-4;
  scene.contact = {.law = "exponential", .values = {{"constant", 1e8}, {"exponent", 50.0}}, .gap = 1e-3};
  scene.forcing = {.amplitude = 250e3, .frequency = 150.0};
  scene.time = {"fourier", "fourier", 63, Formulation::distributional, 256, InnerProducts::quadrature};
  scene.analysis.exact_near = true;  // as of a file that leaves it out
  return scene;
}

}  // namespace wavebalance::app
