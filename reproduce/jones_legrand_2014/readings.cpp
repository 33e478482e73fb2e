#include "readings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/report/rule.hpp"

namespace wavebalance::jl14 {
namespace {

constexpr int read_functions = 64;

app::Response without_solution(const app::Scene& scene) {
  app::Response response;
  response.status = "no solution found";
  response.unknowns = scene.time.functions;
  const auto n = scene.analysis.output_points;
  const Eigen::MatrixXd none = Eigen::MatrixXd::Constant(1, n, std::nan(""));
  response.contacts = {none, none, none};
  return response;
}

}  // namespace

std::string Sums::name() const {
  return fmt::format("{} {}, {}{}{}", samples, offset == 0.0 ? "left ends" : "mid-points",
                     exact ? "exact products" : "same sums", keeps_nyquist ? "" : ", Nyquist dropped",
                     sine ? ", sine" : "");
}

std::string Sums::key() const {
  return fmt::format("{}_{}_{}{}{}", samples, offset == 0.0 ? "left" : "middle", exact ? "exact" : "sums",
                     keeps_nyquist ? "" : "_dropped", sine ? "_sine" : "");
}

std::vector<std::string> choice_names() { return {"Points", "Where", "Products", "Last Fourier function"}; }

std::vector<std::string> Sums::choices() const {
  return {std::to_string(samples), offset == 0.0 ? "left ends" : "mid-points", exact ? "exact" : "same sums",
          !keeps_nyquist  ? "none"
          : sine || exact ? "sine"
                          : "cosine"};
}

std::vector<std::string> Sums::overrides(const Pair& pair) const {
  const bool cosine_vanishes = has_haar_trial(pair) && offset != 0.0 && !exact && !sine;
  return {fmt::format("time.quadrature_points={}",
                      samples > read_functions || has_haar_trial(pair) ? samples : 256),
          fmt::format("time.sample_offset={}", offset),
          std::string("time.inner_products=") + (exact ? "exact" : "quadrature"),
          std::string("time.nyquist=") + (keeps_nyquist && !cosine_vanishes ? "keep" : "drop")};
}

const std::vector<Sums>& all_sums() {
  static const std::vector<Sums> all = [] {
    std::vector<Sums> list{{256, 0.0, false, true}, {256, 0.5, false, true}, {256, 0.0, false, false}};
    list.push_back({.samples = 256, .offset = 0.5, .sine = true});
    for (const double offset : {0.0, 0.5}) list.push_back({256, offset, true, true});
    for (const int samples : {64, 512, 1024})
      for (const double offset : {0.0, 0.5})
        for (const bool exact : {false, true}) list.push_back({samples, offset, exact, true});
    return list;
  }();
  return all;
}

Readings::Readings(report::Artefact& artefact, const Case& study, std::vector<Pair> chosen)
    : chosen_(std::move(chosen)) {
  const bool slow = study.number() == 1 && std::any_of(chosen_.begin(), chosen_.end(), has_haar_trial);
  const Table cells = slow ? artefact.result("haar_readings_cells.csv") : Table();
  for (const Sums& sums : all_sums()) {
    auto& found = responses_.emplace_back();
    for (const Pair& pair : chosen_) {
      const app::Scene scene = study.scene_under(pair, read_functions, sums.overrides(pair));
      if (!slow || !has_haar_trial(pair)) {
        found.push_back(app::weighted_residual_response(scene));
        continue;
      }
      const auto values = cells.numbers(cells_column(pair, sums));
      const Eigen::Map<const Eigen::VectorXd> start(values.data(), static_cast<Eigen::Index>(values.size()));
      found.push_back(start.allFinite() ? solved_from_cells(scene, start) : without_solution(scene));
    }
  }
}

const app::Response& Readings::at(std::size_t reading, const std::string& pair) const {
  for (std::size_t i = 0; i < chosen_.size(); ++i)
    if (chosen_[i].name() == pair) return responses_.at(reading)[i];
  throw std::out_of_range("Readings: \"" + pair + "\" was not chosen");
}

Values Readings::values(std::size_t reading, Eigen::VectorXd (app::Response::*history)() const) const {
  return drawn(responses_.at(reading), history);
}

std::string Readings::missing(std::size_t reading, const std::vector<std::string>& names) const {
  std::string labels;
  for (const std::string& name : names)
    if (!at(reading, name).converged) labels += (labels.empty() ? "" : ", ") + pair(name).label;
  return labels;
}

app::Response solved_from_cells(const app::Scene& scene, const Eigen::VectorXd& cells, bool near) {
  app::ResponseOptions options;
  options.stay_near_guess = near;
  const Eigen::Index per_cell = scene.time.quadrature_points / cells.size();
  options.guess = Eigen::VectorXd::NullaryExpr(scene.time.quadrature_points,
                                               [&](Eigen::Index i) { return cells[i / per_cell]; });
  return app::weighted_residual_response(scene, options);
}

Eigen::VectorXd cell_values(const app::Response& response, int cells) {
  const Eigen::VectorXd u = response.displacement();
  const Eigen::Index width = u.size() / cells;
  return Eigen::VectorXd::NullaryExpr(
      cells, [&](Eigen::Index j) { return response.converged ? u[j * width] : std::nan(""); });
}

std::string cells_column(const Pair& pair, const Sums& sums) { return pair.name() + "_" + sums.key(); }

std::vector<report::Reading> judged(const std::function<Finding(std::size_t)>& judge,
                                    const std::function<std::string(std::size_t)>& missing) {
  std::vector<report::Reading> readings;
  for (std::size_t i = 0; i < all_sums().size(); ++i) {
    const std::string lacking = missing(i);
    const Finding finding =
        lacking.empty() ? judge(i) : Finding{report::Verdict::differs, "no solution found for " + lacking};
    readings.push_back({all_sums()[i].name(), finding.verdict, finding.measured, all_sums()[i].of_text()});
  }
  return readings;
}

std::vector<report::Reading> judged(const Readings& readings, const std::vector<std::string>& needed,
                                    const std::function<Finding(std::size_t)>& judge) {
  return judged(judge, [&](std::size_t i) { return readings.missing(i, needed); });
}

report::Verdict within_twice(const std::vector<double>& errors, const std::vector<double>& others) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < errors.size(); ++i)
    count += errors[i] <= report::similar_factor * others[i] ? 1 : 0;
  return report::mostly(count, errors.size());
}

