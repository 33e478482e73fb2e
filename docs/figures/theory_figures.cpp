// Draws the figures of the pages on theory from the libraries: theory_figures NAME [SCENE...] writes
// NAME.svg, or a table NAME.csv, into the folder where it is started.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/plot/plot.hpp"
#include "wavebalance/contact/exponential_law.hpp"
#include "wavebalance/contact/linear_law.hpp"
#include "wavebalance/contact/rigid_law.hpp"
#include "wavebalance/solvers/problem/contact_problem.hpp"
#include "wavebalance/solvers/response/curve_responses.hpp"
#include "wavebalance/solvers/response/frequency_sweep.hpp"
#include "wavebalance/solvers/stability/contact_dynamics.hpp"
#include "wavebalance/solvers/stability/floquet_exponents.hpp"

namespace {
using namespace wavebalance;
using Files = std::vector<std::string>;

std::vector<double> uniform(double from, double to, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(from + (to - from) * i / (count - 1));
  return values;
}

// The generators of 16 functions, each with the translate by three places.
void draw_bases(const Files&) {
  constexpr int functions = 16, points = 1024;
  const std::map<std::string, std::string> titles{{"fourier", "Fourier, 15 functions"},
                                                  {"haar", "Haar"},
                                                  {"daubechies6", "Daubechies, 6 coefficients"},
                                                  {"bspline", "Orthonormal cubic B-spline"}};
  app::Figure figure{.columns = 2, .panel_width = 380, .panel_height = 240};
  for (const char* name : {"fourier", "haar", "daubechies6", "bspline"}) {
    const solvers::AnyTimeBasis basis = app::make_basis(name, name[0] == 'f' ? functions - 1 : functions);
    const Eigen::VectorXd g = basis.samples(points, 0);
    Eigen::VectorXd moved(points);
    const int shift = 3 * points / basis.functions();
    for (int i = 0; i < points; ++i) moved[i] = g[(i + points - shift) % points];
    const std::vector<double> time = uniform(0.0, 1.0 - 1.0 / points, points);
    app::Panel& panel = figure.add_panel(titles.at(name));
    panel.x = {.label = "Time (fraction of a period)", .lower = 0.0, .upper = 1.0};
    panel.y.label = "Function (1)";
    panel.add({"g(t)", time, g}).add({"g(t - 3/M)", time, moved});
    panel.series.back().dash = app::Dash::dashed;
  }
  app::write_pictures("bases", figure);
}

void write_regularity(const Files&) {
  app::Table table({"basis", "sobolev_exponent", "pointwise_derivatives"});
  for (const char* name : {"haar", "daubechies4", "daubechies6", "daubechies8", "daubechies10",
                           "daubechies12", "daubechies20", "daubechies40", "bspline"}) {
    const solvers::AnyTimeBasis basis = app::make_basis(name, 64);
    table.append_row(
        {std::string(name), basis.sobolev_exponent(), std::int64_t{basis.pointwise_derivatives()}});
  }
  app::write_csv("regularity.csv", table);
}

// How exactly a pair differentiates each harmonic twice: |lambda_2 / lambda_0| against (2 pi k)^2.
void draw_symbols(const Files&) {
  constexpr int functions = 64;
  app::Figure figure{.panel_width = 640, .panel_height = 340};
  app::Panel& panel = figure.add_panel();
  panel.x = {.label = "Harmonic k", .lower = 0.0, .upper = 32.0};
  panel.y = {
      .label = "Relative error of the second derivative", .lower = 1e-12, .upper = 10.0, .logarithmic = true};
  panel.y.tick_format = "10^{%L}";
  const std::vector<std::pair<std::string, std::string>> pairs{{"bspline", "bspline"},
                                                               {"daubechies6", "daubechies6"},
                                                               {"daubechies20", "daubechies20"},
                                                               {"haar", "bspline"}};
  for (const auto& [trial, weight] : pairs) {
    app::Time time{.trial = trial, .weight = weight, .functions = functions, .quadrature_points = 256};
    time.inner_products = app::InnerProducts::exact;
    const solvers::TimePair pair = app::make_pair(time);
    std::vector<double> harmonics, errors;
    for (int k = 1; k < functions / 2; ++k) {
      const double exact = std::pow(2.0 * std::numbers::pi * k, 2);
      const double error = std::abs(pair.symbol(2)[k] / pair.symbol(0)[k] + exact) / exact;
      harmonics.push_back(k);
      errors.push_back(std::max(error, 1e-13));
    }
    panel.add({trial + ":" + weight, harmonics, errors, app::SeriesStyle::line_points});
  }
  app::write_pictures("symbols", figure);
}

// Force over displacement of three laws, and their resolvents, which are finite for the rigid one too.
void draw_laws(const Files&) {
  constexpr double gap = 1e-3, flexibility = 2e-8;  // m, m/N
  const contact::ExponentialLaw exponential(1e5, 1500.0, gap);
  const contact::LinearLaw linear(2e8, gap);
  const contact::RigidLaw rigid(gap);
  const std::vector<double> u = uniform(0.6e-3, 1.6e-3, 201);
  std::vector<double> millimetres;
  for (double value : u) millimetres.push_back(1e3 * value);
  const auto values = [&u](const auto& force) {
    std::vector<double> result;
    for (double value : u) result.push_back(1e-3 * force(value));
    return result;
  };
  app::Figure figure{.columns = 2, .panel_width = 400, .panel_height = 300};
  app::Panel& law = figure.add_panel("Force over displacement");
  law.x = {.label = "u (mm)", .lower = 0.6, .upper = 1.6};
  law.y = {.label = "Force (kN)", .lower = 0.0, .upper = 60.0};
  law.add({"exponential", millimetres, values([&](double x) { return exponential.force(x); })});
  law.add({"linear", millimetres, values([&](double x) { return linear.force(x); })});
  law.add({"rigid", std::vector{0.6, 1.0, 1.0}, std::vector{0.0, 0.0, 60.0}});
  app::Panel& resolvent = figure.add_panel("Resolvents");
  resolvent.x = {.label = "v (mm)", .lower = 0.6, .upper = 1.6};
  resolvent.y = {.label = "Force (kN)", .lower = 0.0, .upper = 60.0};
  const solvers::AnyContactLaw any(exponential);
  resolvent.add(
      {"exponential", millimetres, values([&](double x) { return any.resolvent(x, flexibility).force; })});
  resolvent.add(
      {"linear", millimetres, values([&](double x) { return linear.resolvent(x, flexibility).force; })});
  resolvent.add(
      {"rigid", millimetres, values([&](double x) { return rigid.resolvent(x, flexibility).force; })});
  app::write_pictures("laws", figure);
}

// The largest multiplier on each part of the response curve of a sweep.
void draw_multipliers(const Files& files) {
  const app::Scene scene = app::load_scene(files.at(0));
  solvers::CondensedProblem problem = app::make_problem(scene);
  const solvers::ContactLaws laws = app::make_laws(scene);
  solvers::FrequencySweepOptions options{.from = scene.analysis.frequency_from,
                                         .to = scene.analysis.frequency_to};
  options.keep_unknowns = true;
  const solvers::FrequencySweep curve = solvers::frequency_sweep(problem, laws, options);
  const solvers::ContactDynamics dynamics(problem.structure());
  std::vector<double> frequency, modulus, fold_frequency, one;
  const std::size_t every = std::max<std::size_t>(curve.points.size() / 120, 1);
  for (std::size_t i = 0; i < curve.points.size(); i += every) {
    const solvers::SweepPoint& point = curve.points[i];
    const solvers::PeriodicResponse response =
        solvers::curve_response(problem, laws, curve, point.frequency, point.unknown);
    const solvers::FloquetExponents found = solvers::floquet_exponents(dynamics, problem, laws, response);
    if (found.values.empty()) continue;
    frequency.push_back(point.frequency);
    modulus.push_back(std::abs(found.values.front().multiplier));
  }
  if (modulus.empty()) throw std::runtime_error("no multiplier was found along the curve of " + files[0]);
  for (const solvers::TurningPoint& fold : curve.turning_points) {
    fold_frequency.push_back(fold.frequency);
    one.push_back(1.0);
  }
  app::Figure figure{.panel_width = 640, .panel_height = 320};
  app::Panel& panel = figure.add_panel();
  panel.x.label = "Frequency (Hz)";
  panel.y.label = "Largest modulus of a multiplier";
  panel.add({"along the curve", frequency, modulus, app::SeriesStyle::line_points});
  panel.add({"folds", fold_frequency, one, app::SeriesStyle::points}).mark_y(1.0);
  app::write_pictures("multipliers", figure);
}

// A balance of a scene with Fourier functions, and the motion of the structure near it.
struct Balance {
  Balance(app::Scene scene, int functions, const solvers::CollocationOptions& options)
      : problem(app::compose_problem(with_functions(scene, functions), app::make_model(scene))),
        response(problem.respond(scene.forcing.frequency)) {
    const auto found = problem.exact_near(response, options);
    if (!response.converged() || !found || !found->motion.parts)
      throw std::runtime_error("no motion near the balance with " + std::to_string(functions) + " functions");
    exact = *found;
  }

