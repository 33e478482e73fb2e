#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "figures.hpp"
#include "ll10.hpp"
#include "wavebalance/report/rule.hpp"

namespace wavebalance::ll10 {
namespace {

using report::number;
using report::percent;
using report::Reading;
using report::Verdict;

constexpr double sampled_energy = 1.8;  // [LL10, Fig. 5]
constexpr int harmonics_shown[] = {2, 3, 5, 8, 10};
constexpr int samples_per_harmonic[] = {2, 4, 8, 16};
constexpr int main_harmonics = 5;

struct Sampled {
  int harmonics, samples;
  double frequency = solvers::missing, mean_force = solvers::missing, largest_force = solvers::missing,
         contact_fraction = solvers::missing;
  std::string status = {};

  bool found() const { return std::isfinite(frequency); }
};

Sampled sampled(report::Artefact& artefact, int harmonics, int samples) {
  const app::ModeStudy study(artefact.scene("rod.toml", {"analysis.harmonics=" + std::to_string(harmonics),
                                                         "analysis.samples=" + std::to_string(samples)}));
  const auto point = study.at_energy(sampled_energy);
  Sampled row{harmonics, samples};
  row.status = std::string(to_string(point.status));
  if (!point.accepted()) return row;
  row.frequency = point.omega / study.mode().linear_omega();
  row.mean_force = point.force.mean();
  row.largest_force = point.force.maxCoeff();
  row.contact_fraction = point.contact_fraction;
  return row;
}

struct ExactContact {
  double frequency, mean_force, largest_force, contact_fraction;
};

ExactContact exact_of(const app::Scene& scene) {
  const auto mode = exact_mode(scene, sampled_energy);
  const double fraction = mode.contact_duration() / mode.period(), force = mode.contact_force(0.0);
  return {mode.frequency_ratio(), fraction * force, force, fraction};
}

const Sampled& sampled_at(const std::vector<Sampled>& rows, int harmonics, int per_harmonic) {
  return *std::find_if(rows.begin(), rows.end(), [&](const Sampled& row) {
    return row.harmonics == harmonics && row.samples == per_harmonic * harmonics;
  });
}

Table sampled_table(const std::vector<Sampled>& rows) {
  Table table({"harmonics", "samples", "frequency_ratio", "mean_force_N", "largest_force_N",
               "contact_fraction", "status"});
  for (const Sampled& row : rows)
    table.append_row({std::int64_t{row.harmonics}, std::int64_t{row.samples}, row.frequency, row.mean_force,
                      row.largest_force, row.contact_fraction, row.status});
  return table;
}

void add_panel(app::Figure& figure, const std::string& title, const std::string& label,
               const std::vector<Sampled>& rows, double (*value)(const Sampled&, const ExactContact&),
               const ExactContact& exact, app::Axis ordinate) {
  auto& panel = figure.add_panel(title);
  panel.x = axis("Samples per harmonic, m/N", 1.7, 19.0);
  panel.x.logarithmic = true;
  panel.x.ticks.assign(std::begin(samples_per_harmonic), std::end(samples_per_harmonic));
  panel.x.tick_format = "%g";
  panel.y = std::move(ordinate);
  panel.y.label = label;
  int marker = 0;
  for (const int harmonics : harmonics_shown) {
    std::vector<double> x, y;
    for (const int per_harmonic : samples_per_harmonic) {
      const Sampled& row = sampled_at(rows, harmonics, per_harmonic);
      x.push_back(per_harmonic);
      y.push_back(value(row, exact));
    }
    Series series(fmt::format("N = {}", harmonics), x, y, app::SeriesStyle::line_points);
    series.marker = ++marker;
    if (harmonics == main_harmonics) series.width = 3.0;
    panel.add(series);
  }
}

double frequency_error(const Sampled& row, const ExactContact& exact) {
  return row.frequency / exact.frequency - 1.0;
}
double relative_force(const Sampled& row, const ExactContact& exact) {
  return row.largest_force / exact.largest_force;
}
double relative_contact(const Sampled& row, const ExactContact& exact) {
  return row.contact_fraction / exact.contact_fraction;
}

app::Axis logarithmic(double lower, double upper, const std::vector<double>& ticks) {
  app::Axis result = axis("", lower, upper);
  result.logarithmic = true;
  result.ticks = ticks;
  result.tick_format = "%g";
  return result;
}

app::Figure drawn(const std::vector<Sampled>& rows, const ExactContact& exact) {
  app::Figure figure;
  figure.panel_width = 560;
  figure.panel_height = 260;
  add_panel(figure, "frequency", "Error of ω", rows, frequency_error, exact, axis("", -0.02, 0.04));
  add_panel(figure, "largest contact force, 1 is exact", "Force over exact", rows, relative_force, exact,
            logarithmic(0.2, 30.0, {0.3, 1.0, 3.0, 10.0, 30.0}));
  add_panel(figure, "samples in contact, 1 is exact", "Contact over exact", rows, relative_contact, exact,
            logarithmic(0.03, 4.0, {0.03, 0.1, 0.3, 1.0, 3.0}));
  figure.panels[0].mark_y(0.0);
  figure.panels[1].mark_y(1.0);
  figure.panels[2].mark_y(1.0);
  return figure;
}

/// Whether m = 4N and 8N are better than m = 2N for one N, by frequency, largest force and contact.
Reading reading_of(const std::vector<Sampled>& rows, const ExactContact& exact, int harmonics) {
  const Sampled& least = sampled_at(rows, harmonics, 2);
  std::vector<double> with_more, with_least;
  std::string measured;
  for (const int per_harmonic : {4, 8}) {
    const Sampled& more = sampled_at(rows, harmonics, per_harmonic);
    if (!least.found() || !more.found()) throw report::NotConverged("sampling of the rod's mode");
    with_more.push_back(std::abs(frequency_error(more, exact)));
    with_least.push_back(std::abs(frequency_error(least, exact)));
    for (const auto value : {relative_force, relative_contact}) {
      with_more.push_back(std::abs(value(more, exact) - 1.0));
      with_least.push_back(std::abs(value(least, exact) - 1.0));
    }
  }
  const auto row_text = [&](const Sampled& row) {
    return fmt::format("m = {}: error of ω {}, force {} and contact {} times the exact", row.samples,
                       percent(frequency_error(row, exact), 2), number(relative_force(row, exact), 3),
                       number(relative_contact(row, exact), 3));
  };
  return {fmt::format("N = {}", harmonics), report::lower(with_more, with_least),
          row_text(least) + "; " + row_text(sampled_at(rows, harmonics, 4)) + "; " +
              row_text(sampled_at(rows, harmonics, 8))};
}

/// The rows of the main number of harmonics, "344 kN with m = 10".
std::string forces_text(const std::vector<Sampled>& rows) {
  std::string text;
  for (const int per_harmonic : samples_per_harmonic) {
    const Sampled& row = sampled_at(rows, main_harmonics, per_harmonic);
    text += fmt::format("{}{} kN and {} of the period with m = {}", text.empty() ? "" : ", ",
                        number(1e-3 * row.largest_force, 4), percent(row.contact_fraction), row.samples);
  }
  return text;
}

void claim(report::Artefact& artefact, const std::vector<Sampled>& rows, const ExactContact& exact) {
  std::vector<Reading> readings;
  for (const int harmonics : harmonics_shown) readings.push_back(reading_of(rows, exact, harmonics));
  double least = std::numeric_limits<double>::infinity(), largest = 0.0;
  for (const int per_harmonic : samples_per_harmonic) {
    const double frequency = sampled_at(rows, main_harmonics, per_harmonic).frequency;
    least = std::min(least, frequency);
    largest = std::max(largest, frequency);
  }
  const Sampled &few = sampled_at(rows, main_harmonics, *std::begin(samples_per_harmonic)),
                &many = sampled_at(rows, main_harmonics, *std::rbegin(samples_per_harmonic));
  judge(
      artefact,
      {.place = "section 4",
       .quote = "In practical applications, it is usually required to have N significantly smaller than m.",
       .criterion = fmt::format(
           "at energy {}, m = 4N and 8N have lower errors of frequency, largest force and contact "
           "duration than m = 2N, the fewest samples that N harmonics take",
           number(sampled_energy)),
       .measured = fmt::format(
           "it helps with {} of {} numbers of harmonics. With N = {} the frequency changes by "
           "{} for all m, and the largest force and the contact are {}; exact {} kN and {}",
           report::agreeing(readings), readings.size(), main_harmonics, number(largest - least, 2),
           forces_text(rows), number(1e-3 * exact.largest_force, 4), percent(exact.contact_fraction)),
       .verdict = report::over(readings),
       .readings = readings,
       .claim = "Few harmonics N and many samples m",
       .headline =
           fmt::format("with N = {} and m = {} to {} the largest force grows from {} to {} kN; exact {} kN.",
                       main_harmonics, few.samples, many.samples, number(1e-3 * few.largest_force, 3),
                       number(1e-3 * many.largest_force, 4), number(1e-3 * exact.largest_force, 3))},
      "N harmonics can meet the gap at few samples only. Where a single one bears the force, its mean is fixed by "
      "the motion, so that it grows with m while the motion stays, and the contact shrinks to an instant.");
}

}  // namespace

void fig03_sampling(report::Artefact& artefact) {
  std::vector<Sampled> rows;
  for (const int harmonics : harmonics_shown)
    for (const int per_harmonic : samples_per_harmonic)
      rows.push_back(sampled(artefact, harmonics, per_harmonic * harmonics));
  const auto exact = exact_of(artefact.scene("rod.toml"));
  artefact.data(sampled_table(rows),
                "frequency over the linear one; forces at the samples in N; share of the samples "
                "in contact; missing where no motion was found");
  Table closed({"frequency_ratio", "mean_force_N", "largest_force_N", "contact_fraction"});
  closed.append_row({exact.frequency, exact.mean_force, exact.largest_force, exact.contact_fraction});
  artefact.more_data("exact", closed, "the same of the exact motion");
  artefact.picture(drawn(rows, exact));
  artefact.caption(fmt::format(
      "The rod's motion of energy {} with N harmonics and m samples, eq. (28). The thick line is N = {}; curves "
      "that coincide in (a) from 2 samples per harmonic on do not depend on m.",
      number(sampled_energy), main_harmonics));
  std::string absent;
  for (const Sampled& row : rows)
    if (!row.found())
      absent += fmt::format("{}N = {} and m = {} ({})", absent.empty() ? "" : ", ", row.harmonics,
                            row.samples, row.status);
  if (!absent.empty()) artefact.note("No motion was found, and no point is drawn, for " + absent + ".");
  claim(artefact, rows, exact);
}

}  // namespace wavebalance::ll10
