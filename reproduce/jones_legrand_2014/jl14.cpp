#include "jl14.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/compare/solve_point.hpp"
#include "wavebalance/app/compose/compose.hpp"

namespace wavebalance::jl14 {

report::Identity identity(const std::string& number, const std::string& title, const std::string& stem) {
  return {"jones_legrand_2014", "JL14 " + number, title, stem};
}

const std::vector<Pair>& pairs() {
  static const std::vector<Pair> all = [] {
    std::vector<Pair> found;
    for (const app::BasisPair& pair :
         app::parse_pairs("fourier:fourier,bspline:bspline,daubechies6:daubechies6,"
                          "haar:fourier,daubechies6:fourier,haar:bspline")) {
      const app::PairStyle style = app::style_of(pair);
      found.push_back({pair.trial, pair.weight, app::label_of(pair), style.colour, style.marker});
    }
    return found;
  }();
  return all;
}

std::vector<Pair> panel_pairs() {
  const auto& all = pairs();
  return {all[0], all[4], all[3], all[1], all[5], all[2]};
}

const Pair& pair(const std::string& name) {
  for (const Pair& one : pairs())
    if (one.name() == name) return one;
  throw std::out_of_range("\"" + name + "\" is no pair of Table 2");
}

bool has_haar_trial(const Pair& pair) { return pair.trial == "haar"; }

namespace {

std::vector<std::string> overrides_of(const Pair& pair, int functions) {
  return {"time.trial=" + pair.trial, "time.weight=" + pair.weight,
          "time.functions=" + std::to_string(functions)};
}

}  // namespace

Case::Case(report::Artefact& artefact, int number)
    : artefact_(artefact),
      number_(number),
      scene_(artefact.scene("case" + std::to_string(number) + ".toml")) {
  const Table table = artefact.result("reference_case" + std::to_string(number) + ".csv");
  const auto column = [&](const char* name) -> Eigen::VectorXd {
    const std::vector<double> values = table.numbers(name);
    return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  };
  time_ = column("time_fraction");
  reference_.converged = true;
  reference_.contacts = {column("displacement_m").transpose(), column("velocity_m_per_s").transpose(),
                         column("contact_force_N").transpose()};
  reference_energy_ = column("system_energy_J");
}

std::string Case::frequency_text() const { return report::number(scene_.forcing.frequency, 6) + " Hz"; }

std::string Case::scene_name() const { return "case" + std::to_string(number_) + ".toml"; }

app::Scene Case::scene_for(const Pair& pair, int functions) {
  return artefact_.scene(scene_name(), overrides_of(pair, functions));
}

app::Scene Case::scene_under(const Pair& pair, int functions,
                             const std::vector<std::string>& overrides) const {
  auto all = overrides_of(pair, functions);
  all.insert(all.end(), overrides.begin(), overrides.end());
  return app::load_scene(artefact_.scenes() / scene_name(), all);
}

app::Response Case::solve(const Pair& pair, int functions, bool whole_structure) {
  app::ResponseOptions options;
  const app::Scene scene = scene_for(pair, functions);
  if (whole_structure) options.structure_points = scene.analysis.output_points;
  auto response = app::weighted_residual_response(scene, options);
  if (!response.converged)
    artefact_.note(fmt::format(
        "{} with {} functions at {} did not converge ({}, residual {}) and is not drawn.", pair.label,
        functions, frequency_text(), response.status, report::number(response.residual)));
  return response;
}

std::vector<app::Response> Case::solve_all(bool whole_structure) {
  std::vector<app::Response> responses;
  for (const Pair& pair : pairs()) responses.push_back(solve(pair, scene_.time.functions, whole_structure));
  return responses;
}

app::Response exact_solution(const app::Scene& scene, int structure_points) {
  app::ResponseOptions options;
  options.structure_points = structure_points;
  app::Response motion = app::exact_response(scene, options);
  if (!motion.converged) throw report::NotConverged("exact periodic solution: " + motion.status);
  return motion;
}

Values drawn(const std::vector<app::Response>& responses, Eigen::VectorXd (app::Response::*history)() const) {
  Values values;
  for (const auto& response : responses) {
    values.push_back((response.*history)());
    if (!response.converged) values.back().setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  return values;
}

Values in_panels(const Values& values) {
  Values result;
  for (const Pair& wanted : panel_pairs())
    for (std::size_t i = 0; i < pairs().size(); ++i)
      if (pairs()[i].name() == wanted.name()) result.push_back(values[i]);
  return result;
}

std::vector<double> measured(const Values& values, const Eigen::VectorXd& reference,
                             double (*measure)(const Eigen::VectorXd&, const Eigen::VectorXd&)) {
  std::vector<double> results;
  for (const auto& one : values) results.push_back(measure(one, reference));
  return results;
}

Eigen::VectorXd shifted_by_half_a_period(const Eigen::VectorXd& values) {
  Eigen::VectorXd turned = values;
  std::rotate(turned.begin(), turned.begin() + turned.size() / 2, turned.end());
  return turned;
}

Table comparison_table(const Eigen::VectorXd& time, const Eigen::VectorXd& reference, const Values& values) {
  Table table;
  table.add_column("time_fraction", time).add_column("reference", reference);
  for (std::size_t i = 0; i < values.size(); ++i) table.add_column(pairs()[i].name(), values[i]);
  return table;
}

std::vector<Pair> pairs_named(const std::vector<std::string>& names) {
  std::vector<Pair> chosen;
  for (const auto& name : names) chosen.push_back(pair(name));
  return chosen;
}

std::string listed(const std::vector<Pair>& chosen, const std::vector<double>& values) {
  std::string text;
  for (std::size_t i = 0; i < chosen.size(); ++i)
    text += (i == 0 ? "" : ", ") + chosen[i].label + " " + report::percent(values[i]);
  return text;
}

Table levels_table(const std::string& basis, bool centred) {
  constexpr int points = 1024;
  Table table;
  table.add_column("time_fraction", app::time_fractions(points));
  for (int level = 0; level <= 5; ++level) {
    const int functions = 1 << level;
    const int shift = centred ? (functions / 2 + 2 * functions - 2) % functions : 0;
    Eigen::VectorXd values = functions * app::make_basis(basis, functions).samples(points, 0);
    std::rotate(values.begin(), values.end() - shift * (points / functions), values.end());
    table.add_column("level_" + std::to_string(level), values);
  }
  return table;
}

void check_integrals(report::Artefact& artefact, const Table& table) {
  double largest = 0.0;
  for (const auto& name : table.columns()) {
    if (name == "time_fraction") continue;
    const std::vector<double> values = table.numbers(name);
    const Eigen::Map<const Eigen::VectorXd> level(values.data(), static_cast<Eigen::Index>(values.size()));
    largest = std::max(largest, std::abs(level.mean() - 1.0));
  }
  artefact.check({"section 3.3", "normalization by $\\int_0^1 \\phi_{J,k}(t)\\,dt = 1$",
                  "mean of the samples within 1e-12 of 1 at every level",
                  "largest deviation " + report::number(largest), largest < 1e-12});
}

}  // namespace wavebalance::jl14