  static app::Scene with_functions(app::Scene scene, int functions) {
    scene.time = {.trial = "fourier", .weight = "fourier", .functions = functions};
    scene.time.quadrature_points = 4 * (functions + 1);
    return scene;
  }

  solvers::ContactProblem problem;
  solvers::PeriodicResponse response;
  solvers::ExactNearResponse exact;
};

constexpr double exact = 1e-12;  // tolerance of what errors are measured against

// The force of a motion about its contact, and how far balances are from its displacement.
void draw_intervals(const Files& files) {
  constexpr int points = 2048;
  const app::Scene scene = app::load_scene(files.at(0));
  const std::vector<double> time = uniform(0.0, 1.0 - 1.0 / points, points);
  const Eigen::VectorXd times = Eigen::Map<const Eigen::VectorXd>(time.data(), points);
  app::Figure figure{.columns = 2, .panel_width = 400, .panel_height = 300};
  app::Panel force, distance;
  force.title = "Contact force";
  force.x = {.label = "Time (fraction of a period)", .lower = 0.0, .upper = 0.2};
  force.y.label = "Force (MN)";
  distance.title = "Distance of balances from the motion";
  distance.x = {.label = "Time (fraction of a period)", .lower = 0.0, .upper = 1.0};
  distance.y = {.label = "Distance (m)", .lower = 1e-10, .upper = 1e-4, .logarithmic = true};
  distance.y.tick_format = "10^{%L}";
  for (const int functions : {31, 127, 511}) {
    Balance balance(scene, functions, {.tolerance = exact});
    const solvers::Motion motion = balance.problem.motion(balance.response, points);
    const std::string name = "balance, " + std::to_string(functions) + " functions";
    const Eigen::VectorXd error =
        (motion.displacement - balance.exact.motion.displacement(times)).row(0).cwiseAbs();
    distance.add({name, time, error});
    if (functions > 31) continue;
    for (const solvers::ForceInterval& interval : balance.exact.motion.intervals)
      force.rectangles.push_back({interval.begin, 0.0, interval.end, 1.6});
    const Eigen::VectorXd computed = 1e-6 * motion.force.row(0);
    const Eigen::VectorXd exact = 1e-6 * balance.exact.motion.force(times).row(0);
    force.add({name, time, computed}).add({"exact", time, exact});
    force.series.back().colour = app::Colour::black;
  }
  figure.panels = {force, distance};
  app::write_pictures("intervals", figure);
}

// Error of the displacement over the number of unknowns, of balances and of exact solutions with one panel; a
// panel for each scene.
void draw_exact_errors(const Files& files) {
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(1024, 0.0, 1.0 - 1.0 / 1024);
  app::Figure figure{.columns = 2, .panel_width = 400, .panel_height = 320};
  for (const std::string& file : files) {
    const app::Scene scene = app::load_scene(file);
    std::vector<double> functions, errors, unknowns, exact_errors;
    const Eigen::MatrixXd motion = Balance(scene, 63, {.tolerance = exact}).exact.motion.displacement(times);
    for (const int number : {15, 31, 63, 127, 255, 511, 1023}) {
      solvers::ContactProblem problem =
          app::compose_problem(Balance::with_functions(scene, number), app::make_model(scene));
      const solvers::PeriodicResponse response = problem.respond(scene.forcing.frequency);
      if (!response.converged())
        throw std::runtime_error("no balance with " + std::to_string(number) + " functions");
      const Eigen::MatrixXd found = problem.motion(response, static_cast<int>(times.size())).displacement;
      functions.push_back(number);
      errors.push_back((found - motion).norm() / motion.norm());
    }
    for (const int nodes : {6, 8, 10, 12, 14, 16, 20, 24, 28, 32}) {
      const Balance balance(scene, 63,
                            {.tolerance = 1e-15, .nodes = nodes, .max_nodes = nodes, .max_panels = 1});
      unknowns.push_back(balance.exact.motion.unknowns);
      exact_errors.push_back((balance.exact.motion.displacement(times) - motion).norm() / motion.norm());
    }
    app::Panel& panel =
        figure.add_panel(scene.contact.law == "rigid" ? "rigid obstacle" : scene.contact.law + " law");
    panel.x = {.label = "Unknowns", .lower = 5.0, .upper = 2000.0, .logarithmic = true};
    panel.y = {
        .label = "Relative error of the displacement", .lower = 1e-15, .upper = 1.0, .logarithmic = true};
    panel.y.tick_format = "10^{%L}";
    panel.add({"harmonic balance", functions, errors, app::SeriesStyle::line_points})
        .add({"exact", unknowns, exact_errors, app::SeriesStyle::line_points});
    panel.series.back().colour = app::Colour::black;
  }
  app::write_pictures("phase_errors", figure);
}

// Displacements of a contact whose rigid stop gives way elastically: about each impact half a sine beyond the
// gap.
Eigen::MatrixXd with_penetrations(const solvers::ExactSolution& motion, const Eigen::VectorXd& times,
                                  double gap, double natural) {
  Eigen::MatrixXd u = motion.displacement(times);
  for (const solvers::Impact& impact : motion.impacts)
    for (Eigen::Index k = 0; k < times.size(); ++k) {
      const double apart = times[k] - impact.time - std::round(times[k] - impact.time);
      const double phase = natural * apart / motion.frequency();
      if (std::abs(phase) < 0.5 * std::numbers::pi)
        u(impact.contact, k) = gap + impact.velocity_before / natural * std::cos(phase);
    }
  return u;
}

// How far motions against ever stiffer elastic stops are from those with impacts without loss, of each scene.
void draw_stiff_stops(const Files& files) {
  constexpr int points = 8192;
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(points, 0.0, 1.0 - 1.0 / points);
  app::Figure figure{.panel_width = 480, .panel_height = 320};
  app::Panel& panel = figure.add_panel();
  panel.x = {.label = "Stiffness of the stop (N/m)", .logarithmic = true};
  panel.y = {.label = "Relative distance of the displacement", .logarithmic = true};
  panel.x.tick_format = panel.y.tick_format = "10^{%L}";
  for (const std::string& file : files) {
    app::Scene scene = app::load_scene(file);
    scene.contact.values["restitution"] = 1.0;
    const app::StructureModel model = app::make_model(scene);
    const app::Response rigid = app::impacts_response(scene, model);
    if (!rigid.converged) throw std::runtime_error(file + ": " + rigid.status);
    const double gap = scene.contact.gap, frequency = scene.forcing.frequency,
                 mobility = solvers::inverse_contact_mass(*model.contact_dynamics())(0, 0);
    const solvers::ExactSolution& motion = rigid.impacts->motion;
    const Eigen::MatrixXd exact_motion = motion.displacement(times);
    std::vector<double> stiffnesses, distances;
    for (double stiffness = 1e3; stiffness < 2e8; stiffness *= std::sqrt(10.0)) {
      scene.contact.law = "linear";
      scene.contact.values = {{"stiffness", stiffness}};
      solvers::ContactProblem problem =
          app::compose_problem(Balance::with_functions(scene, 63), model).over_periods(rigid.periods);
      const auto found = problem.exact_near(
          frequency,
          solvers::Motion{with_penetrations(motion, times, gap, std::sqrt(stiffness * mobility)), {}, {}},
          {.tolerance = 1e-9});
      if (!found || !found->converged()) continue;
      stiffnesses.push_back(stiffness);
      distances.push_back((found->displacement(times) - exact_motion).norm() / exact_motion.norm());
    }
    std::string name = std::filesystem::path(file).stem().string();
    std::replace(name.begin(), name.end(), '_', ' ');
    panel.add({name, stiffnesses, distances, app::SeriesStyle::line_points});
  }
  app::write_pictures("stiff_stops", figure);
}

// Number of impacts per period of a bar without end mass against a rigid stop, over its elements.
void write_impacts_of_bars(const Files& files) {
  app::Scene scene = app::load_scene(files.at(0));
  scene.structure.massless_tip = false;
  scene.time = {};
  app::Table table({"elements", "restitution_02", "restitution_08", "restitution_1"});
  for (const int elements : {2, 3, 5, 8, 12, 25}) {
    scene.structure.elements = elements;
    std::vector<app::Cell> row{std::int64_t{elements}};
    for (const double restitution : {0.2, 0.8, 1.0}) {
      scene.contact.values["restitution"] = restitution;
      const app::Response found = app::impacts_response(scene, app::make_model(scene));
      row.emplace_back(found.converged ? std::to_string(found.impacts->motion.impacts.size())
                                       : std::string(to_string(found.impacts->motion.status)));
    }
    table.append_row(std::move(row));
  }
  app::write_csv("impacts_of_bars.csv", table);
}
}  // namespace

int main(int count, char** arguments) try {
  const std::map<std::string, void (*)(const Files&)> figures{{"bases", draw_bases},
                                                              {"regularity", write_regularity},
                                                              {"symbols", draw_symbols},
                                                              {"laws", draw_laws},
                                                              {"multipliers", draw_multipliers},
                                                              {"intervals", draw_intervals},
                                                              {"phase_errors", draw_exact_errors},
                                                              {"stiff_stops", draw_stiff_stops},
                                                              {"impacts_of_bars", write_impacts_of_bars}};
  const auto figure = figures.find(count > 1 ? arguments[1] : "");
  if (figure == figures.end()) {
    std::fprintf(
        stderr,
        "usage: theory_figures bases|regularity|symbols|laws, multipliers|intervals|impacts_of_bars SCENE, or "
        "phase_errors|stiff_stops SCENE...\n");
    return 2;
  }
  figure->second(Files(arguments + 2, arguments + count));
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "theory_figures: %s\n", error.what());
  return 1;
}
