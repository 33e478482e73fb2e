#include <cstdio>
#include <functional>
#include <iterator>
#include <utility>

#include "cheapest_table.hpp"
#include "data_file.hpp"
#include "picture.hpp"
#include "points.hpp"
#include "program.hpp"
#include "wavebalance/app/compare/solve_point.hpp"
#include "wavebalance/app/files/output.hpp"
#include "wavebalance/app/files/table.hpp"

// Error over solve time for every pair of bases: work_precision.csv and its pictures.
namespace wavebalance::bench {
namespace {

app::Table empty_table() {
  return app::Table({"case", "method", "trial", "weight", "inner_products", "functions", "points",
                     "tolerance", "construction_seconds", "seconds", "error", "converged", "status",
                     "on_front"});
}

void append(app::Table& table, const Study& study, const std::vector<Point>& points) {
  for (const Point& p : points)
    table.append_row({study.name, p.method, p.pair.trial, p.pair.weight, p.inner_products,
                      std::int64_t{p.functions}, std::int64_t{p.points}, p.tolerance, p.construction_seconds,
                      p.seconds, p.error, p.converged, p.status, p.on_front});
}

void append(std::vector<Point>& points, std::vector<Point> more) {
  points.insert(points.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

/// Runs expected to exceed `max_seconds` are skipped.
app::SizeStudyOptions sizes(bool quick, std::vector<int> quick_points, double max_seconds) {
  app::SizeStudyOptions options;
  options.functions = quick ? std::vector{4, 16} : std::vector{4, 8, 16, 32, 64, 128, 256, 512, 1024};
  options.points_per_function = quick ? std::move(quick_points) : std::vector{1, 2, 4, 8, 16};
  options.max_seconds = quick ? 0.2 : max_seconds;
  options.without_equals = false;
  return options;
}

std::vector<double> exact_tolerances(bool quick) {
  if (quick) return {1e-3};
  return {1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12};
}

std::vector<Point> penalty_points(const Study& study, bool quick) {
  std::vector<Point> points = app::size_study(study.measured, pairs(), sizes(quick, {2}, 0.5));
  append(points, dense_points(study, quick ? std::vector{3, 7} : std::vector{3, 7, 15, 31, 63}, 2.0));
  append(points, time_stepping_points(study, quick ? std::vector{1e-2}
                                                   : std::vector{1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8}));
  append(points, collocation_points(study, exact_tolerances(quick)));
  app::mark_front(points);
  return points;
}

std::vector<Point> rigid_points(const Study& study, bool quick) {
  std::vector<Point> points = app::size_study(study.measured, pairs(), sizes(quick, {4}, 0.2));
  append(points, collocation_points(study, exact_tolerances(quick)));
  app::mark_front(points);
  return points;
}

void report(const Study& study, const std::vector<Point>& points, double seconds) {
  std::size_t converged = 0, run = 0;
  for (const Point& point : points) {
    converged += point.converged ? 1U : 0U;
    run += point.status != "not_run" ? 1U : 0U;
  }
  std::printf("%-20s %4zu points, %4zu run, %4zu converged, reference to %.1e, %.1f s\n", study.name.c_str(),
              points.size(), run, converged, study.reference.error, seconds);
  std::fflush(stdout);
}

using Method = std::function<std::vector<Point>(const Study&)>;

/// Rows and notes of all studies so far. Written after each, because the whole needs minutes.
class Results {
 public:
  explicit Results(const Program& program) : program_(program) {}

  void add(const std::vector<Study>& studies, const std::string& title, const std::string& picture_name,
           const Method& method) {
    app::Figure picture;
    picture.title = title;
    picture.panel_width = 900;
    picture.panel_height = 460;
    for (const Study& study : studies) {
      const double start = app::processor_seconds();
      const std::vector<Point> points = method(study);
      append(table_, study, points);
      add_panel(picture, study, points);
      cheapest_.add(study, points);
      notes_.push_back("reference of " + study.name + ": " + study.reference.text + ", own error about " +
                       app::cell_text(study.reference.error));
      report(study, points, app::processor_seconds() - start);
      write_data(program_.output, "work_precision", table_,
                 {"Error over solve time of every pair of bases", "SI; a column's name ends in its unit",
                  "reproduce/scenes", notes_});
    }
    write_cheapest();
    write_pictures(program_.output / picture_name, picture);
  }

 private:
  /// The table of the page, which also contains the HTML one.
  void write_cheapest() const {
    write_data(program_.output, "cheapest_pairs", cheapest_.table(),
               {"The cheapest pair of bases for an error, and the time of Fourier:Fourier over its own",
                "SI; a column's name ends in its unit",
                "reproduce/scenes",
                {"of those whose next size, if it was solved, keeps to the error, too"}});
    app::write_file(program_.output / "cheapest_pairs.html", cheapest_.html());
  }

  Program program_;
  CheapestTable cheapest_;
  app::Table table_ = empty_table();
  std::vector<std::string> notes_{
      "error: relative rms over 1024 points of the period; seconds: least of repeated solves, plans made",
      "status not_run: smaller sizes took too long; on_front: no converged point beats it in both"};
};

constexpr const char* about =
    "Measures error over solve time of every pair of bases, in the cases of JL14 and against a rigid obstacle,\n"
    "with exact solutions, time stepping and the assembled system. Writes work_precision.csv, cheapest_pairs.csv and two\n"
    "pictures. For another scene there is: wavebalance compare SCENE.toml --output DIR";

void run(const Program& program) {
  Results results(program);
  results.add(penalty_studies(), "Error over solve time, one solve from the contact-free response",
              "work_precision", [&](const Study& study) { return penalty_points(study, program.quick); });
  results.add(rigid_studies(), "Error over solve time, rigid contact", "work_precision_rigid",
              [&](const Study& study) { return rigid_points(study, program.quick); });
}

}  // namespace
}  // namespace wavebalance::bench

int main(int argc, char** argv) {
  return wavebalance::bench::run_program(argc, argv, wavebalance::bench::about, wavebalance::bench::run);
}
