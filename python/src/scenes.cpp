#include "scenes.hpp"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "bindings.hpp"
#include "report/reports.hpp"
#include "unlocked.hpp"
#include "wavebalance/app/analysis/cost_estimate.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/plot/plot.hpp"
#include "wavebalance/app/results/record.hpp"
#include "wavebalance/fem/matrix_market.hpp"

namespace wavebalance::python {

namespace py = pybind11;

app::Scene scene_of(const SceneSource& source) {
  if (source.text.empty()) return app::load_scene(source.name, source.overrides, source.removed);
  return app::parse_scene(source.text, source.name, source.overrides, source.removed);
}

namespace {

/// A scene and what came of it.
struct Run {
  app::RunArguments arguments;
  app::Scene scene;
  app::Record record;
};

app::InputFiles inputs_of(const app::RunArguments& arguments, const app::Scene& scene) {
  return app::inputs_of(arguments.scene, scene, arguments.start_from);
}

/// The folder is tried before the solution, so that nothing is computed that cannot be written.
Run run_scene(const SceneSource& source, const std::string& output, const std::string& start_from,
              int threads, bool copy_inputs, const solvers::Observer& observer) {
  Run run;
  run.arguments.scene = source.name;
  run.arguments.output = output;
  run.arguments.overrides = source.overrides;
  run.arguments.removed = source.removed;
  run.arguments.start_from = start_from;
  run.arguments.copy_inputs = copy_inputs;
  run.scene = scene_of(source);
  app::check_memory(run.scene, 0.0);
  const app::StartMotion start = start_from.empty() ? app::StartMotion{} : app::read_start_motion(start_from);
  app::require_start_fits(start, run.scene);
  std::optional<app::OutputFiles> files;
  if (!output.empty()) app::check_run_output(run.arguments, run.scene);
  if (!output.empty()) files.emplace(output);
  run.record = app::analyse(run.scene, {.start = start, .observer = observer, .threads = threads});
  if (files && !run.record.interrupted)
    app::write_run_files(*files, app::run_files(run.arguments, run.scene, run.record),
                         inputs_of(run.arguments, run.scene));
  return run;
}

void write(const Run& run, const std::string& output) {
  app::RunArguments arguments = run.arguments;
  arguments.output = output;
  app::OutputFiles files(output);
  app::write_run_files(files, app::run_files(arguments, run.scene, run.record),
                       inputs_of(arguments, run.scene));
}

std::string picture(const app::Figure& figure) {
  return figure.panels.empty() ? std::string() : app::render(figure, app::PictureFormat::svg);
}

}  // namespace

void add_scenes(py::module_& module) {
  py::class_<SceneSource>(module, "SceneSource")
      .def(py::init<std::string, std::string, std::vector<std::string>, std::vector<std::string>>(),
           py::arg("text"), py::arg("name"), py::arg("overrides"), py::arg("removed"))
      .def_readonly("text", &SceneSource::text)
      .def_readonly("name", &SceneSource::name)
      .def_readonly("overrides", &SceneSource::overrides)
      .def_readonly("removed", &SceneSource::removed)
      .def_readwrite("temporary", &SceneSource::temporary);
  py::class_<Run>(module, "Run")
      .def_property_readonly("converged", [](const Run& run) { return run.record.converged; })
      .def_property_readonly("status", [](const Run& run) { return run.record.status; })
      .def_property_readonly("warnings", [](const Run& run) { return run.record.warnings; })
      .def_property_readonly("bar_motion", [](const Run& run) { return run.record.bar_motion; })
      .def_property_readonly("summary", [](const Run& run) { return dictionary_of(run.record.summary); })
      .def_property_readonly("tables",
                             [](const Run& run) {
                               py::dict tables;
                               for (const app::RecordTable& one : app::record_tables)
                                 tables[one.name] = columns_of(run.record.*one.table);
                               return tables;
                             })
      .def_property_readonly("scene", [](const Run& run) { return app::write_scene(run.scene); })
      .def("svg",
           [](const Run& run) {
             return unlocked([&](const solvers::Observer&) { return picture(run.record.figure); });
           })
      .def("write", [](const Run& run, const std::string& output) {
        unlocked([&](const solvers::Observer&) { return write(run, output), true; });
      });
  module.def("run_scene", [](const SceneSource& source, const std::string& output,
                             const std::string& start_from, int threads, bool copy_inputs) {
    return unlocked([&](const solvers::Observer& observer) {
      return run_scene(source, output, start_from, threads, copy_inputs, observer);
    });
  });
  module.def("matrix_market_text",
             [](const Eigen::SparseMatrix<double>& matrix) { return fem::matrix_market_text(matrix); });
  module.def("describe_scene",
             [](const SceneSource& source) { return app::describe_scene(scene_of(source)); });
  module.def("complete_scene", [](const SceneSource& source) { return app::write_scene(scene_of(source)); });
}

}  // namespace wavebalance::python
