#include "readings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "wavebalance/app/compose/scene_loader.hpp"
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
  return fmt::format("{} {}, {}{}", samples, offset == 0.0 ? "left ends" : "mid-points",
                     exact ? "exact products" : "same sums", keeps_nyquist ? "" : ", Nyquist dropped");
}

std::string Sums::key() const {
  return fmt::format("{}_{}_{}{}", samples, offset == 0.0 ? "left" : "middle", exact ? "exact" : "sums",
                     keeps_nyquist ? "" : "_dropped");
}

std::vector<std::string> Sums::overrides(const Pair& pair) const {
  return {fmt::format("time.quadrature_points={}",
                      samples > read_functions || has_haar_trial(pair) ? samples : 256),
          fmt::format("time.sample_offset={}", offset),
          std::string("time.inner_products=") + (exact ? "exact" : "quadrature"),
          std::string("time.nyquist=") + (keeps_nyquist ? "keep" : "drop")};
}

const std::vector<Sums>& all_sums() {
  static const std::vector<Sums> all = [] {
    std::vector<Sums> list;
    for (const int samples : {256, 64, 512, 1024})
      for (const double offset : {0.0, 0.5})
        for (const bool exact : {false, true}) list.push_back({samples, offset, exact, true});
    for (const double offset : {0.0, 0.5}) list.push_back({256, offset, false, false});
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

app::Response solved_from_cells(const app::Scene& scene, const Eigen::VectorXd& cells) {
  app::ResponseOptions options;
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
    readings.push_back({all_sums()[i].name(), finding.verdict, finding.measured});
  }
  return readings;
}

std::vector<report::Reading> judged(const Readings& readings, const std::vector<std::string>& needed,
                                    const std::function<Finding(std::size_t)>& judge) {
  return judged(judge, [&](std::size_t i) { return readings.missing(i, needed); });
}

report::Verdict at_most_similar(const std::vector<double>& errors, const std::vector<double>& others) {
  std::vector<double> larger = errors;
  for (std::size_t i = 0; i < std::min(errors.size(), others.size()); ++i)
    larger[i] = std::max(errors[i], others[i]);
  return report::similar(larger, others);
}

namespace {

int agreeing_where(const std::vector<report::Reading>& readings,
                   const std::function<bool(const Sums&)>& where, int& count) {
  int agreeing = 0;
  count = 0;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    if (!where(all_sums()[i % all_sums().size()])) continue;
    ++count;
    agreeing += readings[i].verdict == report::Verdict::agrees ? 1 : 0;
  }
  return agreeing;
}

int partly_right(const std::vector<report::Reading>& readings) {
  return static_cast<int>(std::count_if(readings.begin(), readings.end(), [](const report::Reading& reading) {
    return reading.verdict == report::Verdict::partly;
  }));
}

std::string share_where(const std::vector<report::Reading>& readings,
                        const std::function<bool(const Sums&)>& where) {
  int count = 0;
  const int agreeing = agreeing_where(readings, where, count);
  return fmt::format("{} of {}", agreeing, count);
}

}  // namespace

report::Statement concluded(report::Statement statement, std::vector<report::Reading> readings) {
  statement.verdict = report::over(readings);
  const auto count = static_cast<int>(readings.size());
  statement.measured = readings.front().measured;
  if (report::agreeing(readings) == count)
    statement.measured += fmt::format("; it agrees under all {} readings", count);
  else
    statement.measured += fmt::format(
        "; of {} readings it agrees under {} and is partly right under {}; of those to the letter it agrees under {}",
        count, report::agreeing(readings), partly_right(readings),
        share_where(readings, [](const Sums& sums) { return sums.literal(); }));
  statement.readings = std::move(readings);
  return reasoned(std::move(statement));
}

report::Statement reasoned(report::Statement statement) {
  if (statement.verdict == report::Verdict::agrees) statement.because.clear();
  return statement;
}

std::string spread(const std::vector<report::Reading>& readings) {
  const int agreeing = report::agreeing(readings), count = static_cast<int>(readings.size());
  if (agreeing == count) return "It agrees under all readings";
  if (agreeing == 0)
    return fmt::format("It agrees under no reading and is partly right under {} of {}",
                       partly_right(readings), count);
  constexpr int few = 3;
  if (agreeing <= few || count - agreeing <= few) {
    std::string names;
    for (const auto& reading : readings)
      if ((reading.verdict == report::Verdict::agrees) == (agreeing <= few))
        names += (names.empty() ? "" : "; ") + reading.name;
    return (agreeing <= few ? "It agrees only with " : "It agrees except with ") + names;
  }
  const auto with = [&](const std::function<bool(const Sums&)>& where) {
    return share_where(readings, where);
  };
  std::string numbers;
  for (const int samples : {64, 256, 512, 1024})
    numbers += fmt::format("{}with {} samples under {}", numbers.empty() ? "" : ", ", samples,
                           with([&](const Sums& sums) { return sums.samples == samples; }));
  return fmt::format(
      "It agrees at left ends under {}, at mid-points under {}; with the same sums under {}, with exact products "
      "under {}; {}",
      with([](const Sums& sums) { return sums.offset == 0.0; }),
      with([](const Sums& sums) { return sums.offset != 0.0; }),
      with([](const Sums& sums) { return !sums.exact; }), with([](const Sums& sums) { return sums.exact; }),
      numbers);
}

void note_readings(report::Artefact& artefact) {
  artefact.note(fmt::format(
      "The {} readings set time.quadrature_points (64, 256, 512, 1024), time.sample_offset (0: left ends, "
      "0.5: mid-points), time.inner_products (\"quadrature\": the same sums for A_d, or \"exact\") and "
      "time.nyquist. The first is that of the pictures. To the letter are those with 256 points for all inner "
      "products. One sample per cell, 64, is a reading of pairs with Haar trial functions; the others keep 256. "
      "This restriction was made after first results had been seen: with 64 samples for all pairs the sentences on "
      "Fourier:Fourier in Fig. 6 and on DB6 in Fig. 9 depend on the reading too.",
      all_sums().size()));
}

}  // namespace wavebalance::jl14
