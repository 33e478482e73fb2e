#include <pybind11/stl.h>

#include "bindings.hpp"
#include "scenes.hpp"
#include "unlocked.hpp"
#include "wavebalance/app/compare/comparison.hpp"

namespace wavebalance::python {

namespace py = pybind11;

void add_comparison(py::module_& module) {
  using app::ComparisonRecord;
  py::class_<ComparisonRecord>(module, "ComparisonRun")
      .def_readonly("converged", &ComparisonRecord::converged)
      .def_readonly("status", &ComparisonRecord::status)
      .def_readonly("warnings", &ComparisonRecord::warnings)
      .def_readonly("text", &ComparisonRecord::text)
      .def_readonly("markdown", &ComparisonRecord::markdown)
      .def_property_readonly("summary",
                             [](const ComparisonRecord& one) { return dictionary_of(one.summary); })
      .def_property_readonly("table", [](const ComparisonRecord& one) { return columns_of(one.table); })
      .def("svgs", [](const ComparisonRecord& one) {
        py::dict pictures;
        for (const app::RecordPicture& picture : one.pictures)
          pictures[py::str(picture.stem)] = app::render(picture.figure, app::PictureFormat::svg);
        return pictures;
      });
  module.def("compare_scene",
             [](const SceneSource& source, const std::string& pairs, const std::string& error, double budget,
                const std::string& start_from, int threads) {
               return unlocked([&](const solvers::Observer& observer) {
                 app::ComparisonOptions options;
                 if (!pairs.empty()) options.pairs = app::parse_pairs(pairs);
                 if (!error.empty()) options.measure = app::parse_error_measure(error);
                 options.budget = budget;
                 options.threads = threads;
                 if (!start_from.empty()) options.start = app::read_start_motion(start_from);
                 return app::compare_bases(scene_of(source), options, observer);
               });
             });
}

}  // namespace wavebalance::python
