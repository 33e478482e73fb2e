#include <pybind11/stl.h>

#include "bindings.hpp"
#include "report/reports.hpp"
#include "scenes.hpp"
#include "unlocked.hpp"
#include "wavebalance/app/files/output.hpp"
#include "wavebalance/app/study/study.hpp"

namespace wavebalance::python {

namespace py = pybind11;

namespace {

/// A study with its runs, made again from the same texts in other processes.
class StudyPlan {
 public:
  StudyPlan(std::string text, std::string name, std::string scene)
      : text_(std::move(text)),
        name_(std::move(name)),
        scene_(std::move(scene)),
        study_(app::parse_study(text_, name_, scene_)),
        runs_(study_) {}

  const app::Study& study() const { return study_; }
  const app::StudyRuns& runs() const { return runs_; }
  py::tuple state() const { return py::make_tuple(text_, name_, scene_); }

  std::vector<std::string> solve(const std::vector<std::int64_t>& which,
                                 const solvers::Observer& observer) const {
    std::vector<std::string> lines;
    app::LastStructure last;
    for (const std::int64_t run : which) {
      if (run < 0 || run >= runs_.size()) throw std::out_of_range("StudyPlan.solve: there is no such run");
      lines.push_back(app::json_line(app::solve_run(study_, runs_, run, last, observer)));
    }
    return lines;
  }

 private:
  std::string text_, name_, scene_;
  app::Study study_;
  app::StudyRuns runs_;
};

/// The rows of a study, in a journal if it has a folder.
class StudySession {
 public:
  StudySession(std::shared_ptr<const StudyPlan> plan, std::string output)
      : plan_(std::move(plan)), output_(std::move(output)) {
    if (output_.empty()) return;
    app::check_study_output(arguments(output_), inputs(output_));
    files_.emplace(output_);
    journal_.emplace(output_, plan_->study(), plan_->runs());
    rows_ = journal_->take_rows();
    unreadable_lines_ = journal_->unreadable_lines();
  }

  std::vector<std::int64_t> missing() const { return app::missing_runs(rows_, plan_->runs().size()); }

  void add(const std::vector<std::string>& lines) {
    for (const std::string& line : lines) keep(app::parse_row(line));
    outcome_.solved += static_cast<std::int64_t>(lines.size());
  }

  void solve(int threads, const solvers::Observer& observer) {
    app::StudyOptions options;
    options.threads = threads;
    outcome_ = app::run_study(
        plan_->study(), plan_->runs(), missing(), options, [&](const app::StudyRow& row) { keep(row); },
        observer);
  }

  app::StudyRecord finish(double wall_seconds) {
    if (wall_seconds > 0.0) outcome_.wall_seconds = wall_seconds;
    app::StudyRecord record =
        app::study_record(plan_->study(), plan_->runs(), rows_, outcome_, unreadable_lines_);
    if (files_)
      app::write_run_files(*files_, app::study_files(arguments(output_), plan_->study(), record),
                           inputs(output_));
    return record;
  }

  /// Ends the journal, so that other studies may go on in its folder.
  void close() {
    journal_.reset();
    files_.reset();
  }

  app::StudyArguments arguments(const std::string& output) const {
    app::StudyArguments arguments;
    arguments.study = plan_->study().name;
    arguments.output = output;
    return arguments;
  }

  void write(const app::StudyRecord& record, const std::string& output) const {
    app::OutputFiles files(output);
    app::write_run_files(files, app::study_files(arguments(output), plan_->study(), record), inputs(output));
  }

 private:
  app::InputFiles inputs(const std::string& output) const {
    return app::inputs_of(arguments(output), plan_->study(), plan_->runs());
  }

  void keep(const app::StudyRow& row) {
    if (journal_) journal_->append(row);
    rows_.push_back(row);
  }

  std::shared_ptr<const StudyPlan> plan_;
  std::string output_;
  std::optional<app::OutputFiles> files_;
  std::optional<app::StudyJournal> journal_;
  std::vector<app::StudyRow> rows_;
  std::int64_t unreadable_lines_ = 0;
  app::StudyOutcome outcome_;
};

std::string drawn(const app::StudyRecord& record) {
  return record.pictures.empty() ? std::string()
                                 : app::render(record.pictures.front().figure, app::PictureFormat::svg);
}

void add_session(py::module_& module) {
  py::class_<StudySession>(module, "StudySession")
      .def(py::init<std::shared_ptr<StudyPlan>, std::string>())
      .def("missing", &StudySession::missing)
      .def("add", &StudySession::add)
      .def("solve",
           [](StudySession& session, int threads) {
             unlocked([&](const solvers::Observer& observer) {
               session.solve(threads, observer);
               return true;
             });
           })
      .def("finish",
           [](StudySession& session, double wall_seconds) {
             return unlocked([&](const solvers::Observer&) { return session.finish(wall_seconds); });
           })
      .def("close", &StudySession::close)
      .def("write", &StudySession::write);
}

}  // namespace

void add_studies(py::module_& module) {
  py::class_<StudyPlan, std::shared_ptr<StudyPlan>>(module, "StudyPlan")
      .def(py::init<std::string, std::string, std::string>(), py::arg("text"), py::arg("name"),
           py::arg("scene"))
      .def("__len__", [](const StudyPlan& plan) { return plan.runs().size(); })
      .def("check", [](const StudyPlan& plan) { app::check_study(plan.study(), plan.runs()); })
      .def("overrides", [](const StudyPlan& plan, std::int64_t run) { return plan.runs().overrides(run); })
      .def("solve",
           [](const StudyPlan& plan, const std::vector<std::int64_t>& which) {
             return unlocked([&](const solvers::Observer& observer) { return plan.solve(which, observer); });
           })
      .def(py::pickle([](const StudyPlan& plan) { return plan.state(); },
                      [](const py::tuple& state) {
                        return std::make_shared<StudyPlan>(state[0].cast<std::string>(),
                                                           state[1].cast<std::string>(),
                                                           state[2].cast<std::string>());
                      }));
  using app::StudyRecord;
  py::class_<StudyRecord>(module, "StudyRun")
      .def_readonly("converged", &StudyRecord::converged)
      .def_readonly("status", &StudyRecord::status)
      .def_readonly("warnings", &StudyRecord::warnings)
      .def_property_readonly("summary", [](const StudyRecord& one) { return dictionary_of(one.summary); })
      .def_property_readonly("table", [](const StudyRecord& one) { return columns_of(one.table); })
      .def("svg", [](const StudyRecord& one) {
        return unlocked([&](const solvers::Observer&) { return drawn(one); });
      });
  add_session(module);
}

}  // namespace wavebalance::python
