#include "command/commands.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "command/interrupt_guard.hpp"
#include "command/progress_bar.hpp"
#include "wavebalance/app/analysis/analysis.hpp"
#include "wavebalance/app/files/output.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"

namespace wavebalance::app {
namespace {

std::string scene_label(const RunArguments& arguments) {
  std::string label = arguments.scene.string();
  for (const auto& text : arguments.overrides) label += " --set " + text;
  return label;
}

CsvHeading heading(const std::string& what, const RunArguments& arguments, const Record& record) {
  CsvHeading result{what, "SI; a column's name ends in its unit", scene_label(arguments), {}};
  if (!record.converged) result.notes.push_back("NOT CONVERGED (" + record.status + ")");
  return result;
}

/// A missing gnuplot must not cost the numbers: the picture is left out, and that is said.
std::string picture(const Figure& figure) {
  try {
    return render(figure, PictureFormat::svg);
  } catch (const PlotError& error) {
    std::fprintf(stderr, "wavebalance: no picture: %s\n", error.what());
    return "";
  }
}

std::vector<std::string> stage(OutputFiles& files, const Scene& scene, const Record& record,
                               const RunArguments& arguments) {
  std::vector<std::string> names;
  const auto add = [&](const std::string& name, const std::string& contents) {
    files.add(name, contents);
    names.push_back(name);
  };
  add("scene.toml", write_scene(scene));
  add("summary.json", json_text(record.summary));
  if (!record.response.empty())
    add("response.csv",
        csv_text(record.response,
                 heading("Motion of the contact degree of freedom over one period", arguments, record)));
  if (!record.contacts.empty())
    add("contacts.csv", csv_text(record.contacts, heading("Every contact degree of freedom over one period; "
                                                          "displacements towards the obstacles",
                                                          arguments, record)));
  for (const RecordFile& file : record.files) add(file.name, file.contents);
  if (!record.sweep.empty())
    add("sweep.csv", csv_text(record.sweep, heading("Periodic responses along the frequency response curve",
                                                    arguments, record)));
  if (!record.backbone.empty())
    add("backbone.csv",
        csv_text(record.backbone, heading("A nonlinear mode over its energy", arguments, record)));
  if (record.figure.panels.empty()) return names;
  const std::string drawn = picture(record.figure);
  const std::string stem = !record.sweep.empty()      ? "sweep"
                           : !record.backbone.empty() ? "backbone"
                                                      : "response";
  if (!drawn.empty()) add(stem + ".svg", drawn);
  return names;
}

std::string shown_value(const Cell& value) { return cell_text(value); }

std::string shown_value(const std::vector<double>& list) {
  std::string shown;
  for (const double one : list) shown += (shown.empty() ? "" : ", ") + cell_text(one);
  return shown;
}

std::string shown_value(const std::vector<std::string>& list) {
  std::string shown;
  for (const auto& one : list) shown += (shown.empty() ? "" : "; ") + one;
  return list.empty() ? "none" : shown;
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

void report(const RunArguments& arguments, const Record& record, const std::vector<std::string>& names) {
  if (!arguments.quiet) {
    std::fputs(summary_text(record.summary).c_str(), stdout);
    std::string list;
    for (const auto& name : names)
      if (!name.ends_with(".vtu")) list += (list.empty() ? "" : ", ") + name;
    std::printf("written to %s: %s\n", arguments.output.c_str(), list.c_str());
  }
  for (const auto& warning : record.warnings)
    std::fprintf(stderr, "wavebalance: warning: %s\n", warning.c_str());
  if (!record.converged)
    std::fprintf(stderr, "wavebalance: not converged (%s); the record says so\n", record.status.c_str());
}

}  // namespace

int run_scene(const RunArguments& arguments) {
  const Scene scene = load_scene(arguments.scene, arguments.overrides);
  OutputFiles files(arguments.output);
  const InterruptGuard guard(files);
  ProgressBar bar;
  Observer observer;
  if (!arguments.quiet) observer = [&bar](const Progress& progress) {
      bar.show(progress);
      return true;
    };
  const Record record = analyse(scene, observer);
  bar.finish();
  const auto names = stage(files, scene, record, arguments);
  files.commit();
  report(arguments, record, names);
  return record.converged ? solved : not_converged;
}

int check_scene(const std::filesystem::path& scene, const std::vector<std::string>& overrides) {
  return print(describe_scene(load_scene(scene, overrides)));
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
  scene.time = {"fourier", "fourier", 64, Formulation::distributional, 256, InnerProducts::quadrature};
  return scene;
}

}  // namespace wavebalance::app