report::Verdict both_within_twice(const std::array<double, 2>& rms, const std::array<double, 2>& mean,
                                  double other_rms, double other_mean) {
  std::vector<report::Verdict> parts;
  for (std::size_t i = 0; i < rms.size(); ++i) {
    parts.push_back(within_twice({rms[i]}, {other_rms}));
    parts.push_back(within_twice({mean[i]}, {other_mean}));
  }
  return report::together(parts);
}

double lowest_of(const std::string& trial, const std::vector<double>& errors) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < errors.size(); ++i)
    if (pairs()[i].trial == trial) least = std::min(least, errors[i]);
  return least;
}

double lowest_without_daubechies(const std::vector<double>& errors) {
  return std::min({lowest_of("fourier", errors), lowest_of("bspline", errors), lowest_of("haar", errors)});
}

Finding daubechies_lowest(const std::vector<double>& rms, const std::vector<double>& mean) {
  const double own_rms = lowest_of("daubechies6", rms), other_rms = lowest_without_daubechies(rms),
               own_mean = lowest_of("daubechies6", mean), other_mean = lowest_without_daubechies(mean);
  return {report::together({report::lower({own_rms}, {other_rms}), report::lower({own_mean}, {other_mean})}),
          fmt::format("rms {} against {}, mean {} against {}", report::percent(own_rms),
                      report::percent(other_rms), report::percent(own_mean), report::percent(other_mean))};
}

namespace {

std::vector<std::string> names_with(const std::vector<report::Reading>& readings, report::Verdict verdict) {
  std::vector<std::string> names;
  for (const auto& reading : readings)
    if (reading.verdict == verdict) names.push_back(reading.name);
  return names;
}

/// "1 of 2 readings of the text (256 left ends, same sums)", with the names of those that agree where they
/// are few.
std::string share_text(const std::vector<report::Reading>& readings, const std::string& what) {
  constexpr std::size_t few = 3;
  const auto names = names_with(readings, report::Verdict::agrees);
  const bool named = !names.empty() && names.size() <= few && names.size() < readings.size();
  return fmt::format("{} of {} {}{}", names.size(), readings.size(), what,
                     named ? fmt::format(" ({})", fmt::join(names, "; ")) : "");
}

}  // namespace

std::string spread(const std::vector<report::Reading>& readings) {
  const auto text = report::of_text(readings), beside = report::of_text(readings, false);
  const auto partly = names_with(text, report::Verdict::partly).size();
  return fmt::format(
      "It agrees under {}{}{}", share_text(text, "readings of the text"),
      partly > 0 ? fmt::format(" and holds in part under {}", partly) : "",
      beside.empty() ? "" : ", and would under " + share_text(beside, "other ways to form the sums"));
}

report::Statement concluded(report::Statement statement, std::vector<report::Reading> readings) {
  statement.verdict = report::over(readings);
  statement.measured = readings.front().measured;
  statement.readings = std::move(readings);
  return statement;
}

void refer_to_readings(report::Artefact& artefact) {
  artefact.note("Fig. 6 explains the interpretations and the variants of the sums.");
}

void note_readings(report::Artefact& artefact) {
  artefact.note(fmt::format(
      "The paper takes 256 points for all inner products, and the last of its 64 Fourier functions is the cosine. It "
      "does not say where the points lie, so that its text allows left ends and mid-points. The pictures show left "
      "ends. At mid-points the cosine has no product with the alternating Haar function, and that coefficient is "
      "zero. The other {} ways to form the sums are not the paper's; they show on what a finding depends. They set "
      "time.quadrature_points, time.sample_offset, time.inner_products and time.nyquist. “Sine” takes the sine as "
      "last Fourier function opposite Haar functions; exact products do so too, since the cosine would enter through "
      "the damping alone. One sample per cell, 64, is taken for pairs with Haar trial functions only; this was "
      "decided after first results had been seen. Numbers of readings are counts of a list, and no probabilities.",
      std::count_if(all_sums().begin(), all_sums().end(), [](const Sums& sums) { return !sums.of_text(); })));
}

}  // namespace wavebalance::jl14
